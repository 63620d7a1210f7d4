// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FITTED_FUNCTION_3_H
#define EQUIAFFINE_FIT_INTERNAL_FITTED_FUNCTION_3_H

#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/number/Jet_3.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>

#include <cmath>
#include <optional>

namespace equiaffine::internal {

/// The margin of a band holds points up to a height, and lets them be farther across the higher they are, as above a
/// crease.
struct Band_margin {
  double height = 0, slope = 0;
};

class Fitted_data_3;

/// The interface through which Fitted_function_traits_3 evaluates a fit, in the coordinates of the data.
class Fitted_function_3 {
public:
  using Vector = Eigen::Vector3d;

  virtual ~Fitted_function_3() = default;

  /// The value; not a number outside of the band.
  virtual double value(const Vector& p, const Band_margin& margin) const = 0;
  virtual Jet_3<double, 1> first_order(const Vector& p) const = 0;
  /// The expansion; not a number where the value is not that of polynomials alone.
  virtual Jet_3<double> taylor(const Vector& p) const = 0;
  virtual double rounding(const Vector& p) const = 0;
  virtual Fitted_structure_3<double> structure(const Vector& p) const = 0;
  virtual double spacing(const Vector& p) const = 0;
  virtual Vector on_tangent_plane(const Vector& p) const = 0;
  virtual std::optional<double> scale() const = 0;
  virtual CGAL::Bbox_3 box() const = 0;

  /// Returns the margin up to a height over the surface.
  virtual Band_margin margin(double height) const = 0;

  /// Returns whether some point of a box may be in the band.
  virtual bool may_meet(const CGAL::Bbox_3& box, const Band_margin& margin) const = 0;

  /// The data with the way to fit them.
  virtual const Fitted_data_3& data() const = 0;
};

/// How far the affine curvatures of a fit at a point can be trusted, from 0 to 1: 1 / (1 + 10 e) for an estimated error e
/// of the affine Gaussian curvature K as a part of |K| + H^2, which affine maps keep.
template <class FT>
double certainty_of_fit(const Fitted_structure_3<FT>& fit) {
  const auto& affine = fit.structure.affine;
  const FT size = std::abs(affine.gaussian_curvature) + affine.mean_curvature * affine.mean_curvature;
  const FT part = fit.error.affine_gaussian_curvature / size;
  return std::isfinite(part) ? double(1 / (1 + 10 * part)) : 0;
}

} // namespace equiaffine::internal

#endif
