// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_STRUCTURE_H
#define EQUIAFFINE_GEOMETRY_AFFINE_STRUCTURE_H

#include <equiaffine/geometry/Monge_chart_3.h>

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

/// ... with what follows from it.
template <class FT>
struct Affine_structure_3 : Affine_invariants_3<FT> {
  internal::Mask_of<FT> has_real_principal_curvatures;
  FT k1, k2; ///< eigenvalues of B, k1 >= k2; NaN where they are complex, which needs a hyperbolic point (K_e < 0)
  /// xx xy xz yy yz zz of the Berwald-Blaschke metric; as a form on space it vanishes along xi, so that an affine map
  /// carries it along.
  std::array<FT, 6> metric;
  /// |T| / |II|^2, the lengths of the apolar cubic form and of the second fundamental form in an orthonormal tangent
  /// basis, whatever the unit of length: zero exactly where t is. J vanishes on other surfaces, too, ruled ones among
  /// them: where K_e < 0 no affine invariant of this order tells quadrics from all others.
  FT quadric_defect;
};

/// The invariants from a chart, in 318 floating-point operations with the chart. Meaningful where chart.is_curved.
///
/// Writing p for the quadratic form Q, with which indices are raised and traces taken (h = -2 p), and v for a quarter
/// of the trace of the cubic form, C = t + 3 sym(v p) with t apolar. The direction alpha = -(1/2) p^-1 L, conjugate to
/// the tangent plane with respect to the second derivatives of f, is that of the affine normal of a quadric; what
/// remains, rho = alpha + (3/2) p^-1 v, is small where the surface is near one, however anisotropic: without alpha
/// digits are lost there. The Gauss-Weingarten equations of the graph -(Q + C + R + Q (e Q - D)) then reduce to
///
///     B = -3/2 s |d|^(1/4) (p^-1 N + sigma I),   N = tr R - D - 3 C(alpha + 2 p^-1 v) + 3 v v^T,
///     sigma = v (3/2 p^-1 v - 2 alpha) - 3/8 |t|^2 + 4/3 (e + L(alpha) / 2) - tr D / 6,
///     J = -9/16 s |d|^(1/4) |t|^2
///
/// since t t, traced over two pairs of indices, is |t|^2 p / 2, and tr (Q D) = D + tr(D) p / 6.
template <class FT>
Affine_invariants_3<FT> affine_invariants(const Monge_chart_3<FT>& chart) {
  using std::abs;
  using std::sqrt;
  const FT &a = chart.a, &b = chart.b;
  const auto &p = chart.quadratic, &m = chart.mixed_quadratic;
  const auto& c = chart.cubic;
  const auto& r = chart.quartic;
  const FT reciprocal = FT(1) / chart.determinant;
  const FT i11 = p[2] * reciprocal, i12 = p[1] * reciprocal, i22 = p[0] * reciprocal; // p^-1 but for the sign of i12
  const FT i12_twice = i12 + i12;
  const auto trace = [&](const FT& uu, const FT& uv, const FT& vv) { return i11 * uu - i12_twice * uv + i22 * vv; };

  const FT v1 = trace(c[0], c[1], c[2]) * FT(0.25), v2 = trace(c[1], c[2], c[3]) * FT(0.25);
  const FT x1 = i11 * v1 - i12 * v2, x2 = i22 * v2 - i12 * v1; // p^-1 v
  const FT l1 = chart.mixed[0] * FT(-0.5), l2 = chart.mixed[1] * FT(-0.5);
  const FT alpha1 = i11 * l1 - i12 * l2, alpha2 = i22 * l2 - i12 * l1;
  const FT w1 = x1 * FT(1.5), w2 = x2 * FT(1.5), v1_thrice = v1 * FT(3), v2_thrice = v2 * FT(3);

  // t, and its Hessian covariant, which is -|t|^2 / 2 det p times p.
  const FT p1_twice = p[1] + p[1];
  const FT t0 = c[0] - v1_thrice * p[0], t1 = c[1] - (v2 * p[0] + v1 * p1_twice);
  const FT t2 = c[2] - (v1 * p[2] + v2 * p1_twice), t3 = c[3] - v2_thrice * p[2];
  const FT covariant = reciprocal * (i11 * (t0 * t2 - t1 * t1) - i12 * (t0 * t3 - t1 * t2) + i22 * (t1 * t3 - t2 * t2));

  const FT u1 = FT(3) * alpha1 + FT(4) * w1, u2 = FT(3) * alpha2 + FT(4) * w2;
  const FT n11 = trace(r[0], r[1], r[2]) - m[0] - (c[0] * u1 + c[1] * u2) + v1_thrice * v1;
  const FT n12 = trace(r[1], r[2], r[3]) - m[1] - (c[1] * u1 + c[2] * u2) + v1_thrice * v2;
  const FT n22 = trace(r[2], r[3], r[4]) - m[2] - (c[2] * u1 + c[3] * u2) + v2_thrice * v2;
  const FT sigma = v1 * (w1 - (alpha1 + alpha1)) + v2 * (w2 - (alpha2 + alpha2)) + FT(0.75) * covariant +
                   internal::fraction<4, 3, FT>() * (chart.e - (l1 * alpha1 + l2 * alpha2)) -
                   trace(m[0], m[1], m[2]) * internal::fraction<1, 6, FT>();

  Affine_invariants_3<FT> s;
  const FT square = FT(2) * sqrt(abs(chart.determinant)), length = chart.sign * sqrt(square);
  const FT inverse = length * square * abs(reciprocal) * FT(0.25); // without another division: length^4 is |d|
  s.conormal = chart.unpermuted(a * inverse, b * inverse, inverse);
  s.slope = {alpha1 + w1, alpha2 + w2};
  const FT xi1 = length * s.slope[0], xi2 = length * s.slope[1];
  s.normal = chart.unpermuted(xi1, xi2, length - a * xi1 - b * xi2);
  const FT factor = FT(-1.5) * length, cross = i12 * n12;
  s.shape_operator = {factor * (i11 * n11 - cross + sigma), factor * (i11 * n12 - i12 * n22),
                      factor * (i22 * n12 - i12 * n11), factor * (i22 * n22 - cross + sigma)};
  const auto& [b11, b12, b21, b22] = s.shape_operator;
  s.gaussian_curvature = b11 * b22 - b12 * b21;
  s.mean_curvature = (b11 + b22) * FT(0.5);
  s.pick_invariant = FT(1.125) * length * covariant;
  s.apolar_cubic = {t0, t1, t2, t3};
  return s;
}

