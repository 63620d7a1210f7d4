// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_FEW_VALUES_H
#define EQUIAFFINE_VOLUME_FEW_VALUES_H

#include <equiaffine/volume/Volume_parts_3.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace equiaffine {

/// Returns the number of distinct values in up to 4096 rows of the samples, if it is 256 or less: then they are steps,
/// such as those of a mask, and curvatures without smoothing are those of the steps. It is the same however the volume
/// is cut.
template <class Kernel>
std::optional<std::size_t> number_of_few_values(const Volume_parts_3<Kernel>& volume) {
  constexpr std::size_t most_values = 256, most_rows = 4096;
  const auto [nx, ny, nz] = volume.lattice.size();
  const std::size_t step = 1 + ny * nz / most_rows;
  std::set<double> values;
  for (const auto& [part, cells] : volume.parts) {
    std::vector<double> row(cells.end[0] + 1 - cells.first[0]);
    for (std::size_t n = 0; n < ny * nz && values.size() <= most_values; n += step) {
      const std::size_t j = n % ny, k = n / ny;
      if (j < cells.first[1] || cells.end[1] < j || k < cells.first[2] || cells.end[2] < k) continue;
      part.copy_line({cells.first[0], j, k}, 0, row);
      for (std::size_t i = 0; i < row.size(); ++i)
        if (std::isfinite(row[i]) && (i == 0 || row[i] != row[i - 1])) values.insert(row[i]);
    }
  }
  const std::vector<double> of_all = volume.gather({values.begin(), values.end()});
  values.insert(of_all.begin(), of_all.end());
  if (values.size() > most_values) return std::nullopt;
  return values.size();
}

} // namespace equiaffine

#endif
