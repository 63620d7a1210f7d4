// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_REGISTER_PIECES_H
#define EQUIAFFINE_SRC_REGISTRATION_REGISTER_PIECES_H

#include "registration/Contact_evidence.h"
#include "registration/Piece_of_surface_3.h"
#include "registration/Shape_matches.h"
#include "registration/Two_point_frames.h"
#include "registration/contacts.h"
#include "registration/refine_map.h"
#include "registration/tolerances_of_meshes.h"
#include "registration/without_near.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/internal/Registration_request.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The search for maps between two pieces whose areas have centroid 0, in coordinates where the target has size 1.
class Registration_of_pieces {
public:
  /// Points nearer than `tolerance` are in contact.
  Registration_of_pieces(bool in_threads, const Piece_of_surface_3& source, const Piece_of_surface_3& target,
                         const Registration_request& request, double tolerance)
      : in_threads_(in_threads), source_(source), target_(target), request_(request), tolerance_(tolerance),
        tolerance_of_search_(std::max(tolerance, usual_contact)) {}

  Shape_matches run() {
    Two_point_frames frames(in_threads_, source_, target_, request_);
    std::vector<Candidate> candidates = candidates_of(frames.run());
    Shape_matches result;
    result.hypotheses = hypotheses_ = frames.hypotheses();
    refine(candidates, {few_samples, 8, 0.15, 0.8, tolerance_of_search_});
    keep_best(candidates, most_judged);
    refine(candidates, {more_samples, 8, 0.03, 0.8, tolerance_of_search_});
    refine(candidates, {more_samples, 12, 3 * tolerance_of_search_, 0.5, tolerance_});
    judge(candidates);
    for (const auto& [map, is_sound, evidence] : candidates)
      if (reason_against(evidence).empty())
        result.maps.push_back(
            {map, evidence.rms, evidence.inliers, evidence.log10_false_alarms, evidence.contradictions});
    if (result.maps.empty()) result.reason = reason_for_none(candidates);
    return result;
  }

private:
  static constexpr std::size_t few_samples = 120, more_samples = 400, most_judged = 64;
  static constexpr double accepted_log10 = -6, most_contradictions = 0.02, least_part = 0.05;
  static constexpr double least_rigidity = 20; ///< beside the tolerance

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

  /// Points nearer than a limit are in contact.
  struct Steps {
    std::size_t samples;
    int most;
    double first_limit, contraction, last_limit; ///< the limit falls by a factor at most
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
    return mapped_samples(source_, target_, map, count, {touching * unit(map), greatest_displacement * unit(map)});
  }

  void refine(std::vector<Candidate>& candidates, const Steps& how) const {
    parallel_for(in_threads_, 0, candidates.size(), [&](std::size_t i) {
      candidates[i].is_sound = refine(candidates[i].map, how);
      if (candidates[i].is_sound) candidates[i].evidence = evidence(candidates[i].map, how.samples, how.last_limit);
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
      limit = std::clamp(6 * deviations_per_median * median, how.last_limit,
                         std::max(how.last_limit, how.contraction * limit));
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
    const std::array chances = {chance_of_nearness(areas[0], radii[0]), chance_of_nearness(areas[1], radii[1])};
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
    parallel_for(in_threads_, 0, candidates.size(), [&](std::size_t i) {
      candidates[i].evidence = evidence(candidates[i].map, samples_of_piece, tolerance_);
    });
    keep_best(candidates, candidates.size());
    sort_best_by_rms(candidates);
  }

  /// Maps with about as much in contact as the best one are as good as near they move the surfaces to each other.
  static void sort_best_by_rms(std::vector<Candidate>& candidates) {
    constexpr double as_good = 0.98;
    const auto end = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const Candidate& c) { return c.score() < as_good * candidates.front().score(); });
    std::stable_sort(candidates.begin(), end,
                     [](const Candidate& a, const Candidate& b) { return a.evidence.rms < b.evidence.rms; });
  }

