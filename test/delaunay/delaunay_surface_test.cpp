// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/sample_on_lattice.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/mesh/mesh_topology.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace delaunay_surface_test {

using namespace equiaffine;
namespace functions = equiaffine::analytic_functions;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Surface = Delaunay_surface_3<Kernel>;

template <class Function>
auto traits_of(const Function& f) {
  return make_analytic_traits<Kernel>(f, f.box());
}

Mesh_topology topology(const Surface& surface) { return mesh_topology(surface.triangles, surface.points.size()); }

/// Of the triangles without a vertex on a feature.
double smallest_angle(const Surface& surface, const std::vector<bool>& is_on_feature) {
  double smallest = 180;
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (!is_on_feature[t[0]] && !is_on_feature[t[1]] && !is_on_feature[t[2]])
        smallest = std::min(smallest, CGAL::approximate_angle(surface.points[t[(i + 1) % 3]], surface.points[t[i]],
                                                              surface.points[t[(i + 2) % 3]]));
  return smallest;
}

/// Per vertex; a boundary edge is one of a single triangle.
std::vector<bool> is_on_boundary(const Surface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles;
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++triangles[std::minmax(t[i], t[(i + 1) % 3])];
  std::vector<bool> result(surface.points.size(), false);
  for (const auto& [edge, n] : triangles)
    if (n == 1) result[edge.first] = result[edge.second] = true;
  return result;
}

template <class Traits>
void expect_vertices_on_surface(const Traits& traits, const Surface& surface, double diagonal) {
  for (const Point_3& p : surface.points) ASSERT_LE(distance_estimate(first_order(traits, p)), 1e-14 * diagonal) << p;
  for (const Point_status status : surface.vertex_status) ASSERT_EQ(status, Point_status::REGULAR);
  ASSERT_EQ(surface.vertex_status.size(), surface.points.size());
}

struct Expected {
  double radius;
  long components, euler_characteristic;
  bool is_closed = true;
};

template <class Function>
void expect_mesh(const Function& f, const Expected& expected, const Clip_domain_3& domain) {
  const auto traits = traits_of(f);
  const auto surface = delaunay_surface(traits, {30, expected.radius, 0}, parameters::clip(domain));
  const auto t = topology(surface);
  EXPECT_TRUE(t.is_manifold);
  EXPECT_EQ(t.boundary_edges == 0, expected.is_closed);
  EXPECT_EQ(long(t.components), expected.components);
  EXPECT_EQ(long(t.euler_characteristic), expected.euler_characteristic);
  EXPECT_TRUE(surface.is_certified);
  EXPECT_TRUE(surface.undecided_boxes.empty());
  EXPECT_GE(smallest_angle(surface, is_on_boundary(surface)), 29.999);
  EXPECT_GT(surface.triangles.size(), 1000u);
  EXPECT_LE(double(surface.function_evaluations), 60 * double(surface.triangles.size()));
  expect_vertices_on_surface(traits, surface, domain.diagonal());
}

template <class Function>
void expect_mesh(const Function& f, const Expected& expected) {
  expect_mesh(f, expected, Clip_domain_3(f.box()));
}

TEST(Delaunay_surface, the_sphere) { expect_mesh(functions::Sphere(), {0.07, 1, 2}); }
TEST(Delaunay_surface, the_torus) { expect_mesh(functions::Torus(), {0.04, 1, 0}); }
TEST(Delaunay_surface, blobby_is_two_nested_spheres) { expect_mesh(functions::Blobby(), {0.06, 2, 4}); }
TEST(Delaunay_surface, the_tanglecube_has_genus_5) { expect_mesh(functions::Tanglecube(), {0.15, 1, -8}); }
TEST(Delaunay_surface, chmutovs_sextic_has_genus_28) { expect_mesh(functions::Chmutov_sextic(), {0.06, 1, -54}); }
TEST(Delaunay_surface, a_small_sphere_beside_a_large_one) { expect_mesh(functions::Two_spheres(), {0.1, 2, 4}); }

TEST(Delaunay_surface, sheets_outside_the_ball_make_no_holes) {
  expect_mesh(functions::Genus_two(), {0.08, 1, -2}, Clip_domain_3({0, 0, 0}, 2.5));
}

TEST(Delaunay_surface, a_sextic_is_cut_off_at_the_ball) {
  expect_mesh(functions::Barth_sextic{0.3}, {0.07, 1, -40, false}, Clip_domain_3({0, 0, 0}, 1.7));
}

