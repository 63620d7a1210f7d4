// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_AFFINE_STRUCTURE_H
#define EQUIAFFINE_AFFINE_STRUCTURE_H

#include <equiaffine/Monge_chart_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// Equi-affine (Blaschke) structure of an oriented surface at a point: what volume-preserving affine maps leave
/// invariant (curvatures, Pick invariant) or carry along (metric, co-normal, normal). See Andrade, Lewiner:
/// Affine-invariant curvature estimators for implicit surfaces, 2012, section 2; Nomizu, Sasaki: Affine Differential
/// Geometry, 1994, chapter II.
///
/// Conventions: nu(xi) = 1, dxi(X) = -B X. A sphere of radius r with outward gradient has K = r^-3, H = -r^(-3/2), J =
/// 0. -f instead of f changes the sign of nu, xi, H, J and of the metric; c f with c > 0 nothing. Units: K length^-3, H
/// and J length^(-3/2), xi length^(-1/2), nu length^(1/2); the metric maps two vectors to length^(3/2). Under p -> A p
/// with a = |det A|: K / a, H / sqrt(a), J / sqrt(a), sqrt(a) A^-T nu, A xi / sqrt(a), sqrt(a) A^-T metric A^-1. The
/// Gauss equation holds: the Gaussian curvature of the metric is H + J.
template <class FT>
struct Affine_structure_3 {
  std::array<FT, 3> conormal; ///< nu: |K_e|^(-1/4) times the unit normal along the gradient
  std::array<FT, 3> normal;   ///< xi
  FT gaussian_curvature;      ///< K = det B
  FT mean_curvature;          ///< H = trace B / 2
  FT pick_invariant;          ///< J
  bool has_real_principal_curvatures;
  FT k1, k2; ///< eigenvalues of B, k1 >= k2; NaN where they are complex, which needs a hyperbolic point (K_e < 0)
  /// xx xy xz yy yz zz of the Berwald-Blaschke metric; as a form on space it vanishes along xi, so that an affine map
  /// carries it along.
  std::array<FT, 6> metric;
  /// B in the basis e_u, e_v of the chart, row by row.
  std::array<FT, 4> shape_operator;
};

