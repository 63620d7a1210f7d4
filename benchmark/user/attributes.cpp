// SPDX-License-Identifier: GPL-3.0-or-later
// A user's program for attributes of many points; the benchmark `kernel` measures its compile time.
#include "surface.h"

#include <iostream>
#include <vector>

int main() {
  const Traits traits = surface_traits();
  const std::vector<Kernel::Point_3> points = {{1, 1, -1}, {1, 0, 1}, {0, 1, 1}};
  const auto attributes = equiaffine::compute_attributes(traits, points, equiaffine::select_attributes("basic"));
  for (const auto& column : attributes.columns) std::cout << column.name << ' ' << column.values[0] << '\n';
}
