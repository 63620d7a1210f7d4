// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates curvatures, and their errors, at the vertices of a mesh for which no formula is known, by fitting
// polynomials. The mesh in this example samples a known surface, so that the estimates can be checked.
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/attributes/annotate_by_fit.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdio>
#include <string>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main() {
  const equiaffine::Expression_3 f("x^2 + y^2/2 + z^2/3 + x*y*z/4 = 1");
  const auto surface = equiaffine::make_analytic_traits<Kernel>(f, CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  const auto sampled = equiaffine::marching_cubes(surface, {.resolution = 40});
  Mesh mesh = equiaffine::to_surface_mesh(sampled); // or CGAL::IO::read_polygon_mesh("scan.ply", mesh)

  //! [fit]
  equiaffine::annotate_by_fit(mesh, {.scale = 0});

  const auto map = [&](const std::string& name) {
    return mesh.add_property_map<Mesh::Vertex_index, double>("v:" + name).first; // returns the existing map
  };
  const auto K = map("affine_gaussian_curvature"), error = map("affine_gaussian_curvature_error");
  //! [fit]
  int known = 0, right = 0;
  for (const auto v : mesh.vertices()) {
    if (!(error[v] < 0.01 * std::abs(K[v]))) continue;
    ++known;
    const auto& p = mesh.point(v);
    const auto truth = equiaffine::local_structure(surface.taylor(p), {p.x(), p.y(), p.z()});
    right += std::abs(K[v] - truth.affine.gaussian_curvature) <= error[v];
  }
  const int all = int(num_vertices(mesh));
  std::printf("affine Gaussian curvature known to 1 %% at %d %% of the vertices\n", 100 * known / all);
  std::printf("correct within the estimated error at %d %% of these\n", 100 * right / known);
}
