// SPDX-License-Identifier: GPL-3.0-or-later
// Computes a Delaunay mesh of a torus, with a certificate that no component is missing.
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Simple_cartesian.h>

#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;

int main() {
  //! [delaunay]
  const equiaffine::analytic_functions::Torus torus;
  const auto traits = equiaffine::make_analytic_traits<Kernel>(torus, torus.box());
  const auto surface = equiaffine::delaunay_surface(traits, {.angle = 30, .radius = 0.05});
  const auto topology = equiaffine::mesh_topology(surface.triangles, surface.points.size());
  std::cout << "closed: " << (topology.boundary_edges == 0) << '\n'
            << "components: " << topology.components << '\n'
            << "Euler characteristic: " << topology.euler_characteristic << '\n'
            << "certified: " << surface.is_certified << '\n';
  //! [delaunay]
}
