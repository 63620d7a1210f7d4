// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices and triangles are removed from a mesh, and copies of vertices are added, so that all others keep their order:
// what a plane of nodes and a layer of cells have stays together.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_REMOVE_FROM_MESH_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_REMOVE_FROM_MESH_H

#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// The places in the arrays of a mesh where the vertices of each plane of nodes, with those of the cells above, and the
/// triangles of each layer of cells begin. One more place is the end.
struct Layer_bounds {
  std::vector<std::size_t> vertices, triangles;

  explicit Layer_bounds(const Isosurface_numbering& numbering) {
    const std::size_t planes = numbering.number_of_planes();
    for (std::size_t k = 0; k <= planes; ++k) {
      vertices.push_back(numbering.vertices_of_planes(k, planes).first);
      triangles.push_back(k < planes ? numbering.triangles_of_layer(k).first : numbering.number_of_triangles());
    }
  }
};

/// Counts how many of some numbers are smaller than another one, in constant time.
template <class Index>
class Counts_below {
public:
  /// `numbers` are ascending, without repetition, and below n.
  Counts_below(const std::vector<Index>& numbers, std::size_t n) : words_(n / 64 + 1), before_(n / 64 + 1) {
    for (const Index number : numbers) words_[number / 64] |= std::uint64_t(1) << number % 64;
    for (std::size_t w = 1; w < words_.size(); ++w) before_[w] = before_[w - 1] + Index(std::popcount(words_[w - 1]));
  }

  /// \pre number <= n
  Index operator()(std::size_t number) const {
    const std::uint64_t smaller = words_[number / 64] & ((std::uint64_t(1) << number % 64) - 1);
    if (smaller == 0) return before_[number / 64]; // mostly; code for any processor counts bits by a call
    return before_[number / 64] + Index(std::popcount(smaller));
  }

private:
  std::vector<std::uint64_t> words_; // a bit per number
  std::vector<Index> before_;        // the count before each word
};

/// Removes entries from an array, and calls `move(first, end, to)` to move those between to a place at or before theirs,
/// which returns the end of it. `removed` is ascending, without repetition.
template <class Index, class Array, class Move>
void remove_from_array(const std::vector<Index>& removed, Array& array, const Move& move) {
  auto first = array.begin(), to = first;
  for (const Index n : removed) {
    const auto entry = array.begin() + std::ptrdiff_t(n);
    to = move(first, entry, to);
    first = entry + 1;
  }
  array.erase(move(first, array.end(), to), array.end());
}

template <class Index, class Array>
void remove_from_array(const std::vector<Index>& removed, Array& array) {
  remove_from_array(removed, array,
                    [](auto first, auto end, auto to) { return first == to ? end : std::move(first, end, to); });
}

/// Writes triangles to a place at or before theirs, with the numbers that their vertices have when others are removed.
/// Returns the end of that place. Mostly no removed vertex is among those of a block of triangles, whose numbers then all
/// change by the same.
template <class Iterator, class Index>
Iterator write_renumbered(Iterator first, Iterator end, const Counts_below<Index>& removed_before, Iterator to) {
  constexpr std::ptrdiff_t most = 256; // triangles in a block
  while (first != end) {
    const Iterator end_of_block = first + std::min(end - first, most);
    Index least = (*first)[0], greatest = least;
    for (Iterator t = first; t != end_of_block; ++t)
      for (const Index v : *t) {
        least = std::min(least, v);
        greatest = std::max(greatest, v);
      }
    const Index change = removed_before(least);
    if (change == removed_before(greatest)) {
      for (; first != end_of_block; ++first, ++to)
        *to = {(*first)[0] - change, (*first)[1] - change, (*first)[2] - change};
    } else {
      for (; first != end_of_block; ++first, ++to) {
        *to = *first;
        for (Index& v : *to) v -= removed_before(v);
      }
    }
  }
  return to;
}

template <class Index>
void remove_from_bounds(const std::vector<Index>& removed, std::vector<std::size_t>& bounds) {
  for (std::size_t& bound : bounds)
    bound -= std::size_t(std::lower_bound(removed.begin(), removed.end(), bound) - removed.begin());
}

/// Removes vertices that no other triangles have, and triangles. `properties` are arrays with an entry per vertex. The
/// numbers that are removed are ascending, without repetition.
template <class Triangles, class Points, class... Properties>
void remove_from_mesh(const std::vector<std::uint32_t>& removed_vertices,
                      const std::vector<std::size_t>& removed_triangles, Layer_bounds& bounds, Triangles& triangles,
                      Points& points, Properties&... properties) {
  remove_from_bounds(removed_triangles, bounds.triangles);
  if (removed_vertices.empty()) return remove_from_array(removed_triangles, triangles);
  const Counts_below removed_before(removed_vertices, points.size());
  remove_from_array(removed_triangles, triangles,
                    [&](auto first, auto end, auto to) { return write_renumbered(first, end, removed_before, to); });
  remove_from_array(removed_vertices, points);
  (remove_from_array(removed_vertices, properties), ...);
  remove_from_bounds(removed_vertices, bounds.vertices);
}

/// Moves the last entries of an array, copies of earlier ones, behind these. `originals` says of which, and is
/// ascending.
template <class Array>
void place_copies(const std::vector<std::uint32_t>& originals, const std::vector<std::size_t>& order, Array& array) {
  const std::size_t old_size = array.size() - originals.size();
  const std::vector<typename Array::value_type> copies(array.begin() + std::ptrdiff_t(old_size), array.end());
  std::size_t to = array.size(), from = old_size;
  for (std::size_t n = originals.size(); n-- > 0;) {
    while (from > originals[n] + std::size_t(1)) array[--to] = array[--from];
    array[--to] = copies[order[n]];
  }
}

/// Moves copies of vertices, which are the last ones, behind their originals: `originals` says of which each is a copy.
template <class Triangles, class Points, class... Properties>
void place_copies_behind_originals(const std::vector<std::uint32_t>& originals, Layer_bounds& bounds,
                                   Triangles& triangles, Points& points, Properties&... properties) {
  std::vector<std::size_t> order(originals.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return originals[a] < originals[b]; });
  std::vector<std::uint32_t> sorted(originals.size()), number_of_copy(originals.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    sorted[n] = originals[order[n]];
    number_of_copy[order[n]] = std::uint32_t(sorted[n] + n + 1);
  }
  const std::size_t old_size = points.size() - originals.size();
  const auto copies_before = [&](std::size_t v) {
    return std::uint32_t(std::lower_bound(sorted.begin(), sorted.end(), v) - sorted.begin());
  };
  for (auto& triangle : triangles)
    for (auto& v : triangle) v = v < old_size ? v + copies_before(v) : number_of_copy[v - old_size];
  for (std::size_t& bound : bounds.vertices) bound += copies_before(bound);
  place_copies(sorted, order, points);
  (place_copies(sorted, order, properties), ...);
}

} // namespace equiaffine::internal

#endif
