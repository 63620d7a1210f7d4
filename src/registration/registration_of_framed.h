// SPDX-License-Identifier: GPL-3.0-or-later
// Registers whole surfaces or parts by the affine frames of their points.
#ifndef EQUIAFFINE_SRC_REGISTRATION_REGISTRATION_OF_FRAMED_H
#define EQUIAFFINE_SRC_REGISTRATION_REGISTRATION_OF_FRAMED_H

#include "registration/Centered_surface_3.h"
#include "registration/Frame_thresholds.h"
#include "registration/Framed_surface_3.h"
#include "registration/candidate_pairs.h"
#include "registration/map_evidence.h"
#include "registration/map_of_quadrics.h"
#include "registration/refine_map.h"
#include "registration/register_wholes.h"
#include "registration/slippage.h"
#include <equiaffine/registration/register_surfaces.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The points of the source and the target whose frames determine a map.
using Pair_of_points = std::array<Framed_point_3, 2>;

/// A refined map and its evidence.
struct Judged_map {
  Affine_map_3 map;
  Map_evidence evidence;
  std::optional<Pair_of_points> pair;
};

/// Searches for maps from the source to the target: each pair of points with equal invariants is a hypothesis. Pairs are
/// matched in parallel, and judged sequentially in a fixed order.
class Registration_search {
public:
  Registration_search(bool in_threads, const Framed_surface_3& source, const Framed_surface_3& target,
                      const Registration_options& options, const Frame_thresholds& thresholds)
      : in_threads_(in_threads), source_(source), target_(target), options_(options), thresholds_(thresholds),
        tolerance_(options.tolerance.value_or(std::clamp(
            8 * std::max(source.noise, target.noise), thresholds_.exact_tolerance, thresholds_.greatest_tolerance))) {}

  /// Tries similar pairs; then, while no map is accepted, pairs that might be similar if the structure is inaccurate.
  void run() {
    const auto points = points_to_try(in_threads_, source_, options_.kind, thresholds_.most_points_to_try, thresholds_);
    try_all(points, thresholds_.usual);
    if (first_accepted_ == 0) try_all(points, thresholds_.wrong_structure);
  }

  /// Refines a map and keeps it if it becomes as good as a correct map would after as many steps.
  void try_map(const Affine_map_3& map, const std::optional<Pair_of_points>& pair = {}) {
    ++hypotheses_;
    const Map_evidence first = rough_evidence(map, thresholds_.greatest_first_tolerance);
    if (first.log10_by_volume > thresholds_.first_log10) return;
    const double tolerance = std::clamp(30 * first.tolerance, 1e-3, 0.05);
    const auto improved = refined_map(map, {options_.kind, tolerance, 8, thresholds_.probes_at_first});
    if (!improved) return;
    const Map_evidence second =
        rough_evidence(*improved, std::min(thresholds_.greatest_first_tolerance, 10 * tolerance_));
    if (second.log10_by_volume > thresholds_.second_log10) return;
    const auto refined = refined_map(*improved, {options_.kind, std::clamp(30 * second.tolerance, 1e-3, 0.05)});
    if (refined && !is_known(*refined, 1e-4)) keep({*refined, evidence(*refined), pair});
  }

  /// Tries all other images of the point of the best map: if the target has symmetries, other maps fit equally well.
  void find_equally_good() {
    const auto best = accepted();
    if (best.empty() || !best.front().pair) return;
    const Framed_point_3 point = (*best.front().pair)[0];
    const auto source = std::find_if(source_.points.begin(), source_.points.end(),
                                     [&](const Framed_point_3& p) { return p.point == point.point; });
    const auto index = std::size_t(source - source_.points.begin());
    const Candidate_limits limits = {3000, 3000, thresholds_.usual.greatest_mismatch};
    auto pairs = pairs_of_point(source_, target_, index, options_.kind, limits, thresholds_);
    pairs = without_near(pairs, most_images, [&](const Candidate_pair& a, const Candidate_pair& b) {
      return (target_.points[a.target].point - target_.points[b.target].point).norm() < 1.5 * target_.spacing;
    });
    std::vector<Counterpart> found(pairs.size());
    parallel_for(in_threads_, 0, pairs.size(), [&](std::size_t n) {
      found[n] = find_counterpart(source_, target_, pairs[n], options_.kind, thresholds_);
    });
    const std::size_t hypotheses = hypotheses_;
    for (const Counterpart& c : found)
      if (c.cost < 1) try_counterpart(c);
    hypotheses_ = hypotheses; // of the search for a map
  }

  /// The number of other maps that move as many points onto the other surface, as closely, as the best one.
  std::size_t equally_good() const {
    constexpr double part = 0.98, factor = 3;
    const auto maps = accepted();
    if (maps.empty()) return 0;
    const Map_evidence& best = maps.front().evidence;
    return std::size_t(std::count_if(maps.begin() + 1, maps.end(), [&](const Judged_map& m) {
      const double limit = factor * best.rms + thresholds_.rounding * target_.size;
      return m.evidence.rms <= limit && m.evidence.inliers[0] >= part * best.inliers[0] &&
             m.evidence.inliers[1] >= part * best.inliers[1];
    }));
  }

