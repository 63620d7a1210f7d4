// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_WHOLES_CENTERED_SYMMETRY_SEARCH_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_WHOLES_CENTERED_SYMMETRY_SEARCH_H

#include <equiaffine/base/internal/shared/parallel_for.h>
#include <equiaffine/registration/internal/wholes/Centered_map.h>
#include <equiaffine/registration/internal/wholes/Centered_symmetries.h>
#include <equiaffine/registration/internal/wholes/Finite_group.h>
#include <equiaffine/registration/internal/wholes/candidate_rotations.h>
#include <equiaffine/registration/internal/wholes/refined_candidates.h>
#include <equiaffine/registration/internal/wholes/slipping_rotations.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Thresholds of distances, parts of the size.
struct Symmetry_thresholds {
  double rounding = 0, exact = 0, exact_turn = 0, turn = 0, approximate = 0.01, none = 0.03;

  /// Triangles that stand for a smooth surface are exact to within their own error, up to 0.1 %, and turn to within more
  /// of it. Thin surfaces have less than their thickness allows. With a `tolerance` above 0, maps up to it are sought,
  /// and a surface turns to within it.
  Symmetry_thresholds(const Centered_surface_3& surface, double tolerance) {
    const double thickness = surface.thickness(), facet_error = surface.samples.facet_error;
    rounding = surface.is_exact ? 1e-7 : 2e-5;
    approximate = std::min(approximate, 0.03 * thickness);
    exact = std::min(rounding + std::min(1e-3, facet_error), approximate / 3);
    exact_turn = rounding + std::min(1.2 * facet_error, approximate);
    turn = tolerance > 0 ? std::max(rounding, tolerance) : exact_turn;
    none = std::max({0.03 * thickness, 1.2 * approximate, 1.2 * tolerance});
  }
};

/// The mean squared distance of the first `count` points of a surface that a map moves.
inline double mean_square_of_moved(const Centered_surface_3& surface, const Affine_map_3& map, std::size_t count) {
  count = std::min(count, surface.samples.points.size());
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i)
    sum += std::pow((*surface.distances)(map(surface.samples.points[i])).distance, 2);
  return sum / double(count);
}

/// The search for the symmetries of a whole surface. They keep the centroid of its area, so that all rotations about it
/// are searched; maps that are found are refined, and complete groups of them are the result.
template <class ConcurrencyTag>
class Centered_symmetry_search {
public:
  /// The symmetries of a bounded surface keep its volume, so that similarities are rigid, and affine maps equiaffine.
  /// A tolerance of 0 is none; the levels up to it do not depend on it.
  Centered_symmetry_search(const Centered_surface_3& surface, Map_kind kind, bool allows_reflections,
                           double tolerance = 0)
      : surface_(surface), kind_(keeps_angles(kind) ? Map_kind::RIGID : Map_kind::EQUIAFFINE),
        allows_reflections_(allows_reflections), thresholds_(surface, tolerance) {}

  Centered_symmetries run() {
    Centered_symmetries result;
    result.reason = surface_.reason_against;
    if (!result.reason.empty()) return result;
    const auto rotations = slipping_rotations<ConcurrencyTag>(surface_, kind_);
    if (add_continuous(rotations, result)) return result;
    find_maps();
    result.complete_to = complete_to_;
    result.least_rms = std::min(thresholds_.none, found_rms());
    result.levels = levels();
    decide(rotations.front().rms, result);
    for (Symmetry_level& level : result.levels)
      for (std::size_t i = 1; i < level.maps.size(); ++i) // the identity comes first
        level.maps[i].map = surface_.map.inverse() * level.maps[i].map * surface_.map;
    return result;
  }

  /// The maps that were found beside the identity, by their rms, in the coordinates of the Centered_surface_3.
  const std::vector<Centered_map>& found() const { return found_; }

private:
  static constexpr std::size_t largest_group = 240;
  static constexpr std::size_t points_verified = 6000, points_verified_exactly = 2000; ///< of a mesh, and of a function
  static constexpr double tolerance_of_products = 0.1;

  bool add_continuous(const std::vector<Slipping_rotation>& rotations, Centered_symmetries& result) const {
    result.continuous = continuous_symmetries(surface_, rotations, thresholds_.turn);
    const std::size_t dimension = result.continuous.dimension();
    if (dimension == 0) return false;
    const bool is_exact = rotations[dimension - 1].rms < thresholds_.exact_turn;
    result.verdict = is_exact ? Symmetry_verdict::EXACT : Symmetry_verdict::APPROXIMATE;
    return true;
  }

  void find_maps() {
    const Rotation_candidates candidates =
        candidate_rotations<ConcurrencyTag>(surface_, surface_, 1.25 * thresholds_.none, allows_reflections_);
    complete_to_ = candidates.complete_to;
    found_ = refined_candidates<ConcurrencyTag>(Centered_pair(surface_), candidates.rotations, 1, kind_, gate());
    std::erase_if(found_, [](const Centered_map& map) { return difference(map, Centered_map{}) < same_map; });
  }

  /// Maps that are worse after their refinement are given up.
  double gate() const { return std::max(0.06, 2 * thresholds_.none); }

  double found_rms() const { return found_.empty() ? std::numeric_limits<double>::infinity() : found_.front().rms; }

