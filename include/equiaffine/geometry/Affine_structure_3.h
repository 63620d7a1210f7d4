// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_STRUCTURE_3_H
#define EQUIAFFINE_GEOMETRY_AFFINE_STRUCTURE_3_H

#include <equiaffine/number/select.h>

#include <array>

namespace equiaffine {

/// The equi-affine (Blaschke) structure of an oriented surface at a point: the numbers that volume-preserving affine
/// maps keep (curvatures, Pick invariant) and the forms and vectors that they carry along (metric, co-normal, normal).
/// See Andrade, Lewiner: Affine-invariant curvature estimators for implicit surfaces, 2012, section 2; Nomizu, Sasaki:
/// Affine Differential Geometry, 1994, chapter II.
///
/// Conventions: nu(xi) = 1, dxi(X) = -B X. A sphere of radius r with outward gradient has K = r^-3, H = -r^(-3/2), J =
/// 0. -f instead of f changes the sign of nu, xi, H, J and of the metric; c f with c > 0 nothing. Units: K length^-3, H
/// and J length^(-3/2), xi length^(-1/2), nu length^(1/2); the metric maps two vectors to length^(3/2). Under p -> A p
/// with a = |det A|: K / a, H / sqrt(a), J / sqrt(a), sqrt(a) A^-T nu, A xi / sqrt(a), sqrt(a) A^-T metric A^-1. The
/// Gauss equation holds: the Gaussian curvature of the metric is H + J.
template <class FT>
struct Affine_invariants_3 {
  std::array<FT, 3> conormal; ///< nu: |K_e|^(-1/4) times the unit normal along the gradient
  std::array<FT, 3> normal;   ///< xi
  FT gaussian_curvature;      ///< K = det B
  FT mean_curvature;          ///< H = trace B / 2
  FT pick_invariant;          ///< J
  /// B in the basis e_u, e_v of the chart, row by row.
  std::array<FT, 4> shape_operator;
  /// rho: xi is, up to length, e_w + rho_u e_u + rho_v e_v in the chart.
  std::array<FT, 2> slope;
  /// The symmetric coefficients of t, the apolar part of the chart's cubic form: zero everywhere exactly on quadrics.
  std::array<FT, 4> apolar_cubic;
};

/// The invariants with what follows from them.
template <class FT>
struct Affine_structure_3 : Affine_invariants_3<FT> {
  Mask_of<FT> has_real_principal_curvatures; ///< whether the eigenvalues of B are real
  FT k1,  ///< the greater eigenvalue of B; NaN where they are complex, which needs a hyperbolic point (K_e < 0)
      k2; ///< the other one
  /// xx xy xz yy yz zz of the Berwald-Blaschke metric; as a form on space it vanishes along xi, so that an affine map
  /// carries it along.
  std::array<FT, 6> metric;
  /// |T| / |II|^2, the lengths of the apolar cubic form and of the second fundamental form in an orthonormal tangent
  /// basis, whatever the unit of length: zero exactly where t is. J vanishes on other surfaces, too, ruled ones among
  /// them: where K_e < 0 no affine invariant of this order tells quadrics from all others.
  FT quadric_defect;
  std::array<FT, 3> tangent_u,       ///< the vector e_u of the chart in space
      tangent_v;                     ///< the vector e_v
  std::array<FT, 3> metric_in_chart; ///< uu uv vv of the metric in this basis
  /// uuu uuv uvv vvv in this basis of T, the trace-free part of the cubic form: J = 1/8 |T|^2 in the metric.
  std::array<FT, 4> cubic_in_chart;
};

} // namespace equiaffine

#endif