  std::size_t hypotheses() const { return hypotheses_; }
  double tolerance() const { return tolerance_; } ///< in the unit of distances

  /// The significant maps, distinct from each other, the best first.
  std::vector<Judged_map> accepted() const {
    std::vector<Judged_map> result;
    for (const Judged_map& m : maps_)
      if (is_accepted(m) && std::none_of(result.begin(), result.end(), [&](const Judged_map& better) {
            return difference_of(m.map, better.map) < same;
          }))
        result.push_back(m);
    return result;
  }

  /// The rms distance of the best map other than the first accepted one, whether accepted or not.
  std::optional<double> next_best_rms() const {
    const auto maps = accepted();
    for (const Judged_map& m : maps_)
      if (maps.empty() || difference_of(m.map, maps.front().map) >= same) return m.evidence.rms;
    return {};
  }

private:
  static constexpr std::size_t most_images = 200;
  static constexpr double same = 0.02; ///< maps that differ by less are the same

  bool is_accepted(const Judged_map& m) const { return m.evidence.log10_false_alarms < thresholds_.accepted_log10; }

  bool is_done() const {
    if (hypotheses_ >= thresholds_.most_hypotheses) return true;
    if (first_accepted_ == 0 || options_.number_of_maps > 1) return false;
    const Map_evidence& best = maps_.front().evidence;
    const bool has_noise = tolerance_ > thresholds_.exact_tolerance,
               has_all = std::max(best.inliers[0], best.inliers[1]) > 0.8;
    const bool is_within_noise =
        has_noise ? has_all || best.tolerance <= tolerance_ / 3 : best.tolerance <= thresholds_.rounding;
    return is_within_noise || hypotheses_ >= first_accepted_ + thresholds_.more_hypotheses;
  }

  void try_all(const std::vector<std::size_t>& points, const Candidate_limits& limits) {
    for (std::size_t begin = 0; begin < points.size() && !is_done(); begin += thresholds_.points_per_batch) {
      const std::size_t count = std::min(thresholds_.points_per_batch, points.size() - begin);
      try_points(std::span(points).subspan(begin, count), limits);
    }
  }

  void try_points(std::span<const std::size_t> points, const Candidate_limits& limits) {
    auto pairs = candidate_pairs(in_threads_, source_, target_, points, options_.kind, limits, thresholds_);
    std::erase_if(pairs, [&](const Candidate_pair& p) { return !tried_.insert({p.source, p.target}).second; });
    for (std::size_t begin = 0; begin < pairs.size() && !is_done(); begin += thresholds_.pairs_at_once) {
      const std::size_t count = std::min(thresholds_.pairs_at_once, pairs.size() - begin);
      std::vector<Counterpart> found(count);
      parallel_for(in_threads_, 0, count, [&](std::size_t n) {
        found[n] = find_counterpart(source_, target_, pairs[begin + n], options_.kind, thresholds_);
      });
      std::stable_sort(found.begin(), found.end(),
                       [](const Counterpart& a, const Counterpart& b) { return a.cost < b.cost; });
      for (const Counterpart& c : found)
        if (!is_done()) try_counterpart(c);
    }
  }

  void try_counterpart(const Counterpart& pair) {
    const Framed_point_3& p = source_.points[pair.source];
    const Affine_map_3 map = map_between(p, pair.target, options_.kind);
    const double determinant = map.matrix.determinant();
    if (!map.matrix.allFinite() || !(condition(map.matrix) < greatest_condition)) return;
    if (determinant < 0 && !options_.reflections) return;
    if (is_known(map, same)) return;
    try_map(map, Pair_of_points{p, pair.target});
  }

  std::optional<Affine_map_3> refined_map(const Affine_map_3& map, const Refinement& how) const {
    return refine_map(in_threads_, source_, target_, map, how);
  }

  Map_evidence rough_evidence(const Affine_map_3& map, double tolerance) const {
    const Judgement how{tolerance, options_.min_overlap, 0, 1, thresholds_.probes_at_first};
    return evidence_of_map(in_threads_, source_, target_, map, how);
  }

  Map_evidence evidence(const Affine_map_3& map) const {
    Judgement how{tolerance_, options_.min_overlap, degrees_of_freedom(options_.kind), double(hypotheses_)};
    how.are_exact = has_exact_frames(source_) && has_exact_frames(target_);
    return evidence_of_map(in_threads_, source_, target_, map, how);
  }

  /// Sorts the maps by their evidence.
  void keep(const Judged_map& m) {
    if (is_accepted(m) && first_accepted_ == 0) first_accepted_ = hypotheses_;
    const auto is_better = [this](const Judged_map& a, const Judged_map& b) {
      if (is_accepted(a) != is_accepted(b)) return is_accepted(a);
      return a.evidence.log10_by_volume < b.evidence.log10_by_volume;
    };
    maps_.insert(std::upper_bound(maps_.begin(), maps_.end(), m, is_better), m);
  }

