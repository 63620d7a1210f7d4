// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/Affine_map_3.h"
#include "registration/Centered_symmetry_search.h"
#include "registration/Framed_surface_3.h"
#include "registration/Symmetry_check.h"
#include "registration/Symmetry_search.h"
#include "registration/slippage.h"
#include "registration/surface_of_data.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/internal/searches.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

bool has_finite_group(const Affine_symmetries_3<Kernel_of_searches>& result) {
  return result.continuous.dimension() == 0 || !result.levels.empty();
}

/// Selects the maps: those of the last level within the tolerance or, without a tolerance, of the first level with a
/// verdict. They are all symmetries unless another map is also within the tolerance.
void choose_maps(Affine_symmetries_3<Kernel_of_searches>& result, std::optional<double> tolerance,
                 const Centered_symmetries& found) {
  result.maps = {symmetry({}, 0, 0)};
  result.is_decided = result.verdict != Symmetry_verdict::UNDECIDED;
  if (!has_finite_group(result)) return;
  const bool is_first_meant =
      result.verdict == Symmetry_verdict::EXACT || result.verdict == Symmetry_verdict::APPROXIMATE;
  if (!tolerance && is_first_meant && !result.levels.empty()) result.maps = result.levels.front().maps;
  if (!tolerance) return;
  double next_rms = found.least_rms;
  for (std::size_t n = 0; n < result.levels.size(); ++n)
    if (result.levels[n].rms <= *tolerance) {
      result.maps = result.levels[n].maps;
      next_rms = found.levels[n].next_rms;
    }
  result.is_decided = std::min(found.complete_to, next_rms) > *tolerance;
  if (!result.is_decided) result.verdict = Symmetry_verdict::UNDECIDED;
}

/// Converts the result to the types of CGAL. Distances of maps are in the unit of the surface.
Affine_symmetries_3<Kernel_of_searches> to_CGAL(const Centered_symmetries& found, const Centered_surface_3& surface) {
  const double unit = surface.own.size;
  const Affine_map_3 back = surface.map.inverse();
  Affine_symmetries_3<Kernel_of_searches> result{found.verdict, found.reason};
  for (const Symmetry_level& level : found.levels) {
    auto& copy = result.levels.emplace_back();
    copy.rms = level.rms;
    copy.greatest = level.greatest;
    copy.maps.push_back(symmetry({}, 0, 0));
    for (std::size_t i = 1; i < level.maps.size(); ++i) {
      const auto& [map, rms, greatest] = level.maps[i];
      copy.maps.push_back(symmetry(back * map * surface.map, unit * rms, unit * greatest));
    }
  }
  result.continuous = found.continuous;
  if (found.complete_to > 0) result.complete_to = found.complete_to;
  return result;
}

/// Corrects maps that are a group to within tolerances so that their products are exact; returns nothing if they are not
/// a group.
std::optional<std::vector<Affine_map_3>> nearby_group(std::vector<Affine_map_3> maps, const Framed_surface_3& surface,
                                                      double tolerance) {
  constexpr double least = 1e-3, tolerances = 30;
  const Whitening whitening(surface.probes);
  const Affine_map_3 to = whitening.to(), from = whitening.from();
  for (Affine_map_3& map : maps) map = to * map * from;
  auto group = as_group(maps, std::max(least, tolerances * tolerance));
  if (!group || !make_exact(*group)) return std::nullopt;
  for (Affine_map_3& map : group->maps) map = from * map * to;
  return group->maps;
}

