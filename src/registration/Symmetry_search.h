// SPDX-License-Identifier: GPL-3.0-or-later
// Searches for the finite group of symmetries of a surface by affine frames, and checks the group.
#ifndef EQUIAFFINE_SRC_REGISTRATION_SYMMETRY_SEARCH_H
#define EQUIAFFINE_SRC_REGISTRATION_SYMMETRY_SEARCH_H

#include "registration/Affine_map_3.h"
#include "registration/Framed_surface_3.h"
#include "registration/Rotation_search.h"
#include "registration/Symmetry_check.h"
#include "registration/candidate_pairs.h"
#include "registration/map_evidence.h"
#include "registration/refine_map.h"
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/registration/affine_symmetries.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The default tolerances of distances of moved points, relative to the size. Splines and fits represent the surface
/// only within their errors.
struct Default_tolerances {
  static constexpr double function = 1e-8, spline = 1e-5, fit = 1e-3;
};

/// Searches for the finite group of maps that move a surface onto itself. A few generic points are matched with all
/// possible images; products of the symmetries complete the group.
class Symmetry_search {
public:
  /// A symmetry moves no point off the surface by more than `tolerance` times the size of the surface.
  Symmetry_search(bool in_threads, const Framed_surface_3& surface, Map_kind kind, double tolerance)
      : in_threads_(in_threads), surface_(surface), kind_(kind), tolerance_(tolerance) {}

  /// Returns the maps of the group, the identity first.
  std::vector<Affine_map_3> run() {
    group_.assign(1, Affine_map_3());
    const std::vector<std::size_t> points = points_to_match();
    const auto good_of = [&](auto begin, auto end) {
      return std::size_t(
          std::count_if(begin, end, [&](std::size_t i) { return surface_.points[i].quality > least_quality; }));
    };
    good_points_matched_ = good_of(points.begin(), points.end());
    good_inner_points_matched_ = good_of(points.begin(), points.begin() + std::ptrdiff_t(inner_points_chosen_));
    for (const std::size_t point : points) {
      const std::size_t known = group_.size();
      match(point);
      if (group_.size() > known) close();
    }
    std::erase_if(group_, [&](const Affine_map_3& map) { return !is_symmetry(map); });
    return group_;
  }

  /// The number of points with good frames that run() matched with all possible images.
  std::size_t good_points_matched() const { return good_points_matched_; }

  /// The number of those in the inner half of the surface, whose images are rarely outside of the box.
  std::size_t good_inner_points_matched() const { return good_inner_points_matched_; }

  /// The distances of moved points from the surface.
  Checked_map distances(const Affine_map_3& map) const {
    double sum = 0, count = 0;
    Checked_map result;
    for (const Mapped_point& p : moved_source(in_threads_, surface_, surface_, map, most_probes))
      if (const double d = std::abs(p.to_other.distance); !std::isnan(d)) {
        sum += d * d;
        ++count;
        result.greatest = std::max(result.greatest, d);
      }
    result.rms = count > 0 ? std::sqrt(sum / count) : std::numeric_limits<double>::infinity();
    return result;
  }

private:
  static constexpr std::size_t inner_points = 4, most_neighbors = 3000, most_images = 600, most_points = 3000,
                               largest_group = 1000;
  static constexpr double least_difference = 0.01; ///< between maps, relative to their norm and to the size

  /// Returns points with different invariants, because images of each other have the same images: first some of the
  /// inner half of the surface, then some of all. A symmetry preserves the distance from the center in coordinates
  /// in which the points have covariance 1, so it rarely moves a point of the inner half out of the box. Points are
  /// chosen such that the search finds them from the points around them, as is required for their images.
  std::vector<std::size_t> points_to_match() {
    const Whitening whitening(surface_.probes);
    std::vector<double> distances;
    for (const Eigen::Vector3d& p : surface_.probes) distances.push_back(whitening(p).norm());
    const auto points = points_to_try(in_threads_, surface_, kind_, most_points);
    std::vector<std::size_t> chosen;
    add_different(points, inner_points, median_of(distances), whitening, chosen);
    inner_points_chosen_ = chosen.size();
    add_different(points, 2 * inner_points, std::numeric_limits<double>::infinity(), whitening, chosen);
    return chosen;
  }

