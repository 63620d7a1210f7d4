// SPDX-License-Identifier: GPL-3.0-or-later
// Registers parts of meshes by their contact area, without curvature.
#ifndef EQUIAFFINE_SRC_REGISTRATION_REGISTER_PIECES_H
#define EQUIAFFINE_SRC_REGISTRATION_REGISTER_PIECES_H

#include "registration/Affine_map_3.h"
#include "registration/Piece_of_surface_3.h"
#include "registration/mesh_samples.h"
#include "registration/refine_map.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/register_surfaces.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Two points of a surface with their normals, which define a frame unless the normals are parallel.
struct Pair_of_samples {
  Eigen::Vector3d middle, way; ///< from the first point to the second one
  std::array<Eigen::Vector3d, 2> normals;
  double distance;

  Pair_of_samples(const Area_samples_3& samples, std::size_t i, std::size_t j)
      : middle((samples.points[i] + samples.points[j]) / 2),
        way(samples.points[j] - samples.points[i]), normals{samples.normals[i], samples.normals[j]},
        distance(way.norm()) {}

  double cosine() const { return normals[0].dot(normals[1]); }
  double slope(std::size_t k) const { return normals[k].dot(way) / distance; }
  /// Positive if the normals turn to the right along the way.
  double turn() const { return normals[0].cross(normals[1]).dot(way) / distance; }

  /// An orthonormal basis that depends only on the normals, which are exact on planes.
  Eigen::Matrix3d frame() const {
    Eigen::Matrix3d result;
    result << (normals[0] + normals[1]).normalized(), (normals[0] - normals[1]).normalized(),
        normals[0].cross(normals[1]).normalized();
    return result;
  }
};

/// A map determined by a pair of points of each surface, and how well it matches the surfaces.
struct Scored_map {
  Affine_map_3 map;
  double score;
};

/// Searches for maps by matching pairs of points with equal distance and angles.
class Two_point_frames {
public:
  Two_point_frames(bool in_threads, const Piece_of_surface_3& source, const Piece_of_surface_3& target,
                   const Registration_options& options)
      : in_threads_(in_threads), source_(source), target_(target),
        options_(options), nearest_{Nearest_of_cells::of(in_threads, source),
                                    Nearest_of_cells::of(in_threads, target)} {}

  /// Returns distinct maps, the best first.
  std::vector<Scored_map> run() {
    const auto bases = chosen_bases();
    std::vector<std::vector<Scored_map>> found(bases.size());
    std::vector<std::size_t> tried(bases.size());
    parallel_for(in_threads_, 0, bases.size(), [&](std::size_t b) { found[b] = maps_of(bases[b], tried[b]); });
    std::vector<Scored_map> all;
    for (std::size_t b = 0; b < bases.size(); ++b) {
      hypotheses_ += tried[b];
      all.insert(all.end(), found[b].begin(), found[b].end());
    }
    return different(std::move(all));
  }

  std::size_t hypotheses() const { return hypotheses_; }

private:
  static constexpr std::size_t points = 1200, number_of_bases = 240, most_per_base = 1500, best_per_base = 40,
                               probes = 80;
  static constexpr std::size_t most_maps = 160;

  bool keeps_size() const { return options_.kind == Map_kind::RIGID; }

  /// Pairs of distant points whose normals and connecting line are far from coplanar.
  std::vector<Pair_of_samples> chosen_bases() const {
    const auto& samples = source_.samples();
    const std::size_t n = std::min(points, samples.points.size());
    const double size = samples.area.size();
    std::minstd_rand random(1);
    std::vector<Pair_of_samples> result;
    for (std::size_t i = 0; i < 100 * number_of_bases && result.size() < number_of_bases; ++i) {
      const std::size_t a = random() % n, b = random() % n;
      if (a == b) continue;
      const Pair_of_samples pair(samples, a, b);
      const bool is_far = pair.distance > 0.5 * size && pair.distance < 2.5 * size;
      if (is_far && std::abs(pair.cosine()) < 0.9 && std::abs(pair.turn()) > 0.2) result.push_back(pair);
    }
    return result;
  }

