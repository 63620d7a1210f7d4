// SPDX-License-Identifier: GPL-3.0-or-later
// Finds all affine symmetries of some surfaces. The second surface is an affine image of the first, so it has the same
// number of symmetries, but most of them are not isometries. An infinite symmetry group has a positive dimension: 3 or
// 4 for quadrics, 1 for an affine image of a surface of revolution.
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/registration/affine_symmetries.h>

#include <CGAL/Simple_cartesian.h>

#include <cstdio>

using Kernel = CGAL::Simple_cartesian<double>;

int main() {
  namespace parameters = equiaffine::parameters;
  for (const char* equation : {"x^6 + y^6 + z^6 = 1", "x^6 + 2*y^6 + z^6/2 = 1", "x^4 + y^4 + z^4 + 1.2*x*y*z = 1",
                               "x^4 + y^4 + z^4 + x^3/3 + x*y^2/4 - z^3/5 + x*y*z/3 = 1",
                               "x^2 + 2*y^2 + 3*z^2 + x*y/3 = 1", "(x^2 + y^2/4 + z^2 + 0.84)^2 = 4*(x^2 + y^2/4)"}) {
    //! [symmetries]
    const auto traits =
        equiaffine::make_analytic_traits<Kernel>(equiaffine::Expression_3(equation), CGAL::Bbox_3(-3, -3, -3, 3, 3, 3));
    const auto points = equiaffine::marching_cubes(traits, {.resolution = 50}).points;
    const auto affine = equiaffine::affine_symmetries(traits, points);
    std::printf("%s\n", equation);
    if (!affine.order()) {
      std::printf("  infinitely many symmetries, dimension %zu\n", affine.continuous.dimension());
      continue;
    }
    const auto rigid = equiaffine::affine_symmetries(traits, points, {.kind = equiaffine::Map_kind::RIGID});
    std::printf("  symmetries: %zu, rigid: %zu\n", *affine.order(), *rigid.order());
    //! [symmetries]
  }
}
