// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Without_bounds.h"
#include "support/error_field.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/marching_cubes/marching_cubes_in_slabs.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace marching_cubes_in_slabs_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;

/// Expects that slabs of that many planes follow on each other and together are the mesh.
template <class Traits>
void expect_same(const Traits& traits, const Isosurface_3<Kernel>& whole, std::size_t planes,
                 const Marching_cubes_options& options, const std::string& name) {
  std::vector<Kernel::Point_3> points;
  std::vector<Point_status> status;
  std::vector<std::array<std::size_t, 3>> triangles, expected(whole.triangles.size());
  std::size_t next_plane = 0;
  const auto totals =
      marching_cubes_in_slabs(traits,
                              [&](const Isosurface_slab_3<Kernel>& slab) {
                                EXPECT_EQ(slab.first_plane, next_plane);
                                EXPECT_EQ(slab.first_vertex, points.size());
                                EXPECT_EQ(slab.first_triangle, triangles.size());
                                next_plane = slab.end_plane;
                                points.insert(points.end(), slab.points.begin(), slab.points.end());
                                status.insert(status.end(), slab.vertex_status.begin(), slab.vertex_status.end());
                                triangles.insert(triangles.end(), slab.triangles.begin(), slab.triangles.end());
                              },
                              {.sampling = options, .planes_per_slab = planes});
  for (std::size_t t = 0; t < expected.size(); ++t)
    expected[t] = {whole.triangles[t][0], whole.triangles[t][1], whole.triangles[t][2]};
  EXPECT_EQ(points, whole.points) << name << ", " << planes << " planes per slab";
  EXPECT_EQ(status, whole.vertex_status) << name << ", " << planes << " planes per slab";
  EXPECT_EQ(triangles, expected) << name << ", " << planes << " planes per slab";
  EXPECT_EQ(totals.vertices, whole.points.size());
  EXPECT_EQ(totals.triangles, whole.triangles.size());
}

// Surfaces through nodes along lines and planes of the grid, ones that only touch zero there, so that parts without
// area reach through all slabs, ends, poles, and cells with vertices inside.
TEST(Marching_cubes_in_slabs, slabs_are_the_mesh_whatever_the_function_is) {
  const std::array<const char*, 16> functions = {"x^2+y^2+z^2-1",
                                                 "x^2+y^2+z^2-0.36",
                                                 "x^2+y^2-1",
                                                 "x^2-y^2",
                                                 "y^2-z^2",
                                                 "x*y*z",
                                                 "x",
                                                 "z",
                                                 "-(x^2+y^2)",
                                                 "-(x^2+y^2+max(0,z^2-0.25))",
                                                 "-max(0,x^2+y^2+z^2-0.5)",
                                                 "-abs(z)",
                                                 "sqrt(0.5-x^2-y^2)-z",
                                                 "z/x",
                                                 "tan(x)-y",
                                                 "sin(7*x)*cos(7*y)+sin(7*y)*cos(7*z)+sin(7*z)*cos(7*x)"};
  for (const char* text : functions) {
    const auto traits = make_analytic_traits<Kernel>(Expression_3(text), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
    const Marching_cubes_options options{.resolution = {21, 21, 41}};
    const auto whole = marching_cubes(traits, options);
    for (const std::size_t planes : {1u, 2u, 5u, 16u, 41u, 100u}) expect_same(traits, whole, planes, options, text);
    expect_same(Without_bounds(traits), whole, 7, options, text);
  }
}

TEST(Marching_cubes_in_slabs, slabs_are_the_mesh_of_random_samples) {
  std::mt19937 random(17);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int n = 0; n < 12; ++n)
    for (const auto& values : {std::vector{-0.7, -0.1, 0.2, 0.9}, std::vector{-1.0, -0.5, 0.0, 0.5, 1.0},
                               std::vector{-1.0, 0.0, 0.0, 1.0, nan}}) {
      Volume_3<Kernel> volume{Lattice_3<Kernel>({8, 7, 30}, CGAL::Bbox_3(0, 0, 0, 7, 6, 29)), {}};
      for (std::size_t i = 0; i < volume.lattice.number_of_nodes(); ++i)
        volume.values.push_back(values[random() % values.size()]);
      const Sampled_function_traits_3<Kernel> traits(volume);
      const std::string name = "volume " + std::to_string(n);
      for (const std::size_t planes : {3u, 10u})
        for (const auto position : {Vertex_position::LINEAR, Vertex_position::PROJECTED}) {
          const Marching_cubes_options options{.vertices = position};
          expect_same(traits, marching_cubes(traits, options), planes, options, name);
        }
    }
}

TEST(Marching_cubes_in_slabs, threads_change_nothing) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("x^2+y^2+z^2-1"), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  std::vector<Kernel::Point_3> one, many;
  const auto add_to = [](std::vector<Kernel::Point_3>& points) {
    return [&points](const Isosurface_slab_3<Kernel>& slab) {
      points.insert(points.end(), slab.points.begin(), slab.points.end());
    };
  };
  marching_cubes_in_slabs<CGAL::Sequential_tag>(traits, add_to(one), {.planes_per_slab = 9});
  marching_cubes_in_slabs<CGAL::Parallel_if_available_tag>(traits, add_to(many));
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one, many);
}

TEST(Marching_cubes_in_slabs, a_visitor_may_stop_and_a_slab_needs_a_plane) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("x^2+y^2+z^2-1"), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  struct Stop {};
  const auto stop = [](const auto&) { throw Stop(); };
  EXPECT_THROW(marching_cubes_in_slabs(traits, stop), Stop);
  const auto field = [&](const Slab_options& options) {
    return error_field([&] { marching_cubes_in_slabs(traits, stop, options); });
  };
  EXPECT_EQ(field({.planes_per_slab = 0}), "planes_per_slab");
  EXPECT_EQ(field({.sampling = {.resolution = 1}}), "sampling.resolution");
}

} // namespace marching_cubes_in_slabs_test