  /// The maps that move a pair of points of the source to similar pairs of the target, the best first.
  std::vector<Scored_map> maps_of(const Pair_of_samples& base, std::size_t& tried) const {
    const auto pairs = similar_pairs(base);
    tried = std::min(pairs.size(), most_per_base);
    std::vector<Scored_map> result;
    for (std::size_t k = 0; k < tried; ++k) {
      const auto& [i, j] = pairs[k * pairs.size() / tried];
      const Affine_map_3 map = map_between(base, Pair_of_samples(target_.samples(), i, j));
      result.push_back({map, score(map)});
    }
    sort(result);
    if (result.size() > best_per_base) result.erase(result.begin() + best_per_base, result.end());
    return result;
  }

  static void sort(std::vector<Scored_map>& maps) {
    std::stable_sort(maps.begin(), maps.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  }

  /// The pairs of the target whose distance and angles agree to within the spacing of the samples.
  std::vector<std::array<std::size_t, 2>> similar_pairs(const Pair_of_samples& base) const {
    constexpr double bend = 0.05;
    const auto& samples = target_.samples();
    const std::size_t n = std::min(points, samples.points.size());
    const double spacing = 0.7 * std::sqrt(samples.area.measure / double(n));
    const double shortest = keeps_size() ? base.distance - spacing : 0.3 * samples.area.size();
    const double longest = keeps_size() ? base.distance + spacing : 2.5 * samples.area.size();
    const double cosine = base.cosine(), first = base.slope(0), second = base.slope(1), turn = base.turn();
    std::vector<std::array<std::size_t, 2>> result;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const Eigen::Vector3d &m = samples.normals[i], &k = samples.normals[j];
        if (std::abs(m.dot(k) - cosine) > 2 * bend) continue;
        const Eigen::Vector3d way = samples.points[j] - samples.points[i];
        const double squared = way.squaredNorm();
        if (squared < shortest * shortest || squared > longest * longest) continue;
        const double distance = std::sqrt(squared), slack = bend + spacing / distance;
        if (std::abs(m.dot(way) / distance - first) > slack || std::abs(k.dot(way) / distance - second) > slack)
          continue;
        const bool is_mirrored = m.cross(k).dot(way) * turn < 0;
        if (options_.reflections || !is_mirrored) result.push_back({i, j});
      }
    return result;
  }

  Affine_map_3 map_between(const Pair_of_samples& from, const Pair_of_samples& to) const {
    const double scale = keeps_size() ? 1 : to.distance / from.distance;
    const Eigen::Vector3d signs(1, 1, from.turn() * to.turn() < 0 ? -1 : 1);
    const Eigen::Matrix3d matrix = scale * to.frame() * signs.asDiagonal() * from.frame().transpose();
    return {matrix, to.middle - matrix * from.middle};
  }

  /// The contact area minus that of contradictions, relative to the area of the smaller surface.
  double score(const Affine_map_3& map) const {
    const Similarity_3 s(map);
    const double areas[] = {source_.samples().area.measure * s.scale * s.scale, target_.samples().area.measure};
    const double moved = score_of(source_, target_, nearest_[1], s.map, s.scale, 1);
    const double fixed = score_of(target_, source_, nearest_[0], s.inverse, 1 / s.scale, 1 / s.scale);
    return (areas[0] * moved + areas[1] * fixed) / std::min(areas[0], areas[1]);
  }