  void add_different(const std::vector<std::size_t>& points, std::size_t most, double greatest_distance,
                     const Whitening& whitening, std::vector<std::size_t>& chosen) const {
    for (const std::size_t i : points) {
      if (chosen.size() == most) return;
      if (!(whitening(surface_.points[i].point).norm() <= greatest_distance)) continue;
      const Invariants invariants = kept_invariants(surface_.points[i], kind_);
      if (std::none_of(
              chosen.begin(), chosen.end(),
              [&](std::size_t j) { return (kept_invariants(surface_.points[j], kind_) - invariants).norm() < 1e-3; }) &&
          is_found_from_neighbors(i))
        chosen.push_back(i);
    }
  }

  /// Whether the search for a counterpart finds the point from most of its neighbors.
  bool is_found_from_neighbors(std::size_t i) const {
    constexpr std::size_t neighbors = 6, fewest = 4;
    const Eigen::Vector3d& p = surface_.points[i].point;
    std::size_t found = 0;
    for (const auto& [j, distance] : surface_.tree.neighbors(p, neighbors + 1)) {
      if (j == i || surface_.points[j].is_elliptic != surface_.points[i].is_elliptic) continue;
      const Counterpart c = find_counterpart(surface_, surface_, {i, j, 0}, kind_);
      found += (c.target.point - p).norm() < 1e-3 * surface_.spacing;
    }
    return found >= fewest;
  }

  /// Adds the symmetries that move the point to another one with the same invariants.
  void match(std::size_t point) {
    const auto pairs = apart(pairs_of_point(surface_, surface_, point, kind_, {most_neighbors, most_neighbors, 0.5}));
    std::vector<Counterpart> found(pairs.size());
    parallel_for(in_threads_, 0, pairs.size(),
                 [&](std::size_t n) { found[n] = find_counterpart(surface_, surface_, pairs[n], kind_); });
    std::vector<Affine_map_3> tried;
    for (const Counterpart& c : found) {
      if (c.cost > 1) continue;
      const Affine_map_3 map = map_between(surface_.points[c.source], c.target, kind_);
      if (!map.matrix.allFinite() || !(condition(map.matrix) < greatest_condition) || contains(tried, map)) continue;
      tried.push_back(map);
      if (contains(group_, map) || !may_be_symmetry(map)) continue;
      const auto refined = refine_map(in_threads_, surface_, surface_, map, {kind_, 0.01});
      if (refined && is_symmetry(*refined) && !contains(group_, *refined)) group_.push_back(*refined);
    }
  }

  /// Returns pairs whose target points are some spacings apart, lowest cost first; otherwise all of them could be
  /// around one image.
  std::vector<Candidate_pair> apart(const std::vector<Candidate_pair>& pairs) const {
    std::vector<Candidate_pair> chosen;
    const auto position = [&](const Candidate_pair& pair) { return surface_.points[pair.target].point; };
    for (const Candidate_pair& pair : pairs)
      if (chosen.size() < most_images && std::none_of(chosen.begin(), chosen.end(), [&](const Candidate_pair& other) {
            return (position(pair) - position(other)).norm() < 1.5 * surface_.spacing;
          }))
        chosen.push_back(pair);
    return chosen;
  }

  /// Adds products until there is no new one.
  void close() {
    for (std::size_t i = 1; i < group_.size(); ++i)
      for (std::size_t j = 1; j <= i; ++j)
        for (const Affine_map_3& product : {group_[i] * group_[j], group_[j] * group_[i]})
          if (group_.size() < largest_group && !contains(group_, product)) group_.push_back(product);
  }

  bool may_be_symmetry(const Affine_map_3& map) const { return part_moved_onto_surface(map, 60, 0.01) > 0.7; }

  bool is_symmetry(const Affine_map_3& map) const {
    return part_moved_onto_surface(map, most_probes, std::max(tolerance_, 1e-10)) > part_of_same_surface;
  }

  double part_moved_onto_surface(const Affine_map_3& map, std::size_t probes, double tolerance) const {
    return part_on_surface(moved_source(in_threads_, surface_, surface_, map, probes), tolerance * surface_.size);
  }

  bool contains(const std::vector<Affine_map_3>& maps, const Affine_map_3& map) const {
    const Eigen::Vector3d p = surface_.probes.front();
    return std::any_of(maps.begin(), maps.end(), [&](const Affine_map_3& other) {
      return (map.matrix - other.matrix).norm() < least_difference * other.matrix.norm() &&
             (map(p) - other(p)).norm() < least_difference * surface_.size;
    });
  }

