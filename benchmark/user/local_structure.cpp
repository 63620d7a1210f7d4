// SPDX-License-Identifier: GPL-3.0-or-later
// What a user compiles for curvatures at a point; the benchmark `kernel` takes the time.
#include "surface.h"

#include <iostream>

int main() {
  const Traits traits = surface_traits();
  const auto s = equiaffine::local_structure_at(traits, Kernel::Point_3(1, 1, -1));
  std::cout << to_string(s.status) << ' ' << s.affine.gaussian_curvature << ' ' << s.affine.mean_curvature << '\n';
}
