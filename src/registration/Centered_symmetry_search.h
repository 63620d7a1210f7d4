// SPDX-License-Identifier: GPL-3.0-or-later
// Searches for the symmetries of a whole surface among all rotations about its centroid.
#ifndef EQUIAFFINE_SRC_REGISTRATION_CENTERED_SYMMETRY_SEARCH_H
#define EQUIAFFINE_SRC_REGISTRATION_CENTERED_SYMMETRY_SEARCH_H

#include "registration/Centered_map.h"
#include "registration/Rotation_search.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/slippage_of_mesh.h>

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

/// Thresholds of distances, relative to the size.
struct Symmetry_thresholds {
  double exact = 0, turn = 0, approximate = 0.01, none = 0.03;

  /// A symmetry is exact if it holds to rounding at every point. Triangles approximating a smooth surface turn to
  /// within their own error. Thresholds are smaller for thin surfaces. A `tolerance` above 0 is the limit for maps
  /// to search, and for turning.
  Symmetry_thresholds(const Centered_surface_3& surface, double tolerance) {
    const double thickness = surface.thickness(), facet_error = surface.samples.facet_error;
    exact = exact_distance(surface.rounding);
    approximate = std::min(approximate, 0.03 * thickness);
    const double facets = exact + std::min(3 * facet_error, approximate); // points of facets are off other facets
    turn = tolerance > 0 ? std::max(exact, tolerance) : facets;
    none = std::max({0.03 * thickness, 1.2 * approximate, 1.2 * tolerance});
  }
};

/// A finite group of maps, each of which moves the surface onto itself to within an rms distance.
struct Symmetry_level {
  std::vector<Centered_map> maps; ///< in the coordinates of the surface; the identity first, then by rms
  double rms = 0;                 ///< maximum of its maps, relative to the size, in the proportions of the surface
  double greatest = 0;            ///< largest distance of a moved point from the surface, there
  double searched_rms = 0;        ///< maximum of its maps, in the proportions of the search
  double next_rms = std::numeric_limits<double>::infinity(); ///< a lower bound on the rms of maps outside of the group
};

/// The symmetries of a whole surface.
struct Centered_symmetries {
  Symmetry_verdict verdict = Symmetry_verdict::UNDECIDED;
  std::string reason = {};                 ///< of an undecided case
  std::vector<Symmetry_level> levels = {}; ///< nested groups with increasing rms
  Affine_slippage_3 continuous = {};       ///< rotations of the continuous group: none, 1 or 3
  double complete_to = 0;                  ///< all maps with a smaller rms were tried, in the proportions of the
                                           ///< surface
  double least_rms = 0;                    ///< smallest rms of a map other than the identity, relative to the size
};

/// Searches for the symmetries of a whole surface. They preserve the centroid of its area, so all rotations about it
/// are searched. Maps that are found are refined; the result consists of complete groups of them.
class Centered_symmetry_search {
public:
  /// Symmetries of a bounded surface preserve its volume, so similarities are rigid, and affine maps equiaffine. A
  /// tolerance of 0 means none; the levels up to it do not depend on it.
  Centered_symmetry_search(bool in_threads, const Centered_surface_3& surface, Map_kind kind, bool allows_reflections,
                           double tolerance = 0)
      : in_threads_(in_threads), surface_(surface), kind_(keeps_angles(kind) ? Map_kind::RIGID : Map_kind::EQUIAFFINE),
        allows_reflections_(allows_reflections), tolerance_(tolerance),
        thresholds_(surface, tolerance / std::max(surface.own.least_stretch(), least_stretch_of_tolerance)) {}