TEST(Delaunay_surface, the_boundary_lies_on_the_sphere_that_cuts_a_surface_off) {
  const auto surface = delaunay_surface(traits_of(functions::Barth_sextic{0.3}), {30, 0.1, 0},
                                        parameters::clip(Clip_domain_3({0, 0, 0}, 1.7)));
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
  const auto surface = delaunay_surface(traits, {30, 0.08, 0});
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
      delaunay_surface(make_analytic_traits<Kernel>(Expression_3("x-z+1e-3*sin(1e3*y)"), box), {30, 0.1, 0});
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

TEST(Delaunay_surface, a_mesh_of_CGAL_gets_the_same_triangles_by_default_criteria) {
  const auto traits = traits_of(functions::Gyroid());
  const auto surface = delaunay_surface(traits, CGAL::parameters::verbose(false));
  CGAL::Surface_mesh<Point_3> mesh;
  const auto facts = delaunay_surface(traits, mesh);
  EXPECT_EQ(mesh.number_of_faces(), surface.triangles.size());
  EXPECT_GT(mesh.number_of_faces(), 1000u);
  EXPECT_EQ(facts.is_certified, surface.is_certified);
  EXPECT_TRUE(facts.triangles.empty());
}

TEST(Delaunay_surface, beside_features_angles_are_as_large_as_elsewhere) {
  const auto surface = delaunay_surface(traits_of(functions::Gyroid()), {30, 0.2, 0});
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
    const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box), {30, radius, 0});
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

TEST(Delaunay_surface, what_has_no_gradient_anywhere_ends_in_undecided_boxes) {
  const auto surface =
      delaunay_surface(make_analytic_traits<Kernel>(Expression_3("0"), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1)));
  EXPECT_TRUE(surface.triangles.empty());
  EXPECT_FALSE(surface.is_certified);
  EXPECT_FALSE(surface.undecided_boxes.empty());
}

TEST(Delaunay_surface, strips_between_faces_of_the_box_much_narrower_than_facets_are_whole) {
  for (const double thickness : {0.1, 0.02, 0.004}) {
    const CGAL::Bbox_3 slice(-2, -2, -thickness / 2, 2, 2, thickness / 2);
    const auto surface = delaunay_surface(make_analytic_traits<Kernel>(functions::Sphere(), slice), {30, 0.11, 0});
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
      const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box), {30, radius, 0});
      const auto t = topology(surface);
      EXPECT_TRUE(t.is_manifold) << text << radius;
      EXPECT_EQ(t.components, 1u) << text << radius;
      EXPECT_EQ(t.euler_characteristic, 1) << text << radius;
      EXPECT_TRUE(surface.is_certified) << text << radius;
    }
}

TEST(Delaunay_surface, components_at_any_face_and_edge_of_the_box_are_found) {
  const auto expect_two = [](const char* text, const CGAL::Bbox_3& box, double radius) {
    const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box), {30, radius, 0});
    EXPECT_EQ(topology(surface).components, 2u) << text;
    EXPECT_TRUE(surface.is_certified) << text;
  };
  const CGAL::Bbox_3 cube(-2, -2, -2, 2, 2, 2), slab(-1, -1, 0, 1, 1, 0.1);
  expect_two("min(x^2+y^2+z^2-1, (x-1.31)^2+(y-2)^2+(z-2)^2-1e-3)", cube, 0.1);
  expect_two("min(x^2+y^2+z^2-1, (x-1.31)^2+(y+2)^2+(z-2)^2-1e-3)", cube, 0.1);
  expect_two("min(0.1-1e-6+(x-.313)^2+(y-.217)^2-z, (x+.5)^2+(y+.5)^2+(z-.05)^2-.0004)", slab, 0.03);
  expect_two("min(-1e-6+(x-.313)^2+(y-.217)^2+z, (x+.5)^2+(y+.5)^2+(z-.05)^2-.0004)", slab, 0.03);
}

TEST(Delaunay_surface, triangles_beside_creases_are_oriented_as_their_neighbors_are) {
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  for (const char* text : {"min((x-.5)^2+y^2+z^2-1, (x+.5)^2+y^2+z^2-1)", "max((x-.5)^2+y^2+z^2-1, (x+.5)^2+y^2+z^2-1)",
                           "abs(x)+abs(y)+abs(z)-1"}) {
    const auto traits = make_analytic_traits<Kernel>(Expression_3(text), box);
    const auto surface = delaunay_surface(traits);
    const auto t = topology(surface);
    EXPECT_TRUE(t.is_manifold) << text;
    EXPECT_EQ(t.euler_characteristic, 2) << text;
    double volume = 0; // outwards is where f is positive
    for (const auto& [a, b, c] : surface.triangles)
      volume += CGAL::volume(Point_3(0, 0, 0), surface.points[a], surface.points[b], surface.points[c]);
    EXPECT_GT(volume, 0.5) << text;
  }
}

