// SPDX-License-Identifier: GPL-3.0-or-later
// Section 3 of the paper: an affine map after which the gradient is (0, 0, 1) and f_xy = 0, and formulas for that case.
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_TRANSFORMATION_ESTIMATE_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_TRANSFORMATION_ESTIMATE_H

#include <equiaffine/geometry/internal/affine_estimate.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine {

namespace internal {

template <class FT>
using Matrix_3 = std::array<std::array<FT, 3>, 3>;

/// The number of the monomial that is the product of the given variables: 0 is x, 1 is y, 2 is z.
constexpr std::size_t monomial_of(auto... variables) {
  std::array<int, 3> exponents{};
  (++exponents[variables], ...);
  return std::size_t(monomial_index(exponents[0], exponents[1], exponents[2]));
}

/// monomial_of(a, b, c, d) as a table.
inline constexpr auto products_of_four = [] {
  std::array<std::array<std::array<std::array<std::size_t, 3>, 3>, 3>, 3> table{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < 3; ++d) table[a][b][c][d] = monomial_of(a, b, c, d);
  return table;
}();

/// monomial_of(a, b, c) as a table.
inline constexpr auto products_of_three = [] {
  std::array<std::array<std::array<std::size_t, 3>, 3>, 3> table{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t c = 0; c < 3; ++c) table[a][b][c] = monomial_of(a, b, c);
  return table;
}();

/// The map A = R2 S R1 of proposition 1 (`matrix`) and its inverse.
template <class FT>
struct Simplifying_map_3 {
  Matrix_3<FT> matrix, inverse;

  explicit Simplifying_map_3(const std::array<FT, Jet_3<FT>::size>& f) {
    using std::atan2;
    using std::cos;
    using std::sin;
    using std::sqrt;
    const FT eta = sqrt(FT(f[1] * f[1] + f[2] * f[2] + f[3] * f[3])), root = sqrt(eta);
    rotate_to_vertical(f[1] / eta, f[2] / eta, f[3] / eta);
    for (std::size_t i = 0; i < 3; ++i) // S = diag(eta^(-1/2), eta^(-1/2), eta)
      for (std::size_t j = 0; j < 3; ++j) {
        inverse[j][i] = i < 2 ? matrix[i][j] * root : matrix[i][j] / eta;
        matrix[i][j] = i < 2 ? matrix[i][j] / root : matrix[i][j] * eta;
      }
    const auto second = [&](std::size_t i, std::size_t j) {
      FT sum(0);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) sum = sum + f[monomial_of(a, b)] * inverse[a][i] * inverse[b][j];
      return sum;
    };
    // R2 turns by theta with tan 2 theta = -2 f_xy / (f_xx - f_yy), which takes f_xy away.
    const FT theta = atan2(FT(-2) * second(0, 1), FT(second(0, 0) - second(1, 1))) / FT(2);
    turn(cos(theta), sin(theta));
  }

private:
  /// The rotation with the rows t1, t2, n (Duff et al.: Building an orthonormal basis, revisited, 2017).
  void rotate_to_vertical(const FT& x, const FT& y, const FT& z) {
    const FT sign = z < FT(0) ? FT(-1) : FT(1), a = FT(-1) / (sign + z), b = x * y * a;
    matrix = {{{FT(1) + sign * x * x * a, sign * b, -sign * x}, {b, sign + y * y * a, -y}, {x, y, z}}};
  }

  void turn(const FT& c, const FT& s) {
    for (std::size_t j = 0; j < 3; ++j) {
      const FT u = matrix[0][j], v = matrix[1][j], p = inverse[j][0], q = inverse[j][1];
      matrix[0][j] = c * u - s * v;
      matrix[1][j] = s * u + c * v;
      inverse[j][0] = c * p - s * q;
      inverse[j][1] = s * p + c * q;
    }
  }
};

/// The derivatives of f(A^-1 p), by equation (4) of the paper without any rearrangement.
template <class FT>
std::array<FT, Jet_3<FT>::size> mapped_derivatives(const std::array<FT, Jet_3<FT>::size>& f,
                                                   const Matrix_3<FT>& inverse) {
  std::array<FT, Jet_3<FT>::size> g{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t a = 0; a < 3; ++a) g[1 + i] = g[1 + i] + f[1 + a] * inverse[a][i];
    for (std::size_t j = i; j < 3; ++j) {
      FT second(0);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) second = second + f[monomial_of(a, b)] * inverse[a][i] * inverse[b][j];
      g[monomial_of(i, j)] = second;
      for (std::size_t k = j; k < 3; ++k) {
        FT third(0);
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b)
            for (std::size_t c = 0; c < 3; ++c)
              third = third + f[products_of_three[a][b][c]] * inverse[a][i] * inverse[b][j] * inverse[c][k];
        g[monomial_of(i, j, k)] = third;
        for (std::size_t l = k; l < 3; ++l) {
          FT fourth(0);
          for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
              for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t d = 0; d < 3; ++d)
                  fourth = fourth + f[products_of_four[a][b][c][d]] * inverse[a][i] * inverse[b][j] * inverse[c][k] *
                                        inverse[d][l];
          g[monomial_of(i, j, k, l)] = fourth;
        }
      }
    }
  }
  return g;
}