  Centered_symmetries run() {
    Centered_symmetries result;
    result.reason = surface_.reason_against;
    if (!result.reason.empty()) return result;
    find_maps_of_corners(surface_.corners[0], surface_.rounding);
    find_maps_of_corners(surface_.corners[1], std::max(surface_.rounding, rounding_of_few_digits));
    result.levels = levels();
    const auto rotations = slipping_rotations(in_threads_, surface_, kind_);
    if (add_continuous(rotations, result)) return result;
    if (!turns_about(rotations, result)) {
      find_maps_of_rotations();
      result.levels = levels();
    }
    result.complete_to = complete_to_;
    result.least_rms = std::min(thresholds_.none, found_rms());
    decide(rotations.front(), result);
    const double least = least_own_rms();
    result.complete_to *= least;
    result.least_rms *= least;
    for (Symmetry_level& level : result.levels) level.next_rms *= least;
    return result;
  }

  /// The maps that were found, without the identity, sorted by rms, in the coordinates of the Centered_surface_3.
  const std::vector<Centered_map>& found() const { return found_; }

private:
  static constexpr std::size_t largest_group = 1000;
  static constexpr std::size_t fewest_verified = 6000, most_verified = 4000000; ///< points for one map, and for all
                                                                                ///< maps
  static constexpr double tolerance_of_products = 0.1;
  /// Maps are searched to at most three times a tolerance, so less is decided for longer bodies.
  static constexpr double least_stretch_of_tolerance = 1.0 / 3;

  /// Adds rotations of any angle if they move the surface onto itself. A finite group to rounding, if there is one,
  /// is stronger, unless turns up to a tolerance were requested.
  bool add_continuous(std::vector<Slipping_rotation> rotations, Centered_symmetries& result) const {
    if (!surface_.is_exact && tolerance_ == 0) // a given tolerance is one of the rms
      std::erase_if(rotations, [this](const Slipping_rotation& r) {
        return r.rms < thresholds_.turn && !keeps_to_facets(in_threads_, surface_, r, thresholds_.exact);
      });
    if (tolerance_ > 0)
      std::erase_if(rotations,
                    [this](const Slipping_rotation& r) { return !(r.own_rms < std::max(own_exact(), tolerance_)); });
    result.continuous = continuous_symmetries(surface_, rotations, thresholds_.turn);
    const std::size_t dimension = result.continuous.dimension();
    if (dimension == 0) return false;
    const bool turns_exactly = result.continuous.rms < own_exact();
    if (turns_exactly || tolerance_ > 0) result.levels.clear();
    const bool is_exact = turns_exactly || (!result.levels.empty() && result.levels.front().greatest <= own_exact());
    result.verdict = is_exact ? Symmetry_verdict::EXACT : Symmetry_verdict::APPROXIMATE;
    return true;
  }

  /// Whether the surface turns about an axis to within the threshold, and has a group of corners. A search would
  /// then find rotations of any angle.
  bool turns_about(const std::vector<Slipping_rotation>& rotations, const Centered_symmetries& result) const {
    return tolerance_ == 0 && !result.levels.empty() && rotations.front().rms < thresholds_.none;
  }

  /// Finds all maps that move corners onto each other to within the rounding of their coordinates.
  void find_maps_of_corners(const std::vector<Corner>& corners, double rounding) {
    const Corner_symmetry_search search(corners, exact_distance(rounding));
    const auto maps = search.run(in_threads_, allows_reflections_);
    if (!maps) return;
    std::vector<Centered_map> found(maps->size());
    parallel_for(in_threads_, 0, found.size(), [&](std::size_t i) {
      const auto [mean_square, greatest] = distances_of_moved(surface_, (*maps)[i], fewest_verified / 10);
      found[i] = {(*maps)[i], std::sqrt(mean_square), greatest};
    });
    std::erase_if(found, [&](const Centered_map& map) { return !(map.greatest < 4 * exact_distance(rounding)); });
    add(std::move(found));
  }

