// SPDX-License-Identifier: GPL-3.0-or-later
// Compares curvatures at a point of a torus and at its images under affine maps. Maps of determinant 1 or -1 change the
// Euclidean curvatures K_e and H_e, but not the affine K, H, J. Other maps multiply K, H, J by powers of a = |det|.
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>

#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <cstdio>
#include <tuple>

using Kernel = CGAL::Simple_cartesian<double>;
using Map = Kernel::Aff_transformation_3;

template <class Traits>
void print(const char* name, const Traits& traits, const Kernel::Point_3& p, double determinant) {
  const auto s = equiaffine::local_structure_at(traits, p);
  const double a = std::abs(determinant);
  std::printf("%-10s %9.4g %9.4g %9.4g %9.4g %9.4g %9.4g %9.4g %9.4g\n", name, s.euclidean.gaussian_curvature,
              s.euclidean.mean_curvature, s.affine.gaussian_curvature, s.affine.mean_curvature, s.affine.pick_invariant,
              a * s.affine.gaussian_curvature, std::sqrt(a) * s.affine.mean_curvature,
              std::sqrt(a) * s.affine.pick_invariant);
}

int main() {
  const equiaffine::analytic_functions::Torus torus{.major_radius = 2, .minor_radius = 1};
  const auto traits = equiaffine::make_analytic_traits<Kernel>(torus, torus.box());
  const Kernel::Point_3 p(2.6, 0, 0.8);

  std::printf("%-10s %9s %9s %9s %9s %9s %9s %9s %9s\n", "", "K_e", "H_e", "K", "H", "J", "a K", "a^.5 H", "a^.5 J");
  print("torus", traits, p, 1);
  for (const auto& [name, map, determinant] :
       {std::tuple("det = 1", Map(1, 2, 0, 0, 1, 3, 0, 0, 1), 1.0),
        std::tuple("det = 2", Map(1, 2, 0, 0, 1, 0.5, 1, 0, 1), 2.0),
        std::tuple("det = -0.9", Map(0.9, 0, 0.9, 0, 2, 0, 1.1, 0, 0.6), -0.9)}) // figure 8 of Andrade, Lewiner 2012
    print(name, equiaffine::Transformed_function_traits_3(traits, map), map(p), determinant);
}
