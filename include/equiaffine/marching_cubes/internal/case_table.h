// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_CASE_TABLE_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_CASE_TABLE_H

#include <equiaffine/marching_cubes/internal/marching_cubes_cases.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The sub-cases of Marching_cubes_cases in flat arrays, for speed. The vertices of a cell are kept in slots: first
/// those on the edges 0, 1, 2, 3, which run along i, then those on 4, 5, 8, 10 at the lower end of the cell along i,
/// then those on 6, 7, 9, 11, which face them at its upper end, then the inner vertices.
struct Case_table {
  static constexpr std::size_t first_lower_slot = 4, first_upper_slot = 8, first_inner_slot = 12, number_of_slots = 16;

  /// One number for each edge of the first eight slots, which begin at the lower end of the cell: 1 if the edge is
  /// crossed, else 0.
  using Crossed_edges = std::array<std::uint32_t, 8>;

  struct Entry {
    std::uint32_t first_slot;
    std::uint8_t triangles, inner_vertices;
    bool is_ambiguous;
  };

  /// Few cells have more triangles than this. The slots of so many triangles may be read from any entry on.
  static constexpr std::size_t triangles_of_most_cells = 4;

  static const Case_table& instance() {
    static const Case_table table;
    return table;
  }

  Case_table() {
    const auto& cases = Marching_cubes_cases::instance();
    constexpr std::uint8_t slot_of_edge[15] = {0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12, 13, 14};
    for (std::size_t s = 0; s < cases.size(); ++s) {
      of_sub_case.push_back({std::uint32_t(slots[0].size()), std::uint8_t(cases[s].triangles.size()),
                             std::uint8_t(cases[s].inner_edges.size()), false});
      for (const auto& t : cases[s].triangles)
        for (std::size_t m = 0; m < 3; ++m) {
          slots[0].push_back(slot_of_edge[t[m]]);
          slots[1].push_back(slot_of_edge[t[(3 - m) % 3]]);
        }
    }
    for (auto& side : slots) side.resize(side.size() + 3 * triangles_of_most_cells);
    for (unsigned signs = 0; signs < 256; ++signs) {
      of_signs[signs] = of_sub_case[cases.variant(signs, 0).sub_case];
      of_signs[signs].is_ambiguous = cases.is_ambiguous(signs);
      const auto differ = [&](int c, int d) { return (signs >> c ^ signs >> d) & 1; };
      crossed[signs] = {differ(0, 1), differ(2, 3), differ(4, 5), differ(6, 7),
                        differ(0, 2), differ(4, 6), differ(0, 4), differ(2, 6)};
    }
  }

  std::vector<Entry> of_sub_case;
  std::array<Entry, 256> of_signs; ///< for all signs of the corners; if is_ambiguous is set, only that is valid
  std::array<std::vector<std::uint8_t>, 2> slots; ///< three per triangle; slots[1] has them the other way round
  std::array<Crossed_edges, 256> crossed;         ///< for all signs of the corners
};

} // namespace equiaffine::internal

#endif
