// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of meshes by fits to their vertices, which estimate their errors.
#include "support/fit_data.h"
#include "support/registration_cases.h"
#include <equiaffine/Fitted_function_traits_3.h>
#include <equiaffine/register_surfaces.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

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
  explicit Fitted_mesh(const Fit_mesh& mesh) : points(points_of(mesh)), fit(mesh) {}

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

TEST(Register_fits, certainty_falls_with_the_estimated_error) {
  const Fitted_mesh exact(30, 0, Map(CGAL::IDENTITY)), noisy(30, 0.02, Map(CGAL::IDENTITY));
  const internal::Oracle_of_traits_3 oracle(exact.fit), noisy_oracle(noisy.fit);
  const auto exact_surface = metaballs();
  const internal::Oracle_of_traits_3 formula(exact_surface);
  double sum = 0, noisy_sum = 0;
  for (std::size_t i = 0; i < exact.points.size(); i += 20) {
    const Eigen::Vector3d p = coordinates_of(exact.points[i]), q = coordinates_of(noisy.points[i]);
    const double certainty = oracle.certainty(p);
    EXPECT_GE(certainty, 0);
    EXPECT_LE(certainty, 1);
    EXPECT_EQ(formula.certainty(p), 1);
    sum += certainty;
    noisy_sum += noisy_oracle.certainty(q);
  }
  EXPECT_LT(noisy_sum, 0.8 * sum);
}

} // namespace
