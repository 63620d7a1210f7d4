// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's make_mesh_3 with solids that reach the border of the clip domain, and the functors for the zero set alone.
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace Implicit_mesh_domain_3_test {

using namespace equiaffine;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = Analytic_function_traits_3<Kernel, Expression_3>;
using Domain = Implicit_mesh_domain_3<Traits>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;

constexpr double facet_distance = 0.02;

/// Expects a mesh of the solid f < 0 in the domain, whose volume and area of surface are known: it may lack as much as
/// facets are off the surface.
void expect_solid(const char* f, const Clip_domain_3& clip, double volume, double area, const std::set<int>& patches) {
  const Domain domain(Traits(Expression_3(f), clip.bbox()), {.clip = clip, .radius = 0.2});
  const CGAL::Mesh_criteria_3<Triangulation> criteria(
      CGAL::Mesh_facet_criteria_3<Triangulation>(25, 0.2, facet_distance),
      CGAL::Mesh_cell_criteria_3<Triangulation>(3, 0.3));
  const auto mesh = CGAL::make_mesh_3<Complex>(domain, criteria);
  double found = 0;
  for (auto c = mesh.cells_in_complex_begin(); c != mesh.cells_in_complex_end(); ++c)
    found += std::abs(mesh.triangulation().tetrahedron(c).volume());
  EXPECT_NEAR(found, volume, facet_distance * area) << f;
  std::set<int> found_patches;
  for (auto facet = mesh.facets_in_complex_begin(); facet != mesh.facets_in_complex_end(); ++facet)
    found_patches.insert(mesh.surface_patch_index(*facet));
  EXPECT_EQ(found_patches, patches) << f;
}

const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);

TEST(Implicit_mesh_domain, a_solid_ends_at_the_border_of_a_box) {
  expect_solid("z", Clip_domain_3(box), 4, 16, {1, 2});
  expect_solid("x^2+y^2-0.25", Clip_domain_3(box), std::numbers::pi / 2, 2.5 * std::numbers::pi, {1, 2});
  expect_solid("0.25-x^2-y^2-z^2", Clip_domain_3(box), 8 - std::numbers::pi / 6, 24 + std::numbers::pi, {1, 2});
}

TEST(Implicit_mesh_domain, a_solid_that_fills_the_domain_has_its_border) {
  expect_solid("-1-x^2", Clip_domain_3(box), 8, 24, {2});
}

TEST(Implicit_mesh_domain, a_solid_ends_at_the_border_of_a_ball) {
  const Clip_domain_3 ball({0, 0, 0}, 1);
  expect_solid("z", ball, 2 * std::numbers::pi / 3, 3 * std::numbers::pi, {1, 2});
  expect_solid("x^2+y^2+z^2-0.25", ball, std::numbers::pi / 6, std::numbers::pi, {1});
}

TEST(Implicit_mesh_domain, segments_rays_and_lines_meet_the_zero_set_inside_the_domain) {
  const Domain domain(Traits(Expression_3("x^2+y^2+z^2-1"), CGAL::Bbox_3(-2, -2, -2, 0.5, 2, 2)));
  const auto intersect = domain.construct_intersection_with_zero_set_object();
  const Kernel::Point_3 inside(-0.5, 0, 0), outside(-1.5, 0, 0), right(3, 0, 0);
  for (const auto& [point, patch, dimension] :
       {intersect(Kernel::Segment_3(inside, outside)), intersect(Kernel::Ray_3(inside, outside)),
        intersect(Kernel::Line_3(inside, outside))}) {
    EXPECT_EQ(dimension, 2);
    EXPECT_EQ(patch, 1);
    EXPECT_NEAR(point.x(), -1, 1e-15);
  }
  const auto dimension = [](const Domain::Intersection& found) { return std::get<2>(found); };
  EXPECT_EQ(dimension(intersect(Kernel::Segment_3(inside, right))), 0) << "it meets the sphere outside the box";
  EXPECT_EQ(dimension(intersect(Kernel::Ray_3(inside, right))), 0);
  EXPECT_EQ(dimension(domain.construct_intersection_object()(Kernel::Ray_3(inside, right))), 2)
      << "it meets the border";
}

TEST(Implicit_mesh_domain, initial_points_of_the_zero_set_are_none_of_the_border) {
  const Domain domain(Traits(Expression_3("z"), box), {.radius = 0.2});
  std::vector<std::pair<Kernel::Point_3, int>> points, all;
  domain.construct_initial_points_of_zero_set_object()(std::back_inserter(points));
  domain.construct_initial_points_object()(std::back_inserter(all));
  EXPECT_FALSE(points.empty());
  EXPECT_GT(all.size(), points.size());
  for (const auto& [point, patch] : points) {
    EXPECT_EQ(patch, 1);
    EXPECT_NEAR(point.z(), 0, 1e-15);
  }
}

} // namespace Implicit_mesh_domain_3_test
