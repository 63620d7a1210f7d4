// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_CELL_BLOCK_H
#define EQUIAFFINE_VOLUME_CELL_BLOCK_H

#include <array>
#include <cstddef>

namespace equiaffine {

/// The cells of a lattice from `first` up to, but without, `end` along each axis. Cell (i, j, k) has the nodes (i, j, k)
/// to (i + 1, j + 1, k + 1).
struct Cell_block {
  std::array<std::size_t, 3> first; ///< the first cell along each axis
  std::array<std::size_t, 3> end;   ///< the cell behind the last one along each axis

  /// Whether the block contains a cell.
  bool contains(const std::array<std::size_t, 3>& cell) const {
    return first[0] <= cell[0] && cell[0] < end[0] && first[1] <= cell[1] && cell[1] < end[1] && first[2] <= cell[2] &&
           cell[2] < end[2];
  }
};

} // namespace equiaffine

#endif
