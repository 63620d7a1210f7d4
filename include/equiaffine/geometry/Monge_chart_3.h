// SPDX-License-Identifier: GPL-3.0-or-later
// Monge_chart_3, the level set of f through a point as a graph, in an adapted frame of determinant 1, from the jet of
// f.
#ifndef EQUIAFFINE_GEOMETRY_MONGE_CHART_3_H
#define EQUIAFFINE_GEOMETRY_MONGE_CHART_3_H

#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/select.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace equiaffine::internal {

/// The axis that is used as z in a chart.
template <class FT>
struct Pivot_3 {
  Mask_of<FT> is_x, is_y;
  std::array<FT, 3> reciprocals; ///< 1 / f_i for all three axes
};

/// Chooses the axis i with the smallest maximum over j of |f_ij| / |f_i f_j|. Axes with zero slope are not considered.
/// Ties go to the largest |f_i|.
///
/// Two axes are compared without their common term: x with y without xy, then the better one with z.
template <class FT>
[[gnu::always_inline]] inline Pivot_3<FT> choose_pivot(const Jet_3<FT>& jet) {
  using std::abs;
  const auto& c = jet.coefficients();
  const std::array<FT, 3> slope = {abs(c[1]), abs(c[2]), abs(c[3])};
  const std::array<FT, 3> reciprocals = {FT(1) / c[1], FT(1) / c[2], FT(1) / c[3]};
  std::array<Mask_of<FT>, 3> counts;
  std::array<FT, 3> r; // the reciprocals; 0 for axes with zero slope
  for (std::size_t i = 0; i < 3; ++i) {
    counts[i] = slope[i] >= FT(std::numeric_limits<FT>::min());
    r[i] = select(counts[i], reciprocals[i], FT(0));
  }
  const auto larger = [](const FT& x, const FT& y) { return select(x > y, x, y); };
  const auto curvature = [&](std::size_t monomial, std::size_t i, std::size_t j) {
    return FT(abs(c[monomial] * r[i] * r[j]));
  };
  const FT never(std::numeric_limits<FT>::infinity());
  const FT xy = curvature(5, 0, 1), xz = curvature(6, 0, 2), yz = curvature(8, 1, 2);
  const FT xx = select(counts[0], FT(FT(2) * curvature(4, 0, 0)), never);
  const FT yy = select(counts[1], FT(FT(2) * curvature(7, 1, 1)), never);
  const FT zz = select(counts[2], FT(FT(2) * curvature(9, 2, 2)), never);

  const FT x = larger(xx, xz), y = larger(yy, yz);
  const Mask_of<FT> x_beats_y = x < y || (x == y && slope[0] > slope[1]);
  const FT winner = larger(select(x_beats_y, xx, yy), xy), z = larger(zz, select(x_beats_y, yz, xz));
  const FT slope_of_winner = select(x_beats_y, slope[0], slope[1]);
  const Mask_of<FT> winner_beats_z = winner < z || (winner == z && slope_of_winner > slope[2]);
  return {x_beats_y && winner_beats_z, !x_beats_y && winner_beats_z, reciprocals};
}

} // namespace equiaffine::internal