  /// Whether a map differs from an accepted one by less than a fraction of the size of the moved source.
  bool is_known(const Affine_map_3& map, double part) const {
    return std::any_of(maps_.begin(), maps_.end(),
                       [&](const Judged_map& m) { return is_accepted(m) && difference_of(map, m.map) < part; });
  }

  /// The mean distance between images of points, relative to the size of the moved source.
  double difference_of(const Affine_map_3& a, const Affine_map_3& b) const {
    const std::size_t count = std::min<std::size_t>(20, source_.probes.size());
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += (a(source_.probes[i]) - b(source_.probes[i])).norm() / double(count);
    return sum / unit_of_distances(source_, target_, b);
  }

  bool in_threads_;
  const Framed_surface_3 &source_, &target_;
  Registration_options options_;
  Frame_thresholds thresholds_;
  double tolerance_; ///< in the unit of distances: closer surfaces may be equal
  std::size_t hypotheses_ = 0, first_accepted_ = 0;
  std::vector<Judged_map> maps_;
  std::set<std::array<std::size_t, 2>> tried_; ///< pairs of points of the source and of the target
};

inline Registered_map_3<Kernel_of_searches> registered_map(const Judged_map& m) {
  Registered_map_3<Kernel_of_searches> result{m.map.to_CGAL<Kernel_of_searches::Aff_transformation_3>(),
                                              m.evidence.log10_false_alarms,
                                              m.evidence.inliers,
                                              m.evidence.rms,
                                              {}};
  if (!m.pair) return result;
  result.pair.emplace();
  for (std::size_t side = 0; side < 2; ++side) {
    const Framed_point_3& framed = (*m.pair)[side];
    const Eigen::Vector3d& p = framed.point;
    const Eigen::Matrix3d& basis = framed.basis;
    result.pair->points[side] = Kernel_of_searches::Point_3(p[0], p[1], p[2]);
    for (int k = 0; k < 3; ++k)
      result.pair->frames[side][std::size_t(k)] = Kernel_of_searches::Vector_3(basis(0, k), basis(1, k), basis(2, k));
  }
  return result;
}

inline bool is_equivalence(bool in_threads, const Framed_surface_3& source, const Framed_surface_3& target,
                           const Affine_map_3& map, double tolerance) {
  const double distance = tolerance * unit_of_distances(source, target, map);
  return part_on_surface(moved_source(in_threads, source, target, map, most_probes), distance) > part_of_same_surface &&
         part_on_surface(target_beside_moved_source(in_threads, source, target, map, most_probes), distance) >
             part_of_same_surface;
}

/// Whether the probes lie in a plane to within a fraction of their size. Every map between planes moves one onto the
/// other, which is not evidence.
inline bool is_in_plane(const Framed_surface_3& surface, double tolerance) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : surface.probes) mean += p / double(surface.probes.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : surface.probes)
    covariance += (p - mean) * (p - mean).transpose() / double(surface.probes.size());
  const double variance = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0];
  return !(variance > std::pow(tolerance * surface.size, 2));
}

/// The motions by which the source slides over itself, from the velocities at its probes.
inline Affine_slippage_3 slippage_of_source(const Framed_surface_3& source, Map_kind kind) {
  const bool is_exact = has_exact_frames(source);
  Affine_slippage_3 result = slippage_of(source, kind, is_exact ? slippage_tolerance : slippage_of_fits);
  if (is_exact) result.rms = 0;
  return result;
}

inline Registration_of_functions_3 registration_of_framed(bool in_threads, const Framed_surface_3& source,
                                                          const Framed_surface_3& target,
                                                          const Registration_options& options,
                                                          Affine_slippage_3 slippage,
                                                          const Frame_thresholds& thresholds = {}) {
  Registration_of_functions_3 registration;
  Surface_registration_3<Kernel_of_searches>& result = registration.result;
  result.size = target.size;
  result.slippage = std::move(slippage);
  Registration_search search(in_threads, source, target, options, thresholds);
  if (is_in_plane(source, search.tolerance()) || is_in_plane(target, search.tolerance())) return registration;
  if (result.slippage.dimension() > 0)
    if (const auto map = map_of_quadrics(source, target, options)) search.try_map(*map);
  if (search.accepted().empty()) search.run();
  if (result.slippage.dimension() == 0) search.find_equally_good();
  result.hypotheses = search.hypotheses();
  const auto accepted = search.accepted();
  if (result.slippage.dimension() == 0) result.equally_good = search.equally_good();
  for (std::size_t n = 0; n < std::min(accepted.size(), options.number_of_maps); ++n)
    result.maps.push_back(registered_map(accepted[n]));
  result.next_best_rms = search.next_best_rms();
  registration.is_equivalence =
      result.found() && is_equivalence(in_threads, source, target, accepted[0].map, search.tolerance());
  return registration;
}

} // namespace equiaffine::internal

#endif
