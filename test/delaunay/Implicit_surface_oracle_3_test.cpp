// SPDX-License-Identifier: GPL-3.0-or-later
#define CGAL_NO_DEPRECATION_WARNINGS // the package is deprecated since CGAL 6
#include <equiaffine/delaunay/Implicit_surface_oracle_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/Surface_mesh_default_criteria_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace Implicit_surface_oracle_3_test {

using namespace equiaffine;
namespace functions = equiaffine::analytic_functions;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Surface_mesh_default_triangulation_3;

template <class Function>
using Domain = Implicit_mesh_domain_3<Analytic_function_traits_3<Kernel, Function>>;

/// The topology of the mesh that CGAL's mesher makes; its vertices are on the surface.
template <class Function>
Mesh_topology topology_of_mesh(const Domain<Function>& surface, double radius) {
  Triangulation triangulation;
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(30, radius, radius / 10);
  CGAL::make_surface_mesh(complex, surface, Implicit_surface_oracle_3<Domain<Function>>(), criteria,
                          CGAL::Manifold_with_boundary_tag());
  std::map<Triangulation::Vertex_handle, std::uint32_t> index;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (auto facet = complex.facets_begin(); facet != complex.facets_end(); ++facet) {
    auto& triangle = triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto vertex = facet->first->vertex(Triangulation::vertex_triple_index(facet->second, i));
      triangle[std::size_t(i)] = index.try_emplace(vertex, std::uint32_t(index.size())).first->second;
      EXPECT_LE(distance_estimate(first_order(surface.traits(), vertex->point())), 1e-14 * surface.domain().diagonal());
    }
  }
  return mesh_topology(triangles, index.size());
}

TEST(Implicit_surface_oracle, a_small_component_is_found) {
  const functions::Two_spheres f;
  const auto t = topology_of_mesh<functions::Two_spheres>({{f, f.box()}, Clip_domain_3(f.box()), 0.2}, 0.2);
  EXPECT_EQ(t.components, 2u);
  EXPECT_EQ(t.euler_characteristic, 4);
  EXPECT_EQ(t.boundary_edges, 0u);
}

TEST(Implicit_surface_oracle, sheets_outside_the_ball_make_no_holes) {
  const functions::Genus_two f;
  const auto t = topology_of_mesh<functions::Genus_two>({{f, f.box()}, Clip_domain_3({0, 0, 0}, 2.5), 0.15}, 0.15);
  EXPECT_EQ(t.components, 1u);
  EXPECT_EQ(t.euler_characteristic, -2);
  EXPECT_EQ(t.boundary_edges, 0u);
}

TEST(Implicit_surface_oracle, segments_rays_and_lines_meet_the_surface_inside_the_domain) {
  const functions::Sphere f;
  const Domain<functions::Sphere> surface({f, CGAL::Bbox_3(-2, -2, -2, 0.5, 2, 2)});
  const auto intersect = Implicit_surface_oracle_3<Domain<functions::Sphere>>().intersect_3_object();
  const Kernel::Point_3 inside(-0.5, 0, 0), outside(-1.5, 0, 0), right(3, 0, 0);
  Kernel::Point_3 p;
  for (const CGAL::Object& found :
       {intersect(surface, Kernel::Segment_3(inside, outside)), intersect(surface, Kernel::Ray_3(inside, outside)),
        intersect(surface, Kernel::Line_3(inside, outside))}) {
    ASSERT_TRUE(CGAL::assign(p, found));
    EXPECT_NEAR(p.x(), -1, 1e-15);
  }
  EXPECT_TRUE(intersect(surface, Kernel::Segment_3(inside, right)).empty()) << "it meets the sphere outside the box";
  EXPECT_TRUE(intersect(surface, Kernel::Ray_3(inside, right)).empty());
}

} // namespace Implicit_surface_oracle_3_test