namespace equiaffine {

/// The level set of f through a point as a graph, in an adapted frame of determinant 1, from the jet of f there.
///
/// The coordinates are permuted cyclically to (x, y, z) so that z is the best direction of a graph (the pivot). With a
/// = f_x / f_z, b = f_y / f_z, the vectors e_u = (1, 0, -a), e_v = (0, 1, -b) are tangent, and the gradient of f / f_z
/// in the frame (e_u, e_v, e_w) with e_w = (0, 0, 1) is (0, 0, 1). In this frame
///
///     f / f_z = w + Q + w L + e w^2 + C + w D + R + irrelevant terms,
///
/// with forms in (u, v) of degree Q:2, L:1, C:3, D:2, R:4. A form of degree n is stored as its symmetric coefficients
/// s_i: it is the sum of binomial(n, i) s_i u^(n-i) v^i.
///
/// In exact arithmetic any axis with f_i != 0 would do. If the axes are scaled so that all f_i are 1, the second
/// derivatives are f_ij / (f_i f_j). The shear subtracts those of the pivot from the others, which loses digits if they
/// are large. The pivot is therefore the axis whose largest one is smallest; this choice does not depend on the units
/// of the axes. Choosing the axis of the largest |f_i| would lose digits if the surface is elongated along another
/// axis, and a rotation instead of the shear would mix the scales of an anisotropic surface.
///
/// If Q is nearly the square of a linear form, e_u and e_v are nearly parallel relative to their lengths. The pivot
/// then becomes the axis for which they are least parallel. If that is not sufficient, conjugate() preserves the digits
/// of C, D and R in the direction in which Q nearly vanishes.
///
/// FT is a number or a pack of numbers. Only the choice of the pivot branches on values.
template <class FT>
struct Monge_chart_3 {
  using Mask = Mask_of<FT>; ///< a truth value, or one per lane of a pack

  Mask pivot_is_x, ///< the x-axis is used as z, and the next two, cyclically, as x and y
      pivot_is_y;  ///< the y-axis is used as z; if neither, z itself
  Mask is_steep;   ///< the gradient is not zero; see ignore_gradient_within_rounding()
  /// d is not zero: it exceeds the error from 500 roundings of the terms of its entries. See also
  /// ignore_d_within_error().
  Mask is_curved;
  /// Q is nearly the square of a linear form in both u and v: essential parts of the chart's forms are much smaller
  /// than the forms.
  Mask is_nearly_square;
  FT sign;                           ///< of f_z: normals along the gradient are parallel to sign (a, b, 1)
  FT a,                              ///< f_x / f_z
      b;                             ///< f_y / f_z
  FT shear = FT(0);                  ///< e_v is (0, 1, -b) minus `shear` times e_u
  std::array<FT, 3> quadratic;       ///< coefficients of Q
  std::array<FT, 2> mixed;           ///< coefficients of L
  FT e;                              ///< coefficient of w^2
  std::array<FT, 4> cubic;           ///< coefficients of C
  std::array<FT, 3> mixed_quadratic; ///< coefficients of D
  std::array<FT, 5> quartic;         ///< coefficients of R
  FT determinant;                    ///< of the symmetric coefficients of Q: d / 4

  /// Creates the chart at a point from the jet of f there.
  explicit Monge_chart_3(const Jet_3<FT>& jet) : Monge_chart_3(jet, internal::choose_pivot(jet), true) {}

  /// \cond for internal use
  /// Creates the chart with the given pivot, or with a better one if `may_change`.
  Monge_chart_3(const Jet_3<FT>& jet, const internal::Pivot_3<FT>& pivot, bool may_change = false)
      : pivot_is_x(pivot.is_x), pivot_is_y(pivot.is_y) {
    using std::abs;
    const auto& c = jet.coefficients();
    is_steep = abs(c[1]) > FT(0) || abs(c[2]) > FT(0) || abs(c[3]) > FT(0);
    expand_around_pivot(jet, pivot.reciprocals);
    if (may_change && any(is_nearly_square) && change_pivot()) expand_around_pivot(jet, pivot.reciprocals);
  }
  /// \endcond

  /// Sets `is_steep` to false if rounding the coordinates of the point could account for the gradient. Each component
  /// is tested separately, since the axes can have different units.
  void ignore_gradient_within_rounding(const std::array<FT, 3>& point, const Jet_3<FT>& jet) {
    using std::abs;
    const auto& c = jet.coefficients();
    const FT x = roundings(4) * abs(point[0]), y = roundings(4) * abs(point[1]), z = roundings(4) * abs(point[2]);
    const FT xy = abs(c[5]), xz = abs(c[6]), yz = abs(c[8]), two(2);
    is_steep = abs(c[1]) > two * abs(c[4]) * x + xy * y + xz * z || abs(c[2]) > xy * x + two * abs(c[7]) * y + yz * z ||
               abs(c[3]) > xz * x + yz * y + two * abs(c[9]) * z;
  }