namespace internal {

/// The eigenvalues of B: real for a definite metric, for which B is self-adjoint; else by the sign of the discriminant,
/// which counts as zero (a double eigenvalue) within the rounding errors of B.
template <class FT>
void set_principal_curvatures(Affine_structure_3<FT>& s, const Mask_of<FT>& is_definite) {
  using std::abs;
  using std::sqrt;
  const auto& [b11, b12, b21, b22] = s.shape_operator;
  const FT half_difference = (b11 - b22) * FT(0.5), product = b12 * b21;
  const FT discriminant = half_difference * half_difference + product;
  const FT rounding = FT(1000) * FT(std::numeric_limits<FT>::epsilon());
  const FT size = abs(b11) + abs(b22) + sqrt(FT(abs(product)));
  s.has_real_principal_curvatures = is_definite || discriminant >= -(rounding * rounding * size * size);
  const FT radius = sqrt(select(discriminant > FT(0), discriminant, FT(0)));
  const FT nan = std::numeric_limits<FT>::quiet_NaN();
  s.k1 = select(s.has_real_principal_curvatures, FT(s.mean_curvature + radius), nan);
  s.k2 = select(s.has_real_principal_curvatures, FT(s.mean_curvature - radius), nan);
}

/// metric = s h / |d|^(1/4) in the covectors dual to e_u, e_v that vanish on xi.
template <class FT>
void set_metric(Affine_structure_3<FT>& s, const Monge_chart_3<FT>& chart) {
  using std::abs;
  using std::sqrt;
  const FT factor = FT(-2) * chart.sign / sqrt(FT(FT(2) * sqrt(FT(abs(chart.determinant)))));
  const auto& [p11, p12, p22] = chart.quadratic;
  const auto& [x1, x2] = s.slope;
  const auto u = chart.unpermuted(FT(1) - x1 * chart.a, -(x1 * chart.b), -x1);
  const auto v = chart.unpermuted(-(x2 * chart.a), FT(1) - x2 * chart.b, -x2);
  std::size_t n = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      s.metric[n++] = factor * (p11 * u[i] * u[j] + p12 * (u[i] * v[j] + v[i] * u[j]) + p22 * v[i] * v[j]);
}

/// The forms in the orthonormal tangent basis s = x e_u, t = y e_u + z e_v of euclidean_structure().
template <class FT>
void set_quadric_defect(Affine_structure_3<FT>& s, const Monge_chart_3<FT>& chart) {
  using std::sqrt;
  const FT e = FT(1) + chart.a * chart.a, length = sqrt(FT(e + chart.b * chart.b)), root = sqrt(e);
  const FT x = FT(1) / root, z = root / length, y = -(chart.a * chart.b) * z / e;
  const auto& [p11, p12, p22] = chart.quadratic;
  const auto& [t0, t1, t2, t3] = s.apolar_cubic;
  const FT q12 = x * (y * p11 + z * p12), q22 = y * y * p11 + FT(2) * y * z * p12 + z * z * p22, q11 = x * x * p11;
  const FT c0 = x * x * x * t0, c1 = x * x * (y * t0 + z * t1), c2 = x * (y * y * t0 + FT(2) * y * z * t1 + z * z * t2);
  const FT c3 = y * y * (y * t0 + FT(3) * z * t1) + z * z * (FT(3) * y * t2 + z * t3);
  const FT cubic = sqrt(FT(c0 * c0 + FT(3) * (c1 * c1 + c2 * c2) + c3 * c3));
  s.quadric_defect = FT(1.5) * length * cubic / (q11 * q11 + FT(2) * q12 * q12 + q22 * q22);
}

} // namespace internal

/// The whole structure from a chart. Meaningful where chart.is_curved.
template <class FT>
Affine_structure_3<FT> affine_structure(const Monge_chart_3<FT>& chart) {
  Affine_structure_3<FT> s;
  static_cast<Affine_invariants_3<FT>&>(s) = affine_invariants(chart);
  internal::set_principal_curvatures(s, chart.determinant > FT(0));
  internal::set_metric(s, chart);
  internal::set_quadric_defect(s, chart);
  return s;
}

} // namespace equiaffine

#endif
