// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_FRAMED_FUNCTION_3_H
#define EQUIAFFINE_SRC_REGISTRATION_FRAMED_FUNCTION_3_H

#include "registration/framed_point.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>

#include <limits>
#include <utility>

namespace equiaffine::internal {

/// The distance from a point to the surface to first order, and the direction in which it grows. The distance is NaN
/// where the function is not defined.
struct Signed_distance_3 {
  double distance;
  Eigen::Vector3d normal;
};

/// A function whose domain is its box, with frames on its zero set and distances from it.
class Framed_function_3 {
public:
  explicit Framed_function_3(Any_function_3 function) : function_(std::move(function)), box_(function_.bbox()) {}
  virtual ~Framed_function_3() = default;

  /// A benchmark overrides this to make frames wrong.
  virtual Framed_point_3 framed_point(const Eigen::Vector3d& p, Map_kind kind) const {
    return internal::framed_point([this](const Eigen::Vector3d& q) { return taylor(q); }, p, kind);
  }

  Jet_3<double, 1> first_order(const Eigen::Vector3d& p) const {
    if (!contains(p)) return Jet_3<double, 1>(std::numeric_limits<double>::quiet_NaN());
    return function_.first_order(point(p));
  }

  double certainty(const Eigen::Vector3d& p) const { return function_.certainty(point(p)); }

  Signed_distance_3 distance(const Eigen::Vector3d& p) const {
    const auto jet = first_order(p);
    const Eigen::Vector3d gradient = eigen_gradient(jet);
    const double length = gradient.stableNorm();
    return {jet.value() / length, gradient / length};
  }

  /// Moves a point towards the surface by Newton's steps along the gradient.
  Eigen::Vector3d moved_to_surface(Eigen::Vector3d p, int steps) const {
    for (int step = 0; step < steps; ++step) {
      const auto [distance, normal] = this->distance(p);
      p -= distance * normal;
    }
    return p;
  }

  /// Whether a point is in the box of the function.
  bool contains(const Eigen::Vector3d& p) const {
    for (int a = 0; a < 3; ++a)
      if (!(p[a] >= box_.min(a) && p[a] <= box_.max(a))) return false;
    return true;
  }

private:
  using Point_3 = Any_function_3::Point_3;

  Jet_3<double> taylor(const Eigen::Vector3d& p) const {
    if (!contains(p)) return Jet_3<double>(std::numeric_limits<double>::quiet_NaN());
    return function_.taylor(point(p));
  }

  static Point_3 point(const Eigen::Vector3d& p) { return Point_3(p[0], p[1], p[2]); }

  Any_function_3 function_;
  CGAL::Bbox_3 box_;
};

} // namespace equiaffine::internal

#endif
