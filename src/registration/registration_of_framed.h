// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_REGISTRATION_OF_FRAMED_H
#define EQUIAFFINE_SRC_REGISTRATION_REGISTRATION_OF_FRAMED_H

#include "registration/Centered_surface_3.h"
#include "registration/Framed_surface_3.h"
#include "registration/Registration_search.h"
#include "registration/map_of_quadrics.h"
#include "registration/part_on_surface.h"
#include "registration/registration_of_wholes.h"
#include "registration/slippage.h"
#include <equiaffine/registration/Affine_slippage_3.h>
#include <equiaffine/registration/internal/searches.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

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

/// Whether the probes lie in a plane to within a part of their size. Each map between planes moves all of one onto the
/// other, which is no evidence.
inline bool is_in_plane(const Framed_surface_3& surface, double tolerance) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : surface.probes) mean += p / double(surface.probes.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : surface.probes)
    covariance += (p - mean) * (p - mean).transpose() / double(surface.probes.size());
  const double variance = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0];
  return !(variance > std::pow(tolerance * surface.size, 2));
}

/// How the source slides over itself by the velocities at its probes.
inline Affine_slippage_3 slippage_of_source(const Framed_surface_3& source, Map_kind kind) {
  const bool is_exact = has_exact_frames(source);
  Affine_slippage_3 result = slippage_of(source, kind, is_exact ? slippage_tolerance : slippage_of_fits);
  if (is_exact) result.rms = 0;
  return result;
}

inline Registration_of_functions_3 registration_of_framed(bool in_threads, const Framed_surface_3& source,
                                                          const Framed_surface_3& target,
                                                          const Registration_request& request,
                                                          Affine_slippage_3 slippage) {
  Registration_of_functions_3 registration;
  Surface_registration_3<Kernel_of_searches>& result = registration.result;
  result.size = target.size;
  result.slippage = std::move(slippage);
  Registration_search search(in_threads, source, target, request);
  if (is_in_plane(source, search.tolerance()) || is_in_plane(target, search.tolerance())) return registration;
  if (result.slippage.dimension() > 0)
    if (const auto map = map_of_quadrics(source, target, request)) search.try_map(*map);
  if (search.accepted().empty()) search.run();
  if (result.slippage.dimension() == 0) search.find_equally_good();
  result.hypotheses = search.hypotheses();
  const auto accepted = search.accepted();
  if (result.slippage.dimension() == 0) result.equally_good = search.equally_good();
  for (std::size_t n = 0; n < std::min(accepted.size(), request.number_of_maps); ++n)
    result.maps.push_back(registered_map(accepted[n]));
  result.next_best_rms = search.next_best_rms();
  registration.is_equivalence =
      result.found() && is_equivalence(in_threads, source, target, accepted[0].map, search.tolerance());
  return registration;
}

} // namespace equiaffine::internal

#endif
