// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_CELL_VERTICES_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_CELL_VERTICES_H

#include <equiaffine/marching_cubes/internal/case_table.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace equiaffine::internal {

/// The numbers of the vertices of one cell, in the slots of Case_table. They are kept up to date on the way along a row
/// of cells. The slot of an edge without a vertex has the number of the next vertex along the row on such an edge.
class Cell_vertices {
public:
  using Index = Isosurface_numbering::Index;
  using Crossed = Case_table::Crossed_edges;

  /// Looks up the vertices on the edges that begin at the lower end of a cell.
  void start_at(const Isosurface_numbering& numbering, std::size_t i, std::size_t j, std::size_t k) {
    constexpr std::size_t axes[8] = {0, 0, 0, 0, 1, 1, 2, 2}, dj[8] = {0, 1, 0, 1, 0, 0, 0, 1},
                          dk[8] = {0, 0, 1, 1, 0, 1, 0, 0};
    for (std::size_t n = 0; n < 8; ++n) slots_[n] = numbering.vertex_from(i, j + dj[n], k + dk[n], axes[n]);
  }

  /// Sets the vertices at the upper end of the cell: the row of an edge there goes on after the edge at the lower end.
  void enter_cell(const Crossed& crossed) {
    for (std::size_t n = lower; n < upper; ++n) slots_[n + upper - lower] = slots_[n] + crossed[n];
  }

  /// Goes on to the next cell of the row, whose lower end is the upper end of this one.
  void leave_cell(const Crossed& crossed) {
    for (std::size_t n = 0; n < lower; ++n) slots_[n] += crossed[n];
    for (std::size_t n = lower; n < upper; ++n) slots_[n] = slots_[n + upper - lower];
  }

  std::size_t first_inner() const { return slots_[inner]; }

  /// The inner vertices of a cell have successive numbers.
  void set_first_inner(std::size_t vertex) {
    for (std::size_t n = 0; n < 3; ++n) slots_[inner + n] = Index(vertex + n);
  }

  Index operator[](std::uint8_t slot) const { return slots_[slot]; }

private:
  static constexpr std::size_t lower = Case_table::first_lower_slot, upper = Case_table::first_upper_slot,
                               inner = Case_table::first_inner_slot;

  std::array<Index, Case_table::number_of_slots> slots_{};
};

} // namespace equiaffine::internal

#endif
