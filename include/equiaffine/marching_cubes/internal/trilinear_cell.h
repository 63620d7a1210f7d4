// SPDX-License-Identifier: GPL-3.0-or-later
// The topology of the set where the trilinear interpolant f of eight values is positive, decided exactly. Everywhere a
// value of zero is taken as positive: of a corner, of a saddle on a face, of a saddle inside. So the topology is that
// of the set where f is greater than -e, for all small e > 0: one and the same perturbation for all cells.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_TRILINEAR_CELL_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_TRILINEAR_CELL_H

#include <equiaffine/marching_cubes/internal/marching_cubes_cases.h>

#include <CGAL/MP_Float.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

namespace equiaffine::internal {

/// Computes signs of homogeneous polynomials in numbers of magnitude up to `scale`, and remembers whether all were
/// certain. The tolerances are generous bounds of the rounding errors of the expressions in `corners_joined_inside`:
/// with unit roundoff u these err by less than 80 u scale^2, 400 u scale^3 and 3000 u scale^4, errors of u in the
/// numbers included.
template <class FT>
class Filtered_sign {
public:
  explicit Filtered_sign(const FT& scale) {
    constexpr FT u = std::numeric_limits<FT>::epsilon();
    tolerance_ = {FT(128) * u * scale * scale, FT(1024) * u * scale * scale * scale,
                  FT(8192) * u * scale * scale * scale * scale};
  }
  int operator()(const FT& x, std::size_t degree) {
    if (!(std::abs(x) > tolerance_[degree - 2])) is_certain_ = false;
    return x > FT(0) ? 1 : x < FT(0) ? -1 : 0;
  }
  bool is_certain() const { return is_certain_; }

private:
  std::array<FT, 3> tolerance_;
  bool is_certain_ = true;
};

/// Computes signs of exact numbers, with the interface of Filtered_sign.
struct Exact_sign {
  template <class Number>
  int operator()(const Number& x, std::size_t) const {
    return int(CGAL::sign(x));
  }
};

/// Two corners of the same sign that are joined in the horizontal slice in which the saddle of f is extremal, facing
/// each other diagonally there; nothing if there is no such slice in the cell.
///
/// f is linear on the four vertical edges and bilinear in a slice, whose positive part has as many components as it has
/// positive corners on vertical edges, but for two diagonal ones, which are joined if D(z) = f00 f11 - f10 f01 says so.
/// So regions of the cell's surface are joined inside only where D, a quadratic polynomial A z^2 + B z + C, changes its
/// sign twice between slices where other corners vanish, hence at its extremum z = -B / 2A.
template <class Number, class Sign>
std::optional<std::pair<std::size_t, std::size_t>> corners_joined_inside(const std::array<Number, 8>& f, Sign& sign) {
  const std::array<Number, 4> slope = {f[4] - f[0], f[5] - f[1], f[6] - f[2], f[7] - f[3]};
  const Number A = slope[0] * slope[3] - slope[1] * slope[2];
  const Number B = (f[0] * slope[3] + f[3] * slope[0]) - (f[1] * slope[2] + f[2] * slope[1]);
  const int sign_of_A = sign(A, 2);
  if (sign_of_A == 0 || sign(B, 2) * sign_of_A >= 0) return std::nullopt;
  const Number two_A = A + A;
  if (sign(Number(two_A + B), 2) * sign_of_A <= 0) return std::nullopt;
  std::array<bool, 4> is_positive{};
  for (std::size_t c = 0; c < 4; ++c) is_positive[c] = sign(Number(two_A * f[c] - B * slope[c]), 3) * sign_of_A >= 0;
  if (is_positive[0] != is_positive[3] || is_positive[1] != is_positive[2] || is_positive[0] == is_positive[1])
    return std::nullopt;
  const Number C = f[0] * f[3] - f[1] * f[2];
  const int sign_of_D = sign(Number((two_A + two_A) * C - B * B), 4) * sign_of_A;
  const bool are_positive_joined = is_positive[0] ? sign_of_D >= 0 : sign_of_D <= 0;
  const std::size_t c = is_positive[0] == are_positive_joined ? 0 : 1;
  const auto end = [&](std::size_t column) {
    return (f[column] >= Number(0)) == is_positive[column] ? column : column + 4;
  };
  return std::pair(end(c), end(3 - c));
}

/// Chooses the sub-case of a cell with the values v[c] - isovalue at its corners. Exact for float and double; for other
/// number types as exact as their arithmetic.
template <class FT>
class Trilinear_cell {
  static constexpr bool has_exact_signs =
      std::is_floating_point_v<FT> && std::numeric_limits<FT>::digits <= std::numeric_limits<double>::digits;
  using Number = std::conditional_t<has_exact_signs, double, FT>;
  using Exact = std::conditional_t<has_exact_signs, CGAL::MP_Float, FT>;

public:
  Trilinear_cell(const std::array<FT, 8>& v, const FT& isovalue) : v_(v), isovalue_(isovalue) {
    for (std::size_t c = 0; c < 8; ++c) f_[c] = Number(v_[c]) - Number(isovalue_);
  }

