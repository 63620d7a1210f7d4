// SPDX-License-Identifier: GPL-3.0-or-later
// Decides whether a map moves a part of one surface onto the other, a contrario: how many maps that are as good would
// be expected by chance (Desolneux, Moisan, Morel: From Gestalt theory to image analysis, 2008)?
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

/// The part of the points in the domain of the other surface that lie on it to within a distance; 0 if most points are
/// outside of the domain.
inline double part_on_surface(const std::vector<Mapped_point>& points, double distance) {
  std::size_t inside = 0, on_surface = 0;
  for (const Mapped_point& p : points) {
    inside += !std::isnan(p.to_other.distance);
    on_surface += std::abs(p.to_other.distance) < distance;
  }
  return 2 * inside > points.size() ? double(on_surface) / double(inside) : 0;
}

/// So much of a surface, at least, has to lie on another one that is the same. The rest may be points that are not on
/// the zero set, or where the function is not smooth.
constexpr double part_of_same_surface = 0.98;

/// What the distances between two surfaces say of a map.
struct Map_evidence {
  double log10_false_alarms = 0;
  double log10_by_volume = 0;      ///< of the first of the two chances alone: the less, the better the map
  double tolerance = 1;            ///< in the unit of distances: the one that makes the map least probable
  std::array<double, 2> inliers{}; ///< parts of the probes of the source, and of the target, within the tolerance
  double rms = std::numeric_limits<double>::infinity(); ///< of their distances, a length
};

/// Chernoff's bound of the logarithm, to base 10, of the probability of `hits` or more in `trials` with probability p.
inline double log10_tail(double hits, double trials, double p) {
  if (!(trials > 0) || !(hits > p * trials)) return 0;
  const double x = std::min(hits / trials, 1.0);
  const double miss = x < 1 ? (1 - x) * std::log((1 - x) / (1 - p)) : 0;
  return -trials * (x * std::log(x / p) + miss) * std::numbers::log10e;
}

/// The least number of probes that a map can be judged by, beside its own parameters.
constexpr std::size_t fewest_probes = 5;

/// The distances of probes in the domain, in increasing order.
struct Sorted_distances {
  std::vector<double> distances;
  std::size_t probes; ///< with those outside of the domain

  Sorted_distances(const std::vector<Mapped_point>& points, double unit) : probes(points.size()) {
    for (const Mapped_point& p : points)
      if (!std::isnan(p.to_other.distance)) distances.push_back(std::abs(p.to_other.distance) / unit);
    std::sort(distances.begin(), distances.end());
  }

  double within(double tolerance) const {
    return double(std::upper_bound(distances.begin(), distances.end(), tolerance) - distances.begin());
  }
};

/// The tolerances that are tried: two per factor of 10, down to roundings.
constexpr int most_tolerances = 25;
inline double tolerance_of_number(double greatest, int i) { return greatest * std::pow(10, -0.5 * i); }

/// How a map is judged.
struct Judgement {
  double greatest_tolerance; ///< in the unit of distances: points that are nearer may lie on the other surface
  double min_overlap;        ///< the part of the probes of one surface, at least, that is to lie on the other
  int parameters = 0;        ///< of the map, which can bring as many points to the other surface
  double tests = 1;          ///< the number of maps that were tried
  std::size_t probes = most_probes;
  bool are_exact = false; ///< whether points on both surfaces are on them up to rounding, as those of formulas
};

/// Two ways how chance could bring points near to a surface: they lie anywhere in the volume, or on a surface that
/// touches the other one. Where two surfaces have contact of order n the distance grows with the power n + 1, and the
/// part of the points within a tenth of a distance is at most 10^(-2/(n + 1)). The order is 4 for surfaces in general.
/// Flat caps, as of x^6 + y^6 + z^6 = 1, have more: of formulas only roundings are no such contact.
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

/// Judges a map by the distances of moved points and of points beside the moved surface, in a unit; one of them is
/// enough, since either surface may be a part of the other, or stand among other things. The chances are those that a
/// point is near to the target, and to the source, see chance_of_nearness.
inline Map_evidence evidence_of_distances(const std::vector<Mapped_point>& moved,
                                          const std::vector<Mapped_point>& fixed, double unit,
                                          const std::array<double, 2>& chances, const Judgement& how) {
  const std::array sorted = {Sorted_distances(moved, unit), Sorted_distances(fixed, unit)};
  Map_evidence evidence;
  for (std::size_t way = 0; way < 2; ++way) judge_one_way(sorted[way], chances[way], how, evidence);
  const double more = std::log10(2 * most_tolerances * how.tests);
  evidence.log10_false_alarms = std::min(0.0, evidence.log10_false_alarms + more);
  evidence.log10_by_volume = std::min(0.0, evidence.log10_by_volume + more);
  constexpr double rounding = 2e-6; // of coordinates with six digits: points that are nearer lie on the other surface
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
