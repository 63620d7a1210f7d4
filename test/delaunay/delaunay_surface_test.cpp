// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/meshed_surfaces.h"
#include "support/error_field.h"
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/sample_on_lattice.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace delaunay_surface_test {

using namespace equiaffine;
using namespace meshed_surfaces;
namespace functions = equiaffine::analytic_functions;

struct Expected {
  double radius;
  long components, euler_characteristic;
  bool is_closed = true;
};

template <class Function>
void expect_mesh(const Function& f, const Expected& expected, const Clip_domain_3& domain) {
  const auto traits = traits_of(f);
  const auto surface = delaunay_surface(traits, {.radius = expected.radius, .clip = domain});
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

TEST(Delaunay_surface, a_mesh_of_CGAL_gets_the_same_triangles_by_default_criteria) {
  const auto traits = traits_of(functions::Gyroid());
  const auto surface = delaunay_surface(traits, {}, CGAL::parameters::verbose(false));
  CGAL::Surface_mesh<Point_3> mesh;
  const auto facts = delaunay_surface(traits, mesh);
  EXPECT_EQ(mesh.number_of_faces(), surface.triangles.size());
  EXPECT_GT(mesh.number_of_faces(), 1000u);
  EXPECT_EQ(facts.is_certified, surface.is_certified);
  EXPECT_TRUE(facts.triangles.empty());
}

TEST(Delaunay_surface, arguments_without_a_result_are_refused_in_every_build) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const auto sphere = traits_of(functions::Sphere());
  const auto field = [&](const Delaunay_options& options) {
    return error_field([&] { delaunay_surface(sphere, options); });
  };
  for (const double angle : {31.0, -1.0, nan}) EXPECT_EQ(field({.angle = angle, .radius = 0.1}), "angle");
  for (const double length : {-1.0, 0.0, nan, infinity}) {
    EXPECT_EQ(field({.radius = length}), "radius");
    EXPECT_EQ(field({.radius = 0.1, .distance = length}), "distance");
  }
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
    EXPECT_EQ(error_field([&] { Implicit_mesh_domain_3(sphere, {.radius = size}); }), "radius");
    EXPECT_THROW(certified_seeding(
                     sphere, domain, [](const Point_3&) { return 1.0; }, size),
                 std::invalid_argument);
  }
}

TEST(Delaunay_surface, the_image_of_a_surface_has_its_topology_and_vertices_on_it) {
  const functions::Tanglecube f;
  const Kernel::Aff_transformation_3 map(0.9, 0, 0.9, 0, 2, 0, 1.1, 0, 0.6);
  const Transformed_function_traits_3 traits(traits_of(f), map);
  const auto surface = delaunay_surface(traits, {.radius = 0.15});
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
  const auto surface = delaunay_surface(volume, {.radius = 0.06});
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
    const auto surface = delaunay_surface(traits_of(f), {.radius = 0.4});
    const auto t = topology(surface);
    ASSERT_EQ(t.components, 2u) << f.center[0] << ' ' << f.center[1] << ' ' << f.center[2];
    ASSERT_EQ(t.euler_characteristic, 4);
    ASSERT_TRUE(t.is_manifold && t.boundary_edges == 0 && surface.is_certified);
    ++found;
  }
}

} // namespace delaunay_surface_test
