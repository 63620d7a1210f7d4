// SPDX-License-Identifier: GPL-3.0-or-later
// What a user compiles for curvatures at a point; the benchmark `kernel` takes the time.
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/attributes.h>

#include <CGAL/Simple_cartesian.h>

#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;

struct Surface {
  auto operator()(const auto& x, const auto& y, const auto& z) const {
    const auto r2 = x * x + y * y;
    const auto q = r2 * z + x * z;
    return q * q + exp(z) - 1.0;
  }
};

int main() {
  const auto traits = equiaffine::make_analytic_traits<Kernel>(Surface(), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  const auto s = equiaffine::local_structure_at(traits, Kernel::Point_3(1, 1, -1));
  std::cout << to_string(s.status) << ' ' << s.affine.gaussian_curvature << ' ' << s.affine.mean_curvature << '\n';
}
