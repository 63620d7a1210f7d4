// SPDX-License-Identifier: GPL-3.0-or-later
// Decides whether a map moves a part of one surface onto the other, a contrario: by the number of equally good maps
// expected by chance (Desolneux, Moisan, Morel: From Gestalt theory to image analysis, 2008).
#ifndef EQUIAFFINE_SRC_REGISTRATION_MAP_EVIDENCE_H
#define EQUIAFFINE_SRC_REGISTRATION_MAP_EVIDENCE_H

#include "registration/refine_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace equiaffine::internal {

/// The fraction of the points in the domain of the other surface that lie on it to within a distance; 0 if most
/// points are outside of the domain.
inline double part_on_surface(const std::vector<Mapped_point>& points, double distance) {
  std::size_t inside = 0, on_surface = 0;
  for (const Mapped_point& p : points) {
    inside += !std::isnan(p.to_other.distance);
    on_surface += std::abs(p.to_other.distance) < distance;
  }
  return 2 * inside > points.size() ? double(on_surface) / double(inside) : 0;
}

/// The minimum fraction of a surface that must lie on an equal one. The rest may be points that are not on the zero
/// set, or where the function is not smooth.
constexpr double part_of_same_surface = 0.98;

/// The evidence of the distances between two surfaces for a map.
struct Map_evidence {
  double log10_false_alarms = 0;
  double log10_by_volume = 0;      ///< by the volume model alone: the lower, the better the map
  double tolerance = 1;            ///< in the unit of distances: the one that makes the map least probable
  std::array<double, 2> inliers{}; ///< fractions of the probes of the source, and of the target, within the tolerance
  double rms = std::numeric_limits<double>::infinity(); ///< of their distances, a length
};

/// Chernoff bound on log10 of the probability of `hits` or more successes in `trials` with probability p.
inline double log10_tail(double hits, double trials, double p) {
  if (!(trials > 0) || !(hits > p * trials)) return 0;
  const double x = std::min(hits / trials, 1.0);
  const double miss = x < 1 ? (1 - x) * std::log((1 - x) / (1 - p)) : 0;
  return -trials * (x * std::log(x / p) + miss) * std::numbers::log10e;
}

/// The smallest number of probes to judge a map, in addition to its parameters.
constexpr std::size_t fewest_probes = 5;

/// The distances of probes in the domain, in increasing order.
struct Sorted_distances {
  std::vector<double> distances;
  std::size_t probes; ///< including those outside of the domain

  Sorted_distances(const std::vector<Mapped_point>& points, double unit) : probes(points.size()) {
    for (const Mapped_point& p : points)
      if (!std::isnan(p.to_other.distance)) distances.push_back(std::abs(p.to_other.distance) / unit);
    std::sort(distances.begin(), distances.end());
  }

  double within(double tolerance) const {
    return double(std::upper_bound(distances.begin(), distances.end(), tolerance) - distances.begin());
  }
};

/// The tolerances to try: two per factor of 10, down to rounding.
constexpr int most_tolerances = 25;
inline double tolerance_of_number(double greatest, int i) { return greatest * std::pow(10, -0.5 * i); }

/// How to judge a map.
struct Judgement {
  double greatest_tolerance; ///< in the unit of distances: closer points may lie on the other surface
  double min_overlap;        ///< minimum fraction of the probes of one surface that must lie on the other
  int parameters = 0;        ///< of the map, which can move as many points to the other surface by itself
  double tests = 1;          ///< number of maps that were tried
  std::size_t probes = most_probes;
  bool are_exact = false; ///< whether points are on both surfaces up to rounding, as for formulas
};

/// Two models of how chance can move points close to a surface: they lie anywhere in the volume, or on a surface
/// that touches the other one. If two surfaces have contact of order n, the distance grows with the power n + 1, and
/// the fraction of the points within a tenth of a distance is at most 10^(-2/(n + 1)). The order is 4 for surfaces
/// in general, and higher for flat caps, as of x^6 + y^6 + z^6 = 1; for formulas only rounding rules out such a
/// contact.
inline void judge_one_way(const Sorted_distances& sorted, double chance, const Judgement& how, Map_evidence& evidence) {
  constexpr double rounding = 1e-9;
  double contact = 0, volume = 0, tolerance = 1;
  const double all = double(sorted.distances.size()) - how.parameters;
  if (all < double(fewest_probes)) return;
  for (int i = 0; i < most_tolerances; ++i) {
    const double t = tolerance_of_number(how.greatest_tolerance, i), hits = sorted.within(t) - how.parameters;
    if (hits < double(fewest_probes) || hits + how.parameters < how.min_overlap * double(sorted.probes)) continue;
    const double part_nearer = std::pow(10, how.are_exact && t > rounding ? -0.1 : -0.4);
    contact = std::min(contact, log10_tail(hits, sorted.within(10 * t) - how.parameters, part_nearer));
    const double by_volume = log10_tail(hits, all, std::min(0.5, chance * t));
    if (by_volume < volume) {
      volume = by_volume;
      tolerance = t;
    }
  }
  evidence.log10_false_alarms = std::min(evidence.log10_false_alarms, std::max(contact, volume));
  if (volume < evidence.log10_by_volume) {
    evidence.log10_by_volume = volume;
    evidence.tolerance = tolerance;
  }
}

/// Judges a map by the distances of moved points, and of points near the moved surface, in a unit. One of them is
/// enough, because either surface may be a part of the other, or be surrounded by clutter. `chances` are the
/// probabilities that a point is close to the target, and to the source, see chance_of_nearness.
inline Map_evidence evidence_of_distances(const std::vector<Mapped_point>& moved,
                                          const std::vector<Mapped_point>& fixed, double unit,
                                          const std::array<double, 2>& chances, const Judgement& how) {
  const std::array sorted = {Sorted_distances(moved, unit), Sorted_distances(fixed, unit)};
  Map_evidence evidence;
  for (std::size_t way = 0; way < 2; ++way) judge_one_way(sorted[way], chances[way], how, evidence);
  const double more = std::log10(2 * most_tolerances * how.tests);
  evidence.log10_false_alarms = std::min(0.0, evidence.log10_false_alarms + more);
  evidence.log10_by_volume = std::min(0.0, evidence.log10_by_volume + more);
  constexpr double rounding = 2e-6; // of coordinates with six digits: closer points lie on the other surface
  double sum = 0, count = 0;
  for (std::size_t way = 0; way < 2; ++way) {
    const double hits = sorted[way].within(std::max(evidence.tolerance, rounding));
    evidence.inliers[way] = sorted[way].probes > 0 ? hits / double(sorted[way].probes) : 0;
    for (std::size_t i = 0; i < std::size_t(hits); ++i) sum += sorted[way].distances[i] * sorted[way].distances[i];
    count += hits;
  }
  if (count > 0) evidence.rms = unit * std::sqrt(sum / count);
  return evidence;
}

inline Map_evidence evidence_of_map(bool in_threads, const Framed_surface_3& source, const Framed_surface_3& target,
                                    const Affine_map_3& map, const Judgement& how) {
  return evidence_of_distances(moved_source(in_threads, source, target, map, how.probes),
                               target_beside_moved_source(in_threads, source, target, map, how.probes),
                               unit_of_distances(source, target, map), {target.chance, source.chance}, how);
}

} // namespace equiaffine::internal

#endif
