// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_SYMMETRY_SEARCH_H
#define EQUIAFFINE_SRC_REGISTRATION_SYMMETRY_SEARCH_H

#include "registration/Framed_surface_3.h"
#include "registration/Symmetry_check.h"
#include "registration/Whitening.h"
#include "registration/candidate_pairs.h"
#include "registration/counterpart.h"
#include "registration/map_distances.h"
#include "registration/order_of_points.h"
#include "registration/part_on_surface.h"
#include "registration/refine_map.h"
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/registration/internal/Frame_thresholds.h>
#include <equiaffine/registration/internal/Registration_request.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// The search for the finite group of maps that move a surface onto itself. A few generic points are matched with all
/// points of the surface that may be their images; products of the symmetries that are found complete the group.
class Symmetry_search {
public:
  /// A symmetry moves no point from the surface by more than `tolerance` times the size of the surface.
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

  /// The number of points with good frames that run() matched with all their possible images.
  std::size_t good_points_matched() const { return good_points_matched_; }

  /// The number of those in the inner half of the surface, whose images are seldom out of the box.
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
  static constexpr double least_difference = 0.01; ///< between maps, a part of their norm and of the size

  /// Returns points with different invariants, since images of each other have the same images: some of the inner half
  /// of the surface, then some of all. A symmetry keeps the distance from the center in coordinates where the points
  /// have covariance 1, so that it seldom moves a point of the inner half out of the box. Points are chosen that are
  /// found from the points around them, as their images will have to be.
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

  /// Whether the search for a counterpart leads to the point from most of its neighbors.
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

  /// Adds the symmetries that move the point to another one with its invariants.
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

  /// Returns pairs whose points on the target are some spacings apart, those of the least cost first: the points around
  /// one image would crowd out other images.
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

} // namespace equiaffine::internal

#endif
