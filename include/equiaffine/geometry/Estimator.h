// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_ESTIMATOR_H
#define EQUIAFFINE_GEOMETRY_ESTIMATOR_H

namespace equiaffine {

/// The ways to compute the affine structure from the 34 derivatives of f at a point: our own, and those of Andrade,
/// Lewiner: Affine-invariant curvature estimators for implicit surfaces, 2012, with the errata of doc/errata.md
/// corrected. Theirs are longer, slower and less accurate, and are there to compare with.
enum class Estimator {
  COMPACT,        ///< pivot and shear: affine_structure()
  TRANSFORMATION, ///< section 3: an affine map after which the formulas are short
  DIRECT,         ///< section 2: the implicit function theorem on the axis that is closest to the gradient
  DIRECT_Z        ///< section 2 on the z axis wherever the gradient points; not finite where f_z vanishes
};

} // namespace equiaffine

#endif