  /// Sets `is_curved` to false if errors of up to `error` in the second derivatives of the jet could account for d. The
  /// resulting errors of the coefficients of Q are those in a frame with a = b = 0, times 1 + |a| for each u and 1 +
  /// |b| for each v.
  void ignore_d_within_error(const Jet_3<FT>& jet, const FT& error) {
    using std::abs;
    const auto& c = jet.coefficients();
    const FT pivot = select(pivot_is_x, c[1], select(pivot_is_y, c[2], c[3]));
    const FT one_u = FT(1) + abs(a), one_v = FT(1) + abs(b), uv = abs(FT(0.5) * error / pivot) * one_u * one_v;
    const FT doubt =
        uv * (abs(quadratic[0]) * one_v / one_u + abs(quadratic[2]) * one_u / one_v + FT(2) * (abs(quadratic[1]) + uv));
    is_curved = is_curved && abs(determinant) > doubt;
  }

  /// The second derivatives of the surface as a graph w = g(u, v): the affine fundamental form.
  /// @{
  FT h_uu() const { return FT(-2) * quadratic[0]; }
  FT h_uv() const { return FT(-2) * quadratic[1]; }
  FT h_vv() const { return FT(-2) * quadratic[2]; }
  /// @}

  /// The determinant of the affine fundamental form.
  FT d() const { return FT(4) * determinant; }

  /// Converts a vector or covector from the permuted to the original coordinates.
  std::array<FT, 3> unpermuted(const FT& x, const FT& y, const FT& z) const {
    return {select(pivot_is_x, z, select(pivot_is_y, y, x)), select(pivot_is_x, x, select(pivot_is_y, z, y)),
            select(pivot_is_x, y, select(pivot_is_y, x, z))};
  }

  /// The vector with components (u, v, w) in the frame, in the original coordinates.
  std::array<FT, 3> vector(const FT& u, const FT& v, const FT& w) const {
    const FT x = u - shear * v;
    return unpermuted(x, v, w - (a * x + b * v));
  }

  /// Where `condition` holds, the chart whose e_v is conjugate to e_u, so that Q has no term u v; elsewhere this chart.
  Monge_chart_3 conjugate(const Mask& condition) const {
    Monge_chart_3 result = *this;
    const FT k = result.shear = select(condition, FT(quadratic[1] / quadratic[0]), FT(0));
    result.quadratic[1] = select(condition, FT(0), quadratic[1]);
    result.quadratic[2] = select(condition, FT(determinant / quadratic[0]), quadratic[2]);
    const auto subtract_u_from_v = [&](auto& form) { // for each argument in turn; preserves -0 elsewhere
      for (std::size_t n = 1; n < form.size(); ++n)
        for (std::size_t i = form.size() - 1; i >= n; --i)
          form[i] = select(condition, FT(form[i] - k * form[i - 1]), form[i]);
    };
    subtract_u_from_v(result.mixed);
    subtract_u_from_v(result.cubic);
    subtract_u_from_v(result.mixed_quadratic);
    subtract_u_from_v(result.quartic);
    return result;
  }

private:
  static FT roundings(int n) { return FT(n) * FT(std::numeric_limits<FT>::epsilon()); }

  /// Index of the monomial that corresponds to x^i y^j z^k if axis `pivot` is used as z.
  static constexpr int permuted_index(int pivot, int i, int j, int k) {
    return pivot == 2 ? Jet_3<FT>::index(i, j, k) : pivot == 1 ? Jet_3<FT>::index(j, k, i) : Jet_3<FT>::index(k, i, j);
  }

  /// The coefficient of x^I y^J z^K in permuted coordinates, for a fixed pivot or, if Pivot == 3, lane by lane.
  template <int Pivot, int I, int J, int K>
  [[gnu::always_inline]] FT f(const Jet_3<FT>& jet) const {
    if constexpr (Pivot < 3) return jet.template at<permuted_index(Pivot, I, J, K)>();
    else return select(pivot_is_x, f<0, I, J, K>(jet), select(pivot_is_y, f<1, I, J, K>(jet), f<2, I, J, K>(jet)));
  }