  bool in_threads_;
  const Framed_surface_3& surface_;
  Map_kind kind_;
  double tolerance_;
  std::size_t good_points_matched_ = 0, good_inner_points_matched_ = 0, inner_points_chosen_ = 0;
  std::vector<Affine_map_3> group_;
};

inline Affine_symmetry_3<Kernel_of_searches> symmetry(const Affine_map_3& map, double rms, double greatest) {
  return {map.to_CGAL<Kernel_of_searches::Aff_transformation_3>(), rms, greatest};
}

/// Maps are tested with the first few points, and a group with all points.
constexpr std::size_t few_points = 3000, most_points_of_check = std::numeric_limits<std::size_t>::max();

struct Checked_symmetry {
  Affine_map_3 map;
  Checked_map check;
};

/// Returns the group generated by maps, if `holds` is true for each of its elements; nothing if it is false for one,
/// or there are too many. Accumulated errors are removed in coordinates in which the points of the surface have
/// covariance 1.
template <class Holds>
std::optional<std::vector<Checked_symmetry>> group_of(bool in_threads, const std::vector<Affine_map_3>& generators,
                                                      const Symmetry_check& check, const Holds& holds) {
  constexpr std::size_t largest_group = 1000;
  constexpr double same = 1e-4, rounding = 1e-6;
  const Whitening whitening(check.points());
  const Affine_map_3 to = whitening.to(), from = whitening.from();
  std::vector<Affine_map_3> maps(1);
  const auto is_known = [&](const Affine_map_3& map) {
    return std::any_of(maps.begin(), maps.end(), [&](const Affine_map_3& other) {
      return difference(map.matrix, other.matrix) < same && (map.translation - other.translation).norm() < same;
    });
  };
  const auto add = [&](const Affine_map_3& map) {
    if (is_known(map)) return true;
    if (maps.size() == largest_group || !holds(check.check(in_threads, from * map * to, few_points))) return false;
    maps.push_back(map);
    return true;
  };
  for (const Affine_map_3& map : generators)
    if (const Affine_map_3 moved = to * map * from; !is_known(moved)) maps.push_back(moved);
  for (std::size_t i = 1; i < maps.size(); ++i)
    for (std::size_t j = 1; j <= i; ++j)
      if (!add(maps[i] * maps[j]) || !add(maps[j] * maps[i])) return std::nullopt;
  auto group = as_group(maps, rounding);
  if (!group || !make_exact(*group)) return std::nullopt;
  std::vector<Checked_symmetry> result = {{{}, {0, 0, 1, true}}};
  for (std::size_t i = 1; i < group->maps.size(); ++i) {
    const Affine_map_3 map = from * group->maps[i] * to;
    result.push_back({map, check.check(in_threads, map)});
    if (!holds(result.back().check)) return std::nullopt;
  }
  return result;
}

/// The maps of a group with their distances.
inline Symmetry_level_3<Kernel_of_searches> level_of(const std::vector<Checked_symmetry>& group, double size) {
  Symmetry_level_3<Kernel_of_searches> level = {{}, 0, 0};
  for (const auto& [map, check] : group) {
    level.maps.push_back(symmetry(map, check.rms, check.greatest));
    level.rms = std::max(level.rms, check.rms / size);
    level.greatest = std::max(level.greatest, check.greatest / size);
  }
  return level;
}

/// Up to this tolerance, the frames of a smooth surface alone decide: they take a hundredth of the time of a search
/// of all rotations, but do not find approximate symmetries.
constexpr double greatest_tolerance_of_frames = 1e-6;

/// Returns the group of the maps that hold, as far as the box shows. If they do not form a group because the surface
/// continues beyond the box, as with translations, returns the group of those that fix the center of the box.
template <class Holds>
std::optional<std::vector<Checked_symmetry>> group_that_holds(bool in_threads, const std::vector<Affine_map_3>& maps,
                                                              const Symmetry_check& check, const Holds& holds) {
  constexpr double same = 1e-6;
  std::vector<Affine_map_3> kept;
  const auto keep = [&](std::size_t points) {
    std::erase_if(kept, [&](const Affine_map_3& map) { return !holds(check.check(in_threads, map, points)); });
    return group_of(in_threads, kept, check, holds);
  };
  kept = maps;
  if (const auto group = keep(few_points)) return group;
  if (const auto group = keep(most_points_of_check)) return group;
  if (!check.is_cut()) return std::nullopt;
  std::erase_if(kept, [&](const Affine_map_3& map) {
    return (map(check.center()) - check.center()).norm() > same * check.size();
  });
  return group_of(in_threads, kept, check, holds);
}

