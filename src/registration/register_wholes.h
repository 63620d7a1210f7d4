// SPDX-License-Identifier: GPL-3.0-or-later
// Registers whole surfaces by their centroids and a search of all rotations and reflections.
#ifndef EQUIAFFINE_SRC_REGISTRATION_REGISTER_WHOLES_H
#define EQUIAFFINE_SRC_REGISTRATION_REGISTER_WHOLES_H

#include "registration/Affine_map_3.h"
#include "registration/Centered_map.h"
#include "registration/Centered_surface_3.h"
#include "registration/map_evidence.h"
#include "registration/mesh_samples.h"
#include <equiaffine/registration/register_surfaces.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Thresholds on rms distances of whole surfaces.
struct Tolerances_of_wholes {
  double equal; ///< the surfaces are equal up to this distance
  double alone; ///< a map counts up to this distance if all others are twice as far off
  double tried; ///< rotations are tried up to this distance
};

/// Triangles deviate from a smooth surface, and thin surfaces are closer to others. Two samplings of one object, such as
/// a scan and its coarse version, are similar without being equal; polyhedral solids have no such versions.
inline Tolerances_of_wholes tolerances_of_wholes(const Centered_pair& surfaces, const Registration_options& options) {
  constexpr double least = 3e-3, greatest = 0.01, alike = 0.015;
  const double facet_error = surfaces.source.samples.facet_error + surfaces.target.samples.facet_error;
  const double thickness = std::min(surfaces.source.thickness(), surfaces.target.thickness());
  const double usual = std::clamp(1.2 * facet_error, least, greatest) * thickness;
  if (options.tolerance) return {*options.tolerance, 0, std::max(*options.tolerance, least * thickness)};
  const double equal = tolerance_of_facets(facet_error, usual);
  return {equal, equal < usual ? 0 : alike * thickness, usual};
}

/// A map between centered surfaces with its evidence, in the coordinates of the surfaces. Points farther than `touching`
/// from the other surface contradict the map, and the others lie on it.
inline Shape_match match_of(const Centered_pair& surfaces, const Affine_map_3& map, double touching,
                            const Judgement& how) {
  const auto& [source, target] = surfaces;
  const Distances_both_ways distances(surfaces, map, how.probes);
  const std::array chances = {chance_of_nearness(target.samples.area.measure, target.samples.radius()),
                              chance_of_nearness(source.samples.area.measure, source.samples.radius())};
  const Map_evidence evidence = evidence_of_distances(distances.moved, distances.fixed, 1, chances, how);
  const std::array<double, 2> parts = {part_on_surface(distances.moved, touching),
                                       part_on_surface(distances.fixed, touching)};
  return {target.map.inverse() * map * source.map,
          target.own.size * own_rms(surfaces, map, how.probes, distances.rms()),
          parts,
          evidence.log10_false_alarms,
          {1 - parts[0], 1 - parts[1]}};
}

/// Returns rotations close to all those that may move one surface to within a distance of the other. If the source is
/// symmetric about an axis there are too many, and the best ones are enough; a surface that is symmetric about every axis
/// is a sphere.
inline std::vector<Rotation_candidate> rotations_to_refine(bool in_threads, const Centered_pair& surfaces,
                                                           double distance, bool allows_reflections,
                                                           std::size_t dimension_of_slippage) {
  constexpr std::size_t most_of_family = 200;
  if (dimension_of_slippage == 3) return {{Eigen::Matrix3d::Identity(), 0}};
  auto rotations =
      candidate_rotations(in_threads, surfaces.source, surfaces.target, distance, allows_reflections).rotations;
  if (dimension_of_slippage > 0 && rotations.size() > most_of_family) rotations.resize(most_of_family);
  return rotations;
}

/// Whether the best map is below an rms distance and all others are at least twice as far off.
inline bool is_one_alone(const std::vector<Centered_map>& maps, double rms) {
  return !maps.empty() && maps[0].rms < rms && (maps.size() == 1 || maps[1].rms > 2 * maps[0].rms);
}