TEST(Delaunay_surface, what_is_not_a_manifold_is_not_certified) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1); // strips nearer to each other than the facets are large
  const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3("z-.9999-1e-3*sin(1e2*y)"), box));
  EXPECT_TRUE(topology(surface).is_manifold || !surface.is_certified);
  EXPECT_TRUE(surface.is_certified || !surface.undecided_boxes.empty());
}

TEST(Delaunay_surface, what_straddles_a_parabolic_curve_is_not_certified) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  const auto traits = make_analytic_traits<Kernel>(Expression_3("z-sin(3*x)*sin(2.5*y)/2"), box);
  const auto coarse = delaunay_surface(traits, {30, 0.5, 0}, parameters::parabolic_features());
  EXPECT_FALSE(coarse.is_certified);
  EXPECT_FALSE(coarse.undecided_boxes.empty());
  EXPECT_TRUE(delaunay_surface(traits, {30, 0.1, 0}, parameters::parabolic_features()).is_certified);
}

// At these radii the first mesh is so coarse that the pieces of parabolic curves found on it lead to the same curve.
TEST(Delaunay_surface, parabolic_curves_that_coincide_but_for_rounding_end_in_undecided_boxes) {
  struct Case {
    const char* text;
    double half_side, radius;
  };
  for (const auto& [text, h, radius] : {Case{"z-sin(3*x)*sin(2.5*y)/2", 1, 1}, Case{"z-sin(3*x)*sin(2.5*y)/2", 3, 1},
                                        Case{"z-sin(3*x)*sin(2.5*y)/2", 5, 1}, Case{"y^x-z-.5*z/x-x", 2, 0.5}}) {
    const auto traits = make_analytic_traits<Kernel>(Expression_3(text), CGAL::Bbox_3(-h, -h, -h, h, h, h));
    const auto surface = delaunay_surface(traits, {30, radius, 0}, parameters::parabolic_features());
    EXPECT_FALSE(surface.is_certified) << text;
    EXPECT_FALSE(surface.undecided_boxes.empty()) << text;
    EXPECT_FALSE(surface.triangles.empty()) << text;
    EXPECT_LT(surface.points.size(), CGAL_VERSION_MAJOR < 6 ? 2000u : 2500u)
        << text; // at most 1,294, and 2,154 with 6.2
  }
}

TEST(Delaunay_surface, poles_are_no_surfaces) {
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  const Delaunay_criteria criteria{30, 0.2, 0};
  EXPECT_TRUE(delaunay_surface(make_analytic_traits<Kernel>(Expression_3("1/x"), box), criteria).points.empty());
  const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3("1/x+y"), box), criteria);
  EXPECT_FALSE(surface.triangles.empty());
  for (const Point_3& p : surface.points) ASSERT_NEAR(p.x() * p.y(), -1, 1e-13) << p;
  const auto tangent = make_analytic_traits<Kernel>(Expression_3("tan(x)-y"), box);
  for (const double radius : {0.2, 0.0}) {
    const auto sheet = delaunay_surface(tangent, {30, radius, 0}); // between the poles at -pi/2 and pi/2
    const auto t = topology(sheet);
    EXPECT_TRUE(t.is_manifold) << radius;
    EXPECT_EQ(t.components, 1u) << radius;
    EXPECT_EQ(t.euler_characteristic, 1) << radius;
    const auto is_boundary = is_on_boundary(sheet);
    for (std::size_t v = 0; v < sheet.points.size(); ++v)
      EXPECT_TRUE(!is_boundary[v] || std::abs(sheet.points[v].y()) == 2 || std::abs(sheet.points[v].z()) == 2);
  }
}

TEST(Delaunay_surface, a_surface_is_found_on_a_segment_that_meets_a_pole_as_well) {
  const CGAL::Bbox_3 box(-5, -5, -5, 5, 5, 5);
  using Exact_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Implicit_mesh_domain_3 domain(make_analytic_traits<Kernel>(Expression_3("tan(x)-y"), box), Clip_domain_3(box),
                                      0.3);
  const auto meets = [&](double x_below, double x_above) {
    const Exact_kernel::Segment_3 segment({x_below, -3, 0}, {x_above, 3, 0.1});
    const auto [p, index, dimension] = domain.construct_intersection_object()(segment);
    EXPECT_TRUE(dimension == 0 || std::abs(std::tan(p.x()) - p.y()) < 1e-12) << p;
    return dimension == 2;
  };
  EXPECT_TRUE(meets(2, 1.45)) << "a pole and a root: no change of sign";
  EXPECT_TRUE(meets(2, -1.45)) << "a pole and two roots: a change of sign";
  EXPECT_FALSE(meets(-2, -1.45)) << "a pole alone";
}

