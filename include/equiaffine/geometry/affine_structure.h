// SPDX-License-Identifier: GPL-3.0-or-later
// The equi-affine structure of a surface at a point, or only its invariants, computed from a chart.
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_STRUCTURE_H
#define EQUIAFFINE_GEOMETRY_AFFINE_STRUCTURE_H

#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/number/select.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// The equi-affine (Blaschke) structure of an oriented surface at a point. Volume-preserving affine maps preserve its
/// curvatures and Pick invariant, and map its metric, co-normal and normal along with the surface. See Andrade,
/// Lewiner: Affine-invariant curvature estimators for implicit surfaces, 2012, section 2; Nomizu, Sasaki: Affine
/// Differential Geometry, 1994, chapter II.
///
/// Conventions: nu(xi) = 1, dxi(X) = -B X. A sphere of radius r with outward gradient has K = r^-3, H = -r^(-3/2), J =
/// 0. Replacing f by -f changes the sign of nu, xi, H, J and of the metric; c f with c > 0 changes nothing. Units: K
/// length^-3, H and J length^(-3/2), xi length^(-1/2), nu length^(1/2); the metric maps two vectors to length^(3/2).
/// The image under p -> A p with a = |det A| has K / a, H / sqrt(a), J / sqrt(a), sqrt(a) A^-T nu, A xi / sqrt(a),
/// sqrt(a) A^-T metric A^-1. The Gauss equation holds: the Gaussian curvature of the metric is H + J.
template <class FT>
struct Affine_invariants_3 {
  std::array<FT, 3> conormal; ///< nu: |K_e|^(-1/4) times the unit normal along the gradient
  std::array<FT, 3> normal;   ///< xi
  FT gaussian_curvature;      ///< K = det B
  FT mean_curvature;          ///< H = trace B / 2
  FT pick_invariant;          ///< J
  /// B in the basis e_u, e_v of the chart, row-major.
  std::array<FT, 4> shape_operator;
  /// rho: xi is parallel to e_w + rho_u e_u + rho_v e_v in the chart.
  std::array<FT, 2> slope;
  /// The symmetric coefficients of t, the apolar part of the chart's cubic form. A surface is a quadric if and only if
  /// t is zero everywhere.
  std::array<FT, 4> apolar_cubic;
};

/// The invariants and the quantities derived from them.
template <class FT>
struct Affine_structure_3 : Affine_invariants_3<FT> {
  Mask_of<FT> has_real_principal_curvatures; ///< whether the eigenvalues of B are real
  FT k1,  ///< the larger eigenvalue of B; NaN if complex, which is only possible if K_e < 0
      k2; ///< the smaller eigenvalue of B
  /// xx xy xz yy yz zz of the Berwald-Blaschke metric. As a form on space it vanishes along xi, so that affine maps map
  /// it along with the surface.
  std::array<FT, 6> metric;
  /// |T| / |II|^2, with the norms of the apolar cubic form and the second fundamental form in an orthonormal tangent
  /// basis. Independent of the unit of length; zero exactly if t is zero. J also vanishes on other surfaces, for
  /// example on ruled ones: if K_e < 0, no affine invariant of this order separates quadrics from all other surfaces.
  FT quadric_defect;
  std::array<FT, 3> tangent_u,       ///< the vector e_u of the chart in space
      tangent_v;                     ///< the vector e_v
  std::array<FT, 3> metric_in_chart; ///< uu uv vv of the metric in this basis
  /// uuu uuv uvv vvv in this basis of T, the trace-free part of the cubic form: J = 1/8 |T|^2 in the metric.
  std::array<FT, 4> cubic_in_chart;
};

} // namespace equiaffine

namespace equiaffine::internal {

// The steps from a chart to the affine invariants, in the notation of affine_invariants(): p is the quadratic form of
// the chart, C = t + 3 sym(v p) its cubic form. A test counts the operations.

/// A form of the given degree in two variables, by its symmetric coefficients.
template <class FT, std::size_t Degree>
using Binary_form = std::array<FT, Degree + 1>;

/// The value of a linear form for a vector.
template <class FT>
FT linear_form_at(const Binary_form<FT, 1>& form, const std::array<FT, 2>& x) {
  return form[0] * x[0] + form[1] * x[1];
}

/// p^-1, which raises indices and takes traces.
template <class FT>
struct Inverse_form {
  FT reciprocal;               // 1 / det p
  FT i11, i12, i22, i12_twice; // p^-1, except for the sign of i12

  explicit Inverse_form(const Monge_chart_3<FT>& chart) {
    const auto& p = chart.quadratic;
    reciprocal = FT(1) / chart.determinant;
    i11 = p[2] * reciprocal;
    i12 = p[1] * reciprocal;
    i22 = p[0] * reciprocal;
    i12_twice = i12 + i12;
  }

