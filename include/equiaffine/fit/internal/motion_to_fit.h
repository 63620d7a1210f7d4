// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_MOTION_TO_FIT_H
#define EQUIAFFINE_FIT_INTERNAL_MOTION_TO_FIT_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/fit/internal/Whole_motion_3.h>
#include <equiaffine/fit/internal/Zero_of_fit_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Moves the vertices of a mesh whose triangles cross each other in some pairs, and no others. Those that are marked as
/// features stay; without marks there are none.
template <class ConcurrencyTag, class Fit>
Whole_motion_3 motion_to_fit(const Triangle_array_3& mesh, const Fit& fit, std::vector<Triangle_pair> crossings,
                             const std::vector<char>& is_feature = {}) {
  const std::vector<Eigen::Vector3d> normals = mesh.vertex_normals();
  std::vector<Zero_of_fit_3> zeros(normals.size());
  parallel_for<ConcurrencyTag>(
      0, zeros.size(),
      [&](std::size_t v) {
        zeros[v] = !is_feature.empty() && is_feature[v]
                       ? Zero_of_fit_3{Fit_outcome::ON_FEATURE}
                       : zero_of_fit(fit, mesh.points()[v], normals[v], mesh.mean_edge(v));
      },
      64);
  return Whole_motion_3(mesh, std::move(zeros), std::move(crossings));
}

/// Gives the vertices of a mesh, in their order, their new points and outcomes.
template <class Kernel, class Mesh, class Parameters>
Fit_move_report apply_motion(Mesh& mesh, const Whole_motion_3& motion, const Parameters& parameters) {
  const auto point_of = vertex_points(mesh, parameters);
  Fit_move_report report;
  report.crossings = motion.crossings();
  std::size_t n = 0;
  for (const auto v : vertices_of(mesh)) {
    const Eigen::Vector3d& p = motion.points()[n];
    const Fit_outcome outcome = motion.outcome(n++);
    report.largest_move = std::max(report.largest_move, (p - coordinates_of(get(point_of, v))).norm());
    ++report.number_of[std::size_t(outcome)];
    put(point_of, v, typename Kernel::Point_3(p[0], p[1], p[2]));
    if constexpr (has_parameter<Vertex_outcome_tag, Parameters>)
      put(given_parameter<Vertex_outcome_tag>(parameters), v, outcome);
  }
  return report;
}

} // namespace equiaffine::internal

#endif
