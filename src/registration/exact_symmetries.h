// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_EXACT_SYMMETRIES_H
#define EQUIAFFINE_SRC_REGISTRATION_EXACT_SYMMETRIES_H

#include "registration/Finite_group.h"
#include "registration/Framed_surface_3.h"
#include "registration/Symmetry_check.h"
#include "registration/Symmetry_search.h"
#include "registration/Whitening.h"
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/internal/Symmetry_request.h>
#include <equiaffine/registration/internal/searches.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

inline Affine_symmetry_3<Kernel_of_searches> symmetry(const Affine_map_3& map, double rms, double greatest) {
  return {map.to_CGAL<Kernel_of_searches::Aff_transformation_3>(), rms, greatest};
}

/// Maps are tried by the first of these numbers of points, and a group by all points.
constexpr std::size_t few_points = 3000, most_points_of_check = std::numeric_limits<std::size_t>::max();

/// A map that was checked.
struct Checked_symmetry {
  Affine_map_3 map;
  Checked_map check;
};

/// Returns the group that maps generate, if each of its elements `holds`; nothing if one does not, or there are too
/// many. Sums of errors are made right in coordinates in which the points of the surface have covariance 1.
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

/// Up to this tolerance, the frames of a smooth surface decide alone: they take a hundredth of the time of a search of
/// all rotations, and say nothing of what holds approximately.
constexpr double greatest_tolerance_of_frames = 1e-6;

/// Returns the group of the maps that hold, as far as the box shows; of those that keep its center if they are none
/// since the surface goes on beyond it, such as translations.
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

/// The groups that affine frames of points of a smooth surface give: that of the maps which hold to rounding at every
/// point, and a larger one to within the tolerance.
inline Affine_symmetries_3<Kernel_of_searches> symmetries_by_exact_frames(bool in_threads,
                                                                          const Framed_surface_3& surface,
                                                                          const Symmetry_check& check,
                                                                          const Map_request& request) {
  constexpr std::size_t fewest_points = 4, fewest_inner_points = 2;
  constexpr double least_inside = 0.05; // of the images of points, in the box
  const double tolerance = request.tolerance.value_or(default_tolerance);
  Symmetry_search search(in_threads, surface, request.kind, std::max(tolerance, greatest_tolerance_of_frames));
  std::vector<Affine_map_3> maps = search.run();
  if (!request.allows_reflections)
    std::erase_if(maps, [](const Affine_map_3& map) { return map.matrix.determinant() < 0; });
  const auto is_exact = [](const Checked_map& map) { return map.is_exact && map.inside > least_inside; };
  const auto is_near = [&](const Checked_map& map) {
    return map.rms <= tolerance * check.size() && map.inside > least_inside;
  };

  Affine_symmetries_3<Kernel_of_searches> result;
  result.kind = request.kind;
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
    result.reason = "maps that move the surface onto itself to rounding are no group";
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
  if (!result.levels.empty()) result.maps = (request.tolerance ? result.levels.back() : result.levels.front()).maps;
  return result;
}

/// The first points, and others after them, up to a number.
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
                                                                          const Map_request& request) {
  constexpr std::array<std::size_t, 2> counts = {most_framed_points, 5 * most_framed_points};
  Affine_symmetries_3<Kernel_of_searches> result;
  for (const std::size_t count : counts) {
    const auto surface =
        framed_surface(in_threads, function, function, filled_up(points, check.points(), count), request.kind, count);
    result = symmetries_by_exact_frames(in_threads, surface, check, request);
    if (result.is_decided) break;
  }
  return result;
}

} // namespace equiaffine::internal

#endif