  /// If Q is nearly a square, changes to the axis with the smallest coefficient of u v times f_i^2; d times f_i^4 is
  /// the same for all three. Powers of the new a and b must not overflow. Returns whether the axis has changed.
  bool change_pivot() {
    using std::abs;
    const FT with_x = abs(quadratic[1] - b / a * quadratic[0]), with_y = abs(quadratic[1] - a / b * quadratic[2]);
    const FT with_z = abs(quadratic[1]), least(1e-37F); // also in the range of float
    const Mask x_is_better = is_nearly_square && abs(a) > least && with_x < with_z;
    const Mask y_is_better = is_nearly_square && abs(b) > least && with_y < with_z;
    const Mask to_x = x_is_better && !(y_is_better && with_y < with_x), to_y = y_is_better && !to_x;
    const Mask stays = !to_x && !to_y;
    const Mask was_x = pivot_is_x, was_y = pivot_is_y, was_z = !was_x && !was_y;
    pivot_is_x = (stays && was_x) || (to_x && was_z) || (to_y && was_y);
    pivot_is_y = (stays && was_y) || (to_x && was_x) || (to_y && was_z);
    return any(to_x || to_y);
  }

  void expand_around_pivot(const Jet_3<FT>& jet, const std::array<FT, 3>& reciprocals) {
    const FT r = select(pivot_is_x, reciprocals[0], select(pivot_is_y, reciprocals[1], reciprocals[2]));
    if constexpr (!std::is_same_v<Mask, bool>) expand<3>(jet, r);
    else if (pivot_is_x) expand<0>(jet, r);
    else if (pivot_is_y) expand<1>(jet, r);
    else expand<2>(jet, r);
  }

  /// Divides every homogeneous part of the jet by z - (w - a u - b v), where `r` is 1 / f_z. The part is a polynomial
  /// in z whose coefficients are forms in (u, v); synthetic division turns it into one in w. The coefficients of the
  /// result, starting with w^0, are the forms of the chart: Q, L, e for degree 2, C and D for degree 3, R for degree 4.
  template <int P>
  void expand(const Jet_3<FT>& jet, const FT& r) {
    sign = select(r > FT(0), FT(1), FT(-1));
    a = f<P, 1, 0, 0>(jet) * r;
    b = f<P, 0, 1, 0>(jet) * r;
    const FT r2 = r * FT(0.5);
    expand_second_order<P>(jet, r, r2);
    expand_third_order<P>(jet, r, r2);
    expand_fourth_order<P>(jet, r);
  }

  /// Sets Q, L and e from xx x^2 + ... + zz z^2, d, and whether d counts as zero.
  template <int P>
  [[gnu::always_inline]] void expand_second_order(const Jet_3<FT>& jet, const FT& r, const FT& r2) {
    using std::abs;
    const FT xx = f<P, 2, 0, 0>(jet), xy = f<P, 1, 1, 0>(jet), yy = f<P, 0, 2, 0>(jet);
    const FT xz = f<P, 1, 0, 1>(jet), yz = f<P, 0, 1, 1>(jet), zz = f<P, 0, 0, 2>(jet);
    const FT azz = a * zz, bzz = b * zz;
    const Form<1> q1 = {xz - azz, yz - bzz};
    Form<2> q2 = {xx, xy, yy};
    subtract_multiple(q2, q1);
    quadratic = {r * q2[0], r2 * q2[1], r * q2[2]};
    mixed = {r * (q1[0] - azz), r * (q1[1] - bzz)};
    e = r * zz;

    determinant = quadratic[0] * quadratic[2] - quadratic[1] * quadratic[1];
    // The magnitudes of the terms in the coefficients of Q (Andrade, Lewiner 2012, equation (2)) and, from these, the
    // error of d. Products of the magnitudes alone would hide a nonzero d if large terms of the coefficients cancel.
    const FT u = abs(xz) + abs(azz), v = abs(yz) + abs(bzz);
    const FT rounded = roundings(500) * abs(r), rounded2 = roundings(500) * abs(r2);
    const FT uu = rounded * (abs(xx) + abs(a) * u), vv = rounded * (abs(yy) + abs(b) * v);
    const FT uv = rounded2 * (abs(xy) + abs(a) * v + abs(b) * u);
    const FT q11 = abs(quadratic[0]), q12 = abs(quadratic[1]), q22 = abs(quadratic[2]);
    is_curved = abs(determinant) > uu * (q22 + vv) + vv * q11 + uv * (q12 + q12 + uv);
    is_nearly_square = FT(16) * abs(determinant) < quadratic[1] * quadratic[1];
  }

