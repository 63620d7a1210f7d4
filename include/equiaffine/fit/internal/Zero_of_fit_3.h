// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_ZERO_OF_FIT_3_H
#define EQUIAFFINE_FIT_INTERNAL_ZERO_OF_FIT_3_H

#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/surface/internal/jet_derivatives.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/number_utils.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace equiaffine::internal {

/// The move of a vertex of a mesh onto the zero set of a fit, if there is one.
struct Zero_of_fit_3 {
  Fit_outcome outcome;
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< the unit normal of the fit at the zero
};

/// Finds the zero of a fit for a vertex with a normal, which need not have length 1, and edges of a mean length. The
/// search starts below or above the vertex where the fit has no derivatives at the vertex itself.
template <class Fit>
Zero_of_fit_3 zero_of_fit(const Fit& fit, const Eigen::Vector3d& vertex, const Eigen::Vector3d& normal, double edge) {
  using FT = typename Fit::FT;
  constexpr double least_cosine = 0.5; // of the angle between the normals of fit and mesh
  constexpr double reach = 0.5;        // of a zero, a part of the edges or of the distance of the data
  const auto is_known = [](const auto& jet) { return std::isfinite(CGAL::to_double(jet.value())); };
  typename Fit::Point_3 start(vertex[0], vertex[1], vertex[2]);
  auto jet = fit.first_order(start);
  if (!is_known(jet)) {
    start = fit.on_tangent_plane(start);
    jet = fit.first_order(start);
  }
  if (!is_known(jet)) return {Fit_outcome::NO_VALUE};
  const auto agrees = [&](const Eigen::Vector3d& g) {
    return g.dot(normal) >= least_cosine * g.norm() * normal.norm();
  };
  if (!agrees(eigen_gradient(jet))) return {Fit_outcome::OTHER_SIDE};
  const double farthest = reach * std::max(edge, CGAL::to_double(fit.spacing(start)));
  const auto zero = project_to_surface(fit, start, FT(farthest), jet);
  const Eigen::Vector3d move = coordinates_of(zero.point) - vertex;
  if (!zero.has_converged || !(move.norm() <= farthest)) return {Fit_outcome::NO_ZERO};
  const Eigen::Vector3d gradient = eigen_gradient(fit.first_order(zero.point));
  if (!agrees(gradient)) return {Fit_outcome::OTHER_SIDE};
  return {Fit_outcome::ON_FIT, move, gradient.normalized()};
}

} // namespace equiaffine::internal

#endif
