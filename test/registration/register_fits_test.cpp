// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of meshes by fits to their vertices, which estimate their errors.
#include "support/fit_data.h"
#include "support/registration_cases.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/registration/register_surfaces.h>

#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace register_fits_test {

using namespace equiaffine;
using namespace equiaffine::test;
using namespace registration_cases;
using Fit = Fitted_function_traits_3<Kernel>;

/// A fit to a triangulation of the metaballs, or to its image under a map.
struct Fitted_mesh {
  std::vector<Point_3> points;
  Fit fit;

  Fitted_mesh(std::size_t nodes, double noise, const Map& map) : Fitted_mesh(image(nodes, noise, map)) {}

private:
  explicit Fitted_mesh(const Fit_mesh& mesh) : points(points_of(mesh)), fit(mesh, {.scale = 0}) {}

  static Fit_mesh image(std::size_t nodes, double noise, const Map& map) {
    Fit_mesh mesh = metaballs_mesh(nodes);
    if (noise > 0) add_noise(mesh, noise * mean_edge(mesh));
    for (const auto v : mesh.vertices()) mesh.point(v) = map(mesh.point(v));
    return mesh;
  }
};

TEST(Register_fits, independent_triangulations_have_the_map_of_their_surfaces) {
  Random random(1);
  const Map identity(CGAL::IDENTITY), map = random_map(random, 3, 2);
  const Fitted_mesh source(30, 0, identity), target(33, 0, map);
  const auto result = register_surfaces(source.fit, source.points, target.fit, target.points);
  ASSERT_TRUE(result.found());
  EXPECT_LT(error_of(result.best().map, map), 1e-4);
}

TEST(Register_fits_long, a_mesh_and_points_become_fits_at_the_same_scales) {
  Random random(2);
  const Map map = random_map(random, 2, 1);
  std::vector<std::pair<Point_3, int>> points;
  for (const Point_3& p : points_of(metaballs_mesh(33))) points.emplace_back(map(p), 0);
  const auto result = register_surfaces<CGAL::Parallel_if_available_tag>(
      metaballs_mesh(30), points, {}, {},
      parameters::point_map(CGAL::First_of_pair_property_map<std::pair<Point_3, int>>()));
  ASSERT_TRUE(result.found());
  EXPECT_LT(error_of(result.best().map, map), 1e-3);
  EXPECT_FALSE(result.is_by_triangles);
  EXPECT_TRUE(result.advice.empty());
}

TEST(Register_fits, a_scale_that_is_too_large_is_an_error_about_the_fit) {
  const Fit_mesh mesh = metaballs_mesh(10);
  try {
    register_surfaces(mesh, mesh, {.fit = {.scale = 100}});
    ADD_FAILURE() << "there is no error";
  } catch (const Input_error& error) {
    EXPECT_EQ(error.field(), "fit.scale");
  }
}

TEST(Register_fits, certainty_falls_with_the_estimated_error) {
  const Fitted_mesh exact(30, 0, Map(CGAL::IDENTITY)), noisy(30, 0.02, Map(CGAL::IDENTITY));
  const auto formula = metaballs();
  double sum = 0, noisy_sum = 0;
  for (std::size_t i = 0; i < exact.points.size(); i += 20) {
    const double of_exact = certainty(exact.fit, exact.points[i]);
    EXPECT_GE(of_exact, 0);
    EXPECT_LE(of_exact, 1);
    EXPECT_EQ(certainty(formula, exact.points[i]), 1);
    sum += of_exact;
    noisy_sum += certainty(noisy.fit, noisy.points[i]);
  }
  EXPECT_LT(noisy_sum, 0.8 * sum);
}

} // namespace register_fits_test
