// SPDX-License-Identifier: GPL-3.0-or-later
// Uses a function as the domain of CGAL's make_mesh_3: tetrahedra inside, and vertices exactly on the surface.
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Sphere = equiaffine::analytic_functions::Sphere;
using Domain = equiaffine::Implicit_mesh_domain_3<equiaffine::Analytic_function_traits_3<Kernel, Sphere>>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;

int main() {
  //! [domain]
  const Sphere sphere;
  const double facet_size = 0.2;
  const Domain domain({sphere, sphere.box()}, {.radius = facet_size});
  const CGAL::Mesh_criteria_3<Triangulation> criteria(CGAL::Mesh_facet_criteria_3<Triangulation>(30, facet_size, 0.005),
                                                      CGAL::Mesh_cell_criteria_3<Triangulation>(3, 0.3));
  const auto mesh = CGAL::make_mesh_3<Complex>(domain, criteria);
  //! [domain]

  double volume = 0, largest_distance = 0;
  for (auto cell = mesh.cells_in_complex_begin(); cell != mesh.cells_in_complex_end(); ++cell)
    volume += std::abs(mesh.triangulation().tetrahedron(cell).volume());
  for (auto facet = mesh.facets_in_complex_begin(); facet != mesh.facets_in_complex_end(); ++facet) {
    const auto p = facet->first->vertex((facet->second + 1) % 4)->point().point();
    largest_distance = std::max(largest_distance, std::abs(std::sqrt((p - CGAL::ORIGIN).squared_length()) - 1));
  }
  std::cout << "volume within 3 percent: " << (std::abs(volume / (4 * CGAL_PI / 3) - 1) < 0.03) << '\n'
            << "vertices exact: " << (largest_distance < 1e-14) << '\n';
}