/// The formulas of section 3(b), which hold where f_x = f_y = f_xy = 0 and f_z = 1; on demand with x and y exchanged.
template <class FT>
struct Simplified_formulas_3 {
  const std::array<FT, Jet_3<FT>::size>& f;
  bool exchanged;

  FT operator()(int i, int j, int k) const {
    return f[std::size_t(exchanged ? monomial_index(j, i, k) : monomial_index(i, j, k))];
  }

  /// xi_1 times 4 d^2 / |d|^(1/4).
  FT normal() const {
    const auto& D = *this;
    const FT xx = D(2, 0, 0), yy = D(0, 2, 0);
    return yy * yy * D(3, 0, 0) + xx * yy * D(1, 2, 0) - FT(4) * xx * yy * yy * D(1, 0, 1);
  }

  /// b_11 times 16 f_xx^3 f_yy^2 / |d|^(1/4), with the correction of doc/errata.md.
  FT b11() const {
    const auto& D = *this;
    const FT xx = D(2, 0, 0), yy = D(0, 2, 0), xz = D(1, 0, 1), yz = D(0, 1, 1), zz = D(0, 0, 2);
    const FT xxx = D(3, 0, 0), xxy = D(2, 1, 0), xyy = D(1, 2, 0), yyy = D(0, 3, 0), xxz = D(2, 0, 1), yyz = D(0, 2, 1);
    const FT xx2 = xx * xx, xx3 = xx2 * xx, yy2 = yy * yy;
    return FT(-16) * xx3 * yy2 * zz + FT(4) * xx3 * yy * yyz + FT(16) * xx3 * yy * yz * yz - FT(4) * xx3 * yyy * yz -
           FT(28) * xx2 * xxy * yy * yz + FT(4) * xx2 * xxy * yyy - FT(4) * xx2 * D(2, 2, 0) * yy +
           FT(28) * xx2 * xxz * yy2 + FT(3) * xx2 * xyy * xyy - FT(4) * xx2 * xyy * xz * yy +
           FT(16) * xx2 * xz * xz * yy2 + FT(2) * xx * xxx * xyy * yy - FT(28) * xx * xxx * xz * yy2 -
           FT(4) * xx * D(4, 0, 0) * yy2 + FT(12) * xx * xxy * xxy * yy + FT(7) * xxx * xxx * yy2;
  }

  /// b_21 times 16 f_xx^3 f_yy^2 / |d|^(1/4).
  FT b21() const {
    const auto& D = *this;
    const FT xx = D(2, 0, 0), yy = D(0, 2, 0), xz = D(1, 0, 1), yz = D(0, 1, 1);
    const FT xxx = D(3, 0, 0), xxy = D(2, 1, 0), xyy = D(1, 2, 0), yyy = D(0, 3, 0);
    return FT(15) * xx * yy * xxy * xyy - xx * yy * xxx * yyy - FT(4) * xx * xx * yy * D(1, 3, 0) -
           FT(24) * xx * xx * yy * yz * xyy - FT(4) * xx * yy * yy * D(3, 1, 0) +
           FT(24) * xx * xx * yy * yy * D(1, 1, 1) - FT(24) * xx * yy * yy * xz * xxy + FT(7) * yy * yy * xxx * xxy +
           FT(7) * xx * xx * xyy * yyy;
  }
};

} // namespace internal

/// The transformation method of section 3. About 7,900 operations, of which 7,335 map the derivatives.
template <class FT>
Affine_estimate_3<FT> transformation_estimate(const Jet_3<FT>& jet) {
  using std::abs;
  using std::sqrt;
  const auto f = internal::partial_derivatives(jet);
  const internal::Simplifying_map_3<FT> map(f);
  const auto g = internal::mapped_derivatives(f, map.inverse);
  const internal::Simplified_formulas_3<FT> along_x{g, false}, along_y{g, true};
  const FT xx = along_x(2, 0, 0), yy = along_x(0, 2, 0), d = xx * yy, a4 = sqrt(FT(sqrt(FT(abs(d)))));

  const FT factor = a4 / (FT(16) * d * d), b11 = factor * along_x.b11() / xx, b22 = factor * along_y.b11() / yy;
  const FT b21 = factor * along_x.b21() / xx, b12 = factor * along_y.b21() / yy;
  const std::array<FT, 3> xi = {a4 * along_x.normal() / (FT(4) * d * d), a4 * along_y.normal() / (FT(4) * d * d), a4};

  Affine_estimate_3<FT> r;
  for (std::size_t i = 0; i < 3; ++i) {
    r.conormal[i] = map.matrix[2][i] / a4; // (0, 0, 1) A
    r.normal[i] = map.inverse[i][0] * xi[0] + map.inverse[i][1] * xi[1] + map.inverse[i][2] * xi[2];
  }
  r.gaussian_curvature = b11 * b22 - b12 * b21;
  r.mean_curvature = (b11 + b22) / FT(2);
  return r;
}

} // namespace equiaffine

#endif
