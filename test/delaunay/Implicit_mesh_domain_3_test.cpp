// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's make_mesh_3 with solids that reach the border of the clip domain.
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
#include <numbers>
#include <set>

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
  const Domain domain(Traits(Expression_3(f), clip.bbox()), clip, 0.2);
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

} // namespace Implicit_mesh_domain_3_test
