// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_CHARTS_3_H
#define EQUIAFFINE_FIT_INTERNAL_CHARTS_3_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The smooth parts of a surface between its creases. A point on a crease is one of each part that meets there.
struct Charts_3 {
  using Index = std::uint32_t;

  std::vector<Index> of_point;                    ///< a number for each point; empty if there is no crease
  std::vector<char> is_on_crease;                 ///< for each point; empty if there is no crease
  std::map<std::pair<Index, Index>, double> bend; ///< of the creases between two parts: above 0 if they are convex

  bool empty() const { return of_point.empty(); }
  Index of(std::size_t i) const { return empty() ? 0 : of_point[i]; }
  bool has_crease_at(std::size_t i) const { return !empty() && is_on_crease[i]; }

  /// 1 if two parts meet at a convex crease, -1 at a concave one, and 0 if they do not meet.
  int sign(Index a, Index b) const {
    const auto found = bend.find(std::minmax(a, b));
    return found == bend.end() || found->second == 0 ? 0 : found->second > 0 ? 1 : -1;
  }

  /// Returns the position of the value that a solid has which is bounded by several parts, from the signed distance of
  /// each, that of the nearest part first: the solid is the intersection of those that meet at convex creases, whose
  /// value is the greatest, and the union of those at concave ones (as in constructive solid geometry; Ohtake et al.,
  /// Multi-level partition of unity implicits, 2003). Where both kinds meet, the rarer one comes first.
  std::size_t position_of_value(const std::vector<std::pair<Index, double>>& parts) const {
    int convex = 0, concave = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const int s = sign(parts[i].first, parts[j].first);
        convex += s > 0;
        concave += s < 0;
      }
    const int inner = convex >= concave ? -1 : 1; // the sign of the creases that come first
    const auto better = [&](int kind, std::size_t i, std::size_t j) {
      return kind * (parts[i].second - parts[j].second) > 0 ? i : j;
    };
    std::size_t best = parts.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i > 0 && sign(parts[i].first, parts[0].first) == 0) continue; // another sheet
      std::size_t of_group = i;
      for (std::size_t j = 0; j < parts.size(); ++j)
        if (sign(parts[i].first, parts[j].first) == inner) of_group = better(inner, j, of_group);
      best = best == parts.size() ? of_group : better(-inner, of_group, best);
    }
    return best;
  }
};

} // namespace equiaffine::internal

#endif
