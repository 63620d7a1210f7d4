// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESHER_ORIENT_TRIANGLES_H
#define EQUIAFFINE_MESHER_ORIENT_TRIANGLES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Turns triangles over so that the two at an edge pass it in opposite directions, as few of each part that hangs
/// together by such edges as can be. \pre the parts can be oriented
inline void orient_triangles(std::vector<std::array<std::uint32_t, 3>>& triangles) {
  struct Side {
    std::uint32_t first, second; // the smaller index first
    bool is_reversed;
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

  struct Neighbor {
    std::size_t triangle;
    bool agrees;
  };
  std::vector<std::vector<Neighbor>> neighbors(triangles.size());
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const Side& s) { return ends(s) != ends(*first); });
    if (last - first == 2) {
      const bool agrees = first[0].is_reversed != first[1].is_reversed;
      neighbors[first[0].triangle].push_back({first[1].triangle, agrees});
      neighbors[first[1].triangle].push_back({first[0].triangle, agrees});
    }
    first = last;
  }

  enum State { UNSEEN, KEPT, TURNED };
  std::vector<State> state(triangles.size(), UNSEEN);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (state[t] != UNSEEN) continue;
    std::vector<std::size_t> part = {t};
    state[t] = KEPT;
    for (std::size_t n = 0; n < part.size(); ++n)
      for (const Neighbor& next : neighbors[part[n]]) {
        if (state[next.triangle] != UNSEEN) continue;
        state[next.triangle] = (state[part[n]] == KEPT) == next.agrees ? KEPT : TURNED;
        part.push_back(next.triangle);
      }
    const auto turned = std::count_if(part.begin(), part.end(), [&](std::size_t u) { return state[u] == TURNED; });
    const State lesser = 2 * std::size_t(turned) > part.size() ? KEPT : TURNED;
    for (const std::size_t u : part)
      if (state[u] == lesser) std::swap(triangles[u][1], triangles[u][2]);
  }
}

} // namespace equiaffine::internal

#endif
