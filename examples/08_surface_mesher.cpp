// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's make_surface_mesh, which is deprecated since CGAL 6, with an oracle that misses no component.
#define CGAL_NO_DEPRECATION_WARNINGS
#include <equiaffine/delaunay/Implicit_surface_oracle_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_default_criteria_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>

#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Two_spheres = equiaffine::analytic_functions::Two_spheres;
using Surface = equiaffine::Implicit_mesh_domain_3<equiaffine::Analytic_function_traits_3<Kernel, Two_spheres>>;
using Triangulation = CGAL::Surface_mesh_default_triangulation_3;

int main() {
  const Two_spheres spheres;
  const double facet_size = 0.2;
  const Surface surface({spheres, spheres.box()}, equiaffine::Clip_domain_3(spheres.box()), facet_size);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(30, facet_size, 0.02);
  Triangulation triangulation;
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  CGAL::make_surface_mesh(complex, surface, equiaffine::Implicit_surface_oracle_3<Surface>(), criteria,
                          CGAL::Manifold_tag());

  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, mesh);
  auto component = mesh.add_property_map<decltype(mesh)::Face_index, std::size_t>("f:component").first;
  std::cout << "closed: " << CGAL::is_closed(mesh) << '\n'
            << "components: " << CGAL::Polygon_mesh_processing::connected_components(mesh, component) << '\n';
}