  std::string reason_against(const Contact_evidence& e) const {
    if (std::max(e.inliers[0], e.inliers[1]) < std::max(least_part, request_.least_overlap))
      return "the parts in contact are too small";
    const double contradictions = std::max(e.contradictions[0], e.contradictions[1]);
    if (contradictions > most_contradictions)
      return "by the best map " + std::to_string(std::lround(100 * contradictions)) +
             " % of the points of a mesh lie off the other one, which does not end there";
    if (e.rigidity < least_rigidity * tolerance_) return "the parts in contact slide over each other";
    if (e.affine_rigidity < least_rigidity * tolerance_)
      return "the parts in contact are like a corner of three planes, which many shapes have";
    if (e.log10_false_alarms > accepted_log10) return "the parts in contact may be so by chance";
    return {};
  }

  std::string reason_for_none(const std::vector<Candidate>& candidates) const {
    return candidates.empty() ? "no pairs of points of the two are alike" : reason_against(candidates.front().evidence);
  }

  bool in_threads_;
  const Piece_of_surface_3 &source_, &target_;
  Registration_request request_;
  double tolerance_, tolerance_of_search_;
  std::size_t hypotheses_ = 0;
};

/// Why no map moves a part of one mesh onto the other, as far as areas and sizes tell.
inline std::string reason_against_pieces(const Moments_3& source, const Moments_3& target, Map_kind kind) {
  constexpr double greatest_ratio = 50; // whose samples still meet the smaller mesh
  if (!keeps_angles(kind)) return "pieces are matched by rigid maps and similarities only";
  if (!(source.measure > 0) || !(target.measure > 0)) return "a mesh has no area";
  const double ratio = source.size() / target.size();
  if (kind == Map_kind::RIGID && !(std::max(ratio, 1 / ratio) < greatest_ratio))
    return "one mesh is more than 50 times as large as the other, and rigid maps keep sizes";
  return {};
}

/// Finds rigid maps or similarities that move a mesh, or a part of it, onto another one, without curvature: pieces of
/// planes and cylinders will do. Accepts those that the area in contact proves, and that no other points contradict. The
/// source may be inside out, as meshes are that somebody mirrored. Facets of solids stand for nothing smooth.
inline Shape_matches register_pieces(bool in_threads, const Triangles_3& source, const Triangles_3& target,
                                     const Registration_request& request, bool are_solids = false) {
  const Moments_3 areas[] = {area_moments(source), area_moments(target)};
  Shape_matches result;
  result.reason = reason_against_pieces(areas[0], areas[1], request.kind);
  if (!result.reason.empty()) return result;
  const Affine_map_3 to_target = centering_map(areas[1]);
  Affine_map_3 to_source = centering_map(areas[0]);
  if (request.kind == Map_kind::RIGID) to_source = {to_target.matrix, -(to_target.matrix * areas[0].centroid)};
  const Triangles_3 a = transformed(source, to_source), b = transformed(target, to_target);
  const auto edges_a = sorted_edges(a), edges_b = sorted_edges(b);
  const double error_of_facets = are_solids ? 0 : std::max(facet_error(a, edges_a).rms, facet_error(b, edges_b).rms);
  const double tolerance = tolerance_of_contact(error_of_facets, request);
  const auto piece = [=](const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges) {
    return Piece_of_surface_3(mesh, edges, samples_of_piece, 2 * tolerance);
  };
  const Piece_of_surface_3 p = piece(a, edges_a), q = piece(b, edges_b);
  if (!p.is_oriented() || !q.is_oriented()) {
    result.reason = "the triangles of a mesh are not on one side";
    return result;
  }
  const auto search = [&](const Piece_of_surface_3& from) {
    return Registration_of_pieces(in_threads, from, q, request, tolerance).run();
  };
  const bool is_side_known = p.is_closed() && q.is_closed(), is_turned = is_side_known && p.volume() * q.volume() < 0;
  if (!is_turned) result = search(p);
  if (result.maps.empty() && (is_turned || !is_side_known)) {
    const Triangles_3 turned = turned_inside_out(a);
    Shape_matches other = search(piece(turned, sorted_edges(turned)));
    other.hypotheses += result.hypotheses;
    if (other.maps.empty() && !result.reason.empty()) other.reason = std::move(result.reason);
    result = std::move(other);
  }
  for (Shape_match& m : result.maps) {
    m.map = to_target.inverse() * m.map * to_source;
    m.rms *= areas[1].size();
  }
  result.size = areas[1].size();
  return result;
}

} // namespace equiaffine::internal

#endif