/// The groups from affine frames of points of a smooth surface: that of the maps that hold to rounding at every
/// point, and a larger one to within the tolerance.
inline Affine_symmetries_3<Kernel_of_searches> symmetries_by_exact_frames(bool in_threads,
                                                                          const Framed_surface_3& surface,
                                                                          const Symmetry_check& check,
                                                                          const Symmetry_options& options) {
  constexpr std::size_t fewest_points = 4, fewest_inner_points = 2;
  constexpr double least_inside = 0.05; // of the images of points in the box
  const double tolerance = options.tolerance.value_or(Default_tolerances::function);
  Symmetry_search search(in_threads, surface, options.kind, std::max(tolerance, greatest_tolerance_of_frames));
  std::vector<Affine_map_3> maps = search.run();
  if (!options.reflections) std::erase_if(maps, [](const Affine_map_3& map) { return map.matrix.determinant() < 0; });
  const auto is_exact = [](const Checked_map& map) { return map.is_exact && map.inside > least_inside; };
  const auto is_near = [&](const Checked_map& map) {
    return map.rms <= tolerance * check.size() && map.inside > least_inside;
  };

  Affine_symmetries_3<Kernel_of_searches> result;
  result.kind = options.kind;
  result.spacing = check.spacing();
  result.maps = {symmetry({}, 0, 0)};
  if (check.is_cut()) result.order_in_box = 1;
  if (search.good_points_matched() < fewest_points ||
      (check.is_cut() && search.good_inner_points_matched() < fewest_inner_points)) {
    result.reason = "too few points of the surface have an affine frame that can be compared";
    return result;
  }
  const auto group = group_that_holds(in_threads, maps, check, is_exact);
  if (!group) {
    result.reason = "the maps that move the surface onto itself to rounding do not form a group";
    return result;
  }
  if (check.is_cut())
    result.order_in_box = std::size_t(
        std::count_if(group->begin(), group->end(), [](const Checked_symmetry& s) { return s.check.inside == 1; }));
  if (group->size() > 1) result.levels.push_back(level_of(*group, check.size()));
  if (maps.size() > group->size())
    if (const auto larger = group_that_holds(in_threads, maps, check, is_near);
        larger && larger->size() > group->size())
      result.levels.push_back(level_of(*larger, check.size()));
  result.is_decided = true;
  result.verdict = group->size() > 1       ? Symmetry_verdict::EXACT
                   : result.levels.empty() ? Symmetry_verdict::NONE
                                           : Symmetry_verdict::APPROXIMATE;
  if (!result.levels.empty()) result.maps = (options.tolerance ? result.levels.back() : result.levels.front()).maps;
  return result;
}

/// Appends other points up to a total number.
inline std::vector<Eigen::Vector3d> filled_up(std::vector<Eigen::Vector3d> points,
                                              const std::vector<Eigen::Vector3d>& others, std::size_t count) {
  if (points.size() < count)
    points.insert(points.end(), others.begin(),
                  others.begin() + std::ptrdiff_t(std::min(others.size(), count - points.size())));
  return points;
}

/// Matches exact frames at some points, and at five times as many if curvatures vary too fast between these.
inline Affine_symmetries_3<Kernel_of_searches> symmetries_by_exact_frames(bool in_threads,
                                                                          const Framed_function_3& function,
                                                                          const std::vector<Eigen::Vector3d>& points,
                                                                          const Symmetry_check& check,
                                                                          const Symmetry_options& options) {
  constexpr std::array<std::size_t, 2> counts = {most_framed_points, 5 * most_framed_points};
  Affine_symmetries_3<Kernel_of_searches> result;
  for (const std::size_t count : counts) {
    const auto surface =
        framed_surface(in_threads, function, function, filled_up(points, check.points(), count), options.kind, count);
    result = symmetries_by_exact_frames(in_threads, surface, check, options);
    if (result.is_decided) break;
  }
  return result;
}

} // namespace equiaffine::internal

#endif
