// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/formulas.h"
#include "delaunay/meshed_surfaces.h"
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>

namespace delaunay_surface_undecided_test {

using namespace equiaffine;
using namespace meshed_surfaces;
namespace functions = equiaffine::analytic_functions;

TEST(Delaunay_surface, what_has_no_gradient_anywhere_ends_in_undecided_boxes) {
  const auto surface =
      delaunay_surface(make_analytic_traits<Kernel>(Expression_3("0"), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1)));
  EXPECT_TRUE(surface.triangles.empty());
  EXPECT_FALSE(surface.is_certified);
  EXPECT_FALSE(surface.undecided_boxes.empty());
}

TEST(Delaunay_surface, what_is_not_a_manifold_is_not_certified) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1); // strips nearer to each other than the facets are large
  const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3("z-.9999-1e-3*sin(1e2*y)"), box));
  EXPECT_TRUE(topology(surface).is_manifold || !surface.is_certified);
  EXPECT_TRUE(surface.is_certified || !surface.undecided_boxes.empty());
}

TEST(Delaunay_surface, poles_are_no_surfaces) {
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  const Delaunay_options options{.radius = 0.2};
  EXPECT_TRUE(delaunay_surface(make_analytic_traits<Kernel>(Expression_3("1/x"), box), options).points.empty());
  const auto surface = delaunay_surface(make_analytic_traits<Kernel>(Expression_3("1/x+y"), box), options);
  EXPECT_FALSE(surface.triangles.empty());
  for (const Point_3& p : surface.points) ASSERT_NEAR(p.x() * p.y(), -1, 1e-13) << p;
  const auto tangent = make_analytic_traits<Kernel>(Expression_3("tan(x)-y"), box);
  for (const bool is_coarse : {false, true}) {
    // The sheet lies between the poles at +-pi/2.
    const auto sheet = delaunay_surface(tangent, is_coarse ? Delaunay_options() : options);
    const auto t = topology(sheet);
    EXPECT_TRUE(t.is_manifold) << is_coarse;
    EXPECT_EQ(t.components, 1u) << is_coarse;
    EXPECT_EQ(t.euler_characteristic, 1) << is_coarse;
    const auto is_boundary = is_on_boundary(sheet);
    for (std::size_t v = 0; v < sheet.points.size(); ++v)
      EXPECT_TRUE(!is_boundary[v] || std::abs(sheet.points[v].y()) == 2 || std::abs(sheet.points[v].z()) == 2);
  }
}

TEST(Delaunay_surface, a_surface_is_found_on_a_segment_that_meets_a_pole_as_well) {
  const CGAL::Bbox_3 box(-5, -5, -5, 5, 5, 5);
  using Exact_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Implicit_mesh_domain_3 domain(make_analytic_traits<Kernel>(Expression_3("tan(x)-y"), box), {.radius = 0.3});
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

TEST(Delaunay_surface, where_CGAL_gives_up_the_whole_box_is_undecided) {
  const CGAL::Bbox_3 box(-4, -4, -4, 4, 4, 4);
  const auto surface =
      delaunay_surface(make_analytic_traits<Kernel>(Expression_3("z-x*y*sin(x*y)"), box), {.radius = 0.1});
  const bool gives_up = CGAL_VERSION_NR < 1060200000; // 6.2 does not
  EXPECT_EQ(surface.is_certified, !gives_up);
  EXPECT_EQ(std::count(surface.undecided_boxes.begin(), surface.undecided_boxes.end(), box), gives_up ? 1 : 0);
  EXPECT_FALSE(surface.triangles.empty());
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
    const auto surface = delaunay_surface(traits, {.radius = Clip_domain_3(box).diagonal() / 60});
    if (!surface.is_certified) continue;
    ++certified;
    const auto fine = test::surface_of(traits, {.resolution = 100});
    const auto expected = mesh_topology(fine.triangles, fine.points.size()), found = topology(surface);
    EXPECT_TRUE(found.is_manifold) << waves.str();
    EXPECT_EQ(found.components, expected.components) << waves.str();
    EXPECT_EQ(found.euler_characteristic, expected.euler_characteristic) << waves.str();
  }
  EXPECT_GE(certified, 4);
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
  const auto surface = delaunay_surface(traits_of(f), {.radius = 0.2});
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

TEST(Delaunay_surface_long, singular_curves_end_in_undecided_boxes) {
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

} // namespace delaunay_surface_undecided_test