TEST(Delaunay_surface, arguments_without_a_result_are_refused_in_every_build) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const auto sphere = traits_of(functions::Sphere());
  for (const Delaunay_criteria& criteria : {Delaunay_criteria{31, 0.1, 0},
                                            {-1, 0.1, 0},
                                            {nan, 0.1, 0},
                                            {30, -1, 0},
                                            {30, nan, 0},
                                            {30, infinity, 0},
                                            {30, 0.1, -1},
                                            {30, 0.1, infinity}})
    EXPECT_THROW(delaunay_surface(sphere, criteria), std::invalid_argument);
  const CGAL::Bbox_3 space(-infinity, -infinity, -infinity, infinity, infinity, infinity);
  EXPECT_THROW(delaunay_surface(make_analytic_traits<Kernel>(Expression_3("x"), space)), std::invalid_argument);
  for (const double size : {1e-41, 1e41}) {
    const CGAL::Bbox_3 box(-size, -size, -size, size, size, size);
    EXPECT_THROW(delaunay_surface(make_analytic_traits<Kernel>(Expression_3("x"), box)), std::invalid_argument) << size;
  }
  const CGAL::Bbox_3 far(1e14, 0, 0, 1e14 + 100, 100, 100);
  EXPECT_THROW(delaunay_surface(make_analytic_traits<Kernel>(Expression_3("z-50"), far)), std::invalid_argument);
  const Clip_domain_3 domain(sphere.bbox());
  for (const double size : {-1.0, nan, infinity}) {
    EXPECT_THROW(Implicit_mesh_domain_3(sphere, domain, size), std::invalid_argument);
    EXPECT_THROW(certified_seeding(
                     sphere, domain, [](const Point_3&) { return 1.0; }, size),
                 std::invalid_argument);
  }
}

TEST(Delaunay_surface, where_CGAL_gives_up_the_whole_box_is_undecided) {
  const CGAL::Bbox_3 box(-4, -4, -4, 4, 4, 4);
  const auto surface =
      delaunay_surface(make_analytic_traits<Kernel>(Expression_3("z-x*y*sin(x*y)"), box), {30, 0.1, 0});
  const bool gives_up = CGAL_VERSION_NR < 1060200000; // 6.2 does not
  EXPECT_EQ(surface.is_certified, !gives_up);
  EXPECT_EQ(std::count(surface.undecided_boxes.begin(), surface.undecided_boxes.end(), box), gives_up ? 1 : 0);
  EXPECT_FALSE(surface.triangles.empty());
}

TEST(Delaunay_surface, a_surface_that_touches_the_box_in_an_edge_ends) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  for (const char* text : {"x+y-2", "x^2+y^2-2", "x-y"})
    EXPECT_FALSE(delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box)).is_certified) << text;
}

TEST(Delaunay_surface_long, what_is_lost_is_not_certified) {
  const CGAL::Bbox_3 slice(-2, -2, -0.0005, 2, 2, 0.0005); // less than a fiftieth of the facets' radius thick
  const auto surface = delaunay_surface(make_analytic_traits<Kernel>(functions::Sphere(), slice));
  EXPECT_FALSE(surface.is_certified);
  EXPECT_FALSE(surface.undecided_boxes.empty());
}

TEST(Delaunay_surface, what_is_certified_has_the_topology_that_marching_cubes_find_on_a_fine_grid) {
  const int surfaces = 6;
  int certified = 0;
  for (unsigned seed = 1; seed <= surfaces; ++seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double a, double b) {
      return a + (b - a) * double(random()) / double(std::mt19937::max());
    };
    std::ostringstream waves;
    for (int n = 0; n < 5; ++n)
      waves << uniform(-1, 1) << "*sin(" << uniform(-2.2, 2.2) << "*x+" << uniform(-2.2, 2.2) << "*y+"
            << uniform(-2.2, 2.2) << "*z+" << uniform(0, 6.3) << ")+";
    waves << uniform(-0.3, 0.3);
    std::array<double, 6> side;
    for (double& s : side) s = uniform(1, 1.7);
    const CGAL::Bbox_3 box(-side[0], -side[1], -side[2], side[3], side[4], side[5]);
    const auto traits = make_analytic_traits<Kernel>(Expression_3(waves.str()), box);
    const auto surface = delaunay_surface(traits, {30, Clip_domain_3(box).diagonal() / 60, 0});
    if (!surface.is_certified) continue;
    ++certified;
    const auto fine = marching_cubes(traits, parameters::number_of_nodes(100));
    const auto expected = mesh_topology(fine.triangles, fine.points.size()), found = topology(surface);
    EXPECT_TRUE(found.is_manifold) << waves.str();
    EXPECT_EQ(found.components, expected.components) << waves.str();
    EXPECT_EQ(found.euler_characteristic, expected.euler_characteristic) << waves.str();
  }
  EXPECT_GE(certified, 4);
}