/// The group found by the frames of a fit: symmetries to within the tolerance at 98 % of the points or more. Since a fit
/// has errors, the identity alone is not a result.
Affine_symmetries_3<Kernel_of_searches> symmetries_by_frames(bool in_threads, const Framed_surface_3& surface,
                                                             const Symmetry_options& options, double tolerance) {
  Symmetry_search search(in_threads, surface, options.kind, tolerance);
  Affine_symmetries_3<Kernel_of_searches> result;
  result.kind = options.kind;
  std::vector<Affine_map_3> found = search.run();
  if (!options.reflections) std::erase_if(found, [](const Affine_map_3& map) { return map.matrix.determinant() < 0; });
  const auto group = nearby_group(std::move(found), surface, tolerance);
  if (!group) {
    result.maps = {symmetry({}, 0, 0)};
    result.reason = "the maps that move the fit onto itself to within its errors do not form a group";
    return result;
  }
  std::vector<Checked_symmetry> maps;
  for (const Affine_map_3& map : *group) maps.push_back({map, search.distances(map)});
  auto level = level_of(maps, surface.size);
  result.maps = level.maps;
  if (level.maps.size() > 1) {
    result.verdict = Symmetry_verdict::APPROXIMATE;
    result.levels.push_back(std::move(level));
  } else {
    result.reason = "the curvatures of the fit are too uncertain to find all symmetries from their frames";
  }
  result.is_decided = result.verdict != Symmetry_verdict::UNDECIDED;
  return result;
}

/// Compares a group found by frames with a search of all rotations, and states how far that search went.
void check_by_rotations(const Affine_symmetries_3<Kernel_of_searches>& all,
                        Affine_symmetries_3<Kernel_of_searches>& by_frames) {
  by_frames.complete_to = all.complete_to;
  if (!all.is_decided || !all.complete_to || all.maps.size() == by_frames.maps.size()) return;
  by_frames.is_decided = false;
  by_frames.verdict = Symmetry_verdict::UNDECIDED;
  by_frames.reason = "frames of curvature give " + std::to_string(by_frames.maps.size()) +
                     " maps, and all rotations give " + std::to_string(all.maps.size());
}

/// The symmetries among all rotations about the centroid.
Affine_symmetries_3<Kernel_of_searches> symmetries_by_rotations(bool in_threads, const Any_function_3& function,
                                                                const Symmetry_options& options) {
  const auto centered = centered_surface(in_threads, function, options.kind);
  Centered_symmetry_search search(in_threads, centered, options.kind, options.reflections,
                                  options.tolerance.value_or(0));
  const Centered_symmetries found = search.run();
  auto result = to_CGAL(found, centered);
  result.kind = options.kind;
  if (result.reason.empty()) result.spacing = centered.own.spacing;
  const bool is_exact = result.verdict == Symmetry_verdict::EXACT;
  choose_maps(result, is_exact ? options.tolerance : options.tolerance.value_or(Default_tolerances::function), found);
  return result;
}

/// The continuous symmetries from the velocities at the probes: exact to rounding if there are any, otherwise to within
/// the tolerance.
void find_continuous(const Framed_surface_3& surface, const Symmetry_options& options, bool is_exact,
                     Affine_symmetries_3<Kernel_of_searches>& result) {
  const double tolerance = std::max(options.tolerance.value_or(0), slippage_tolerance);
  Affine_slippage_3 slippage = slippage_of(surface, options.kind, is_exact ? exact_slippage : tolerance);
  const bool is_to_rounding = is_exact && slippage.dimension() > 0;
  if (is_exact && !is_to_rounding) slippage = slippage_of(surface, options.kind, tolerance);
  result.continuous = std::move(slippage);
  if (result.continuous.dimension() == 0) return;
  if (is_to_rounding) result.continuous.rms = 0;
  result.verdict = is_to_rounding ? Symmetry_verdict::EXACT : Symmetry_verdict::APPROXIMATE;
  result.is_decided = true;
  result.reason.clear();
}

