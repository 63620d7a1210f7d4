// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_LINE_PART_H
#define EQUIAFFINE_VOLUME_INTERNAL_LINE_PART_H

#include <equiaffine/volume/Cell_block.h>

#include <cstddef>

namespace equiaffine::internal {

/// The numbers of a line from `first` up to, but without, `end`.
struct Line_part {
  std::size_t first, end;
  std::size_t size() const { return end - first; }
};

/// The nodes of the cells of a block along an axis.
inline Line_part nodes_of(const Cell_block& cells, std::size_t axis) {
  return {cells.first[axis], cells.end[axis] + 1};
}

/// The nodes that belong to a block of cells along an axis, and to no other block: those where its cells begin, and the
/// last one of the lattice.
inline Line_part own_nodes_of(const Cell_block& cells, std::size_t axis, std::size_t nodes_of_lattice) {
  const std::size_t end = cells.end[axis];
  return {cells.first[axis], end + 1 == nodes_of_lattice ? end + 1 : end};
}

} // namespace equiaffine::internal

#endif