bool has_vertex(const Surface& surface, const Point_3& p) {
  return std::any_of(surface.points.begin(), surface.points.end(),
                     [&](const Point_3& q) { return CGAL::squared_distance(p, q) < 1e-24; });
}

TEST(Delaunay_surface, nodes_are_vertices) {
  const auto cayley = delaunay_surface(traits_of(functions::Cayley_cubic()), {30, 0.2, 0});
  for (const Point_3& node : {Point_3(1, 1, 1), Point_3(1, -1, -1), Point_3(-1, 1, -1), Point_3(-1, -1, 1)})
    EXPECT_TRUE(has_vertex(cayley, node)) << node;
}

TEST(Delaunay_surface, apexes_where_the_function_has_no_gradient_are_vertices) {
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  const auto mesh = [&](const char* text) {
    return delaunay_surface(make_analytic_traits<Kernel>(Expression_3(text), box), {30, 0.2, 0});
  };
  for (const char* half_cone : {"z-.2-sqrt((x-.1)^2+(y+.3)^2)", "z-.2-3*hypot(x-.1,y+.3)",
                                "z-.2-sqrt((x-.1)^2+(y+.3)^2)-.3*(x-.1)^2", "z-.2-abs(x-.1)-abs(y+.3)"}) {
    const auto surface = mesh(half_cone);
    EXPECT_TRUE(has_vertex(surface, {0.1, -0.3, 0.2})) << half_cone;
    EXPECT_TRUE(topology(surface).is_manifold) << half_cone;
    EXPECT_EQ(topology(surface).components, 1u) << half_cone;
    EXPECT_EQ(topology(surface).euler_characteristic, 1) << half_cone;
  }
  const auto cube = mesh("max(abs(x),max(abs(y),abs(z)))-1");
  EXPECT_EQ(topology(cube).euler_characteristic, 2);
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) EXPECT_TRUE(has_vertex(cube, {x, y, z})) << x << " " << y << " " << z;
}

TEST(Delaunay_surface, no_triangle_straddles_a_parabolic_curve) {
  const functions::Torus f;
  const auto surface = delaunay_surface(traits_of(f), {30, 0.1, 0}, parameters::parabolic_features());
  EXPECT_EQ(topology(surface).euler_characteristic, 0);
  EXPECT_TRUE(topology(surface).is_manifold);
  int on_curve = 0;
  for (const auto& t : surface.triangles) {
    int inner = 0, outer = 0;
    for (const auto v : t) {
      const Point_3& p = surface.points[v];
      const double distance = std::hypot(p.x(), p.y()) - f.major_radius; // K_e has its sign
      if (std::abs(distance) < 1e-14) ++on_curve;
      else ++(distance < 0 ? inner : outer);
    }
    EXPECT_TRUE(inner == 0 || outer == 0);
  }
  EXPECT_GT(on_curve, 200);
}

TEST(Delaunay_surface, no_triangle_straddles_parabolic_curves_that_cross_and_end_at_the_border) {
  const CGAL::Bbox_3 box(-4, -4, -4, 4, 4, 4);
  const auto traits = make_analytic_traits<Kernel>(Expression_3("z-sin(x)*sin(y)"), box); // lines, x+y and x-y constant
  const auto surface = delaunay_surface(traits, {30, 0.2, 0}, parameters::parabolic_features());
  EXPECT_TRUE(surface.is_certified);
  EXPECT_TRUE(topology(surface).is_manifold);
  EXPECT_EQ(topology(surface).euler_characteristic, 1);
  const auto K = [](const Point_3& p) { return -std::cos(p.x() + p.y()) * std::cos(p.x() - p.y()); }; // has its sign
  for (const auto& t : surface.triangles) {
    int negative = 0, positive = 0;
    for (const auto v : t)
      if (std::abs(K(surface.points[v])) > 1e-12) ++(K(surface.points[v]) < 0 ? negative : positive);
    EXPECT_TRUE(negative == 0 || positive == 0);
  }
  int at_border = 0, at_node = 0;
  for (const auto& curve : surface.parabolic_curves.polylines)
    for (const Point_3& p : {curve.points.front(), curve.points.back()}) {
      const bool is_node = std::abs(std::cos(p.x() + p.y())) < 1e-12 && std::abs(std::cos(p.x() - p.y())) < 1e-12;
      ++(is_node ? at_node : at_border);
      const double squared_reach = is_node ? 1e-24 : 0.04;
      EXPECT_TRUE(std::any_of(surface.points.begin(), surface.points.end(), [&](const Point_3& q) {
        const bool is_there = is_node || (std::max(std::abs(q.x()), std::abs(q.y())) == 4 && std::abs(K(q)) < 1e-12);
        return is_there && CGAL::squared_distance(p, q) <= squared_reach;
      })) << p;
    }
  EXPECT_EQ(at_node, 4 * 12);
  EXPECT_EQ(at_border, 2 * 12);
}