/// Keeps the continuous symmetries of an exact function if finite motions confirm them at all check points. Otherwise
/// tries those compatible with more points. Returns whether none is left.
bool has_refuted_continuous(bool in_threads, Framed_surface_3 surface, const Symmetry_check& check,
                            const Symmetry_options& options, Affine_symmetries_3<Kernel_of_searches>& result) {
  constexpr int attempts = 3, most_steps = 20;
  result.spacing = check.spacing();
  for (int attempt = 0; attempt < attempts && result.continuous.dimension() > 0; ++attempt) {
    const Checked_map moved = check.check_flows(in_threads, result.continuous.generators);
    if (moved.is_exact || (result.verdict == Symmetry_verdict::APPROXIMATE &&
                           moved.rms <= options.tolerance.value_or(Default_tolerances::function) * check.size()))
      return false;
    if (attempt + 1 == attempts) break;
    // Details missed by the probes are at the check points, or where motions end off the surface.
    if (attempt == 0) surface.probes.insert(surface.probes.end(), check.points().begin(), check.points().end());
    for (const Eigen::Vector3d& p : moved.off)
      if (const Eigen::Vector3d foot = surface.refinement.moved_to_surface(p, most_steps);
          std::abs(surface.refinement.distance(foot).distance) < slippage_tolerance * check.size())
        surface.probes.push_back(foot);
    find_continuous(surface, options, true, result);
  }
  result.continuous = {};
  result.verdict = Symmetry_verdict::UNDECIDED;
  result.is_decided = false;
  return true;
}

/// The finite symmetries of an exact function, by points with frames of its surface.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_exact_function(bool in_threads, const Any_function_3& function,
                                                                     const Framed_surface_3& surface,
                                                                     const std::vector<Eigen::Vector3d>& points,
                                                                     const Symmetry_check& check,
                                                                     const Symmetry_options& options) {
  const double tolerance = options.tolerance.value_or(Default_tolerances::function);
  const bool is_strict = tolerance <= greatest_tolerance_of_frames;
  Affine_symmetries_3<Kernel_of_searches> by_frames;
  if (is_strict) {
    by_frames = symmetries_by_exact_frames(in_threads, surface.function, points, check, options);
    if (by_frames.is_decided && options.complete)
      check_by_rotations(symmetries_by_rotations(in_threads, function, options), by_frames);
    if (by_frames.is_decided || check.is_cut()) return by_frames;
  }
  auto result = symmetries_by_rotations(in_threads, function, options);
  if (result.is_decided || is_strict) return result;
  by_frames = symmetries_by_frames(in_threads, surface, options, tolerance);
  return by_frames.is_decided ? by_frames : result;
}

} // namespace

Affine_symmetries_3<Kernel_of_searches> symmetries_of_function(bool in_threads, const Surface_to_register& given,
                                                               const Symmetry_options& options) {
  const Any_function_3& function = given.function;
  const auto points = vectors_of(given.mesh.points);
  check_argument(!points.empty(), "the surface has no points: pass points on it");
  const Framed_function_3 framed(function);
  const Framed_surface_3 surface = framed_surface(in_threads, framed, framed, points, options.kind);
  const double infinity = std::numeric_limits<double>::infinity(), distance = surface.probes.empty() ? infinity : 0;
  Affine_symmetries_3<Kernel_of_searches> result;
  result.maps = {symmetry({}, distance, distance)};
  result.kind = options.kind;
  result.reason = "the fit has no surface near any of the points";
  if (surface.probes.empty()) return result;
  const bool is_exact = has_exact_frames(surface);
  const double tolerance = options.tolerance.value_or(Default_tolerances::function);
  find_continuous(surface, options, is_exact, result);
  if (!is_exact) return result.is_decided ? result : symmetries_by_frames(in_threads, surface, options, tolerance);
  const auto check = Symmetry_check::of(in_threads, function);
  if (check.is_cut()) result.order_in_box = 1;
  const bool is_refuted = result.is_decided && has_refuted_continuous(in_threads, surface, check, options, result);
  if (result.is_decided) return result;
  result = symmetries_of_exact_function(in_threads, function, surface, points, check, options);
  if (is_refuted && (!result.is_decided || (result.verdict == Symmetry_verdict::NONE && result.complete_to))) {
    result.is_decided = false;
    result.verdict = Symmetry_verdict::UNDECIDED;
    result.reason =
        "the surface slides over itself near each sampled point, but the motions move some points off it";
  }
  return result;
}

