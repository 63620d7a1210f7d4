// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the equi-affine structure, or its invariants alone, from a chart.
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_STRUCTURE_H
#define EQUIAFFINE_GEOMETRY_AFFINE_STRUCTURE_H

#include <equiaffine/geometry/Affine_structure_3.h>
#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/geometry/internal/affine_steps.h>

namespace equiaffine {

/// The invariants from a chart, in 340 floating-point operations with the chart, more where Q is nearly a square.
/// Meaningful where chart.is_curved.
///
/// Writing p for the quadratic form Q, with which indices are raised and traces taken (h = -2 p), and v for a quarter
/// of the trace of the cubic form, C = t + 3 sym(v p) with t apolar. The direction alpha = -(1/2) p^-1 L, conjugate to
/// the tangent plane with respect to the second derivatives of f, is that of the affine normal of a quadric; what
/// remains, rho = alpha + (3/2) p^-1 v, is small where the surface is near one, however anisotropic: without alpha
/// digits are lost there. The Gauss-Weingarten equations of the graph -(Q + C + R + Q (e Q - D)) then reduce to
///
///     B = -3/2 s |d|^(1/4) (p^-1 N + sigma I),
///     N = tr R - D - 3 C(alpha + p^-1 v) - 9 v v^T + 3/2 Hess(C) / det p,
///     sigma = 4/3 (e + L(alpha) / 2) - tr D / 6 - 2 v(alpha),   J = -9/16 s |d|^(1/4) |t|^2
///
/// where the product of C with itself, traced over two pairs of indices, is 16 v v^T - 2 Hess(C) / det p, with the
/// Hessian covariant of the cubic form C, and tr (Q D) = D + tr(D) p / 6. Near a parabolic curve |v|^2 and |t|^2 are
/// much larger than K, and their multiples of p would cancel.
template <class FT>
Affine_invariants_3<FT> affine_invariants(const Monge_chart_3<FT>& chart) {
  if (any(chart.is_nearly_square)) return internal::invariants_in_basis(chart.conjugate(chart.is_nearly_square));
  return internal::invariants_in_basis(chart);
}

/// The whole structure from a chart. Meaningful where chart.is_curved.
template <class FT>
Affine_structure_3<FT> affine_structure(const Monge_chart_3<FT>& chart) {
  if (any(chart.is_nearly_square)) return internal::structure_in_basis(chart.conjugate(chart.is_nearly_square));
  return internal::structure_in_basis(chart);
}

} // namespace equiaffine

#endif