TEST(Delaunay_surface, edges_follow_a_curve_that_is_given) {
  const double radius = std::sqrt(0.75); // of the parallel of the unit sphere at z = 1/2
  Polyline_3<Kernel> parallel;
  for (int n = 0; n < 200; ++n) {
    const double angle = 2 * CGAL_PI * n / 200;
    parallel.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.5);
  }
  parallel.is_closed = true;
  const auto traits = traits_of(functions::Sphere());
  const auto surface = delaunay_surface(traits, {30, 0.2, 0}, parameters::feature_curves(std::vector{parallel}));
  EXPECT_EQ(topology(surface).euler_characteristic, 2);
  expect_vertices_on_surface(traits, surface, 1);
  const double sagitta = radius * (1 - std::cos(CGAL_PI / 200));
  for (const auto& t : surface.triangles) {
    int above = 0, below = 0;
    for (const auto v : t) {
      const double height = surface.points[v].z() - 0.5;
      if (std::abs(height) > sagitta) ++(height > 0 ? above : below);
    }
    EXPECT_TRUE(above == 0 || below == 0);
  }
}

TEST(Delaunay_surface, every_point_of_the_surface_is_near_the_mesh) {
  const double radius = 0.08, distance = 0.004;
  const auto surface = delaunay_surface(traits_of(functions::Sphere()), {30, radius, distance});
  for (const auto& t : surface.triangles) {
    const Point_3 c = CGAL::circumcenter(surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]);
    const double height = 1 - std::sqrt((c - CGAL::ORIGIN).squared_length());
    EXPECT_LE(height, distance);
    EXPECT_LE(CGAL::squared_distance(c, surface.points[t[0]]) + height * height, radius * radius * (1 + 1e-12));
  }
}

TEST(Delaunay_surface, the_image_of_a_surface_has_its_topology_and_vertices_on_it) {
  const functions::Tanglecube f;
  const Kernel::Aff_transformation_3 map(0.9, 0, 0.9, 0, 2, 0, 1.1, 0, 0.6);
  const Transformed_function_traits_3 traits(traits_of(f), map);
  const auto surface = delaunay_surface(traits, {30, 0.15, 0});
  EXPECT_TRUE(surface.is_certified);
  EXPECT_TRUE(surface.undecided_boxes.empty());
  EXPECT_EQ(topology(surface).components, 1u);
  EXPECT_EQ(topology(surface).euler_characteristic, -8);
  EXPECT_EQ(topology(surface).boundary_edges, 0u);
  EXPECT_TRUE(topology(surface).is_manifold);
  const double diagonal = Clip_domain_3(traits.bbox()).diagonal();
  expect_vertices_on_surface(traits, surface, diagonal);
}

TEST(Delaunay_surface, a_volume_is_meshed_like_its_function) {
  const functions::Torus torus;
  const auto traits = traits_of(torus);
  const Sampled_function_traits_3<Kernel> volume(sample_on_lattice(traits, sampling_lattice(traits, {40, 40, 24})));
  const auto surface = delaunay_surface(volume, {30, 0.06, 0});
  EXPECT_EQ(topology(surface).euler_characteristic, 0);
  EXPECT_EQ(topology(surface).components, 1u);
  EXPECT_TRUE(surface.is_certified);
  expect_vertices_on_surface(volume, surface, Clip_domain_3(torus.box()).diagonal());
}

TEST(Delaunay_surface, a_volume_without_values_outside_is_meshed_to_its_border) {
  for (const char* text : {"z-0.3", "z-0.3-0.2*x", "sin(3*x)*cos(3*y)+sin(3*y)*cos(3*z)+sin(3*z)*cos(3*x)"}) {
    const auto traits = make_analytic_traits<Kernel>(Expression_3(text), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
    const Sampled_function_traits_3<Kernel> volume(sample_on_lattice(traits, sampling_lattice(traits, {30, 30, 30})));
    const auto surface = delaunay_surface(volume), reference = delaunay_surface(traits);
    EXPECT_TRUE(topology(surface).is_manifold) << text;
    EXPECT_EQ(topology(surface).components, topology(reference).components) << text;
    EXPECT_EQ(topology(surface).euler_characteristic, topology(reference).euler_characteristic) << text;
    EXPECT_TRUE(surface.is_certified) << text;
    EXPECT_GE(smallest_angle(surface, std::vector<bool>(surface.points.size(), false)), 29.9) << text;
    const auto is_boundary = is_on_boundary(surface);
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
      const Point_3& p = surface.points[v];
      EXPECT_EQ(is_boundary[v], std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())}) == 1) << p;
    }
  }
}

