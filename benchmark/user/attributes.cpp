// SPDX-License-Identifier: GPL-3.0-or-later
// What a user compiles for attributes of many points; the benchmark `kernel` takes the time.
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/attributes.h>

#include <CGAL/Simple_cartesian.h>

#include <iostream>
#include <vector>

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
  const std::vector<Kernel::Point_3> points = {{1, 1, -1}, {1, 0, 1}, {0, 1, 1}};
  const auto attributes = equiaffine::compute_attributes(traits, points, equiaffine::select_attributes("basic"));
  for (const auto& column : attributes.columns) std::cout << column.name << ' ' << column.values[0] << '\n';
}