  /// The mean over the probes of a surface that a map moves to another one.
  static double score_of(const Piece_of_surface_3& from, const Piece_of_surface_3& to, const Nearest_of_cells& nearest,
                         const Affine_map_3& map, double scale, double unit) {
    const auto& samples = from.samples();
    const std::size_t n = std::min(probes, samples.points.size());
    const Contact_distances distances = {0.1 * unit, 0.3 * unit};
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector3d p = map(samples.points[i]);
      const Point_of_piece q = nearest(p);
      const Eigen::Vector3d normal = map.matrix * samples.normals[i] / scale;
      const double off = std::abs((p - q.point).dot(q.normal));
      const bool is_near = off < distances.touching && (p - q.point).norm() < 2 * distances.touching;
      if (is_near && normal.dot(q.normal) > 0.7) sum += 1 - off / distances.touching;
      else if (!is_near && contact_of(p, normal, q, to.is_closed(), distances) == Contact::CONTRADICTING) sum -= 1;
    }
    return sum / double(n);
  }

  /// Returns the best maps, without those close to a better one.
  std::vector<Scored_map> different(std::vector<Scored_map> maps) const {
    constexpr double least_difference = 0.15;
    sort(maps);
    const double size = source_.samples().area.size();
    return without_near(maps, most_maps, [&](const Scored_map& a, const Scored_map& b) {
      const double turn = (a.map.matrix - b.map.matrix).norm(), shift = (a.map.translation - b.map.translation).norm();
      return size * turn + shift < least_difference;
    });
  }

  bool in_threads_;
  const Piece_of_surface_3 &source_, &target_;
  Registration_options options_;
  std::array<Nearest_of_cells, 2> nearest_;
  std::size_t hypotheses_ = 0;
};

/// Searches for maps between two pieces with area centroids at 0, in units of the size of the target.
class Registration_of_pieces {
public:
  /// Points closer than `tolerance` are in contact.
  Registration_of_pieces(bool in_threads, const Piece_of_surface_3& source, const Piece_of_surface_3& target,
                         const Registration_options& options, double tolerance)
      : in_threads_(in_threads), source_(source), target_(target), options_(options), tolerance_(tolerance),
        tolerance_of_search_(std::max(tolerance, usual_contact)) {}

  Shape_matches run() {
    Two_point_frames frames(in_threads_, source_, target_, options_);
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
  static constexpr double most_contradictions = 0.02, least_part = 0.05;
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

  /// Points closer than a limit are in contact.
  struct Steps {
    std::size_t samples;
    int most;
    double first_limit, contraction, last_limit; ///< the limit decreases by at most this factor per step
  };

  static std::vector<Candidate> candidates_of(const std::vector<Scored_map>& maps) {
    std::vector<Candidate> result;
    for (const Scored_map& m : maps) result.push_back({m.map});
    return result;
  }

  /// The smaller of the sizes of the target and the moved source.
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

  /// Takes Gauss-Newton steps with the points in contact, within 6 standard deviations.
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
      Refinement_equations equations(infinitesimal_maps(options_.kind), map(Eigen::Vector3d::Zero()), unit(map));
      equations.add(moved, 1, 1);
      equations.add(fixed, 1, -1);
      const Affine_map_3 change = equations.map_of(equations.solution(rounding));
      map = change * map;
      map.matrix = nearest_of_kind(map.matrix, options_.kind);
      const double ratio = map.matrix.determinant() / first_determinant;
      if (!map.matrix.allFinite() || !map.translation.allFinite() || !(ratio > 0.3 && ratio < 3)) return false;
      if ((change.matrix - Eigen::Matrix3d::Identity()).norm() < 1e-9) break;
    }
    return true;
  }

  /// The points in contact, with their signed distances from the planes of the triangles.
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
    const Judgement how{tolerance * unit(map), 0, degrees_of_freedom(options_.kind), double(hypotheses_)};
    return contact_evidence(samples_of(map, count, tolerance), options_.kind, {areas[0], areas[1]}, chances, how);
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

  /// Returns about how far apart two maps move the same points, relative to the size of the target.
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

  /// Maps with about the same contact area as the best one are ranked by their distances.
  static void sort_best_by_rms(std::vector<Candidate>& candidates) {
    constexpr double as_good = 0.98;
    const auto end = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const Candidate& c) { return c.score() < as_good * candidates.front().score(); });
    std::stable_sort(candidates.begin(), end,
                     [](const Candidate& a, const Candidate& b) { return a.evidence.rms < b.evidence.rms; });
  }

  std::string reason_against(const Contact_evidence& e) const {
    if (std::max(e.inliers[0], e.inliers[1]) < std::max(least_part, options_.min_overlap))
      return "the parts in contact are too small";
    const double contradictions = std::max(e.contradictions[0], e.contradictions[1]);
    if (contradictions > most_contradictions)
      return "by the best map " + std::to_string(std::lround(100 * contradictions)) +
             " % of the points of a mesh lie off the other one, which does not end there";
    if (e.rigidity < least_rigidity * tolerance_) return "the parts in contact slide over each other";
    if (e.affine_rigidity < least_rigidity * tolerance_)
      return "the parts in contact look like a corner of three planes, which is not distinctive";
    if (e.log10_false_alarms > accepted_log10) return "the contact could be a coincidence";
    return {};
  }

  std::string reason_for_none(const std::vector<Candidate>& candidates) const {
    return candidates.empty() ? "no pairs of points of the two meshes are similar" : reason_against(candidates.front().evidence);
  }

  bool in_threads_;
  const Piece_of_surface_3 &source_, &target_;
  Registration_options options_;
  double tolerance_, tolerance_of_search_;
  std::size_t hypotheses_ = 0;
};

