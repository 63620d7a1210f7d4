// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/erases_mask.h"

#include <array>
#include <cstddef>
#include <vector>

namespace equiaffine {

namespace {

/// Calls f(node, sample) for the nodes of a volume.
template <class F>
void for_each_node(const Volume_view_3<Kernel>& volume, const F& f) {
  const auto [nx, ny, nz] = volume.lattice().size();
  std::vector<double> row(nx);
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j) {
      volume.copy_line({0, j, k}, 0, row);
      for (std::size_t i = 0; i < nx; ++i) f(std::array{i, j, k}, row[i]);
    }
}

} // namespace

bool erases_mask(const Spline_traits& spline, const Volume_view_3<Kernel>& mask, double isovalue) {
  constexpr std::size_t enough = 1000;
  std::array<std::size_t, 2> sizes{};
  for_each_node(mask, [&](const auto&, double sample) { ++sizes[sample > isovalue]; });
  const bool is_above = sizes[1] < sizes[0];
  const std::size_t step = 1 + sizes[is_above] / enough;
  std::size_t seen = 0, tried = 0, kept = 0;
  for_each_node(mask, [&](const std::array<std::size_t, 3>& node, double sample) {
    if ((sample > isovalue) != is_above || seen++ % step != 0) return;
    ++tried;
    kept +=
        (spline.value(mask.lattice().point(double(node[0]), double(node[1]), double(node[2]))) > isovalue) == is_above;
  });
  return 10 * kept < 9 * tried;
}

} // namespace equiaffine