  std::size_t sub_case(unsigned signs) const {
    const auto& cases = Marching_cubes_cases::instance();
    unsigned joined = 0;
    for (unsigned faces = cases.ambiguous_faces(signs); faces != 0; faces &= faces - 1) {
      const int face = std::countr_zero(faces);
      if (are_positive_joined_on(face)) joined |= 1U << face;
    }
    const auto& variant = cases.variant(signs, joined);
    if (!variant.tunnels.empty())
      if (const auto corners = joined_inside()) {
        const auto r = variant.region[corners->first], s = variant.region[corners->second];
        const auto tunnel =
            std::find(variant.tunnels.begin(), variant.tunnels.end(), std::pair(std::min(r, s), std::max(r, s)));
        if (tunnel != variant.tunnels.end())
          return variant.sub_case + 1U + std::size_t(tunnel - variant.tunnels.begin());
      }
    return variant.sub_case;
  }

private:
  /// Whether the positive corners of a face with diagonal signs are joined on it. The order of the corners is that of
  /// their numbers, so that both cells at the face compute the same.
  bool are_positive_joined_on(int face) const {
    static constexpr std::uint8_t corners[6][4] = {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 1, 4, 5},
                                                   {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
    const auto& c = corners[face];
    const Number p = f_[c[0]] * f_[c[3]], q = f_[c[1]] * f_[c[2]];
    const bool is_first_positive = v_[c[0]] >= isovalue_;
    if constexpr (has_exact_signs) {
      // The relative bound covers 9 roundings; above the absolute one, underflow does no harm.
      constexpr double relative = 1e-15, absolute = 1e-290;
      const double difference = p - q;
      if (!(std::abs(difference) > relative * (std::abs(p) + std::abs(q)) + absolute) ||
          std::abs(difference) > std::numeric_limits<double>::max()) {
        const Exact D = exact(c[0]) * exact(c[3]) - exact(c[1]) * exact(c[2]);
        return is_first_positive ? D >= 0 : D <= 0;
      }
    }
    return is_first_positive ? p >= q : p <= q;
  }

  /// Two corners that a tunnel joins, as in `corners_joined_inside`.
  std::optional<std::pair<std::size_t, std::size_t>> joined_inside() const {
    if constexpr (has_exact_signs) {
      double scale = 0;
      for (const double x : f_) scale = std::max(scale, std::abs(x));
      if (scale > 1e-60 && scale < 1e60) { // no product underflows to harm or overflows
        Filtered_sign<double> sign(scale);
        const auto result = corners_joined_inside(f_, sign);
        if (sign.is_certain()) return result;
      }
    }
    std::array<Exact, 8> f;
    for (std::size_t c = 0; c < 8; ++c) f[c] = exact(c);
    Exact_sign sign;
    return corners_joined_inside(f, sign);
  }

  /// The difference of a value and the isovalue; an infinite value counts as the largest number.
  Exact exact(std::size_t c) const {
    if constexpr (has_exact_signs) {
      constexpr FT lowest = std::numeric_limits<FT>::lowest(), largest = std::numeric_limits<FT>::max();
      return Exact(double(std::clamp(v_[c], lowest, largest))) - Exact(double(isovalue_));
    } else {
      return f_[c];
    }
  }

  std::array<FT, 8> v_;
  FT isovalue_;
  std::array<Number, 8> f_{};
};

} // namespace equiaffine::internal

#endif
