// SPDX-License-Identifier: GPL-3.0-or-later
// How dense the points are that a Delaunay mesh begins with, and that effort is spared nowhere that needs it; that none
// of a surface is missed is tested on the meshes.
#include <equiaffine/delaunay/internal/certified_seeding.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace certified_seeding_test {

using namespace equiaffine;
namespace functions = equiaffine::analytic_functions;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

constexpr double packing = 1.1, jitter = 1.3; // distance of seeds / bound of circumradii, least and largest
constexpr double rounding = 0.98;             // points are compared before they are on the surface

/// The seeds of the unit sphere in the cube [-1.25, 1.25]^3 for facets of one size, none near a given vertex.
std::vector<Point_3> seeds_of_sphere(double size, const Point_3& vertex, double clearance) {
  const functions::Sphere sphere;
  const auto traits = make_analytic_traits<Kernel>(sphere, sphere.box());
  const auto uniform = [=](const Point_3&) { return size; };
  return certified_seeding(traits, Clip_domain_3(sphere.box()), uniform, size, {{vertex, clearance}}).seeds;
}

double distance_to_nearest(const Point_3& p, const std::vector<Point_3>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point_3& q : points)
    if (q != p) least = std::min(least, CGAL::squared_distance(p, q));
  return std::sqrt(least);
}

TEST(Certified_seeding, seeds_keep_their_distance_and_leave_no_gap) {
  for (const double size : {0.05, 0.1, 0.3}) {
    const auto seeds = seeds_of_sphere(size, Point_3(1, 0, 0), packing * size);
    for (const Point_3& p : seeds) {
      const double distance = distance_to_nearest(p, seeds);
      ASSERT_GE(distance, rounding * packing * size);
      ASSERT_LE(distance, jitter * packing * size);
    }
    for (int n = 0; n < 1000; ++n) { // a spiral from pole to pole
      const double z = (n + 0.5) / 500 - 1, angle = 2.4 * n, r = std::sqrt(1 - z * z);
      const Point_3 p(r * std::cos(angle), r * std::sin(angle), z);
      ASSERT_LE(distance_to_nearest(p, seeds), jitter * packing * size) << p;
    }
  }
}

TEST(Certified_seeding, seeds_are_as_many_as_their_distance_tells) {
  const double density = 0.77; // seeds per square of their least distance
  for (const double size : {0.05, 0.1, 0.2}) {
    const auto seeds = seeds_of_sphere(size, Point_3(1, 0, 0), packing * size);
    const double expected = density * 4 * CGAL_PI / (packing * packing * size * size);
    EXPECT_NEAR(double(seeds.size()), expected, 0.05 * expected) << size;
  }
}

TEST(Certified_seeding, the_scaffold_is_around_the_box_and_in_the_middle_of_empty_cells) {
  const functions::Sphere sphere;
  const auto traits = make_analytic_traits<Kernel>(sphere, sphere.box());
  const auto uniform = [](const Point_3&) { return 0.05; };
  const auto scaffold = certified_seeding(traits, Clip_domain_3(sphere.box()), uniform, 0.05).scaffold;
  const double corner = 1.25 * std::sqrt(3.0), smallest_cell = 2.5 / 8; // at least four facets
  ASSERT_GT(scaffold.size(), 8u);
  for (std::size_t n = 0; n < scaffold.size(); ++n) {
    const double distance = std::sqrt((scaffold[n] - CGAL::ORIGIN).squared_length());
    if (n < 8) {
      EXPECT_GE(distance, 2 * corner);
      EXPECT_LE(distance, 3 * corner);
    } else {
      EXPECT_GE(std::abs(distance - 1), 0.9 * smallest_cell / 2);
      EXPECT_LE(distance, corner);
    }
  }
}

// Cells of an eighth of the cube's side are the largest ones in which all gradients of the sphere form acute angles,
// and seeds there are 1.4 sides apart instead of one size, a tenth more as everywhere.
TEST(Certified_seeding, where_cells_have_to_be_small_seeds_are_as_dense) {
  const double spacing = packing * 1.4 * 2.5 / 8, growth = 1.2;
  const auto seeds = seeds_of_sphere(1, Point_3(1, 0, 0), spacing);
  for (const Point_3& p : seeds) {
    EXPECT_GE(distance_to_nearest(p, seeds), rounding * spacing);
    EXPECT_LE(distance_to_nearest(p, seeds), growth * jitter * spacing);
  }
}

TEST(Certified_seeding, seeds_keep_away_from_vertices_of_features) {
  const Point_3 vertex(0, 0.6, 0.8);
  for (const double clearance : {0.02, 0.2, 0.5}) {
    const double distance = distance_to_nearest(vertex, seeds_of_sphere(0.1, vertex, clearance));
    EXPECT_GE(distance, rounding * clearance);
    EXPECT_LE(distance, jitter * std::max(clearance, packing * 0.1));
  }
}

// Two thin shells: cells of the one that comes first in the order of cells need the tightest bounds for long, and
// settle little for the other.
TEST(Certified_seeding, an_image_in_a_mirror_is_decided_as_well) {
  for (const char* small : {"(x+1.2)^2+(y+1.2)^2+(z+1.2)^2", "(x-1.2)^2+(y-1.2)^2+(z-1.2)^2"}) {
    const std::string u = "(25*(" + std::string(small) + "))", v = "(x^2+y^2+z^2)";
    const Expression_3 f("min(0.04*(" + u + "^2-2.5*" + u + "+1.5), " + v + "^2-2.3*" + v + "+1.3)");
    const CGAL::Bbox_3 box(-1.5, -1.5, -1.5, 1.5, 1.5, 1.5);
    const auto traits = make_analytic_traits<Kernel>(f, box);
    const auto uniform = [](const Point_3&) { return 0.1; };
    EXPECT_TRUE(certified_seeding(traits, Clip_domain_3(box), uniform, 0.1).undecided_boxes.empty()) << small;
  }
}

// Where f is undefined no subdivision helps: a half of the box in cells smaller than facets took minutes and gigabytes.
TEST(Certified_seeding, no_effort_is_made_where_the_function_is_undefined) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  for (const char* formula : {"z-sqrt(0.3*x+0.7*y-0.2*z-0.1)", "z-(0.3*x+0.7*y-0.2*z-0.1)^1.5",
                              "z-exp(1.5*log(0.3*x+0.7*y-0.2*z+0.7))", "y-asin(2*x+0.1*z)"})
    for (const double size : {0.05, 0.02}) {
      const Expression_3 f(formula);
      const auto traits = make_analytic_traits<Kernel>(f, box);
      const auto uniform = [=](const Point_3&) { return size; };
      const auto seeding = certified_seeding(traits, Clip_domain_3(box), uniform, size);
      EXPECT_FALSE(seeding.undecided_boxes.empty()) << formula;
      const double area = 4, density = 0.77 / (packing * packing * size * size), boxes_per_facet = 12;
      EXPECT_LT(double(seeding.undecided_boxes.size()), boxes_per_facet * area * density) << formula;
      EXPECT_LT(double(seeding.seeds.size()), 2.5 * area * density) << formula;
    }
}

} // namespace certified_seeding_test
