// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SYMMETRIES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SYMMETRIES_H

#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/internal/declared_searches.h>
#include <equiaffine/registration/internal/frames/Framed_surface_3.h>
#include <equiaffine/registration/internal/frames/Symmetry_search.h>
#include <equiaffine/registration/internal/frames/slippage.h>
#include <equiaffine/registration/internal/wholes/Centered_symmetry_search.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

inline Affine_symmetry_3<Kernel_of_searches> symmetry(const Affine_map_3& map, double rms) {
  return {map.to_CGAL<Kernel_of_searches::Aff_transformation_3>(), rms};
}

/// Sets the maps to within the tolerance: those of the last level that is, or without a tolerance, of the first level
/// that a verdict stands for. They are all there are unless another map is within the tolerance, too.
inline void choose_maps(Affine_symmetries_3<Kernel_of_searches>& result, std::optional<double> tolerance,
                        const Centered_symmetries& found) {
  result.maps = {symmetry({}, 0)};
  result.is_decided = result.verdict != Symmetry_verdict::UNDECIDED;
  if (result.continuous.dimension() > 0) return;
  if (!tolerance && result.is_decided && !result.levels.empty()) result.maps = result.levels.front().maps;
  if (!tolerance) return;
  double next_rms = found.least_rms;
  for (std::size_t n = 0; n < result.levels.size(); ++n)
    if (result.levels[n].rms <= *tolerance) {
      result.maps = result.levels[n].maps;
      next_rms = found.levels[n].next_rms;
    }
  result.is_decided = std::min(found.complete_to, next_rms) > *tolerance;
}

/// Converts what was found to the types of CGAL. Distances of maps are in the unit of the surface.
inline Affine_symmetries_3<Kernel_of_searches> to_CGAL(const Centered_symmetries& found,
                                                       const Centered_surface_3& surface) {
  const double unit = 1 / std::cbrt(std::abs(surface.map.matrix.determinant()));
  Affine_symmetries_3<Kernel_of_searches> result{found.verdict, found.reason};
  for (const Symmetry_level& level : found.levels) {
    auto& copy = result.levels.emplace_back();
    copy.rms = level.rms;
    for (const Centered_map& map : level.maps) copy.maps.push_back(symmetry(map.map, unit * map.rms));
  }
  result.continuous = found.continuous;
  if (found.complete_to > 0) result.complete_to = found.complete_to;
  return result;
}

/// The group that affine frames of points give, which are all symmetries to within the tolerance of at least 98 % of
/// the points. The identity alone is a result only where frames are exact and some good ones were matched.
template <class ConcurrencyTag>
Affine_symmetries_3<Kernel_of_searches> symmetries_by_frames(const Framed_surface_3& surface,
                                                             const Map_request& request, bool is_exact) {
  Symmetry_search<ConcurrencyTag> search(surface, request.kind, *request.tolerance);
  Affine_symmetries_3<Kernel_of_searches> result;
  Symmetry_level_3<Kernel_of_searches> level = {{}, 0};
  for (const Affine_map_3& map : search.run()) {
    if (!request.allows_reflections && map.matrix.determinant() < 0) continue;
    const double rms = search.rms(map);
    level.maps.push_back(symmetry(map, rms));
    level.rms = std::max(level.rms, rms / surface.size);
  }
  constexpr std::size_t fewest_points = 4;
  result.maps = level.maps;
  if (level.maps.size() > 1) {
    result.verdict = is_exact ? Symmetry_verdict::EXACT : Symmetry_verdict::APPROXIMATE;
    result.levels.push_back(std::move(level));
  } else if (is_exact && search.good_points_matched() >= fewest_points) {
    result.verdict = Symmetry_verdict::NONE;
  } else {
    result.reason = is_exact ? "too few points of the surface have an affine frame"
                             : "the curvatures of the fit are too uncertain for their frames to find all symmetries";
  }
  result.is_decided = result.verdict != Symmetry_verdict::UNDECIDED;
  return result;
}

