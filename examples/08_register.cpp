// SPDX-License-Identifier: GPL-3.0-or-later
// Registers a piece of a surface with the whole surface, which was sheared and stretched. One pair of points with the
// same affine invariants determines the affine map. No initial map or overlap is given, and the two point sets are
// unrelated.
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/registration/register_surfaces.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using Kernel = CGAL::Simple_cartesian<double>;
using Map = Kernel::Aff_transformation_3;

int main() {
  namespace parameters = equiaffine::parameters;
  //! [register]
  const equiaffine::Expression_3 f("x^4 + y^4 + z^4 + x^3/3 - x^2*y/4 + x*y^2/4 - x*y*z/3 + y^3/5 - z^3/3 = 1");
  const auto piece = equiaffine::make_analytic_traits<Kernel>(f, CGAL::Bbox_3(0, 0, -2, 2, 2, 2));
  const auto whole = equiaffine::make_analytic_traits<Kernel>(f, CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  const Map map(2, 1, 0, 5, 0, 1, -0.5, 0, 0.3, 0, 0.6, -3);
  const equiaffine::Transformed_function_traits_3 image(whole, map);

  const auto points = equiaffine::marching_cubes(piece, {.resolution = 20}).points;
  const auto image_points = equiaffine::marching_cubes(image, {.resolution = 31}).points;
  const auto result = equiaffine::register_surfaces(piece, points, image, image_points);
  //! [register]
  if (!result.found()) {
    std::puts("no map");
    return 1;
  }

  double error = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      error = std::max(error, std::abs(result.best().map.m(row, column) - map.m(row, column)));
  const auto [of_piece, of_whole] = result.best().inliers;
  std::printf("error of the map below 1e-11: %s\n", error < 1e-11 ? "yes" : "no");
  std::printf("expected number of maps as good by chance below 1e-100: %s\n",
              result.best().log10_false_alarms < -100 ? "yes" : "no");
  std::printf("%.0f %% of the piece lies on the whole, %.0f %% of the whole lies on the piece\n", 100 * of_piece,
              100 * of_whole);

  const auto rigid =
      equiaffine::register_surfaces(piece, points, image, image_points, {.kind = equiaffine::Map_kind::RIGID});
  std::printf("a rigid map: %s\n", rigid.found() ? "found" : "none");
}
