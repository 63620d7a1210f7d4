// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_ORIENT_TRIANGLES_H
#define EQUIAFFINE_SRC_DELAUNAY_ORIENT_TRIANGLES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Two triangles with a common edge, which is in no third one.
struct Adjacent_triangle {
  std::size_t triangle; ///< index of the other one
  bool agrees;          ///< whether both pass the edge in opposite directions
};

/// The triangles across the edges of each triangle.
inline std::vector<std::vector<Adjacent_triangle>>
adjacent_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  struct Side {
    std::uint32_t first, second; // the smaller index first
    bool is_reversed;            // the triangle goes from the larger index to the smaller one
    std::size_t triangle;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::pair(triangles[t][i], triangles[t][(i + 1) % 3]);
      sides.push_back({std::min(a, b), std::max(a, b), a > b, t});
    }
  const auto ends = [](const Side& s) { return std::pair(s.first, s.second); };
  std::sort(sides.begin(), sides.end(), [&](const Side& s, const Side& t) {
    return std::tuple(s.first, s.second, s.triangle) < std::tuple(t.first, t.second, t.triangle);
  });
  std::vector<std::vector<Adjacent_triangle>> adjacent(triangles.size());
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const Side& s) { return ends(s) != ends(*first); });
    if (last - first == 2) {
      const bool agrees = first[0].is_reversed != first[1].is_reversed;
      adjacent[first[0].triangle].push_back({first[1].triangle, agrees});
      adjacent[first[1].triangle].push_back({first[0].triangle, agrees});
    }
    first = last;
  }
  return adjacent;
}

/// Flips the fewest triangles per component so that adjacent ones agree. Components are connected by edges that are in
/// exactly two triangles. \pre the components can be oriented
inline void orient_triangles(std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto adjacent = adjacent_triangles(triangles);
  enum State { UNSEEN, LIKE_FIRST, UNLIKE_FIRST };
  std::vector<State> state(triangles.size(), UNSEEN);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (state[t] != UNSEEN) continue;
    std::vector<std::size_t> component = {t};
    state[t] = LIKE_FIRST;
    for (std::size_t n = 0; n < component.size(); ++n)
      for (const Adjacent_triangle& next : adjacent[component[n]]) {
        if (state[next.triangle] != UNSEEN) continue;
        state[next.triangle] = (state[component[n]] == LIKE_FIRST) == next.agrees ? LIKE_FIRST : UNLIKE_FIRST;
        component.push_back(next.triangle);
      }
    const auto unlike =
        std::count_if(component.begin(), component.end(), [&](std::size_t u) { return state[u] == UNLIKE_FIRST; });
    const State fewer = 2 * std::size_t(unlike) > component.size() ? LIKE_FIRST : UNLIKE_FIRST;
    for (const std::size_t u : component)
      if (state[u] == fewer) std::swap(triangles[u][1], triangles[u][2]);
  }
}

} // namespace equiaffine::internal

#endif
