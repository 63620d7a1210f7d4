// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ZERO_AREA_REPAIR_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ZERO_AREA_REPAIR_H

#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

// Vertices and triangles are removed from a mesh, and copies of vertices are added, such that the order is kept: the
// vertices of a plane of nodes and the triangles of a layer of cells stay contiguous.

/// The indices at which the vertices of each plane of nodes, with those of the cells above, and the triangles of each
/// layer of cells begin. One more index marks the end.
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

/// Counts the numbers of a set that are smaller than a given number, in constant time.
template <class Index>
class Counts_below {
public:
  /// `numbers` are ascending, distinct, and below n.
  Counts_below(const std::vector<Index>& numbers, std::size_t n) : words_(n / 64 + 1), before_(n / 64 + 1) {
    for (const Index number : numbers) words_[number / 64] |= std::uint64_t(1) << number % 64;
    for (std::size_t w = 1; w < words_.size(); ++w) before_[w] = before_[w - 1] + Index(std::popcount(words_[w - 1]));
  }

  /// \pre number <= n
  Index operator()(std::size_t number) const {
    const std::uint64_t smaller = words_[number / 64] & ((std::uint64_t(1) << number % 64) - 1);
    if (smaller == 0) return before_[number / 64]; // usual; in portable code popcount is a function call
    return before_[number / 64] + Index(std::popcount(smaller));
  }

private:
  std::vector<std::uint64_t> words_; // one bit per number
  std::vector<Index> before_;        // the count before each word
};

/// Removes entries from an array. Calls `move(first, end, to)` to move the entries between to an earlier or the same
/// position; it returns the end of the moved entries. `removed` is ascending and distinct.
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

/// Writes triangles to an earlier or the same position, with the vertex indices after the removal. Returns the end of
/// the written triangles. Usually no removed vertex lies between those of a block of triangles, and all indices
/// change by the same amount.
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

/// Removes triangles, and vertices that no remaining triangle has. `properties` are arrays with one entry per vertex.
/// The removed indices are ascending and distinct.
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

/// Moves the last entries of an array, which are copies of earlier ones, directly after their originals. `originals`
/// is ascending.
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

/// Moves copies of vertices from the end to directly after their originals; `originals` has one index per copy.
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

/// Whether three points span a triangle of area zero in double precision.
template <class Coordinates>
bool has_zero_area(const Coordinates& a, const Coordinates& b, const Coordinates& c) {
  std::array<double, 3> u, v;
  for (std::size_t m = 0; m < 3; ++m) {
    u[m] = double(b[m]) - double(a[m]);
    v[m] = double(c[m]) - double(a[m]);
  }
  for (std::size_t m = 0; m < 3; ++m) {
    const std::size_t n = (m + 1) % 3;
    const double product = u[m] * v[n],
                 other = u[n] * v[m]; // compared, because compilers may contract a difference
    if (product != other || std::isinf(product)) return false;
  }
  return true;
}

template <class Triangles, class Coordinates>
bool any_zero_area(const Triangles& triangles, const Coordinates& coordinates) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
    return has_zero_area(coordinates(t[0]), coordinates(t[1]), coordinates(t[2]));
  });
}

/// Removes triangles of zero area from a mesh made by Marching Cubes, where the surface passes through nodes. It
/// contracts edges of zero length while that preserves the topology (link condition: Dey, Edelsbrunner, Guha,
/// Nekhayev 1999), drops components without area, and gives the remaining triangles area by moving vertices slightly.
///
/// `coordinates(v)` returns those of a vertex, `nudge(v, round)` moves it slightly, and `is_at_cut(v)` returns
/// whether the mesh continues there beyond its known part. `run` marks the triangles to remove by three equal
/// indices, and `remove` removes them.
template <class Coordinates, class Nudge, class Is_at_cut>
class Zero_area_repair {
public:
  using Index = std::uint32_t;
  using Triangle = std::array<Index, 3>;

  /// `suspects` are all triangles that may have no area, and all triangles that share a vertex with such a triangle.
  Zero_area_repair(std::span<Triangle> triangles, const std::vector<std::size_t>& suspects,
                   const Coordinates& coordinates, const Nudge& nudge, const Is_at_cut& is_at_cut)
      : triangles_(triangles), coordinates_(coordinates), nudge_(nudge), is_at_cut_(is_at_cut) {
    for (const std::size_t t : suspects)
      if (is_flat(t)) flat_.push_back(t);
    if (!flat_.empty()) find_stars(suspects);
  }

