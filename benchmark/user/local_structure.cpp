// SPDX-License-Identifier: GPL-3.0-or-later
// A user's program for curvatures at a point; the benchmark `kernel` measures its compile time.
#include "surface.h"

#include <iostream>

int main() {
  const Traits traits = surface_traits();
  const auto s = equiaffine::local_structure_at(traits, Kernel::Point_3(1, 1, -1));
  std::cout << to_string(s.status) << ' ' << s.affine.gaussian_curvature << ' ' << s.affine.mean_curvature << '\n';
}