TEST(Delaunay_surface, a_tiny_sphere_is_found_wherever_it_is) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1.9, 1.9);
  const int placements = 100;
  for (int found = 0; found < placements;) {
    functions::Two_spheres f;
    f.small_radius = 0.004; // a thousandth of the box
    f.center = {coordinate(random), coordinate(random), coordinate(random)};
    const double distance = std::hypot(f.center[0], f.center[1], f.center[2]);
    if (distance < 1.02) continue;
    const auto surface = delaunay_surface(traits_of(f), {30, 0.4, 0});
    const auto t = topology(surface);
    ASSERT_EQ(t.components, 2u) << f.center[0] << ' ' << f.center[1] << ' ' << f.center[2];
    ASSERT_EQ(t.euler_characteristic, 4);
    ASSERT_TRUE(t.is_manifold && t.boundary_edges == 0 && surface.is_certified);
    ++found;
  }
}

struct Three_planes {
  auto operator()(const auto& x, const auto& y, const auto& z) const { return x * y * z; }
  CGAL::Bbox_3 box() const { return CGAL::Bbox_3(-1, -1.1, -1.2, 1.1, 1, 1); }
};

struct Cone {
  auto operator()(const auto& x, const auto& y, const auto& z) const { return x * x + y * y - z * z; }
  CGAL::Bbox_3 box() const { return CGAL::Bbox_3(-1, -1.1, -1.2, 1.1, 1, 1); }
};

template <class Function>
Surface singular_surface(const Function& f) {
  const auto surface = delaunay_surface(traits_of(f), {30, 0.2, 0});
  EXPECT_FALSE(surface.is_certified);
  EXPECT_FALSE(surface.undecided_boxes.empty());
  EXPECT_GT(surface.triangles.size(), 100u);
  return surface;
}

bool is_covered(const Surface& surface, const Point_3& p) {
  return std::any_of(surface.undecided_boxes.begin(), surface.undecided_boxes.end(),
                     [&](const CGAL::Bbox_3& box) { return CGAL::do_overlap(box, p.bbox()); });
}

TEST(Delaunay_surface, singular_points_end_in_undecided_boxes) {
  const auto cayley = singular_surface(functions::Cayley_cubic());
  for (const Point_3& node : {Point_3(1, 1, 1), Point_3(1, -1, -1), Point_3(-1, 1, -1), Point_3(-1, -1, 1)})
    EXPECT_TRUE(is_covered(cayley, node)) << node;
  EXPECT_TRUE(is_covered(singular_surface(Cone()), Point_3(0, 0, 0)));
}

TEST(Delaunay_surface, singular_curves_end_in_undecided_boxes) {
  const auto planes = singular_surface(Three_planes());
  for (double t = -0.95; t < 1; t += 0.1)
    for (const Point_3& p : {Point_3(t, 0, 0), Point_3(0, t, 0), Point_3(0, 0, t)}) EXPECT_TRUE(is_covered(planes, p));
}

TEST(Delaunay_surface, an_empty_surface_is_certified) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("x^2+y^2+z^2+1"), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto surface = delaunay_surface(traits);
  EXPECT_TRUE(surface.triangles.empty() && surface.points.empty());
  EXPECT_TRUE(surface.is_certified);
}

TEST(Delaunay_surface, a_cap_cut_off_by_the_border_is_found) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("x^2+y^2+(z-1.49)^2-0.25"), // reaches 0.01 inside
                                                   CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto surface = delaunay_surface(traits, {30, 0.01, 0});
  EXPECT_GT(surface.triangles.size(), 100u);
  EXPECT_EQ(topology(surface).components, 1u);
}

/// Where the surface meets the line through the circumcenter of a triangle, orthogonal to it: the center of its surface
/// Delaunay ball.
template <class Traits>
Point_3 center_of_ball(const Traits& traits, const Point_3& p, const Point_3& q, const Point_3& r) {
  const Kernel::Vector_3 normal = CGAL::cross_product(q - p, r - p);
  Point_3 center = CGAL::circumcenter(p, q, r);
  for (int n = 0; n < 20; ++n) {
    const auto c = first_order(traits, center).coefficients();
    center = center - c[0] / (Kernel::Vector_3(c[1], c[2], c[3]) * normal) * normal;
  }
  return center;
}