  /// p^-1 x
  std::array<FT, 2> raise(const Binary_form<FT, 1>& x) const {
    return {i11 * x[0] - i12 * x[1], i22 * x[1] - i12 * x[0]};
  }

  /// The trace of a quadratic form.
  FT trace(const FT& uu, const FT& uv, const FT& vv) const { return i11 * uu - i12_twice * uv + i22 * vv; }

  /// The trace of a cubic form over two of its arguments.
  Binary_form<FT, 1> trace(const Binary_form<FT, 3>& c) const {
    return {trace(c[0], c[1], c[2]), trace(c[1], c[2], c[3])};
  }

  /// The trace of a quartic form over two of its arguments.
  Binary_form<FT, 2> trace(const Binary_form<FT, 4>& r) const {
    return {trace(r[0], r[1], r[2]), trace(r[1], r[2], r[3]), trace(r[2], r[3], r[4])};
  }
};

/// A cubic form contracted with a vector.
template <class FT>
Binary_form<FT, 2> contract(const Binary_form<FT, 3>& c, const std::array<FT, 2>& u) {
  return {c[0] * u[0] + c[1] * u[1], c[1] * u[0] + c[2] * u[1], c[2] * u[0] + c[3] * u[1]};
}

/// C = t + 3 sym(v p) with t apolar.
template <class FT>
struct Cubic_parts {
  Binary_form<FT, 1> v, v_thrice;
  Binary_form<FT, 3> t;

