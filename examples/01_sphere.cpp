// SPDX-License-Identifier: GPL-3.0-or-later
// Computes a mesh of a function, with curvatures. On a sphere of radius r they are constant:
// K = r^-3, H = -r^(-3/2), and the Euclidean K_e = r^-2.
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cstdio>
#include <string>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Sphere {
  double radius;
  auto operator()(const auto& x, const auto& y, const auto& z) const { return x * x + y * y + z * z - radius * radius; }
};

void print_range(Mesh& mesh, const std::string& name) {
  const auto map = mesh.add_property_map<Mesh::Vertex_index, double>("v:" + name).first; // returns the existing map
  const auto [least, greatest] = std::minmax_element(map.begin(), map.end());
  std::printf("%-26s from %7.4g to %7.4g\n", name.c_str(), *least, *greatest);
}

int main() {
  const auto traits = equiaffine::make_analytic_traits<Kernel>(Sphere{2}, CGAL::Bbox_3(-3, -3, -3, 3, 3, 3));
  const auto surface = equiaffine::marching_cubes(traits, {.resolution = 32});
  Mesh mesh = equiaffine::to_surface_mesh(surface);
  equiaffine::annotate(mesh, traits);

  std::printf("%u vertices, %u faces\n", mesh.number_of_vertices(), mesh.number_of_faces());
  print_range(mesh, "affine_gaussian_curvature");
  print_range(mesh, "affine_mean_curvature");
  print_range(mesh, "gaussian_curvature");
}
