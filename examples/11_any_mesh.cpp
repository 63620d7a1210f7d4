// SPDX-License-Identifier: GPL-3.0-or-later
// Uses a mesh type, a kernel, property maps and named parameters of your choice: computes selected attributes of a
// CGAL::Polyhedron_3, whose kernel differs from that of the function, in external property maps, and writes them to a
// file.
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/attributes/annotate_by_fit.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/io/polygon_mesh_files.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Vertex = boost::graph_traits<Polyhedron>::vertex_descriptor;

int main() {
  namespace parameters = equiaffine::parameters;
  const equiaffine::Expression_3 f("x^2 + 2*y^2 + 3*z^2 = 1");
  const auto ellipsoid = equiaffine::make_analytic_traits<CGAL::Simple_cartesian<double>>(
      f, CGAL::Bbox_3(-1.2, -1.2, -1.2, 1.2, 1.2, 1.2));

  //! [maps]
  Polyhedron mesh;
  equiaffine::marching_cubes(ellipsoid, mesh, {.resolution = 24});

  std::map<Vertex, double> exact, fitted, error;
  equiaffine::annotate(mesh, ellipsoid, CGAL::parameters::geom_traits(Kernel()),
                       parameters::vertex_affine_mean_curvature_map(boost::make_assoc_property_map(exact)));
  equiaffine::annotate_by_fit(mesh, {.scale = 0},
                              parameters::vertex_affine_mean_curvature_map(boost::make_assoc_property_map(fitted))
                                  .vertex_affine_mean_curvature_error_map(boost::make_assoc_property_map(error)));
  //! [maps]

  //! [file]
  equiaffine::IO::write_polygon_mesh(
      "ellipsoid.ply", mesh, parameters::vertex_affine_mean_curvature_map(boost::make_assoc_property_map(exact)));
  //! [file]

  double difference = 0;
  int right = 0;
  for (const Vertex v : vertices(mesh)) {
    difference = std::max(difference, std::abs(exact[v] + std::pow(6, 0.25))); // H of a sphere of the same volume
    right += std::abs(fitted[v] - exact[v]) <= error[v];
  }
  std::printf("affine mean curvature equal to that of a sphere up to rounding: %s\n", difference < 1e-9 ? "yes" : "no");
  std::printf("its estimate by fits is correct within the estimated error at %d %% of the vertices\n",
              int(100 * right / int(num_vertices(mesh))));
}
