// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of cells of a lattice, and the nodes of these cells along an axis.
#ifndef EQUIAFFINE_VOLUME_CELL_BLOCK_H
#define EQUIAFFINE_VOLUME_CELL_BLOCK_H

#include <algorithm>
#include <array>
#include <cstddef>

namespace equiaffine {

/// The cells of a lattice from `first` up to, but not including, `end` along each axis. Cell (i, j, k) has the nodes
/// (i, j, k) to (i + 1, j + 1, k + 1).
struct Cell_block {
  std::array<std::size_t, 3> first; ///< the first cell along each axis
  std::array<std::size_t, 3> end;   ///< one past the last cell along each axis

  /// Whether the block contains a cell.
  bool contains(const std::array<std::size_t, 3>& cell) const {
    return first[0] <= cell[0] && cell[0] < end[0] && first[1] <= cell[1] && cell[1] < end[1] && first[2] <= cell[2] &&
           cell[2] < end[2];
  }

  /// Whether both have the same cells.
  bool operator==(const Cell_block&) const = default;
};

/// All cells of a lattice with the given number of nodes along each axis.
inline Cell_block cells_of(const std::array<std::size_t, 3>& nodes) {
  return {{0, 0, 0}, {nodes[0] - 1, nodes[1] - 1, nodes[2] - 1}};
}

/// The intersection of a block with `all`, or the nearest cells of `all` if it is empty.
inline Cell_block clamped(const Cell_block& block, const Cell_block& all) {
  Cell_block cells;
  for (std::size_t a = 0; a < 3; ++a) {
    cells.first[a] = std::clamp(block.first[a], all.first[a], all.end[a] - 1);
    cells.end[a] = std::clamp(block.end[a], cells.first[a] + 1, all.end[a]);
  }
  return cells;
}

/// A block enlarged by `margin` cells on each side, clipped to `all`.
inline Cell_block widened(const Cell_block& block, std::size_t margin, const Cell_block& all) {
  Cell_block cells = block;
  for (std::size_t a = 0; a < 3; ++a) {
    cells.first[a] = std::max(block.first[a] - std::min(block.first[a], margin), all.first[a]);
    cells.end[a] = std::min(block.end[a] + margin, all.end[a]);
  }
  return cells;
}

} // namespace equiaffine

namespace equiaffine::internal {

/// The indices of a line from `first` up to, but not including, `end`.
struct Line_part {
  std::size_t first, end;
  std::size_t size() const { return end - first; }
};

/// The nodes of the cells of a block along an axis.
inline Line_part nodes_of(const Cell_block& cells, std::size_t axis) {
  return {cells.first[axis], cells.end[axis] + 1};
}

/// The nodes along an axis that belong to a block of cells and to no other block: the lower nodes of its cells, and
/// the last node of the lattice.
inline Line_part own_nodes_of(const Cell_block& cells, std::size_t axis, std::size_t nodes_of_lattice) {
  const std::size_t end = cells.end[axis];
  return {cells.first[axis], end + 1 == nodes_of_lattice ? end + 1 : end};
}

} // namespace equiaffine::internal

#endif
