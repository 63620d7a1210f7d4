// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_REGISTER_PIECES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_REGISTER_PIECES_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/registration/internal/Contact_evidence.h>
#include <equiaffine/registration/internal/Piece_of_surface_3.h>
#include <equiaffine/registration/internal/Registration_request.h>
#include <equiaffine/registration/internal/Shape_matches.h>
#include <equiaffine/registration/internal/Two_point_frames.h>
#include <equiaffine/registration/internal/contacts.h>
#include <equiaffine/registration/internal/refine_map.h>
#include <equiaffine/registration/internal/without_near.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The search for maps between two pieces whose areas have centroid 0, in coordinates where the target has size 1.
template <class ConcurrencyTag>
class Registration_of_pieces {
public:
  Registration_of_pieces(const Piece_of_surface_3& source, const Piece_of_surface_3& target,
                         const Registration_request& request, double tolerance)
      : source_(source), target_(target), request_(request), tolerance_(tolerance) {}

  Shape_matches run() {
    Two_point_frames<ConcurrencyTag> frames(source_, target_, request_);
    std::vector<Candidate> candidates = candidates_of(frames.run());
    Shape_matches result;
    result.hypotheses = hypotheses_ = frames.hypotheses();
    refine(candidates, {few_samples, 8, 0.15});
    keep_best(candidates, most_judged);
    refine(candidates, {more_samples, 8, 0.03});
    judge(candidates);
    for (const Candidate& c : candidates)
      if (reason_against(c).empty() && result.maps.size() < request_.number_of_maps)
        result.maps.push_back({c.map, c.evidence.rms, c.evidence.inliers, c.evidence.log10_false_alarms});
    if (result.maps.empty()) result.reason = reason_for_none(candidates);
    return result;
  }

private:
  static constexpr std::size_t few_samples = 120, more_samples = 400, all_samples = 4000, most_judged = 40;
  static constexpr double accepted_log10 = -6, most_contradictions = 0.02;

  struct Candidate {
    Affine_map_3 map;
    bool is_sound = true;
    Contact_evidence evidence = {};

    /// The area in contact, less that of contradictions.
    double score() const {
      const double contradictions = evidence.contradictions[0] + evidence.contradictions[1];
      return evidence.area * (1 - 5 * contradictions);
    }
  };

  struct Steps {
    std::size_t samples;
    int most;
    double first_limit; ///< beyond which points are not in contact
  };

  static std::vector<Candidate> candidates_of(const std::vector<Scored_map>& maps) {
    std::vector<Candidate> result;
    for (const Scored_map& m : maps) result.push_back({m.map});
    return result;
  }

  /// The size of the target, or that of the moved source if it is smaller.
  double unit(const Affine_map_3& map) const {
    return std::min(1.0, Similarity_3(map).scale * source_.samples().area.size());
  }

  Mapped_samples samples_of(const Affine_map_3& map, std::size_t count, double touching) const {
    return mapped_samples(source_, target_, map, count, {touching * unit(map), 0.1 * unit(map)});
  }

  void refine(std::vector<Candidate>& candidates, const Steps& how) const {
    parallel_for<ConcurrencyTag>(0, candidates.size(), [&](std::size_t i) {
      candidates[i].is_sound = refine(candidates[i].map, how);
      if (candidates[i].is_sound) candidates[i].evidence = evidence(candidates[i].map, how.samples, tolerance_);
    });
    std::erase_if(candidates, [](const Candidate& c) { return !c.is_sound; });
  }

  /// Takes steps of Gauss and Newton with the points in contact, within 6 deviations of the median.
  bool refine(Affine_map_3& map, const Steps& how) const {
    constexpr double rounding = 1e-12;
    const double first_determinant = map.matrix.determinant();
    double limit = how.first_limit;
    for (int step = 0; step < how.most; ++step) {
      const auto samples = samples_of(map, how.samples, limit);
      const auto moved = touching_points(samples[0]), fixed = touching_points(samples[1]);
      if (moved.size() + fixed.size() < 16) return false;
      const double median = median_distance(moved, fixed, 1) / unit(map);
      limit = std::clamp(6 * deviations_per_median * median, tolerance_, std::max(tolerance_, 0.8 * limit));
      Refinement_equations equations(infinitesimal_maps(request_.kind), map(Eigen::Vector3d::Zero()), unit(map));
      equations.add(moved, 1, 1);
      equations.add(fixed, 1, -1);
      const Affine_map_3 change = equations.map_of(equations.solution(rounding));
      map = change * map;
      map.matrix = nearest_of_kind(map.matrix, request_.kind);
      const double ratio = map.matrix.determinant() / first_determinant;
      if (!map.matrix.allFinite() || !map.translation.allFinite() || !(ratio > 0.3 && ratio < 3)) return false;
      if ((change.matrix - Eigen::Matrix3d::Identity()).norm() < 1e-9) break;
    }
    return true;
  }

  /// The points in contact with their signed distances from the planes of the triangles.
  static std::vector<Mapped_point> touching_points(const std::vector<Mapped_sample>& samples) {
    std::vector<Mapped_point> result;
    for (const Mapped_sample& s : samples)
      if (s.contact == Contact::TOUCHING) result.push_back({s.point, {(s.point - s.nearest).dot(s.normal), s.normal}});
    return result;
  }

