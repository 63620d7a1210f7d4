// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MONGE_CHART_3_H
#define EQUIAFFINE_MONGE_CHART_3_H

#include <equiaffine/Jet_3.h>
#include <equiaffine/Point_status.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// The level set of f through a point as a graph w = g(u, v) of order 4, made from the jet of f there.
///
/// The coordinates are permuted cyclically to (x, y, z) so that |f_z| is the largest component of the gradient (the
/// pivot). With a = f_x / f_z, b = f_y / f_z the vectors e_u = (1, 0, -a), e_v = (0, 1, -b) are tangent, and
/// e_w = (0, 0, 1) + alpha e_u + beta e_v is the transversal direction conjugate to the tangent plane with respect to
/// the second derivatives of f. The frame has determinant 1, the gradient of f / f_z in it is (0, 0, 1), and for a
/// quadric e_w is already the direction of the affine normal: nothing is left to cancel. A rotation instead of this
/// shear would mix the scales of an anisotropic surface; without the pivot digits are lost wherever f_z is small; with
/// alpha = beta = 0 they are lost where e_w and the affine normal differ much.
///
/// In this frame f / f_z = w + Q + e w^2 + C + w D + R + ..., with forms in (u, v) of degree Q:2, e:0, C:3, D:2, R:4,
/// and g = -(Q + C + R + Q (e Q - D)). Where d vanishes there is no conjugate direction: alpha and beta are 0 and only
/// h is of use.
///
/// Signs: `sign` is that of f_z, so that normals along the gradient are sign (a, b, 1) up to length.
template <class FT>
struct Monge_chart_3 {
  Point_status status = Point_status::REGULAR; ///< SINGULAR, OUTSIDE: nothing else is set; PARABOLIC: d vanishes
  int pivot = 2;                               ///< the axis that plays z; the next two, cyclically, play x and y
  FT sign, a, b;
  FT alpha{}, beta{};        ///< of e_w
  std::array<FT, 3> h;       ///< g_uu g_uv g_vv: the affine fundamental form in (u, v)
  std::array<FT, 4> cubic;   ///< g_uuu g_uuv g_uvv g_vvv
  std::array<FT, 5> quartic; ///< g_uuuu ... g_vvvv
  FT d;                      ///< g_uu g_vv - g_uv^2

  /// `point_magnitude` is the largest absolute coordinate of the point, 0 if unknown: a gradient that one rounding of
  /// the coordinates could produce at a singular point is taken for zero. A jet with value NaN is OUTSIDE, one with
  /// another coefficient that is not finite SINGULAR. PARABOLIC is |d| below 1000 roundings of its own terms.
  explicit Monge_chart_3(const Jet_3<FT>& jet, const FT& point_magnitude = FT(0)) {
    status = status_of(jet, point_magnitude);
    if (status != Point_status::REGULAR) return;
    using std::abs;
    const auto gradient = [&](int axis) { return jet.coefficients()[std::size_t(1 + axis)]; };
    pivot = abs(gradient(0)) > abs(gradient(1)) ? 0 : 1;
    if (!(abs(gradient(pivot)) > abs(gradient(2)))) pivot = 2;
    build(jet);
  }

  /// A vector or covector given in the permuted coordinates, in the original ones.
  std::array<FT, 3> unpermuted(const FT& x, const FT& y, const FT& z) const {
    std::array<FT, 3> r;
    r[std::size_t((pivot + 1) % 3)] = x;
    r[std::size_t((pivot + 2) % 3)] = y;
    r[std::size_t(pivot)] = z;
    return r;
  }

  /// The vector with components (u, v) in the tangent basis, in the original coordinates.
  std::array<FT, 3> tangent(const FT& u, const FT& v) const { return unpermuted(u, v, -(a * u + b * v)); }

private:
  static constexpr int rounding_factor = 1000;

  static FT roundings(int n) { return FT(n) * std::numeric_limits<FT>::epsilon(); }

  static Point_status status_of(const Jet_3<FT>& jet, const FT& point_magnitude) {
    using std::abs;
    const auto& c = jet.coefficients();
    const auto is_finite = [](const FT& x) { return x - x == FT(0); };
    if (!is_finite(c[0])) return Point_status::OUTSIDE;
    for (const FT& x : c)
      if (!is_finite(x)) return Point_status::SINGULAR;
    FT gradient(0), second(0);
    for (std::size_t n = 1; n < 4; ++n) gradient = abs(c[n]) > gradient ? abs(c[n]) : gradient;
    for (std::size_t n = 4; n < 10; ++n) second = abs(c[n]) > second ? abs(c[n]) : second;
    return gradient > roundings(4) * second * point_magnitude ? Point_status::REGULAR : Point_status::SINGULAR;
  }

