// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_FACET_SIZING_FIELD_H
#define EQUIAFFINE_SRC_DELAUNAY_FACET_SIZING_FIELD_H

#include <equiaffine/delaunay/Facet_sizing.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <algorithm>
#include <cmath>

namespace equiaffine::internal {

/// The bound of the radius of facets near a point, which lies between radius/16 and radius.
class Facet_sizing_field {
public:
  Facet_sizing_field(const Any_function_3& function, const Clip_domain_3& domain, double radius, Facet_sizing sizing)
      : function_(function), radius_(radius), extent_(domain.diagonal() / 4), sizing_(sizing) {}

  template <class Point_3>
  double operator()(const Point_3& p) const {
    if (sizing_ == Facet_sizing::UNIFORM) return radius_;
    const auto structure = local_structure(function_.taylor(Any_function_3::Point_3(p.x(), p.y(), p.z())));
    const double size = sizing_ == Facet_sizing::EUCLIDEAN ? euclidean(structure) : affine(structure);
    if (size < radius_ / 16) return radius_ / 16;
    return size >= radius_ / 16 ? std::min(size, radius_) : radius_; // NaN gives the radius, too
  }

private:
  /// A quarter of the smaller radius of curvature.
  static double euclidean(const Local_structure_3<double>& s) {
    const auto& e = s.euclidean;
    return 0.25 / std::max(std::abs(e.k1), std::abs(e.k2));
  }

  /// The size that gives facets of equal affine area. It is the radius where the Gaussian curvature is that of a sphere
  /// that fills the domain.
  double affine(const Local_structure_3<double>& s) const {
    return radius_ * std::pow(std::abs(s.euclidean.gaussian_curvature) * extent_ * extent_, -0.125);
  }

  Any_function_3 function_;
  double radius_, extent_;
  Facet_sizing sizing_;
};

} // namespace equiaffine::internal

#endif