/// Affine structure from a chart. The formulas are those of a graph with vanishing gradient, with the products of
/// second and third derivatives gathered into the Hessian covariant of the cubic form. \pre chart.status is REGULAR.
template <class FT>
Affine_structure_3<FT> affine_structure(const Monge_chart_3<FT>& chart) {
  using std::abs;
  using std::sqrt;
  const FT &a = chart.a, &b = chart.b, &s = chart.sign, &d = chart.d;
  const auto& h = chart.h;
  const auto& c = chart.cubic;
  const auto& g = chart.quartic;
  const FT root = sqrt(abs(d)), a4 = sqrt(root), reciprocal = FT(1) / d;
  const FT i11 = h[2] * reciprocal, i12 = -h[1] * reciprocal, i22 = h[0] * reciprocal; // h^-1

  const auto trace = [&](const FT& uu, const FT& uv, const FT& vv) { return i11 * uu + (i12 + i12) * uv + i22 * vv; };
  const FT q1 = trace(c[0], c[1], c[2]) / FT(4), q2 = trace(c[1], c[2], c[3]) / FT(4); // d log|d| / 4
  const FT w1 = i11 * q1 + i12 * q2, w2 = i12 * q1 + i22 * q2;

  // tr(h^-1 C_k h^-1 C_l) = 16 q_k q_l - Hess(C)_kl / d, hence M = (tr_h G + Hess(C) / d) / 4 - 3 q q^T - C(., ., w).
  const FT hess11 = FT(2) * (c[0] * c[2] - c[1] * c[1]), hess12 = c[0] * c[3] - c[1] * c[2];
  const FT hess22 = FT(2) * (c[1] * c[3] - c[2] * c[2]);
  const FT m11 = (trace(g[0], g[1], g[2]) + hess11 * reciprocal) / FT(4) - FT(3) * q1 * q1 - (c[0] * w1 + c[1] * w2);
  const FT m12 = (trace(g[1], g[2], g[3]) + hess12 * reciprocal) / FT(4) - FT(3) * q1 * q2 - (c[1] * w1 + c[2] * w2);
  const FT m22 = (trace(g[2], g[3], g[4]) + hess22 * reciprocal) / FT(4) - FT(3) * q2 * q2 - (c[2] * w1 + c[3] * w2);

  Affine_structure_3<FT> r;
  const FT scale = s * a4;
  r.conormal = chart.unpermuted(a / scale, b / scale, FT(1) / scale);
  const FT x1 = chart.alpha - w1, x2 = chart.beta - w2;
  r.normal = chart.unpermuted(scale * x1, scale * x2, scale * (FT(1) - a * x1 - b * x2));
  const FT b11 = scale * (i11 * m11 + i12 * m12), b12 = scale * (i11 * m12 + i12 * m22);
  const FT b21 = scale * (i12 * m11 + i22 * m12), b22 = scale * (i12 * m12 + i22 * m22);
  r.shape_operator = {b11, b12, b21, b22};
  r.gaussian_curvature = root * (m11 * m22 - m12 * m12) * reciprocal;
  r.mean_curvature = (b11 + b22) / FT(2);

  // T = C - sym(q h) is apolar, so that |T|^2 = -2 h^-1 : Hess-like minors of T / d.
  const FT t0 = c[0] - FT(3) * q1 * h[0], t1 = c[1] - (q2 * h[0] + FT(2) * q1 * h[1]);
  const FT t2 = c[2] - (q1 * h[2] + FT(2) * q2 * h[1]), t3 = c[3] - FT(3) * q2 * h[2];
  const FT norm = trace(t0 * t2 - t1 * t1, (t0 * t3 - t1 * t2) / FT(2), t1 * t3 - t2 * t2) * FT(-2) * reciprocal;
  r.pick_invariant = scale * norm / FT(8);

  set_principal_curvatures(r, d > FT(0));
  set_metric(r, chart, -x1, -x2);
  return r;
}

/// The eigenvalues of B: real for a definite metric, for which B is self-adjoint; else by the sign of the discriminant,
/// which counts as zero (a double eigenvalue) within the rounding errors of B.
template <class FT>
void set_principal_curvatures(Affine_structure_3<FT>& r, bool is_definite) {
  using std::abs;
  using std::sqrt;
  const auto& m = r.shape_operator;
  const FT half_difference = (m[0] - m[3]) / FT(2), product = m[1] * m[2];
  const FT discriminant = half_difference * half_difference + product;
  const FT rounding = FT(1000) * std::numeric_limits<FT>::epsilon();
  const FT size = abs(m[0]) + abs(m[3]) + sqrt(abs(product));
  r.has_real_principal_curvatures = is_definite || discriminant >= -(rounding * rounding * size * size);
  const FT radius = discriminant > FT(0) ? FT(sqrt(discriminant)) : FT(0);
  const FT nan = std::numeric_limits<FT>::quiet_NaN();
  r.k1 = r.has_real_principal_curvatures ? r.mean_curvature + radius : nan;
  r.k2 = r.has_real_principal_curvatures ? r.mean_curvature - radius : nan;
}

/// metric = s h / |d|^(1/4) in the covectors dual to e_u, e_v that vanish on xi.
template <class FT>
void set_metric(Affine_structure_3<FT>& r, const Monge_chart_3<FT>& chart, const FT& w1, const FT& w2) {
  using std::abs;
  using std::sqrt;
  const FT factor = chart.sign / sqrt(sqrt(abs(chart.d)));
  const auto u = chart.unpermuted(FT(1) + w1 * chart.a, w1 * chart.b, w1);
  const auto v = chart.unpermuted(w2 * chart.a, FT(1) + w2 * chart.b, w2);
  std::size_t n = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      r.metric[n++] =
          factor * (chart.h[0] * u[i] * u[j] + chart.h[1] * (u[i] * v[j] + v[i] * u[j]) + chart.h[2] * v[i] * v[j]);
}

} // namespace equiaffine

#endif
