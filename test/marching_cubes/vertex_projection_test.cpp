// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

namespace vertex_projection_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Function = Analytic_function_traits_3<Kernel, Expression_3>;

double cosine(const Isosurface_3<Kernel>& a, const Isosurface_3<Kernel>& b, const std::array<std::uint32_t, 3>& t) {
  const auto normal = [&](const auto& p) { return CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]); };
  return normal(a.points) * normal(b.points);
}

std::size_t unconverged(const Isosurface_3<Kernel>& s) {
  return std::size_t(std::count(s.vertex_status.begin(), s.vertex_status.end(), Point_status::UNCONVERGED));
}

// The grid has more planes than one slab, which is projected before the next.
TEST(Vertex_projection, no_triangle_turns_over_in_many_planes_and_threads_change_nothing) {
  std::mt19937 random(3);
  std::size_t undone = 0;
  for (int n = 0; n < 3; ++n) {
    const std::array<std::size_t, 3> size = {16, 16, 70};
    Volume_3<Kernel> volume{Lattice_3<Kernel>(size, CGAL::Bbox_3(0, 0, 0, 15, 15, 69)), {}};
    const std::array<double, 6> values = {-1.0, -0.8, -0.1, 0.03, 0.4, 0.9};
    for (std::size_t v = 0; v < 16 * 16 * 70; ++v) volume.values.push_back(values[random() % 6]);
    const Sampled_function_traits_3<Kernel> traits(volume);
    const auto linear = marching_cubes(traits, {.vertices = Vertex_position::LINEAR});
    const auto one = marching_cubes<CGAL::Sequential_tag>(traits),
               many = marching_cubes<CGAL::Parallel_if_available_tag>(traits);
    ASSERT_EQ(linear.triangles, one.triangles);
    for (const auto& t : linear.triangles) ASSERT_GE(cosine(linear, one, t), 0);
    for (std::size_t v = 0; v < one.points.size(); ++v)
      if (one.vertex_status[v] == Point_status::UNCONVERGED) {
        ASSERT_EQ(one.points[v], linear.points[v]) << v;
      }
    EXPECT_GE(unconverged(one), one.repairs.flips_undone);
    EXPECT_EQ(one.points, many.points);
    EXPECT_EQ(one.function_evaluations, many.function_evaluations);
    undone += one.repairs.flips_undone;
  }
  EXPECT_GT(undone, 100u) << "the test shows nothing";
}

/// A function with samples that are not its values.
struct Traits_with_samples : Function {
  Volume_3<Kernel> volume;
  const Lattice_3<Kernel>& lattice() const { return volume.lattice; }
  double sample(std::size_t i, std::size_t j, std::size_t k) const { return volume(i, j, k); }
};

TEST(Vertex_projection, no_triangle_loses_its_area) {
  // Six vertices around the negative sample. Projected on the plane x = y, those on the edges that leave to the back
  // along x and to the front along y would both lie at the node.
  const CGAL::Bbox_3 box(0, 0, 0, 2, 2, 2);
  Traits_with_samples traits{Function(Expression_3("x-y"), box),
                             {Lattice_3<Kernel>({3, 3, 3}, box), std::vector<double>(27, 1.0)}};
  traits.volume.values[traits.volume.lattice.index(1, 1, 1)] = -1;
  const auto surface = marching_cubes(traits);
  EXPECT_EQ(surface.triangles.size(), 8u);
  for (const auto& t : surface.triangles) EXPECT_GT(cosine(surface, surface, t), 0);
  EXPECT_GT(surface.repairs.flips_undone, 0u);
  EXPECT_EQ(unconverged(surface), surface.repairs.flips_undone);
  EXPECT_EQ(surface.repairs.contracted_edges, 0u);
}

TEST(Vertex_projection, no_triangle_is_left_without_area_beside_samples_that_all_but_vanish) {
  std::mt19937 random(5);
  const CGAL::Bbox_3 box(0, 0, 0, 4, 4, 4);
  const std::array<const char*, 4> planes = {"x-2", "x+y-3", "x-y+2*z-1", "2*x+y+z-2"};
  const std::array<double, 8> values = {1, -1, 4e-16, -4e-16, 1e-15, -1e-15, 3, -3};
  for (int n = 0; n < 3000; ++n) {
    Traits_with_samples traits{Function(Expression_3(planes[random() % 4]), box),
                               {Lattice_3<Kernel>({5, 5, 5}, box), {}}};
    for (int v = 0; v < 125; ++v) traits.volume.values.push_back(values[random() % 8]);
    const auto surface = marching_cubes(traits);
    const auto at = [&](std::size_t v) {
      const auto& p = surface.points[v];
      return std::array<double, 3>{p.x(), p.y(), p.z()};
    };
    ASSERT_FALSE(internal::any_zero_area(surface.triangles, at)) << n;
  }
}

} // namespace vertex_projection_test