  /// Repairs the triangles and returns the number of repairs.
  Isosurface_repairs run() {
    if (flat_.empty()) return {};
    while (contract_edges()) continue;
    drop_components();
    move_vertices();
    return repairs_;
  }

  /// Whether a closed part without area may continue beyond a cut, so that dropping it cannot be decided.
  bool is_undecided() const { return is_undecided_; }

  /// Removes the marked triangles, and the vertices that are no longer in any triangle from `points...`, arrays with
  /// one entry per vertex.
  template <class Triangles, class... Points>
  void remove(Layer_bounds& bounds, Triangles& triangles, Points&... points) {
    sort_and_unite(removed_vertices_);
    sort_and_unite(removed_triangles_);
    remove_from_mesh(removed_vertices_, removed_triangles_, bounds, triangles, points...);
  }

private:
  static bool is_removed(const Triangle& t) { return t[0] == t[1]; }
  static void sort_and_unite(auto& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }
  static bool contains(const Triangle& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

  bool is_flat(std::size_t t) const {
    const Triangle& triangle = triangles_[t];
    return !is_removed(triangle) &&
           has_zero_area(coordinates_(triangle[0]), coordinates_(triangle[1]), coordinates_(triangle[2]));
  }

  /// Finds the triangles around the vertices of flat triangles.
  void find_stars(const std::vector<std::size_t>& suspects) {
    Index last = 0;
    for (const std::size_t t : suspects) last = std::max({last, triangles_[t][0], triangles_[t][1], triangles_[t][2]});
    std::vector<bool> has_star(std::size_t(last) + 1);
    for (const std::size_t t : flat_)
      for (const Index v : triangles_[t]) has_star[v] = true;
    for (const std::size_t t : suspects)
      for (const Index v : triangles_[t])
        if (has_star[v]) stars_[v].push_back(t);
  }

  /// Contracts edges of zero length where possible. Returns false if there was none.
  bool contract_edges() {
    const std::size_t before = repairs_.contracted_edges;
    for (const std::size_t t : flat_)
      for (std::size_t m = 0; m < 3 && !is_removed(triangles_[t]); ++m) {
        const Index u = triangles_[t][m], v = triangles_[t][(m + 1) % 3];
        if (coordinates_(u) == coordinates_(v) && may_contract(u, v)) contract(u, v);
      }
    return repairs_.contracted_edges != before;
  }

  /// The vertices around v, each with the number of triangles at the edge to it: 1 on the boundary, otherwise 2.
  std::unordered_map<Index, int> neighbors(Index v) const {
    std::unordered_map<Index, int> result;
    for (const std::size_t t : stars_.at(v))
      for (const Index w : triangles_[t])
        if (w != v) ++result[w];
    return result;
  }

  static bool is_on_boundary(const std::unordered_map<Index, int>& around) {
    return std::any_of(around.begin(), around.end(), [](const auto& n) { return n.second == 1; });
  }

  /// Whether contraction of the edge uv preserves the topology and creates no duplicate triangle.
  bool may_contract(Index u, Index v) const {
    const auto around_u = neighbors(u), around_v = neighbors(v);
    const int triangles = around_u.at(v);
    if (is_on_boundary(around_u) && is_on_boundary(around_v) && triangles == 2) return false;
    int common = 0;
    for (const auto& [w, n] : around_u) {
      const auto at_v = around_v.find(w);
      if (at_v == around_v.end()) continue;
      ++common;
      if (n == 1 && at_v->second == 1) return false; // w has no other triangle
    }
    return common == triangles && !is_edge_facing_both(u, v);
  }

  /// Whether some triangle at u and another one at v share the edge opposite to these vertices. They would become the
  /// same triangle.
  bool is_edge_facing_both(Index u, Index v) const {
    for (const std::size_t s : stars_.at(u)) {
      if (contains(triangles_[s], v)) continue;
      for (const std::size_t t : stars_.at(v)) {
        const auto is_at_u_or_in_t = [&](Index w) { return w == u || contains(triangles_[t], w); };
        if (std::all_of(triangles_[s].begin(), triangles_[s].end(), is_at_u_or_in_t)) return true;
      }
    }
    return false;
  }

  /// Moves the triangles at u to v and removes those at both.
  void contract(Index u, Index v) {
    for (const std::size_t t : stars_[u]) {
      Triangle& triangle = triangles_[t];
      if (contains(triangle, v)) {
        for (const Index w : triangle)
          if (const auto star = stars_.find(w); w != u && star != stars_.end()) std::erase(star->second, t);
        triangle.fill(v);
        removed_triangles_.push_back(t);
      } else {
        std::replace(triangle.begin(), triangle.end(), u, v);
        stars_[v].push_back(t);
      }
    }
    stars_.erase(u);
    removed_vertices_.push_back(u);
    ++repairs_.contracted_edges;
  }

  /// Drops the closed components without area.
  void drop_components() {
    std::unordered_set<std::size_t> visited;
    for (const std::size_t first : flat_) {
      if (!is_flat(first) || visited.contains(first)) continue;
      std::vector<std::size_t> component = {first}; // the flat triangles that are connected with the first
      visited.insert(first);
      bool is_closed_and_flat = true, meets_cut = false;
      for (std::size_t n = 0; n < component.size(); ++n)
        for (const Index v : triangles_[component[n]]) {
          if (is_on_boundary(neighbors(v))) {
            if (is_at_cut_(v)) meets_cut = true;
            else is_closed_and_flat = false;
          }
          for (const std::size_t t : stars_[v]) {
            if (!is_flat(t)) is_closed_and_flat = false;
            else if (visited.insert(t).second) component.push_back(t);
          }
        }
      if (is_closed_and_flat && meets_cut) is_undecided_ = true;
      else if (is_closed_and_flat) drop(component);
    }
  }

  void drop(const std::vector<std::size_t>& component) {
    ++repairs_.dropped_components;
    for (const std::size_t t : component) {
      removed_vertices_.insert(removed_vertices_.end(), triangles_[t].begin(), triangles_[t].end());
      triangles_[t].fill(triangles_[t][0]);
    }
    removed_triangles_.insert(removed_triangles_.end(), component.begin(), component.end());
  }

  /// Moves vertices slightly to give the remaining flat triangles area.
  void move_vertices() {
    constexpr int rounds = 4; // a vertex moves by at most 2.5e-7 in each
    std::unordered_set<Index> moved;
    for (int round = 0; round < rounds; ++round) {
      std::vector<Index> vertices;
      for (const std::size_t t : flat_)
        if (is_flat(t)) vertices.insert(vertices.end(), triangles_[t].begin(), triangles_[t].end());
      sort_and_unite(vertices);
      for (const Index v : vertices) nudge_(v, round);
      moved.insert(vertices.begin(), vertices.end());
      flat_.clear(); // moving a vertex may have flattened triangles around it
      for (const Index v : vertices) flat_.insert(flat_.end(), stars_[v].begin(), stars_[v].end());
    }
    repairs_.moved_vertices = moved.size();
    sort_and_unite(flat_);
    repairs_.zero_area_left =
        std::size_t(std::count_if(flat_.begin(), flat_.end(), [&](std::size_t t) { return is_flat(t); }));
  }

  std::span<Triangle> triangles_;
  const Coordinates& coordinates_;
  const Nudge& nudge_;
  const Is_at_cut& is_at_cut_;
  std::vector<std::size_t> flat_;                             // triangles that may have no area
  std::unordered_map<Index, std::vector<std::size_t>> stars_; // the triangles around their vertices
  std::vector<Index> removed_vertices_;
  std::vector<std::size_t> removed_triangles_;
  Isosurface_repairs repairs_;
  bool is_undecided_ = false;
};

/// A position near p = move(0): move(d) for a small d that depends on the place of the vertex and the round. d is at
/// most 2.5e-7 if move(0.5e-7) differs from p, otherwise a few roundings.
template <class Point, class Move>
Point nudged(const Point& p, std::size_t place, int round, const Move& move) {
  // The square makes vertices that move alike in one round move differently in the next one.
  const double golden = 0.6180339887498949 * double(place) * (round + 1) * (round + 1);
  double d = 0.5e-7;
  while (move(d) == p && d < 1) d *= 2;
  return move(d * (1 + 4 * (golden - std::floor(golden))));
}

} // namespace equiaffine::internal

#endif