  void build(const Jet_3<FT>& jet) {
    const auto f = [&](int i, int j, int k) {
      std::array<int, 3> exponents{};
      exponents[std::size_t((pivot + 1) % 3)] = i;
      exponents[std::size_t((pivot + 2) % 3)] = j;
      exponents[std::size_t(pivot)] = k;
      return jet.coefficients()[std::size_t(Jet_3<FT>::index(exponents[0], exponents[1], exponents[2]))];
    };
    const FT r = FT(1) / f(0, 0, 1);
    sign = r > FT(0) ? FT(1) : FT(-1);
    a = f(1, 0, 0) * r;
    b = f(0, 1, 0) * r;

    // Synthetic division of each homogeneous part by z - (w - a u - b v): the remainder is its part without w, the next
    // one the coefficient of w. `times` multiplies a form by -(a u + b v) and adds another.
    const std::array<FT, 1> p2 = {f(0, 0, 2)}, p3 = {f(0, 0, 3)}, p4 = {f(0, 0, 4)};
    const auto q1 = times(p2, std::array{f(1, 0, 1), f(0, 1, 1)});
    const auto q = times(q1, std::array{f(2, 0, 0), f(1, 1, 0), f(0, 2, 0)});
    const auto l = times(p2, q1);
    const auto c1 = times(p3, std::array{f(1, 0, 2), f(0, 1, 2)});
    const auto c2 = times(c1, std::array{f(2, 0, 1), f(1, 1, 1), f(0, 2, 1)});
    const auto c3 = times(c2, std::array{f(3, 0, 0), f(2, 1, 0), f(1, 2, 0), f(0, 3, 0)});
    const auto d2 = times(times(p3, c1), c2);
    const auto r1 = times(p4, std::array{f(1, 0, 3), f(0, 1, 3)});
    const auto r2 = times(r1, std::array{f(2, 0, 2), f(1, 1, 2), f(0, 2, 2)});
    const auto r3 = times(r2, std::array{f(3, 0, 1), f(2, 1, 1), f(1, 2, 1), f(0, 3, 1)});
    const auto r4 = times(r3, std::array{f(4, 0, 0), f(3, 1, 0), f(2, 2, 0), f(1, 3, 0), f(0, 4, 0)});

    h = {FT(-2) * r * q[0], -r * q[1], FT(-2) * r * q[2]};
    d = h[0] * h[2] - h[1] * h[1];
    if (is_parabolic(f(2, 0, 0), f(1, 1, 0), f(0, 2, 0), f(1, 0, 1), f(0, 1, 1), f(0, 0, 2), r))
      status = Point_status::PARABOLIC;
    else set_higher_derivatives(scaled(q, r), scaled(l, r), p2[0] * r, scaled(c3, r), scaled(d2, r), scaled(r4, r));
  }

  /// From the forms Q, L, e, C, D, R of f / f_z in the frame (e_u, e_v, (0, 0, 1)), in which there is also a term w L.
  void set_higher_derivatives(const std::array<FT, 3>& q, const std::array<FT, 2>& l, const FT& e,
                              const std::array<FT, 4>& c, const std::array<FT, 3>& w, const std::array<FT, 5>& r) {
    alpha = (h[2] * l[0] - h[1] * l[1]) / d;
    beta = (h[0] * l[1] - h[1] * l[0]) / d;
    const FT conjugate_e = e + (l[0] * alpha + l[1] * beta) / FT(2);
    const std::array<FT, 3> k = {conjugate_e * q[0] - (w[0] + FT(3) * c[0] * alpha + c[1] * beta),
                                 conjugate_e * q[1] - (w[1] + FT(2) * (c[1] * alpha + c[2] * beta)),
                                 conjugate_e * q[2] - (w[2] + c[2] * alpha + FT(3) * c[3] * beta)}; // e Q - D
    cubic = {FT(-6) * c[0], FT(-2) * c[1], FT(-2) * c[2], FT(-6) * c[3]};
    quartic = {FT(-24) * (r[0] + q[0] * k[0]), FT(-6) * (r[1] + (q[0] * k[1] + q[1] * k[0])),
               FT(-4) * (r[2] + (q[0] * k[2] + q[1] * k[1] + q[2] * k[0])),
               FT(-6) * (r[3] + (q[1] * k[2] + q[2] * k[1])), FT(-24) * (r[4] + q[2] * k[2])};
  }

  /// Compares d with the terms of which its entries are sums (Andrade, Lewiner 2012, equation (2)).
  bool is_parabolic(const FT& xx, const FT& xy, const FT& yy, const FT& xz, const FT& yz, const FT& zz,
                    const FT& r) const {
    using std::abs;
    const FT uu = FT(2) * (abs(xx) + abs(a * xz) + abs(a * a * zz)),
             vv = FT(2) * (abs(yy) + abs(b * yz) + abs(b * b * zz));
    const FT uv = abs(xy) + abs(a * yz) + abs(b * xz) + FT(2) * abs(a * b * zz);
    return !(abs(d) > roundings(rounding_factor) * ((r * uu) * (r * vv) + (r * uv) * (r * uv)));
  }

  template <std::size_t N, std::size_t M>
  std::array<FT, M> times(const std::array<FT, N>& form, std::array<FT, M> sum) const {
    static_assert(M == N + 1);
    for (std::size_t n = 0; n < N; ++n) {
      sum[n] -= a * form[n];
      sum[n + 1] -= b * form[n];
    }
    return sum;
  }

  template <std::size_t N>
  static std::array<FT, N> scaled(std::array<FT, N> form, const FT& factor) {
    for (FT& coefficient : form) coefficient *= factor;
    return form;
  }
};

} // namespace equiaffine

#endif