  Cubic_parts(const Monge_chart_3<FT>& chart, const Inverse_form<FT>& inverse) {
    const auto& p = chart.quadratic;
    const auto& c = chart.cubic;
    const auto trace = inverse.trace(c);
    v = {trace[0] * FT(0.25), trace[1] * FT(0.25)};
    v_thrice = {v[0] * FT(3), v[1] * FT(3)};
    const FT p1_twice = p[1] + p[1];
    t = {c[0] - v_thrice[0] * p[0], c[1] - (v[1] * p[0] + v[0] * p1_twice), c[2] - (v[0] * p[2] + v[1] * p1_twice),
         c[3] - v_thrice[1] * p[2]};
  }
};

/// -|t|^2 / 2, from the Hessian covariant of t, which is this number times det p times p.
template <class FT>
FT minus_half_squared_norm(const Binary_form<FT, 3>& t, const Inverse_form<FT>& inverse) {
  const auto& [reciprocal, i11, i12, i22, i12_twice] = inverse;
  return reciprocal *
         (i11 * (t[0] * t[2] - t[1] * t[1]) - i12 * (t[0] * t[3] - t[1] * t[2]) + i22 * (t[1] * t[3] - t[2] * t[2]));
}

/// N = tr R - D - C(u) - 9 v v^T + 3/2 Hess(C) / det p, where u is 3 (alpha + p^-1 v).
template <class FT>
Binary_form<FT, 2> fourth_order_form(const Monge_chart_3<FT>& chart, const Inverse_form<FT>& inverse,
                                     const Binary_form<FT, 1>& v_thrice, const std::array<FT, 2>& u) {
  const auto& c = chart.cubic;
  const auto trace = inverse.trace(chart.quartic), contracted = contract<FT>(c, u);
  const auto& m = chart.mixed_quadratic;
  const FT half = inverse.reciprocal * FT(0.75), whole = half + half;
  return {trace[0] - m[0] - contracted[0] - v_thrice[0] * v_thrice[0] + whole * (c[0] * c[2] - c[1] * c[1]),
          trace[1] - m[1] - contracted[1] - v_thrice[0] * v_thrice[1] + half * (c[0] * c[3] - c[1] * c[2]),
          trace[2] - m[2] - contracted[2] - v_thrice[1] * v_thrice[1] + whole * (c[1] * c[3] - c[2] * c[2])};
}

/// B = `factor` (p^-1 N + sigma I), row-major.
template <class FT>
std::array<FT, 4> affine_shape_operator(const Inverse_form<FT>& inverse, const Binary_form<FT, 2>& n, const FT& sigma,
                                        const FT& factor) {
  const FT i11 = factor * inverse.i11, i12 = factor * inverse.i12, i22 = factor * inverse.i22;
  const FT mean = factor * sigma - i12 * n[1];
  return {i11 * n[0] + mean, i11 * n[1] - i12 * n[2], i22 * n[1] - i12 * n[0], i22 * n[2] + mean};
}

template <class FT>
Affine_invariants_3<FT> invariants_in_basis(const Monge_chart_3<FT>& chart) {
  using std::abs;
  using std::sqrt;
  const FT &a = chart.a, &b = chart.b;
  const auto& m = chart.mixed_quadratic;
  const Inverse_form<FT> inverse(chart);
  const Cubic_parts<FT> cubic(chart, inverse);
  const auto& v = cubic.v;
  const Binary_form<FT, 1> l = {chart.mixed[0] * FT(-0.5), chart.mixed[1] * FT(-0.5)};
  const std::array<FT, 2> alpha = inverse.raise(l), x = inverse.raise(v);
  const auto n =
      fourth_order_form<FT>(chart, inverse, cubic.v_thrice, {FT(3) * (alpha[0] + x[0]), FT(3) * (alpha[1] + x[1])});
  const FT sigma = fraction<4, 3, FT>() * (chart.e - linear_form_at<FT>(l, alpha)) -
                   inverse.trace(m[0], m[1], m[2]) * fraction<1, 6, FT>() - FT(2) * linear_form_at<FT>(v, alpha);

  // Powers of |d|: `square` is the square root, `length` is s times the fourth root, and `reciprocal_length` is 1 /
  // length.
  const FT square = FT(2) * sqrt(abs(chart.determinant)), length = chart.sign * sqrt(square);
  const FT reciprocal_length = length * square * abs(inverse.reciprocal) * FT(0.25);
  Affine_invariants_3<FT> s;
  s.conormal = chart.unpermuted(a * reciprocal_length, b * reciprocal_length, reciprocal_length);
  s.slope = {alpha[0] + FT(1.5) * x[0], alpha[1] + FT(1.5) * x[1]};
  s.normal = chart.vector(length * s.slope[0], length * s.slope[1], length);
  s.shape_operator = affine_shape_operator<FT>(inverse, n, sigma, FT(-1.5) * length);
  const auto& [b11, b12, b21, b22] = s.shape_operator;
  s.gaussian_curvature = b11 * b22 - b12 * b21;
  s.mean_curvature = (b11 + b22) * FT(0.5);
  s.pick_invariant = FT(1.125) * length * minus_half_squared_norm(cubic.t, inverse);
  s.apolar_cubic = cubic.t;
  return s;
}

/// Eigenvalues, the larger one first; NaN if they are complex.
template <class FT>
struct Real_eigenvalues {
  Mask_of<FT> exist;
  FT larger, smaller;
};

/// The eigenvalues of B. They are real for a definite metric, for which B is self-adjoint. Otherwise the sign of the
/// discriminant decides; within the rounding errors of B it counts as zero (a double eigenvalue). Where the subtraction
/// would cause cancellation, the eigenvalue of smaller magnitude is computed from the product K.
template <class FT>
Real_eigenvalues<FT> affine_principal_curvatures(const Affine_invariants_3<FT>& s, const Mask_of<FT>& is_definite) {
  using std::abs;
  using std::sqrt;
  const auto& [b11, b12, b21, b22] = s.shape_operator;
  const FT half_difference = (b11 - b22) * FT(0.5), product = b12 * b21;
  const FT discriminant = half_difference * half_difference + product;
  const FT rounding = FT(1000) * FT(std::numeric_limits<FT>::epsilon());
  const FT size = abs(b11) + abs(b22) + sqrt(FT(abs(product)));
  const Mask_of<FT> are_real = is_definite || discriminant >= -(rounding * rounding * size * size);
  const FT radius = sqrt(select(discriminant > FT(0), discriminant, FT(0)));
  const FT &mean = s.mean_curvature, plus = mean + radius, minus = mean - radius;
  const Mask_of<FT> cancels = radius > FT(0.5) * abs(mean), is_positive = mean > FT(0);
  const FT larger = select(cancels && !is_positive && mean != FT(0), FT(s.gaussian_curvature / minus), plus);
  const FT smaller = select(cancels && is_positive, FT(s.gaussian_curvature / plus), minus);
  const FT nan = std::numeric_limits<FT>::quiet_NaN();
  return {are_real, select(are_real, larger, nan), select(are_real, smaller, nan)};
}

/// s / |d|^(1/4), the factor from the second derivatives of the graph to the metric, and from the apolar part of its
/// third derivatives to T.
template <class FT>
FT scale_of_forms(const Monge_chart_3<FT>& chart) {
  using std::abs;
  using std::sqrt;
  return chart.sign / sqrt(FT(FT(2) * sqrt(FT(abs(chart.determinant)))));
}

template <class FT, std::size_t N>
std::array<FT, N> scaled_form(std::array<FT, N> form, const FT& factor) {
  for (FT& coefficient : form) coefficient = coefficient * factor;
  return form;
}

/// s h / |d|^(1/4) in the covectors dual to e_u, e_v that vanish on xi.
template <class FT>
std::array<FT, 6> affine_metric(const Affine_invariants_3<FT>& s, const Monge_chart_3<FT>& chart) {
  const FT factor = FT(-2) * scale_of_forms(chart);
  const auto& [p11, p12, p22] = chart.quadratic;
  const auto& [x1, x2] = s.slope;
  const auto u = chart.unpermuted(FT(1) - x1 * chart.a, chart.shear - x1 * chart.b, -x1);
  const auto v = chart.unpermuted(-(x2 * chart.a), FT(1) - x2 * chart.b, -x2);
  std::array<FT, 6> metric;
  std::size_t n = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      metric[n++] = factor * (p11 * u[i] * u[j] + p12 * (u[i] * v[j] + v[i] * u[j]) + p22 * v[i] * v[j]);
  return metric;
}

/// |T| / |II|^2 from the forms in the orthonormal tangent basis s = x e_u, t = y e_u + z e_v of euclidean_structure().
template <class FT>
FT quadric_defect(const Affine_invariants_3<FT>& s, const Monge_chart_3<FT>& chart) {
  using std::sqrt;
  const FT e = FT(1) + chart.a * chart.a, length = sqrt(FT(e + chart.b * chart.b)), root = sqrt(e);
  const FT x = FT(1) / root, z = root / length;
  const FT y = (chart.shear - chart.a * chart.b / e) * z;
  const auto& [p11, p12, p22] = chart.quadratic;
  const auto& [t0, t1, t2, t3] = s.apolar_cubic;
  const FT q12 = x * (y * p11 + z * p12), q22 = y * y * p11 + FT(2) * y * z * p12 + z * z * p22, q11 = x * x * p11;
  const FT c0 = x * x * x * t0, c1 = x * x * (y * t0 + z * t1), c2 = x * (y * y * t0 + FT(2) * y * z * t1 + z * z * t2);
  const FT c3 = y * y * (y * t0 + FT(3) * z * t1) + z * z * (FT(3) * y * t2 + z * t3);
  const FT cubic = sqrt(FT(c0 * c0 + FT(3) * (c1 * c1 + c2 * c2) + c3 * c3));
  return FT(1.5) * length * cubic / (q11 * q11 + FT(2) * q12 * q12 + q22 * q22);
}

template <class FT>
Affine_structure_3<FT> structure_in_basis(const Monge_chart_3<FT>& chart) {
  const auto invariants = invariants_in_basis(chart);
  const auto [are_real, k1, k2] = affine_principal_curvatures(invariants, chart.determinant > FT(0));
  const FT scale = scale_of_forms(chart), zero(0), one(1);
  return {invariants,
          are_real,
          k1,
          k2,
          affine_metric(invariants, chart),
          quadric_defect(invariants, chart),
          chart.vector(one, zero, zero),
          chart.vector(zero, one, zero),
          scaled_form(chart.quadratic, FT(-2) * scale),
          scaled_form(invariants.apolar_cubic, FT(-6) * scale)};
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Computes the invariants from a chart. Takes 327 floating-point operations including the chart, more if Q is nearly a
/// square. \pre chart.is_curved; otherwise the result is meaningless
///
/// Let p be the quadratic form Q, which raises indices and takes traces (h = -2 p), and v a quarter of the trace of the
/// cubic form: C = t + 3 sym(v p) with t apolar. The direction alpha = -(1/2) p^-1 L, conjugate to the tangent plane
/// with respect to the second derivatives of f, is that of the affine normal if f is quadratic. In the slope rho =
/// alpha + (3/2) p^-1 v of the affine normal, the second term is small if the surface is close to a quadric, however
/// anisotropic; without separating alpha, digits would be lost there. The Gauss-Weingarten equations of the graph -(Q +
/// C + R + Q (e Q - D)) then reduce to
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

/// Computes the whole structure from a chart. \pre chart.is_curved; otherwise the result is meaningless
template <class FT>
Affine_structure_3<FT> affine_structure(const Monge_chart_3<FT>& chart) {
  if (any(chart.is_nearly_square)) return internal::structure_in_basis(chart.conjugate(chart.is_nearly_square));
  return internal::structure_in_basis(chart);
}

/// The affine area per unit of Euclidean area, |K_e|^(1/4). Its integral over a part of the surface is invariant under
/// affine maps of determinant 1. It equals 1 / |nu|, needs derivatives of order 2 only, and is 0 at a parabolic point.
/// Unit: length^(-1/2).
template <class FT>
FT affine_area_density(const FT& gaussian_curvature) {
  using std::abs;
  using std::sqrt;
  return sqrt(sqrt(abs(gaussian_curvature)));
}

} // namespace equiaffine

#endif
