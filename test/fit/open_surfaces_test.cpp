// SPDX-License-Identifier: GPL-3.0-or-later
// What samplers make of fits to surfaces with borders: a mesh that ends where the data end.
#include "support/fit_data.h"
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/remove_small_fragments.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace open_surfaces_test {

using namespace equiaffine;
using namespace equiaffine::test;
using Traits = Fitted_function_traits_3<Fit_kernel>;

/// The part of a surface in a box, which cuts it open, by its exact vertices.
Isosurface_3<Fit_kernel> surface_in(const std::string& text, const CGAL::Bbox_3& box) {
  return surface_of(formula(text, box), {.resolution = 24});
}

/// Remeshes the fit to a surface on a grid.
Isosurface_3<Fit_kernel> remesh(const Traits& traits, std::size_t nodes) {
  const CGAL::Bbox_3 box = traits.bbox();
  const double step = std::hypot(box.x_span(), box.y_span(), box.z_span()) / double(nodes - 1);
  return marching_cubes<CGAL::Parallel_if_available_tag>(traits.in_band(2 * step), {.resolution = nodes});
}

void expect_all_on_surface(const Isosurface_3<Fit_kernel>& surface, const Traits& traits) {
  EXPECT_GT(surface.points.size(), 500u);
  EXPECT_TRUE(mesh_topology(surface.triangles, surface.points.size()).is_manifold);
  std::size_t with_expansion = 0;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    ASSERT_EQ(surface.vertex_status[v], Point_status::REGULAR) << surface.points[v];
    ASSERT_LT(std::abs(traits.value(surface.points[v])), 1e-12) << surface.points[v];
    with_expansion += std::isfinite(traits.taylor(surface.points[v]).value()); // by polynomials alone
  }
  EXPECT_GE(double(with_expansion), 0.999 * double(surface.points.size()));
}

TEST(Open_surface_long, every_vertex_of_a_remesh_lies_on_the_fitted_surface) {
  const std::string balls = "exp(-4*((x-.45)^2+y^2+z^2))+exp(-4*((x+.45)^2+(y-.2)^2+z^2))"
                            "+exp(-4*(x^2+(y+.35)^2+(z-.45)^2))+exp(-4*((x-.1)^2+(y-.45)^2+(z+.35)^2))";
  const Isosurface_3<Fit_kernel> surfaces[] = {
      surface_in("x^2+y^2+z^2-1", {-1.2, -1.2, 0, 1.2, 1.2, 1.2}),
      surface_in("(sqrt(x^2+y^2)-1)^2+z^2-0.16", {-1.5, 0, -.5, 1.5, 1.5, .5}),
      surface_in("z-0.3*sin(3*x)*cos(2*y)", {-1.03, -1.02, -1.1, 1.05, 1.04, 1}),
      surface_in("0.6-" + balls, {-1, -1, -0.15, 0.5, 1, 1}),
  };
  for (const auto& surface : surfaces) {
    const Traits traits(surface.points, surface.triangles, {.scale = 0});
    for (const std::size_t nodes : {30, 50}) expect_all_on_surface(remesh(traits, nodes), traits);
  }
}

TEST(Open_surface, a_remesh_has_the_topology_of_the_data_and_ends_where_they_end) {
  const auto hemisphere = surface_in("x^2+y^2+z^2-1", {-1.2, -1.2, 0, 1.2, 1.2, 1.2});
  const auto surface = remesh(Traits(hemisphere.points, hemisphere.triangles, {.scale = 0}), 40);
  const auto topology = mesh_topology(surface.triangles, surface.points.size());
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.euler_characteristic, 1);
  double lowest = 1;
  for (const auto& p : surface.points) {
    EXPECT_NEAR((p - CGAL::ORIGIN).squared_length(), 1, 1e-4);
    lowest = std::min(lowest, p.z());
  }
  EXPECT_GT(lowest, -0.04); // a quarter of the spacing of the data
  EXPECT_LT(lowest, 0.04);
}

TEST(Open_surface, a_closed_surface_stays_closed_also_as_random_points) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Fit_kernel::Point_3> points;
  for (int n = 0; n < 3000; ++n) {
    const Fit_kernel::Vector_3 v(normal(random), normal(random), normal(random));
    points.push_back(CGAL::ORIGIN + v / std::sqrt(v.squared_length()));
  }
  EXPECT_TRUE(CGAL::is_closed(to_surface_mesh(remesh(Traits(points, {.scale = 0}), 40))));
}

/// A fit that knows no more than remove_small_fragments() asks for.
struct Spaced {
  double spacing(const Fit_kernel::Point_3&) const { return .1; }
  CGAL::Bbox_3 bbox() const { return {-1, -1, -1, 1, 1, 1}; }
};

TEST(Open_surface, small_fragments_with_a_border_are_removed_unless_the_box_cuts_them_off) {
  Isosurface_3<Fit_kernel> surface;
  const auto add_triangle = [&](double x, double size) {
    const auto n = std::uint32_t(surface.points.size());
    for (const Fit_kernel::Point_3& p : {Fit_kernel::Point_3(x, 0, 0), {x + size, 0, 0}, {x, size, 0}})
      surface.points.push_back(p);
    surface.triangles.push_back({n, n + 1, n + 2});
    surface.vertex_status.resize(surface.points.size(), Point_status::REGULAR);
  };
  add_triangle(-.5, .1); // removed: 2.5 spacings are larger
  add_triangle(0, .3);
  add_triangle(.89, .1); // at the side of the box
  remove_small_fragments(surface, Spaced(), {21, 21, 21});
  ASSERT_EQ(surface.points.size(), 6U);
  EXPECT_EQ(surface.points[0], Fit_kernel::Point_3(0, 0, 0));
  EXPECT_EQ(surface.points[3], Fit_kernel::Point_3(.89, 0, 0));
  EXPECT_EQ(surface.triangles[1], (std::array<std::uint32_t, 3>{3, 4, 5}));
}

TEST(Open_surface, sheets_nearer_than_the_steps_of_a_grid_are_counted) {
  std::vector<Fit_kernel::Point_3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  constexpr std::uint32_t n = 20;
  for (const double z : {0., .03})
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < n; ++j) {
        const auto v = std::uint32_t(points.size());
        points.emplace_back(.05 * i, .05 * j, z + .1 * std::sin(.1 * i) * std::cos(.1 * j));
        if (i + 1 == n || j + 1 == n) continue;
        triangles.push_back({v, v + n, v + n + 1});
        triangles.push_back({v, v + n + 1, v + 1});
      }
  const Traits traits(points, triangles, {.scale = 0});
  const Close_sheets sheets = traits.close_sheets<CGAL::Parallel_if_available_tag>(.05);
  EXPECT_GT(sheets.points, points.size() / 2);
  EXPECT_NEAR(sheets.distance, .03, .01);
  EXPECT_GT(sheets.resolution, 40U);
  EXPECT_EQ(traits.close_sheets(.01).points, 0U);
}

} // namespace open_surfaces_test
