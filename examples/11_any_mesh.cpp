// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes, kernels, maps and named parameters of your own: a CGAL::Polyhedron_3 of another kernel than that of the function
// gets the numbers that are asked for, in maps that need not belong to it, and keeps them in a file.
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
    difference = std::max(difference, std::abs(exact[v] + std::pow(6, 0.25))); // as on a sphere of the same volume
    right += std::abs(fitted[v] - exact[v]) <= error[v];
  }
  std::printf("the affine mean curvature is that of a sphere to %s\n", difference < 1e-9 ? "rounding" : "nothing");
  std::printf("that of fits to the vertices is right to within its error at %d %% of them\n",
              int(100 * right / int(num_vertices(mesh))));
}