  /// Adds maps that differ from the known ones.
  void add(std::vector<Centered_map> maps) {
    maps = different(std::move(maps), std::numeric_limits<double>::infinity());
    std::erase_if(maps, [this](const Centered_map& map) {
      const auto is_same = [&](const Centered_map& other) { return difference(map, other) < same_map; };
      return is_same(Centered_map{}) || std::any_of(found_.begin(), found_.end(), is_same);
    });
    found_.insert(found_.end(), maps.begin(), maps.end());
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Centered_map& a, const Centered_map& b) { return a.rms < b.rms; });
  }

  void find_maps_of_rotations() {
    const Rotation_candidates candidates =
        candidate_rotations(in_threads_, surface_, surface_, 1.25 * thresholds_.none, allows_reflections_);
    complete_to_ = candidates.complete_to;
    auto [maps, least_left_out] = refined_candidates(in_threads_, Centered_pair(surface_), candidates.rotations, 1,
                                                     kind_, gate(), tolerance_ > 0);
    complete_to_ = std::min(complete_to_, least_left_out / 2);
    add(std::move(maps));
  }

  /// A lower bound, in the proportions of the surface, on the rms of a map whose rms is 1 in those of the search: no
  /// distance is stretched less, and no part of the area has a smaller weight.
  double least_own_rms() const {
    if (surface_.own.distances == surface_.distances) return 1;
    const Eigen::Matrix3d of_normals = surface_.own.of_normals();
    double least = std::numeric_limits<double>::infinity(), sum = 0;
    for (const Eigen::Vector3d& n : surface_.samples.normals) {
      const double weight = (of_normals * n).norm();
      least = std::min(least, weight);
      sum += weight;
    }
    return surface_.own.least_stretch() * std::sqrt(least * double(surface_.samples.normals.size()) / sum);
  }

  /// Distances below this are zero in the proportions of the surface.
  double own_exact() const { return exact_distance(surface_.own.rounding); }

  /// Maps with a larger rms after refinement are dropped.
  double gate() const { return std::max(0.06, 2 * thresholds_.none); }

  double found_rms() const { return found_.empty() ? std::numeric_limits<double>::infinity() : found_.front().rms; }

  /// Returns the groups of all maps before each jump of the rms.
  std::vector<Symmetry_level> levels() {
    constexpr double jump = 3;
    std::vector<Symmetry_level> result;
    for (std::size_t k = 1; k <= std::min(found_.size(), largest_group); ++k) {
      const double rms = found_[k - 1].rms;
      if (!(rms < thresholds_.none)) break;
      if (k < found_.size() && found_[k].rms < jump * std::max(rms, thresholds_.exact)) continue;
      auto level = level_of(k);
      if (!level || (!result.empty() && level->maps.size() <= result.back().maps.size())) continue;
      while (!result.empty() && result.back().rms >= level->rms) result.pop_back();
      result.push_back(*std::move(level));
    }
    return result;
  }

  /// Returns the group of the first `count` maps, if they generate one whose maps are all good.
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
    for (const Centered_map& map : level.maps) {
      level.rms = std::max(level.rms, map.rms);
      level.greatest = std::max(level.greatest, map.greatest);
    }
    level.searched_rms = searched_rms(level);
    for (const Centered_map& map : found_)
      if (std::none_of(level.maps.begin(), level.maps.end(),
                       [&](const Centered_map& other) { return difference(map, other) < 2 * same_map; }))
        level.next_rms = std::min(level.next_rms, map.rms);
    if (!(level.searched_rms < thresholds_.none) || !(level.next_rms > 2 * level.searched_rms)) return std::nullopt;
    return level;
  }

  double searched_rms(const Symmetry_level& level) const {
    if (surface_.own.distances == surface_.distances) return level.rms;
    std::vector<double> rms(level.maps.size());
    parallel_for(in_threads_, 1, rms.size(), [&](std::size_t i) {
      rms[i] = judged(Centered_pair(surface_), level.maps[i].map, points_of_rms).rms;
    });
    return *std::max_element(rms.begin(), rms.end());
  }

  /// The maps of a group with their rms in both directions, in the proportions of the surface: the inverse map
  /// covers the other direction.
  std::vector<Centered_map> verified(const Finite_group& group) const {
    const std::size_t points = std::max(fewest_verified, most_verified / group.maps.size());
    std::vector<Distances_of_moved> distances(group.maps.size(), {0, 0});
    parallel_for(in_threads_, 1, distances.size(), [&](std::size_t i) {
      distances[i] = distances_of_moved(surface_, group.maps[i], points, surface_.own);
    });
    std::vector<Centered_map> result;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      const auto& row = group.products[i];
      const Distances_of_moved &there = distances[i],
                               &back = distances[std::size_t(std::find(row.begin(), row.end(), 0U) - row.begin())];
      result.push_back({group.maps[i], std::sqrt((there.mean_square + back.mean_square) / 2),
                        std::max(there.greatest, back.greatest)});
    }
    return result;
  }

  /// Adds refined products until there is no new one. Returns false if one of them is bad, or there are too many:
  /// the maps of a group of that size would have been found.
  bool add_products(std::vector<Affine_map_3>& maps) const {
    const std::size_t most = std::min(largest_group, 4 * maps.size() + 8);
    for (std::size_t i = 1; i < maps.size(); ++i)
      for (std::size_t j = 1; j <= i; ++j)
        for (const bool is_reversed : {false, true}) {
          const Affine_map_3 product = is_reversed ? maps[j] * maps[i] : maps[i] * maps[j];
          if (nearest_map(maps, product.matrix).difference < same_map) continue;
          const Centered_map map = refined_and_judged(Centered_pair(surface_), product, kind_);
          if (nearest_map(maps, map.map.matrix).difference < same_map) continue;
          if (!(map.rms < thresholds_.none) || maps.size() >= most) return false;
          maps.push_back(map.map);
        }
    return true;
  }

  static std::string percent(double part) {
    std::ostringstream text;
    text << std::setprecision(2) << 100 * part << " % of its size";
    return text.str();
  }

  /// Decides about maps to within `approximate`. A group whose next map is many times worse counts, regardless of
  /// how close other maps come.
  void decide(const Slipping_rotation& slipping, Centered_symmetries& result) const {
    constexpr double gap = 100;
    const double slipping_rms = slipping.rms;
    const double best = found_rms();
    const Symmetry_level* const first = result.levels.empty() ? nullptr : &result.levels.front();
    const bool is_group = first && first->searched_rms < thresholds_.approximate;
    const bool is_apart = is_group &&
                          std::min(complete_to_, first->next_rms) > gap * std::max(first->searched_rms, 1e-9) &&
                          slipping_rms > gap * first->searched_rms;
    const double finite_rms = first ? first->searched_rms : best;
    if (is_group && first->greatest <= own_exact()) {
      result.verdict = Symmetry_verdict::EXACT;
    } else if (is_apart) {
      result.verdict = Symmetry_verdict::APPROXIMATE;
    } else if (slipping_rms < thresholds_.approximate && finite_rms > slipping_rms / 3) {
      result.reason = "rotations about an axis move the surface onto itself to within " + percent(slipping.own_rms) +
                      ", and no finite group fits much better";
    } else if (best > thresholds_.none && surface_.thickness() < 0.15) {
      result.reason = "the surface is so thin that it is close to its images";
    } else if (is_group) {
      result.verdict = Symmetry_verdict::APPROXIMATE;
    } else if (best > thresholds_.approximate && complete_to_ > thresholds_.approximate) {
      result.verdict = Symmetry_verdict::NONE;
    } else if (best > thresholds_.approximate) {
      result.reason = "too many rotations move the surface nearly onto itself to try them all";
    } else {
      result.reason = "a map moves the surface onto itself to within " +
                      percent(own_rms(Centered_pair(surface_), found_.front().map, points_of_rms, best)) +
                      ", but similar maps do not form a group";
    }
  }

  bool in_threads_;
  const Centered_surface_3& surface_;
  Map_kind kind_;
  bool allows_reflections_;
  double tolerance_;
  double complete_to_ = 0;
  Symmetry_thresholds thresholds_;
  std::vector<Centered_map> found_;
};

} // namespace equiaffine::internal

#endif
