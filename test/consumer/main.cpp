// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#ifndef HEADERS_ALONE
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/engine/vectorized.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/registration/affine_symmetries.h>
#endif

#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <cstdlib>
#include <vector>

struct Ellipsoid {
  auto operator()(const auto& x, const auto& y, const auto& z) const { return x * x / 4.0 + y * y + z * z - 1.0; }
};

// A unit sphere has the affine Gaussian curvature 1; a map of determinant 2 makes it an ellipsoid with 1 / 2
// everywhere.
int main() {
  using Kernel = CGAL::Simple_cartesian<double>;
  const auto traits = equiaffine::make_analytic_traits<Kernel>(Ellipsoid(), CGAL::Bbox_3(-3, -2, -2, 3, 2, 2));
  auto mesh = equiaffine::to_surface_mesh(equiaffine::marching_cubes<CGAL::Parallel_if_available_tag>(traits));
  equiaffine::annotate(mesh, traits);
  using Vertex_index = decltype(mesh)::Vertex_index;
  const auto curvature = mesh.add_property_map<Vertex_index, double>("v:affine_gaussian_curvature").first;
  for (const Vertex_index v : mesh.vertices())
    if (!(std::abs(curvature[v] - 0.5) < 1e-12)) return EXIT_FAILURE;
#ifndef HEADERS_ALONE
  const equiaffine::Expression_3 ellipsoid("x^2/4 + y^2 + z^2 = 1");
  if (ellipsoid(2.0, 0.0, 0.0) != 0 || ellipsoid.taylor(2.0, 0.0, 0.0).value() != 0) return EXIT_FAILURE;
  if (!equiaffine::delaunay_surface(traits).is_certified) return EXIT_FAILURE;
  const equiaffine::vectorized::Formula formula(equiaffine::make_analytic_traits<Kernel>(ellipsoid, traits.bbox()));
  const equiaffine::Level_set_traits_3 level_set(formula, 0.0);
  if (equiaffine::vectorized::marching_cubes(level_set).points.size() < 1000) return EXIT_FAILURE;
  const std::vector<Kernel::Point_3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::vector<int>> faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  if (equiaffine::affine_symmetries(corners, faces).order() != 24) return EXIT_FAILURE;
  std::vector<Kernel::Point_3> points;
  for (int i = 0; i < 64; ++i) points.emplace_back(i % 8, i / 8, 0.01 * (i % 8) * (i / 8));
  if (equiaffine::fitted_structures(points, {.scale = 0}).size() != points.size()) return EXIT_FAILURE;

  // Exceptions and the observer of a thread pass between this program and the library, shared or not.
  try {
    const equiaffine::Expression_3 unknown_name("x + q");
    return EXIT_FAILURE;
  } catch (const equiaffine::Input_error&) {
  }
  struct Cancelled {};
  const equiaffine::Progress_observer observer([](const auto&) { throw Cancelled(); }, {});
  try {
    equiaffine::fitted_structures(points, {.scale = 0});
    return EXIT_FAILURE;
  } catch (const Cancelled&) {
  }
  try {
    equiaffine::vectorized::marching_cubes(level_set);
    return EXIT_FAILURE;
  } catch (const Cancelled&) {
  }
#endif
  return mesh.number_of_vertices() > 1000 ? EXIT_SUCCESS : EXIT_FAILURE;
}
