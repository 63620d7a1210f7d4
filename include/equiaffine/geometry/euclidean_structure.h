// SPDX-License-Identifier: GPL-3.0-or-later
// The Euclidean structure of a surface at a point, computed from a chart, and derived quantities.
#ifndef EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_H
#define EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_H

#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/number/select.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace equiaffine {

/// The Euclidean structure of an oriented surface at a point. The shape operator S is defined by dn(X) = -S X for the
/// unit normal n along the gradient: a sphere of radius r with outward gradient has k1 = k2 = -1/r, Gaussian curvature
/// 1/r^2 and mean curvature -1/r. Units: curvatures 1/length, Gaussian curvature 1/length^2.
template <class FT>
struct Euclidean_structure_3 {
  std::array<FT, 3> normal;     ///< the unit normal n
  FT k1,                        ///< the larger principal curvature
      k2;                       ///< the smaller principal curvature
  std::array<FT, 3> direction1, ///< unit principal direction of k1
      direction2;               ///< unit principal direction of k2; direction1, direction2, normal are right-handed
  FT gaussian_curvature,        ///< k1 k2
      mean_curvature;           ///< (k1 + k2) / 2
};

} // namespace equiaffine

namespace equiaffine::internal {

/// The orthonormal tangent basis t1 = e_u / sqrt(e), t2 = (e_v - f e_u) sqrt(e) / w of a chart.
template <class FT>
struct Orthonormal_basis {
  FT e;     // |e_u|^2
  FT w2, w; // |e_u x e_v|^2, and its root
  FT f;     // <e_u, e_v> / e

  explicit Orthonormal_basis(const Monge_chart_3<FT>& chart) {
    using std::sqrt;
    const FT &a = chart.a, &b = chart.b;
    e = FT(1) + a * a;
    w2 = e + b * b;
    w = sqrt(w2);
    f = a * b / e;
  }
};

/// The coefficients of the second fundamental form in an orthonormal tangent basis.
template <class FT>
struct Second_fundamental_form {
  FT l, m, n;

  /// `r` is the third component of the unit normal in the chart.
  Second_fundamental_form(const Monge_chart_3<FT>& chart, const Orthonormal_basis<FT>& basis, const FT& r) {
    const auto& [e, w2, w, f] = basis;
    const FT huu = chart.h_uu(), huv = chart.h_uv(), hvv = chart.h_vv();
    l = r * huu / e;
    m = r * (huv - f * huu) / w;
    n = r * (hvv - f * (FT(2) * huv - f * huu)) * e / w2;
  }
};

/// Sets k1 and k2 from their mean, their product and half their difference, `radius`.
template <class FT>
void set_principal_curvatures(Euclidean_structure_3<FT>& s, const FT& radius) {
  const FT zero(0);
  // The curvature of larger magnitude is free of cancellation; the other one follows from the product.
  const auto first_is_larger = s.mean_curvature >= zero;
  const FT larger = s.mean_curvature + select(first_is_larger, radius, FT(-radius));
  const FT smaller = select(larger == zero, zero, FT(s.gaussian_curvature / larger));
  // At an umbilic, k1 and k2 must be equal despite rounding.
  s.k1 = select(first_is_larger || smaller < larger, larger, smaller);
  s.k2 = select(first_is_larger && smaller < larger, smaller, larger);
}

/// Sets the principal directions. The direction of k1 is an eigenvector of the form; at an umbilic, any direction is
/// used.
template <class FT>
void set_principal_directions(Euclidean_structure_3<FT>& s, const Monge_chart_3<FT>& chart,
                              const Orthonormal_basis<FT>& basis, const FT& half_difference, const FT& m,
                              const FT& radius) {
  using std::abs;
  using std::sqrt;
  const FT zero(0);
  const auto along_first = half_difference >= zero;
  const FT sum = radius + abs(half_difference);
  // The direction is c t1 + t t2.
  FT c = select(along_first, sum, FT(abs(m))), t = select(along_first, m, select(m < zero, FT(-sum), sum));
  const FT length = root_of_squares(c, t);
  const auto is_umbilic = length == zero;
  c = select(is_umbilic, FT(1), FT(c / length));
  t = select(is_umbilic, zero, FT(t / length));
  const FT sqrt_e = sqrt(basis.e);
  const FT u2 = -basis.f * sqrt_e / basis.w, v2 = sqrt_e / basis.w; // t2 = u2 e_u + v2 e_v
  s.direction1 = chart.vector(c / sqrt_e + t * u2, t * v2, zero);
  s.direction2 = chart.vector(chart.sign * (c * u2 - t / sqrt_e), chart.sign * c * v2, zero);
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Computes the Euclidean structure from the second derivatives of a chart.
template <class FT>
Euclidean_structure_3<FT> euclidean_structure(const Monge_chart_3<FT>& chart) {
  const internal::Orthonormal_basis<FT> basis(chart);
  const FT r = chart.sign / basis.w;
  const internal::Second_fundamental_form<FT> form(chart, basis, r);
  const FT half_difference = (form.l - form.n) / FT(2), radius = internal::root_of_squares(half_difference, form.m);
  Euclidean_structure_3<FT> s;
  s.normal = chart.unpermuted(chart.a * r, chart.b * r, r);
  s.mean_curvature = (form.l + form.n) / FT(2);
  s.gaussian_curvature = chart.d() / (basis.w2 * basis.w2);
  internal::set_principal_curvatures(s, radius);
  internal::set_principal_directions(s, chart, basis, half_difference, form.m, radius);
  return s;
}

/// The shape index of principal curvatures k1 >= k2, (2 / pi) atan2(k1 + k2, k1 - k2), independent of the size of the
/// surface: -1 on a sphere and -1/2 on a cylinder with outward normals, 0 on a symmetric saddle, 1/2 on a cylinder and
/// 1 on a sphere with inward normals. NaN if both curvatures are zero. See Koenderink, van Doorn: Surface shape and
/// curvature scales, 1992.
template <class FT>
FT shape_index(const FT& k1, const FT& k2) {
  using std::atan2;
  const FT right_angle = atan2(FT(1), FT(0)), index = atan2(FT(k1 + k2), FT(k1 - k2)) / right_angle;
  return select(k1 == FT(0) && k2 == FT(0), FT(std::numeric_limits<double>::quiet_NaN()), index);
}

/// The curvedness of principal curvatures k1, k2, sqrt((k1^2 + k2^2) / 2): 1 / r on a sphere of radius r, 0 on a plane.
/// Unit: 1/length. Source: see shape_index().
template <class FT>
FT curvedness(const FT& k1, const FT& k2) {
  const FT half1 = FT(0.5) * k1, half2 = FT(0.5) * k2;
  // The root of the squares of the mean and half the difference is exactly |k1| if k1 = k2.
  return internal::root_of_squares(FT(half1 + half2), FT(half1 - half2));
}

/// The angle between two vectors in degrees, from 0 to 180.
template <class FT>
FT angle_in_degrees(const std::array<FT, 3>& v, const std::array<FT, 3>& w) {
  using std::atan2;
  using std::sqrt;
  const FT x = v[1] * w[2] - v[2] * w[1], y = v[2] * w[0] - v[0] * w[2], z = v[0] * w[1] - v[1] * w[0];
  return atan2(sqrt(x * x + y * y + z * z), v[0] * w[0] + v[1] * w[1] + v[2] * w[2]) * FT(180 / std::numbers::pi);
}

} // namespace equiaffine

#endif
