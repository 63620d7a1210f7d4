// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_CHARTS_3_H
#define EQUIAFFINE_FIT_INTERNAL_CHARTS_3_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The smooth parts of a surface between its creases. A point on a crease is one of each part that meets there.
struct Charts_3 {
  using Index = std::uint32_t;

  /// How two parts are combined: as the intersection or the union of half-spaces, or by the nearer one alone.
  enum class Relation { NONE, CONVEX, CONCAVE, MIXED };

  std::vector<Index> of_point;                    ///< a number for each point; empty if there is no crease
  std::vector<char> is_on_crease;                 ///< for each point; empty if there is no crease
  std::map<std::pair<Index, Index>, double> bend; ///< of the creases of two parts, in both orders: above 0 if convex
  std::map<std::pair<Index, Index>, Relation> at_corners; ///< of parts that have only a corner in common
  std::size_t most_at_point = 1;                          ///< the greatest number of parts that meet at a point

  bool empty() const { return of_point.empty(); }
  Index of(std::size_t i) const { return empty() ? 0 : of_point[i]; }
  bool has_crease_at(std::size_t i) const { return !empty() && is_on_crease[i]; }
  bool has_creases(Index a) const { return first_crease(a) != last_crease(a); }

  /// Returns the relation of parts that meet, one for all of their creases, or of parts that meet the same third part at
  /// creases of the same kind, as opposite sides of a plate or of a slot do. It is MIXED if they meet third parts in other
  /// ways only. Parts that have a corner in common have the relation of most creases there.
  Relation relation(Index a, Index b) const {
    if (const auto found = bend.find({a, b}); found != bend.end()) return kind_of(found->second);
    if (has_more_creases(a, b)) std::swap(a, b);
    Relation result = Relation::NONE;
    for (auto crease = first_crease(a); crease != last_crease(a); ++crease) {
      const auto other = bend.find({crease->first.second, b});
      if (other == bend.end()) continue;
      const Relation first = kind_of(crease->second), second = kind_of(other->second);
      if (first == second && first == Relation::CONVEX) return first;
      result = first == second || result == Relation::CONCAVE ? Relation::CONCAVE : Relation::MIXED;
    }
    if (result != Relation::NONE) return result;
    const auto found = at_corners.find(std::minmax(a, b));
    return found == at_corners.end() ? result : found->second;
  }

  /// Adds the relations of parts that have a corner in common.
  void add_corner(std::vector<Index> parts) {
    constexpr std::size_t most_parts = 64;
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    most_at_point = std::max(most_at_point, parts.size());
    if (parts.size() > most_parts) return;
    std::vector<std::pair<Index, Index>> apart;
    int convex = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Relation kind = relation(parts[j], parts[i]);
        convex += kind == Relation::CONVEX ? 1 : kind == Relation::CONCAVE ? -1 : 0;
        if (kind == Relation::NONE) apart.emplace_back(parts[j], parts[i]);
      }
    for (const auto& pair : apart) at_corners.emplace(pair, kind_of(convex));
  }

  /// The value of the function of a part. The greater its fading, the less decisive it is beside others; the value of a
  /// part that comes near or goes away has an infinite one.
  struct Part_value {
    Index chart;
    double value, fading;
  };

  /// The part whose value is that of the solid, and what fading adds to it.
  struct Choice {
    std::size_t position;
    double fading;
  };

  /// Returns whose value is that of a solid which is bounded by several parts, that of the nearest part first: the solid is the
  /// intersection of parts that meet at convex creases, whose value is the greatest, and the union of those at concave
  /// ones, whose value is the least (as in constructive solid geometry; Ohtake et al., Multi-level partition of unity
  /// implicits, 2003). Unions come first, then the intersection of all of them, which is right at corners of three parts
  /// and at those with one kind of creases. Parts without a relation to the nearest one are other sheets.
  Choice combined(const std::vector<Part_value>& parts) const {
    const auto is_related = [&](std::size_t i) {
      return i == 0 || relation(parts[0].chart, parts[i].chart) != Relation::NONE;
    };
    const auto value = [&](const Choice& choice) { return parts[choice.position].value + choice.fading; };
    Choice greatest = {0, -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!is_related(i)) continue;
      Choice least = {i, 0};
      for (std::size_t j = 0; j < parts.size(); ++j)
        if (j != i && is_related(j) && relation(parts[i].chart, parts[j].chart) == Relation::CONCAVE)
          least = std::min(least, {j, parts[j].fading}, [&](auto& a, auto& b) { return value(a) < value(b); });
      least.fading -= parts[i].fading;
      if (value(least) > value(greatest)) greatest = least;
    }
    return greatest;
  }

private:
  bool has_more_creases(Index a, Index b) const {
    auto of_a = first_crease(a), of_b = first_crease(b);
    for (; of_a != last_crease(a); ++of_a, ++of_b)
      if (of_b == last_crease(b)) return true;
    return false;
  }

  static Relation kind_of(double bend) {
    return bend > 0 ? Relation::CONVEX : bend < 0 ? Relation::CONCAVE : Relation::MIXED;
  }

  std::map<std::pair<Index, Index>, double>::const_iterator first_crease(Index a) const {
    return bend.lower_bound({a, 0});
  }
  std::map<std::pair<Index, Index>, double>::const_iterator last_crease(Index a) const {
    return bend.lower_bound({a + 1, 0});
  }
};

} // namespace equiaffine::internal

#endif