TEST(Delaunay_surface, facets_have_the_size_of_their_place) {
  const functions::Ellipsoid f; // its smallest radius of curvature is 1/6, at the tips of the longest axis
  const auto traits = traits_of(f);
  const double radius = 0.15, extent = Clip_domain_3(f.box()).diagonal() / 4;
  for (const Facet_sizing sizing : {Facet_sizing::UNIFORM, Facet_sizing::EUCLIDEAN, Facet_sizing::AFFINE}) {
    const auto surface = delaunay_surface(traits, {30, radius, 1}, parameters::facet_sizing(sizing));
    EXPECT_EQ(topology(surface).euler_characteristic, 2);
    double largest = 0, largest_at_tip = 0;
    for (const auto& t : surface.triangles) {
      const Point_3 &p = surface.points[t[0]], &q = surface.points[t[1]], &r = surface.points[t[2]];
      const Point_3 center = center_of_ball(traits, p, q, r);
      const auto e = local_structure_at(traits, center).euclidean;
      const double bound = sizing == Facet_sizing::UNIFORM ? radius
                           : sizing == Facet_sizing::EUCLIDEAN
                               ? 0.25 / std::max(std::abs(e.k1), std::abs(e.k2))
                               : radius * std::pow(e.gaussian_curvature * extent * extent, -0.125);
      const double size = std::sqrt(CGAL::squared_distance(center, p));
      EXPECT_LE(size, std::min(bound, radius) * (1 + 1e-9)) << center;
      largest = std::max(largest, size);
      if (std::abs(center.x()) > 1.45) largest_at_tip = std::max(largest_at_tip, size);
      if (sizing == Facet_sizing::UNIFORM) {
        // Every vertex was inserted outside of all balls of that radius, and facets are inscribed in them.
        EXPECT_GE(CGAL::squared_distance(p, q), radius * radius);
        EXPECT_LE(CGAL::squared_distance(p, q), 4 * radius * radius);
      }
    }
    EXPECT_GT(largest, 0.9 * radius) << "no smaller than asked for";
    if (sizing == Facet_sizing::UNIFORM) {
      EXPECT_GT(largest_at_tip, 0.9 * radius);
    }
  }
}

struct Affine_areas {
  double number, deviation; ///< of the facets; of their affine areas, relative to the mean
};

template <class Traits>
Affine_areas affine_areas(const Traits& traits, Facet_sizing sizing) {
  // Nowhere is the curvature so small, compared to that of a sphere in this box, that the size is cut off.
  const Clip_domain_3 domain(CGAL::Bbox_3(-12, -12, -12, 12, 12, 12));
  const auto surface = delaunay_surface(traits, {30, 0.1, 1}, parameters::clip(domain).facet_sizing(sizing));
  double sum = 0, sum_of_squares = 0;
  for (const auto& t : surface.triangles) {
    const Point_3 &p = surface.points[t[0]], &q = surface.points[t[1]], &r = surface.points[t[2]];
    const double K_e = local_structure_at(traits, CGAL::centroid(p, q, r)).euclidean.gaussian_curvature;
    const double area = std::pow(K_e, 0.25) * std::sqrt(CGAL::squared_area(p, q, r));
    sum += area;
    sum_of_squares += area * area;
  }
  const double n = double(surface.triangles.size());
  return {n, std::sqrt(n * sum_of_squares - sum * sum) / sum};
}

TEST(Delaunay_surface, facets_of_equal_affine_area_are_as_many_on_all_affine_images_of_a_surface) {
  const auto sphere = traits_of(functions::Sphere());
  const auto ellipsoid = traits_of(functions::Ellipsoid{3, 1, 1.0 / 3});
  const Kernel::Aff_transformation_3 map(1.5, 0.3, 0, 0, 1, 0.4, 0.2, 0, 0.65066666666666662); // determinant 1
  const Transformed_function_traits_3 sheared(sphere, map);
  const auto expected = affine_areas(sphere, Facet_sizing::AFFINE);
  const auto uniform = affine_areas(ellipsoid, Facet_sizing::UNIFORM);
  for (const auto& image :
       {affine_areas(ellipsoid, Facet_sizing::AFFINE), affine_areas(sheared, Facet_sizing::AFFINE)}) {
    EXPECT_NEAR(image.number, expected.number, 0.02 * expected.number);
    EXPECT_LT(image.deviation - expected.deviation, 0.1 * (uniform.deviation - expected.deviation));
  }
  EXPECT_GT(uniform.deviation, 2 * expected.deviation) << "the test shows nothing";
}

} // namespace delaunay_surface_test