Affine_symmetries_3<Kernel_of_searches> symmetries_of_triangles(bool in_threads, const Triangles_3& mesh,
                                                                const Symmetry_options& options) {
  check_argument(!mesh.triangles.empty(), "the mesh has no faces: pass faces");
  Centered_surface_3 surface = centered_surface(mesh, options.kind);
  Map_kind kind = options.kind;
  if (!surface.reason_against.empty() && !keeps_angles(kind)) {
    kind = Map_kind::RIGID;
    surface = centered_surface(mesh, kind);
  }
  Centered_symmetry_search search(in_threads, surface, kind, options.reflections, options.tolerance.value_or(0));
  const Centered_symmetries found = search.run();
  auto result = to_CGAL(found, surface);
  result.kind = kind;
  choose_maps(result, options.tolerance, found);
  return result;
}

namespace {

/// The default tolerance of symmetries for a surface of that origin.
std::optional<double> default_tolerance(Surface_origin origin) {
  switch (origin) {
  case Surface_origin::FUNCTION: return std::nullopt;
  case Surface_origin::FIT: return Default_tolerances::fit;
  default: return Default_tolerances::spline;
  }
}

/// What to try if only the identity was found or nothing was decided, the most promising first.
std::vector<Registration_advice> advice_for_symmetries(const Affine_symmetries_3<Kernel_of_searches>& found,
                                                       Surface_origin origin, const Symmetry_options& options) {
  using enum Registration_advice;
  std::vector<Registration_advice> advice;
  if (found.is_undecided()) {
    if (origin == Surface_origin::DISTANCE) advice.push_back(FIT_OF_MESH);
    if (origin == Surface_origin::RAW_VOLUME) advice.push_back(SMOOTHING);
    if (!keeps_angles(found.kind)) advice.push_back(RIGID_MAPS);
    if (!options.tolerance) advice.push_back(OTHER_TOLERANCE);
  } else if (found.order() == 1U) {
    if (!found.levels.empty()) advice.push_back(LARGER_TOLERANCE);
    if (options.kind != Map_kind::AFFINE) advice.push_back(ALL_MAPS);
    if (!options.reflections) advice.push_back(REFLECTIONS);
  }
  return advice;
}

} // namespace

Symmetries_of_surface symmetries_of_surface(bool in_threads, const Mesh_of_searches& mesh, Surface_origin origin,
                                            const std::function<Surface_to_register()>& make_level_set,
                                            const Symmetry_options& options) {
  const auto of_triangles = [&](const Mesh_of_searches& surface) {
    return symmetries_of_triangles(in_threads, triangles_of_soup(surface.points, surface.triangles), options);
  };
  Symmetries_of_surface found;
  const bool is_mesh = !mesh.triangles.empty();
  if (is_mesh) found.result = of_triangles(mesh);
  if (!is_mesh || (found.result.is_undecided() && !keeps_angles(options.kind) && found.result.levels.empty())) {
    found.level_set = make_level_set();
    Symmetry_options of_function = options;
    if (!options.tolerance) of_function.tolerance = default_tolerance(origin);
    const bool is_of_points = origin == Surface_origin::FIT && found.level_set->mesh.triangles.empty() &&
                              !found.level_set->extracted.triangles.empty();
    auto result = is_of_points ? of_triangles(found.level_set->extracted)
                               : symmetries_of_function(in_threads, *found.level_set, of_function);
    if (!is_mesh || !result.is_undecided()) found.result = std::move(result);
  }
  found.result.advice = advice_for_symmetries(found.result, origin, options);
  return found;
}

Affine_symmetries_3<Kernel_of_searches> symmetries_of_data(bool in_threads, const Surface_data_3& data,
                                                           const Symmetry_options& options) {
  const auto fit = [&] { return surface_of_data(in_threads, data, options.fit, Use_of_surface::SYMMETRIES); };
  return symmetries_of_surface(in_threads, data.mesh, Surface_origin::FIT, fit, options).result;
}

} // namespace equiaffine::internal
