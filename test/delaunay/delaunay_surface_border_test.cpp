// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/meshed_surfaces.h"
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delaunay_surface_border_test {

using namespace equiaffine;
using namespace meshed_surfaces;
namespace functions = equiaffine::analytic_functions;

TEST(Delaunay_surface, the_boundary_lies_on_the_sphere_that_cuts_a_surface_off) {
  const auto surface =
      delaunay_surface(traits_of(functions::Barth_sextic{0.3}), {.radius = 0.1, .clip = Clip_domain_3({0, 0, 0}, 1.7)});
  const auto is_boundary = is_on_boundary(surface);
  std::size_t on_sphere = 0;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    const double distance = std::abs(std::sqrt((surface.points[v] - CGAL::ORIGIN).squared_length()) - 1.7);
    EXPECT_EQ(is_boundary[v], distance < 1e-14) << surface.points[v];
    on_sphere += is_boundary[v];
  }
  EXPECT_GT(on_sphere, 50u);
}

TEST(Delaunay_surface, the_boundary_lies_on_the_faces_of_the_box_and_has_vertices_on_its_edges) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  const auto traits = make_analytic_traits<Kernel>(Expression_3("x^2+y^2+z^2-2.2"), box); // a piece at each corner
  const auto surface = delaunay_surface(traits, {.radius = 0.08});
  EXPECT_EQ(topology(surface).components, 8u);
  const auto is_boundary = is_on_boundary(surface);
  int corners = 0;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    int planes = 0;
    for (int a = 0; a < 3; ++a) planes += std::abs(surface.points[v][a]) == 1;
    EXPECT_EQ(is_boundary[v], planes > 0) << surface.points[v];
    corners += planes == 2;
  }
  EXPECT_EQ(corners, 24);
  expect_vertices_on_surface(traits, surface, Clip_domain_3(box).diagonal());
}

TEST(Delaunay_surface, no_vertex_is_outside_of_the_box_where_a_surface_leaves_it_in_fine_waves) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  const auto surface =
      delaunay_surface(make_analytic_traits<Kernel>(Expression_3("x-z+1e-3*sin(1e3*y)"), box), {.radius = 0.1});
  EXPECT_FALSE(surface.triangles.empty());
  for (const Point_3& p : surface.points) ASSERT_TRUE(Clip_domain_3(box).contains(p)) << p;
}

TEST(Delaunay_surface, curves_on_the_border_nearer_than_facets_are_large_are_kept_apart) {
  const CGAL::Bbox_3 box(-3, -3, -3, 3, 3, 3);
  const auto traits = make_analytic_traits<Kernel>(Expression_3("sin(3*x)*sin(3*y)*sin(3*z)-0.2"), box);
  const auto surface = delaunay_surface(traits);
  EXPECT_EQ(topology(surface).components, 108u);
  EXPECT_EQ(topology(surface).euler_characteristic, 108);
  EXPECT_TRUE(topology(surface).is_manifold);
  EXPECT_TRUE(surface.is_certified);
}

TEST(Delaunay_surface, beside_features_angles_are_as_large_as_elsewhere) {
  const auto surface = delaunay_surface(traits_of(functions::Gyroid()), {.radius = 0.2});
  EXPECT_GT(topology(surface).boundary_edges, 500u);
  EXPECT_GE(smallest_angle(surface, std::vector<bool>(surface.points.size(), false)), 29.999);
  EXPECT_TRUE(topology(surface).is_manifold);
  EXPECT_EQ(topology(surface).euler_characteristic, -3);
}

TEST(Delaunay_surface, a_function_may_be_undefined_in_a_part_of_the_box) {
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3("log(x)-z"), box));
  EXPECT_EQ(topology(surface).components, 1u);
  EXPECT_EQ(topology(surface).euler_characteristic, 1);
  EXPECT_TRUE(topology(surface).is_manifold);
  EXPECT_FALSE(surface.is_certified);
  const auto is_boundary = is_on_boundary(surface);
  for (std::size_t v = 0; v < surface.points.size(); ++v)
    if (is_boundary[v]) {
      const Point_3& p = surface.points[v];
      EXPECT_TRUE(std::abs(p.y()) == 2 || std::abs(p.z()) == 2 || p.x() == 2) << p;
    }
}