/// Why no map can move a part of one mesh onto the other, judging by areas and sizes.
inline std::string reason_against_pieces(const Moments_3& source, const Moments_3& target, Map_kind kind) {
  constexpr double greatest_ratio = 50; // for which samples still hit the smaller mesh
  if (!keeps_angles(kind)) return "pieces can be matched only by rigid maps and similarities";
  if (!(source.measure > 0) || !(target.measure > 0)) return "a mesh has no area";
  const double ratio = source.size() / target.size();
  if (kind == Map_kind::RIGID && !(std::max(ratio, 1 / ratio) < greatest_ratio))
    return "one mesh is more than 50 times as large as the other, and rigid maps preserve sizes";
  return {};
}

/// Finds rigid maps or similarities that move a mesh, or a part of it, onto another one. Curvature is not needed: pieces
/// of planes and cylinders are enough. Accepts maps with significant contact area that no other points contradict. The
/// source may be inside out, like a mirrored mesh. Facets are taken as exact, not as samples of a smooth surface.
inline Shape_matches register_pieces(bool in_threads, const Triangles_3& source, const Triangles_3& target,
                                     const Registration_options& options, bool are_solids = false) {
  const Moments_3 areas[] = {area_moments(source), area_moments(target)};
  Shape_matches result;
  result.reason = reason_against_pieces(areas[0], areas[1], options.kind);
  if (!result.reason.empty()) return result;
  const Affine_map_3 to_target = centering_map(areas[1]);
  Affine_map_3 to_source = centering_map(areas[0]);
  if (options.kind == Map_kind::RIGID) to_source = {to_target.matrix, -(to_target.matrix * areas[0].centroid)};
  const Triangles_3 a = transformed(source, to_source), b = transformed(target, to_target);
  const auto edges_a = sorted_edges(a), edges_b = sorted_edges(b);
  const double error_of_facets = are_solids ? 0 : std::max(facet_error(a, edges_a).rms, facet_error(b, edges_b).rms);
  const double tolerance = tolerance_of_contact(error_of_facets, options);
  const auto piece = [=](const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges) {
    return Piece_of_surface_3(mesh, edges, samples_of_piece, 2 * tolerance);
  };
  const Piece_of_surface_3 p = piece(a, edges_a), q = piece(b, edges_b);
  if (!p.is_oriented() || !q.is_oriented()) {
    result.reason = "the triangles of a mesh are not consistently oriented";
    return result;
  }
  const auto search = [&](const Piece_of_surface_3& from) {
    return Registration_of_pieces(in_threads, from, q, options, tolerance).run();
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