  /// Returns the groups of the maps up to places where the rms jumps, each with the one before.
  std::vector<Symmetry_level> levels() {
    constexpr double jump = 3;
    std::vector<Symmetry_level> result;
    for (std::size_t k = 1; k <= std::min(found_.size(), largest_group); ++k) {
      const double rms = found_[k - 1].rms;
      if (!(rms < thresholds_.none)) break;
      if (k < found_.size() && found_[k].rms < jump * std::max(rms, thresholds_.rounding)) continue;
      auto level = level_of(k);
      if (!level || (!result.empty() && level->maps.size() <= result.back().maps.size())) continue;
      while (!result.empty() && result.back().rms >= level->rms) result.pop_back();
      result.push_back(*std::move(level));
    }
    return result;
  }

  /// Returns the group of the first `count` maps, if they have one, all of whose maps are good.
  std::optional<Symmetry_level> level_of(std::size_t count) {
    std::vector<Affine_map_3> maps(1);
    for (std::size_t i = 0; i < count; ++i) maps.push_back(found_[i].map);
    if (!add_products(maps)) return std::nullopt;
    auto group = as_group(maps, tolerance_of_products);
    if (!group) return std::nullopt;
    if (!make_exact(*group)) return std::nullopt;
    Symmetry_level level;
    level.maps = verified(*group);
    std::stable_sort(level.maps.begin() + 1, level.maps.end(),
                     [](const Centered_map& a, const Centered_map& b) { return a.rms < b.rms; });
    for (const Centered_map& map : level.maps) level.rms = std::max(level.rms, map.rms);
    for (const Centered_map& map : found_)
      if (std::none_of(level.maps.begin(), level.maps.end(),
                       [&](const Centered_map& other) { return difference(map, other) < 2 * same_map; }))
        level.next_rms = std::min(level.next_rms, map.rms);
    if (!(level.rms < thresholds_.none) || !(level.next_rms > 2 * level.rms)) return std::nullopt;
    return level;
  }

  /// The maps of a group with their rms, both ways: the points that one way moves are those that the inverse map moves.
  std::vector<Centered_map> verified(const Finite_group& group) const {
    std::vector<double> squares(group.maps.size());
    const std::size_t points = surface_.is_exact ? points_verified_exactly : points_verified;
    parallel_for<ConcurrencyTag>(
        1, squares.size(), [&](std::size_t i) { squares[i] = mean_square_of_moved(surface_, group.maps[i], points); });
    std::vector<Centered_map> result;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const auto& row = group.products[i];
      const auto inverse = std::size_t(std::find(row.begin(), row.end(), 0U) - row.begin());
      result.push_back({group.maps[i], std::sqrt((squares[i] + squares[inverse]) / 2)});
    }
    return result;
  }

  /// Adds products, refined, until there is no new one. Returns false if one of them is bad, or there are too many.
  bool add_products(std::vector<Affine_map_3>& maps) const {
    for (std::size_t i = 1; i < maps.size(); ++i)
      for (std::size_t j = 1; j <= i; ++j)
        for (const bool is_reversed : {false, true}) {
          const Affine_map_3 product = is_reversed ? maps[j] * maps[i] : maps[i] * maps[j];
          if (nearest_map(maps, product.matrix).difference < same_map) continue;
          const Centered_map map = refined_and_judged(Centered_pair(surface_), product, kind_);
          if (nearest_map(maps, map.map.matrix).difference < same_map) continue;
          if (!(map.rms < thresholds_.none) || maps.size() >= largest_group) return false;
          maps.push_back(map.map);
        }
    return true;
  }

  static std::string percent(double part) {
    std::ostringstream text;
    text << std::setprecision(2) << 100 * part << " % of its size";
    return text.str();
  }

  void decide(double slipping_rms, Centered_symmetries& result) const {
    const double best = found_rms();
    const double finite_rms = result.levels.empty() ? best : result.levels.front().rms;
    if (found_.size() > largest_group && found_[largest_group].rms < thresholds_.approximate) {
      result.reason = "more than " + std::to_string(largest_group) + " maps move the surface onto itself to within " +
                      percent(found_[largest_group].rms) + ", too many to be verified";
    } else if (slipping_rms < thresholds_.approximate && finite_rms > slipping_rms / 3) {
      result.reason = "rotations about an axis move the surface onto itself to within " + percent(slipping_rms) +
                      ", which is more than its facets explain";
    } else if (best > thresholds_.none && surface_.thickness() < 0.05) {
      result.reason = "the surface is so thin that it is near to its images";
    } else if (!result.levels.empty() && result.levels.front().rms < thresholds_.approximate) {
      const bool is_exact = result.levels.front().rms < thresholds_.exact;
      result.verdict = is_exact ? Symmetry_verdict::EXACT : Symmetry_verdict::APPROXIMATE;
    } else if (best > thresholds_.none && complete_to_ > thresholds_.none) {
      result.verdict = Symmetry_verdict::NONE;
    } else if (best > thresholds_.none) {
      result.reason = "too many rotations move the surface nearly onto itself for all to be tried";
    } else if (result.levels.empty()) {
      result.reason =
          "a map moves the surface onto itself to within " + percent(best) + ", but maps like it are no group";
    } else {
      result.reason = "a group moves the surface onto itself only to within " + percent(result.levels.front().rms);
    }
  }

  const Centered_surface_3& surface_;
  Map_kind kind_;
  bool allows_reflections_;
  double complete_to_ = 0;
  Symmetry_thresholds thresholds_;
  std::vector<Centered_map> found_;
};

} // namespace equiaffine::internal

#endif
