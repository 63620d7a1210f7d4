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

/// The smooth parts of a surface between its creases. A point on a crease is duplicated, one copy for each part that
/// meets there.
struct Charts_3 {
  using Index = std::uint32_t;

  /// How two parts are combined: not at all, as the intersection of half-spaces, or as their union. Parts that share
  /// creases of both kinds are combined as an intersection, too.
  enum class Relation { NONE, CONVEX, CONCAVE, MIXED };

  std::vector<Index> of_point;                       ///< the part of each point; empty if there is no crease
  std::vector<char> is_on_crease;                    ///< per point; empty if there is no crease
  std::map<std::pair<Index, Index>, double> bend;    ///< total bend of the creases between two parts, in both orders;
                                                     ///< positive if convex
  std::map<std::pair<Index, Index>, int> at_corners; ///< for parts that share a corner; positive if mostly convex
  std::map<Index, std::size_t> number_of_neighbors;  ///< number of parts that a part meets at creases
  std::size_t most_at_point = 1;                     ///< largest number of parts that meet at a point

  bool empty() const { return of_point.empty(); }
  Index of(std::size_t i) const { return empty() ? 0 : of_point[i]; }
  bool has_crease_at(std::size_t i) const { return !empty() && is_on_crease[i]; }
  bool has_creases(Index a) const { return number_of_neighbors.contains(a); }

  void add_crease(Index a, Index b, double angle) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      const auto [crease, is_new] = bend.try_emplace({from, to}, 0);
      crease->second += angle;
      number_of_neighbors[from] += is_new;
    }
  }

  /// Returns the relation of two parts. Parts that meet have one relation for all of their creases. Other parts have
  /// the relation of their creases with a common third part, like opposite sides of a plate or of a slot; it is
  /// MIXED if all such creases are of different kinds. Otherwise parts that share a corner have the relation of most
  /// creases there.
  Relation relation(Index a, Index b) const {
    if (const auto found = bend.find({a, b}); found != bend.end()) return kind_of(found->second);
    if (!has_creases(a) || !has_creases(b)) return Relation::NONE;
    if (number_of_neighbors.at(a) > number_of_neighbors.at(b)) std::swap(a, b);
    Relation result = Relation::NONE;
    for (auto crease = bend.lower_bound({a, 0}); crease != bend.end() && crease->first.first == a; ++crease) {
      const auto other = bend.find({crease->first.second, b});
      if (other == bend.end()) continue;
      const Relation first = kind_of(crease->second), second = kind_of(other->second);
      if (first == Relation::CONVEX && second == Relation::CONVEX) return Relation::CONVEX;
      const bool is_concave = first == Relation::CONCAVE && second == Relation::CONCAVE;
      result = is_concave || result == Relation::CONCAVE ? Relation::CONCAVE : Relation::MIXED;
    }
    if (result != Relation::NONE) return result;
    const auto found = at_corners.find(std::minmax(a, b));
    return found == at_corners.end() ? result : kind_of(found->second);
  }

  /// Adds a corner of several parts. In a corner of more than 64, parts that do not meet at creases have no
  /// relation.
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
        const auto crease = bend.find({parts[j], parts[i]});
        if (crease == bend.end()) apart.emplace_back(parts[j], parts[i]);
        else convex += crease->second > 0 ? 1 : crease->second < 0 ? -1 : 0;
      }
    for (const auto& pair : apart) at_corners[pair] += convex;
  }

  /// The value of the function of a part. The larger its fading, the less it counts beside the values of other
  /// parts. A part that enters or leaves the neighborhood has an infinite fading.
  struct Part_value {
    Index chart;
    double value, fading;
  };

  /// The part whose value is that of the solid, the term added by fading, and their sum.
  struct Choice {
    std::size_t position;
    double fading, value;
  };

  /// Returns the part that gives the value of a solid bounded by several parts, the nearest one first. Parts that
  /// meet at convex creases are intersected, which is the maximum of their values; parts that meet at concave
  /// creases are united, which is the minimum (as in constructive solid geometry; Ohtake et al., Multi-level
  /// partition of unity implicits, 2003). Unions come first, then the intersection of all of them, which is correct
  /// at corners of three parts and at those with creases of one kind. Parts not connected to the nearest one by
  /// relations are other sheets.
  Choice combined(const std::vector<Part_value>& parts) const {
    const std::vector<char> is_related = connected_with_first(parts);
    Choice greatest = {0, 0, -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!is_related[i]) continue;
      Choice least = {i, 0, parts[i].value};
      for (std::size_t j = 0; j < parts.size(); ++j)
        if (j != i && is_related[j] && relation(parts[i].chart, parts[j].chart) == Relation::CONCAVE)
          if (const double value = parts[j].value + parts[j].fading; value < least.value)
            least = {j, parts[j].fading, value};
      least.fading -= parts[i].fading;
      least.value = parts[least.position].value + least.fading;
      if (least.value > greatest.value) greatest = least;
    }
    return greatest;
  }

private:
  std::vector<char> connected_with_first(const std::vector<Part_value>& parts) const {
    std::vector<char> is_connected(parts.size());
    std::vector<std::size_t> reached = {0};
    is_connected[0] = 1;
    for (std::size_t n = 0; n < reached.size(); ++n)
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (!is_connected[i] && relation(parts[reached[n]].chart, parts[i].chart) != Relation::NONE) {
          is_connected[i] = 1;
          reached.push_back(i);
        }
    return is_connected;
  }

  static Relation kind_of(double bend) {
    return bend > 0 ? Relation::CONVEX : bend < 0 ? Relation::CONCAVE : Relation::MIXED;
  }
};

} // namespace equiaffine::internal

#endif