  /// Sets C and D. The form c_n is the coefficient of z^(3 - n) before the division.
  template <int P>
  [[gnu::always_inline]] void expand_third_order(const Jet_3<FT>& jet, const FT& r, const FT& r2) {
    const FT r3 = r * fraction<1, 3, FT>();
    const Form<0> c0 = {f<P, 0, 0, 3>(jet)};
    Form<1> c1 = {f<P, 1, 0, 2>(jet), f<P, 0, 1, 2>(jet)};
    Form<2> c2 = {f<P, 2, 0, 1>(jet), f<P, 1, 1, 1>(jet), f<P, 0, 2, 1>(jet)};
    Form<3> c3 = {f<P, 3, 0, 0>(jet), f<P, 2, 1, 0>(jet), f<P, 1, 2, 0>(jet), f<P, 0, 3, 0>(jet)};
    subtract_multiple(c1, c0);
    subtract_multiple(c2, c1);
    subtract_multiple(c3, c2);
    cubic = {r * c3[0], r3 * c3[1], r3 * c3[2], r * c3[3]};
    Form<1> d1 = c1;
    subtract_multiple(d1, c0);
    Form<2> d2 = c2;
    subtract_multiple(d2, d1);
    mixed_quadratic = {r * d2[0], r2 * d2[1], r * d2[2]};
  }

  /// Sets R. The form s_n is the coefficient of z^(4 - n) before the division.
  template <int P>
  [[gnu::always_inline]] void expand_fourth_order(const Jet_3<FT>& jet, const FT& r) {
    const FT r4 = r * FT(0.25), r6 = r * fraction<1, 6, FT>();
    const Form<0> s0 = {f<P, 0, 0, 4>(jet)};
    Form<1> s1 = {f<P, 1, 0, 3>(jet), f<P, 0, 1, 3>(jet)};
    Form<2> s2 = {f<P, 2, 0, 2>(jet), f<P, 1, 1, 2>(jet), f<P, 0, 2, 2>(jet)};
    Form<3> s3 = {f<P, 3, 0, 1>(jet), f<P, 2, 1, 1>(jet), f<P, 1, 2, 1>(jet), f<P, 0, 3, 1>(jet)};
    Form<4> s4 = {f<P, 4, 0, 0>(jet), f<P, 3, 1, 0>(jet), f<P, 2, 2, 0>(jet), f<P, 1, 3, 0>(jet), f<P, 0, 4, 0>(jet)};
    subtract_multiple(s1, s0);
    subtract_multiple(s2, s1);
    subtract_multiple(s3, s2);
    subtract_multiple(s4, s3);
    quartic = {r * s4[0], r4 * s4[1], r6 * s4[2], r4 * s4[3], r * s4[4]};
  }

  template <std::size_t Degree>
  using Form = std::array<FT, Degree + 1>;

  /// Subtracts (a u + b v) times another form. In place, since copies of arrays of packs would go through memory.
  template <std::size_t N>
  [[gnu::always_inline]] void subtract_multiple(std::array<FT, N + 1>& form, const std::array<FT, N>& other) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      ((form[I] -= a * other[I], form[I + 1] -= b * other[I]), ...);
    }
    (std::make_index_sequence<N>());
  }
};

} // namespace equiaffine

#endif