/// The maps that move a whole surface onto another one. They preserve the centroid of the area, and affine maps the
/// moments of the enclosed solid, so all rotations and reflections about the centroid are tried and no curvature is
/// needed. Surfaces whose extents differ by a tenth of the size are not equal, and no rotation is tried.
inline Shape_matches register_wholes(bool in_threads, const Centered_surface_3& source,
                                     const Centered_surface_3& target, const Registration_options& options) {
  constexpr double gate = 0.06, least_difference = 0.1, most_contradictions = 0.1;
  constexpr std::size_t probes = 6000;
  Shape_matches result;
  if (!source.reason_against.empty() || !target.reason_against.empty()) return result;
  if ((source.extents() - target.extents()).cwiseAbs().maxCoeff() > least_difference) return result;
  const Centered_pair surfaces(source, target);
  result.size = target.own.size;
  const Tolerances_of_wholes tolerances = tolerances_of_wholes(surfaces, options);
  double scale = 1;
  if (keeps_volume(options.kind)) {
    scale = std::cbrt(std::abs(target.map.matrix.determinant() / source.map.matrix.determinant()));
    if (std::abs(std::log(scale)) > least_difference) return result;
  }
  const auto slipping = slipping_rotations(in_threads, source, options.kind);
  result.slippage = continuous_symmetries(source, slipping, tolerances_of_wholes(Centered_pair(source), options).tried);
  const auto rotations = rotations_to_refine(in_threads, surfaces, 2 * std::max(tolerances.tried, tolerances.alone),
                                             options.reflections, result.slippage.dimension());
  result.hypotheses = rotations.size();
  const Judgement how = {10 * tolerances.tried, 0, degrees_of_freedom(options.kind),
                         double(std::max<std::size_t>(result.hypotheses, 1)), probes};
  const double touching =
      tolerance_of_contact(std::max(source.samples.facet_error, target.samples.facet_error), options);
  const auto maps = refined_candidates(in_threads, surfaces, rotations, scale, options.kind, gate).maps;
  const auto match = [&](const Centered_map& map) {
    return match_of(surfaces, map.map, std::max(touching, 3 * map.rms), how);
  };
  for (const Centered_map& map : maps)
    if (map.rms < tolerances.equal)
      if (const Shape_match m = match(map); std::max(m.contradictions[0], m.contradictions[1]) < most_contradictions)
        result.maps.push_back(m);
  std::stable_sort(result.maps.begin(), result.maps.end(),
                   [](const Shape_match& a, const Shape_match& b) { return a.rms < b.rms; });
  if (result.maps.empty() && is_one_alone(maps, tolerances.alone))
    if (const Shape_match m = match(maps[0]); m.contradictions[0] + m.contradictions[1] < most_contradictions)
      result.maps.push_back(m);
  return result;
}

/// The number of other maps that match as much of the surfaces as closely as the first one.
inline std::size_t equally_good(const Shape_matches& found) {
  constexpr double part = 0.98, factor = 3, rounding = 1e-9;
  const auto least_inliers = [](const Shape_match& m) { return std::min(m.inliers[0], m.inliers[1]); };
  const auto greatest_inliers = [](const Shape_match& m) { return std::max(m.inliers[0], m.inliers[1]); };
  const Shape_match& best = found.maps.front();
  return std::size_t(std::count_if(found.maps.begin() + 1, found.maps.end(), [&](const Shape_match& m) {
    return m.rms <= factor * best.rms + rounding * found.size && least_inliers(m) >= part * least_inliers(best) &&
           greatest_inliers(m) >= part * greatest_inliers(best);
  }));
}

/// Converts the result to the types of CGAL. One map represents a continuous family.
inline Surface_registration_3<Kernel_of_searches> to_CGAL(Shape_matches found, const Registration_options& options) {
  Surface_registration_3<Kernel_of_searches> result;
  const bool slips = found.slippage.dimension() > 0;
  for (std::size_t n = 0; n < std::min(slips ? 1 : options.number_of_maps, found.maps.size()); ++n) {
    const Shape_match& m = found.maps[n];
    result.maps.push_back({m.map.to_CGAL<Kernel_of_searches::Aff_transformation_3>(),
                           m.log10_false_alarms,
                           m.inliers,
                           m.rms,
                           {},
                           m.contradictions});
  }
  if (!slips && found.maps.size() > 1) {
    result.next_best_rms = found.maps[1].rms;
    result.equally_good = equally_good(found);
  }
  result.hypotheses = found.hypotheses;
  result.size = found.size;
  result.reason = std::move(found.reason);
  result.slippage = std::move(found.slippage);
  return result;
}

/// The maps between whole surfaces.
inline Surface_registration_3<Kernel_of_searches> registration_of_wholes(bool in_threads,
                                                                         const Centered_surface_3& source,
                                                                         const Centered_surface_3& target,
                                                                         const Registration_options& options) {
  return to_CGAL(register_wholes(in_threads, source, target, options), options);
}

} // namespace equiaffine::internal

#endif
