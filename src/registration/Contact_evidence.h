// SPDX-License-Identifier: GPL-3.0-or-later
// Judges a map between two pieces of surfaces by the points in contact and those that contradict it.
#ifndef EQUIAFFINE_SRC_REGISTRATION_CONTACT_EVIDENCE_H
#define EQUIAFFINE_SRC_REGISTRATION_CONTACT_EVIDENCE_H

#include "registration/contacts.h"
#include "registration/map_evidence.h"
#include "registration/refine_map.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace equiaffine::internal {

/// The evidence that the contacts of two pieces are for a map, and against it.
struct Contact_evidence {
  std::array<double, 2> inliers{};        ///< the parts of the samples of source and target in contact
  std::array<double, 2> contradictions{}; ///< those of the samples that say something
  double area = 0;                        ///< in contact
  double rms = std::numeric_limits<double>::infinity();
  double log10_false_alarms = 0;
  double rigidity = 0;        ///< by how much small motions of the kind move points off the other surface, beside them
  double affine_rigidity = 0; ///< the same for affine maps, one of which may be free
};

/// The parts of the samples of source and target that contradict the map, of those that say something.
inline std::array<double, 2> contradictions_of(const Mapped_samples& samples) {
  std::array<double, 2> result;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto hits = double(count_of(samples[side], Contact::TOUCHING));
    const auto misses = double(count_of(samples[side], Contact::CONTRADICTING));
    result[side] = misses / std::max(1.0, hits + misses);
  }
  return result;
}

/// The distances of samples that touch or contradict; others count as outside of the domain.
inline std::vector<Mapped_point> informative_points(const std::vector<Mapped_sample>& samples) {
  std::vector<Mapped_point> result;
  for (const Mapped_sample& s : samples) {
    const bool is_informative = s.contact != Contact::NONE;
    const double distance = (s.point - s.nearest).norm();
    result.push_back({s.point, {is_informative ? distance : std::numeric_limits<double>::quiet_NaN(), s.normal}});
  }
  return result;
}

/// The root mean squares, in increasing order, by which infinitesimal maps of a kind move the points in contact off the
/// other surface, in units of the size of these points.
inline Eigen::VectorXd rigidities(const Mapped_samples& samples, Map_kind kind) {
  Moment_sums_3 sums(samples[0].front().point);
  std::vector<const Mapped_sample*> touching;
  for (const auto& side : samples)
    for (const Mapped_sample& s : side)
      if (s.contact == Contact::TOUCHING) touching.push_back(&s), sums.add_point(s.point);
  const Eigen::MatrixXd maps = infinitesimal_maps(kind);
  if (touching.empty()) return Eigen::VectorXd::Zero(maps.cols());
  const Moments_3 moments = sums.moments();
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(12, 12);
  for (const Mapped_sample* s : touching) {
    const Eigen::Vector3d x = (s->point - moments.centroid) / moments.size();
    Eigen::Matrix<double, 12, 1> row;
    for (int i = 0; i < 3; ++i) row.segment<3>(3 * i) = s->normal[i] * x;
    row.tail<3>() = s->normal;
    squares += row * row.transpose() / double(touching.size());
  }
  const Eigen::MatrixXd of_maps = maps.transpose() * squares * maps;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(of_maps, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

/// Judges a map by the contacts of both pieces. `chances` are the parts of the space within a unit of distance from the
/// source and the target.
inline Contact_evidence contact_evidence(const Mapped_samples& samples, Map_kind kind,
                                         const std::array<double, 2>& areas, const std::array<double, 2>& chances,
                                         const Judgement& how) {
  Contact_evidence result;
  Map_evidence evidence;
  double sum = 0, count = 0;
  result.contradictions = contradictions_of(samples);
  for (std::size_t side = 0; side < 2; ++side) {
    const auto hits = double(count_of(samples[side], Contact::TOUCHING));
    const auto all = double(samples[side].size());
    result.inliers[side] = hits / all;
    result.area += areas[side] * hits / all / 2;
    judge_one_way(Sorted_distances(informative_points(samples[side]), 1), chances[1 - side], how, evidence);
    for (const Mapped_sample& s : samples[side])
      if (s.contact == Contact::TOUCHING) sum += (s.point - s.nearest).squaredNorm(), count += 1;
  }
  if (count > 0) result.rms = std::sqrt(sum / count);
  result.log10_false_alarms = std::min(0.0, evidence.log10_false_alarms + std::log10(2 * most_tolerances * how.tests));
  result.rigidity = rigidities(samples, kind)[0];
  result.affine_rigidity = rigidities(samples, Map_kind::AFFINE)[1];
  return result;
}

} // namespace equiaffine::internal

#endif