TEST(Delaunay_surface, the_border_follows_the_curves_where_the_function_ends) {
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  const double radius = 0.15;
  const auto distance_to_circle = [](const Point_3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()); };
  const auto distance_to_line = [](const Point_3& p) { return std::hypot(p.x(), p.z()); };
  const auto distance_to_plane = [](const Point_3& p) { return std::abs(p.x() + p.y() + p.z() / 2 - 0.1); };
  const auto expect_end = [&](const char* text, long euler_characteristic, const auto& distance) {
    const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box), {.radius = radius});
    const auto t = topology(surface);
    EXPECT_TRUE(t.is_manifold) << text;
    EXPECT_EQ(t.components, 1u) << text;
    EXPECT_EQ(long(t.euler_characteristic), euler_characteristic) << text;
    const auto is_boundary = is_on_boundary(surface);
    std::size_t at_end = 0;
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
      const Point_3& p = surface.points[v];
      if (!is_boundary[v] || std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())}) == 2) continue;
      EXPECT_LT(distance(p), radius / 100) << text << " at " << p;
      ++at_end;
    }
    EXPECT_GT(at_end, 25u) << text;
  };
  expect_end("sqrt(x^2+y^2-1)-z", 0, distance_to_circle);
  expect_end("sqrt(1-x^2-y^2)-z", 1, distance_to_circle);
  expect_end("sqrt(x)-z", 1, distance_to_line);
  expect_end("x*log(x)-z", 1, distance_to_line);
  expect_end("x^2+y^2+z^2-1+0*sqrt(x+y+z/2-.1)", 1, distance_to_plane);
}

TEST(Delaunay_surface, strips_between_faces_of_the_box_much_narrower_than_facets_are_whole) {
  for (const double thickness : {0.1, 0.02, 0.004}) {
    const CGAL::Bbox_3 slice(-2, -2, -thickness / 2, 2, 2, thickness / 2);
    const auto surface = delaunay_surface(make_analytic_traits<Kernel>(functions::Sphere(), slice), {.radius = 0.11});
    const auto t = topology(surface);
    EXPECT_TRUE(t.is_manifold) << thickness;
    EXPECT_EQ(t.components, 1u) << thickness;
    EXPECT_EQ(t.euler_characteristic, 0) << thickness;
    EXPECT_GT(t.boundary_edges, 0u) << thickness;
    EXPECT_TRUE(surface.is_certified) << thickness;
  }
}

TEST(Delaunay_surface, a_plane_beside_an_edge_of_the_box_is_meshed_at_any_size) {
  const CGAL::Bbox_3 box(0, 0, -1, 1, 1, 1);
  for (const char* text : {"x+y-0.2", "x+y-0.02"})
    for (const double radius : {0.4, 0.2, 0.1, 0.05}) {
      const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box), {.radius = radius});
      const auto t = topology(surface);
      EXPECT_TRUE(t.is_manifold) << text << radius;
      EXPECT_EQ(t.components, 1u) << text << radius;
      EXPECT_EQ(t.euler_characteristic, 1) << text << radius;
      EXPECT_TRUE(surface.is_certified) << text << radius;
    }
}

TEST(Delaunay_surface, components_at_any_face_and_edge_of_the_box_are_found) {
  const auto expect_two = [](const char* text, const CGAL::Bbox_3& box, double radius) {
    const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box), {.radius = radius});
    EXPECT_EQ(topology(surface).components, 2u) << text;
    EXPECT_TRUE(surface.is_certified) << text;
  };
  const CGAL::Bbox_3 cube(-2, -2, -2, 2, 2, 2), slab(-1, -1, 0, 1, 1, 0.1);
  expect_two("min(x^2+y^2+z^2-1, (x-1.31)^2+(y-2)^2+(z-2)^2-1e-3)", cube, 0.1);
  expect_two("min(x^2+y^2+z^2-1, (x-1.31)^2+(y+2)^2+(z-2)^2-1e-3)", cube, 0.1);
  expect_two("min(0.1-1e-6+(x-.313)^2+(y-.217)^2-z, (x+.5)^2+(y+.5)^2+(z-.05)^2-.0004)", slab, 0.03);
  expect_two("min(-1e-6+(x-.313)^2+(y-.217)^2+z, (x+.5)^2+(y+.5)^2+(z-.05)^2-.0004)", slab, 0.03);
}

TEST(Delaunay_surface, a_surface_that_touches_the_box_in_an_edge_ends) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  for (const char* text : {"x+y-2", "x^2+y^2-2", "x-y"})
    EXPECT_FALSE(delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box)).is_certified) << text;
}

TEST(Delaunay_surface, a_cap_cut_off_by_the_border_is_found) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("x^2+y^2+(z-1.49)^2-0.25"), // reaches 0.01 inside
                                                   CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto surface = delaunay_surface(traits, {.radius = 0.01});
  EXPECT_GT(surface.triangles.size(), 100u);
  EXPECT_EQ(topology(surface).components, 1u);
}

} // namespace delaunay_surface_border_test
