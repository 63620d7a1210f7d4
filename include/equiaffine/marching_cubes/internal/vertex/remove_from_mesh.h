// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_REMOVE_FROM_MESH_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_REMOVE_FROM_MESH_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// Removes entries of an array of n by putting the last ones in their places: calls move(from, to), and returns how
/// many are left. `removed` is ascending, without repetition.
template <class Index, class Move>
std::size_t fill_holes(std::size_t n, const std::vector<Index>& removed, const Move& move) {
  const std::size_t kept = n - removed.size();
  auto is_removed_at = std::lower_bound(removed.begin(), removed.end(), kept);
  auto hole = removed.begin();
  for (std::size_t from = kept; from < n; ++from) {
    if (is_removed_at != removed.end() && *is_removed_at == from) ++is_removed_at;
    else move(from, std::size_t(*hole++));
  }
  return kept;
}

template <class Index, class Array>
void remove_from_array(const std::vector<Index>& removed, Array& array) {
  const std::size_t kept =
      fill_holes(array.size(), removed, [&](std::size_t from, std::size_t to) { array[to] = array[from]; });
  array.erase(array.begin() + std::ptrdiff_t(kept), array.end());
}

} // namespace equiaffine::internal

#endif