/// Up to this tolerance, the frames of a smooth surface decide alone: they take a hundredth of the time of a search of
/// all rotations, and say nothing of what holds approximately.
constexpr double greatest_tolerance_of_frames = 1e-6;

/// Says of a group that frames gave how far a search of all rotations went, and whether it found the same group.
inline void check_by_rotations(const Affine_symmetries_3<Kernel_of_searches>& all,
                               Affine_symmetries_3<Kernel_of_searches>& by_frames) {
  std::size_t order = 1;
  for (const auto& level : all.levels)
    if (level.rms <= greatest_tolerance_of_frames) order = level.order();
  by_frames.complete_to = all.complete_to;
  if (!all.complete_to || order == by_frames.maps.size()) return;
  by_frames.is_decided = false;
  by_frames.verdict = Symmetry_verdict::UNDECIDED;
  by_frames.reason = "frames of curvature give " + std::to_string(by_frames.maps.size()) +
                     " maps, and all rotations give " + std::to_string(order);
}

/// The symmetries among all rotations about the centroid.
template <class ConcurrencyTag>
Affine_symmetries_3<Kernel_of_searches> symmetries_by_rotations(const Any_function_3& function,
                                                                const Map_request& request) {
  const auto centered = centered_surface<ConcurrencyTag>(function, request.kind);
  Centered_symmetry_search<ConcurrencyTag> search(centered, request.kind, request.allows_reflections,
                                                  *request.tolerance);
  const Centered_symmetries found = search.run();
  auto result = to_CGAL(found, centered);
  choose_maps(result, request.tolerance, found);
  return result;
}

template <class ConcurrencyTag>
Affine_symmetries_3<Kernel_of_searches> symmetries_of_function(const Any_function_3& function,
                                                               const std::vector<Eigen::Vector3d>& points,
                                                               const Symmetry_request& request) {
  check_argument(!points.empty(), "a surface whose symmetries are sought has no points: give points on it");
  const Framed_function_3 framed(function);
  const Framed_surface_3 surface = framed_surface<ConcurrencyTag>(framed, framed, points, request.kind);
  Affine_symmetries_3<Kernel_of_searches> result;
  result.maps = {symmetry({}, surface.probes.empty() ? std::numeric_limits<double>::infinity() : 0)};
  result.reason = "the surface is beside all of the points";
  if (surface.probes.empty()) return result;
  result.continuous = slippage_of(surface, request.kind, std::max(*request.tolerance, slippage_tolerance));
  if (result.continuous.dimension() > 0) {
    result.verdict = Symmetry_verdict::EXACT;
    result.reason.clear();
    return result;
  }
  const bool is_exact = has_exact_frames(surface);
  const bool is_strict = *request.tolerance <= greatest_tolerance_of_frames;
  if (is_strict || !is_exact) {
    auto by_frames = symmetries_by_frames<ConcurrencyTag>(surface, request, is_exact);
    if (by_frames.is_decided && is_exact && request.is_complete)
      check_by_rotations(symmetries_by_rotations<ConcurrencyTag>(function, request), by_frames);
    if (by_frames.is_decided || !is_exact) return by_frames;
  }
  result = symmetries_by_rotations<ConcurrencyTag>(function, request);
  if (result.is_decided || is_strict) return result;
  auto by_frames = symmetries_by_frames<ConcurrencyTag>(surface, request, is_exact);
  return by_frames.is_decided ? by_frames : result;
}

template <class ConcurrencyTag>
Affine_symmetries_3<Kernel_of_searches> symmetries_of_triangles(const Triangles_3& mesh, const Map_request& request) {
  check_argument(!mesh.triangles.empty(), "a mesh whose symmetries are sought has no faces: give faces");
  const Centered_surface_3 surface = centered_surface(mesh, request.kind);
  Centered_symmetry_search<ConcurrencyTag> search(surface, request.kind, request.allows_reflections,
                                                  request.tolerance.value_or(0));
  const Centered_symmetries found = search.run();
  auto result = to_CGAL(found, surface);
  choose_maps(result, request.tolerance, found);
  return result;
}

} // namespace equiaffine::internal

#endif