  Contact_evidence evidence(const Affine_map_3& map, std::size_t count, double tolerance) const {
    const double scale = Similarity_3(map).scale;
    const double areas[] = {source_.samples().area.measure * scale * scale, target_.samples().area.measure};
    const double radii[] = {source_.samples().radius() * scale, target_.samples().radius()};
    std::array<double, 2> chances;
    for (std::size_t k = 0; k < 2; ++k) chances[k] = 2 * areas[k] / (4.2 * std::pow(radii[k], 3));
    const Judgement how{tolerance * unit(map), 0, degrees_of_freedom(request_.kind), double(hypotheses_)};
    return contact_evidence(samples_of(map, count, tolerance), request_.kind, {areas[0], areas[1]}, chances, how);
  }

  static void sort(std::vector<Candidate>& candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score() > b.score(); });
  }

  void keep_best(std::vector<Candidate>& candidates, std::size_t count) const {
    constexpr double least_difference = 0.02;
    sort(candidates);
    candidates = without_near(candidates, count, [&](const Candidate& a, const Candidate& b) {
      return difference(a.map, b.map) < least_difference;
    });
  }

  /// Returns how far a map moves points from where another one moves them, about, beside the size of the target.
  double difference(const Affine_map_3& a, const Affine_map_3& b) const {
    return (a.matrix - b.matrix).norm() * source_.samples().area.size() + (a.translation - b.translation).norm();
  }

  void judge(std::vector<Candidate>& candidates) const {
    parallel_for<ConcurrencyTag>(0, candidates.size(), [&](std::size_t i) {
      candidates[i].evidence = evidence(candidates[i].map, all_samples, tolerance_);
    });
    keep_best(candidates, candidates.size());
  }

  std::string reason_against(const Candidate& c) const {
    const Contact_evidence& e = c.evidence;
    if (std::max(e.inliers[0], e.inliers[1]) < std::max(0.05, request_.least_overlap))
      return "the parts in contact are too small";
    const double contradictions = std::max(e.contradictions[0], e.contradictions[1]);
    if (contradictions > most_contradictions)
      return "the best map contradicts " + std::to_string(std::lround(100 * contradictions)) + " % of the points";
    if (e.rigidity < 20 * tolerance_) return "the points in contact slide over each other";
    if (e.affine_rigidity < 20 * tolerance_) return "the points in contact are like a corner of three planes";
    if (e.log10_false_alarms > accepted_log10) return "chance may have made the best map";
    return {};
  }

  std::string reason_for_none(const std::vector<Candidate>& candidates) const {
    return candidates.empty() ? "no pairs of points are alike" : reason_against(candidates.front());
  }

  const Piece_of_surface_3 &source_, &target_;
  Registration_request request_;
  double tolerance_;
  std::size_t hypotheses_ = 0;
};

/// Returns the tolerance beside the size of the target: that of the request, or what the error of facets allows.
inline double tolerance_of_pieces(double facet_error, const Registration_request& request) {
  return request.tolerance.value_or(std::clamp(4 * facet_error, 1e-3, 1e-2));
}

/// Finds rigid maps or similarities that move a mesh, or a part of it, onto another one, without curvature: pieces of
/// planes and cylinders will do. Accepts those that the area in contact proves, and that no other points contradict. The
/// source may be inside out, as meshes are that somebody mirrored.
template <class ConcurrencyTag>
Shape_matches register_pieces(const Triangles_3& source, const Triangles_3& target,
                              const Registration_request& request) {
  constexpr std::size_t samples = 4000;
  Shape_matches none;
  if (!keeps_angles(request.kind)) {
    none.reason = "pairs of points give rigid maps and similarities only";
    return none;
  }
  const Moments_3 areas[] = {area_moments(source), area_moments(target)};
  if (!(areas[0].measure > 0) || !(areas[1].measure > 0)) {
    none.reason = "a mesh has no area";
    return none;
  }
  const Affine_map_3 to_target = centering_map(areas[1]);
  Affine_map_3 to_source = centering_map(areas[0]);
  if (request.kind == Map_kind::RIGID) to_source = {to_target.matrix, -(to_target.matrix * areas[0].centroid)};
  const Triangles_3 a = transformed(source, to_source), b = transformed(target, to_target);
  const auto edges_a = sorted_edges(a), edges_b = sorted_edges(b);
  const double tolerance = tolerance_of_pieces(std::max(facet_error(a, edges_a), facet_error(b, edges_b)), request);
  const Piece_of_surface_3 p(a, edges_a, samples, 2 * tolerance), q(b, edges_b, samples, 2 * tolerance);
  if (!p.is_oriented() || !q.is_oriented()) {
    none.reason = "the triangles of a mesh are not on one side";
    return none;
  }
  Shape_matches result = Registration_of_pieces<ConcurrencyTag>(p, q, request, tolerance).run();
  if (result.maps.empty()) {
    const Triangles_3 turned = turned_inside_out(a);
    const Piece_of_surface_3 inside_out(turned, sorted_edges(turned), samples, 2 * tolerance);
    Shape_matches other = Registration_of_pieces<ConcurrencyTag>(inside_out, q, request, tolerance).run();
    other.hypotheses += result.hypotheses;
    if (other.maps.empty()) other.reason = std::move(result.reason);
    result = std::move(other);
  }
  for (Shape_match& m : result.maps) {
    m.map = to_target.inverse() * m.map * to_source;
    m.rms *= areas[1].size();
  }
  return result;
}

} // namespace equiaffine::internal

#endif
