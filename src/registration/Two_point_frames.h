// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_TWO_POINT_FRAMES_H
#define EQUIAFFINE_SRC_REGISTRATION_TWO_POINT_FRAMES_H

#include "registration/Area_samples_3.h"
#include "registration/contacts.h"
#include "registration/without_near.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/internal/Registration_request.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace equiaffine::internal {

/// Two points of a surface with their normals, which make a frame if these are not parallel.
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

  /// An orthonormal basis that depends on the normals alone, which planes have without an error.
  Eigen::Matrix3d frame() const {
    Eigen::Matrix3d result;
    result << (normals[0] + normals[1]).normalized(), (normals[0] - normals[1]).normalized(),
        normals[0].cross(normals[1]).normalized();
    return result;
  }
};

/// A map that a pair of points of each surface gives, and how well the surfaces fit then.
struct Scored_map {
  Affine_map_3 map;
  double score;
};

/// The search for maps by pairs of points with the same distance and angles.
class Two_point_frames {
public:
  Two_point_frames(bool in_threads, const Piece_of_surface_3& source, const Piece_of_surface_3& target,
                   const Registration_request& request)
      : in_threads_(in_threads), source_(source), target_(target),
        request_(request), nearest_{Nearest_of_cells::of(in_threads, source),
                                    Nearest_of_cells::of(in_threads, target)} {}

  /// Returns maps that are different, the best first.
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

  bool keeps_size() const { return request_.kind == Map_kind::RIGID; }

  /// Pairs that are far apart and whose normals and way are far from a plane.
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

  /// The maps that move a pair of points of the source to similar ones of the target, the best first.
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

  /// The pairs of the target whose distance and angles differ by what the spacing of the samples allows.
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
        if (request_.allows_reflections || !is_mirrored) result.push_back({i, j});
      }
    return result;
  }

  Affine_map_3 map_between(const Pair_of_samples& from, const Pair_of_samples& to) const {
    const double scale = keeps_size() ? 1 : to.distance / from.distance;
    const Eigen::Vector3d signs(1, 1, from.turn() * to.turn() < 0 ? -1 : 1);
    const Eigen::Matrix3d matrix = scale * to.frame() * signs.asDiagonal() * from.frame().transpose();
    return {matrix, to.middle - matrix * from.middle};
  }

  /// The area in contact, less that of contradictions, beside the smaller one of the two surfaces.
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

  /// Returns the best maps, without those near to a better one.
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
  Registration_request request_;
  std::array<Nearest_of_cells, 2> nearest_;
  std::size_t hypotheses_ = 0;
};

} // namespace equiaffine::internal

#endif
