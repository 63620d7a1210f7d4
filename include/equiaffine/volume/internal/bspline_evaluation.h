// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_EVALUATION_H
#define EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_EVALUATION_H

#include <equiaffine/number/internal/monomials_3.h>
#include <equiaffine/volume/internal/bspline.h>

#include <array>
#include <cstddef>
#include <utility>

namespace equiaffine::internal {

/// Calls f(0), ..., f(N - 1) with constant arguments, so that arrays indexed by them stay in registers.
template <int N, class F>
void unrolled(F f) {
  [&]<int... I>(std::integer_sequence<int, I...>) { (f(std::integral_constant<int, I>()), ...); }
  (std::make_integer_sequence<int, N>());
}

/// The Taylor coefficients at t in [0, 1] of the n + 1 B-splines of a cell: row d has the d-th derivatives / d!.
template <int Degree, int Order, class FT>
struct Bspline_taylor {
  static constexpr int width = Spline_pack<FT>::round_up(Degree + 1);
  FT rows[Order + 1][width];

  /// Horner's scheme, extended to derivatives, with a B-spline in each lane.
  explicit Bspline_taylor(FT t) {
    static constexpr auto basis = bspline_basis_polynomials<FT, Degree, width>();
    const FT s = t - FT(0.5);
    for (int r = 0; r < width; r += Spline_pack<FT>::lanes) {
      typename Spline_pack<FT>::type b[Order + 1] = {};
      b[0] = Spline_pack<FT>::load(basis[Degree].data() + r);
      unrolled<Degree>([&](auto step) {
        unrolled<Order>([&](auto e) { b[Order - e] = b[Order - e] * s + b[Order - e - 1]; });
        b[0] = b[0] * s + Spline_pack<FT>::load(basis[Degree - 1 - step].data() + r);
      });
      unrolled<Order + 1>([&](auto d) { Spline_pack<FT>::store(b[d], rows[d] + r); });
    }
  }
};

/// The contraction of the coefficients of a cell with the Taylor coefficients of the B-splines, one axis at a time:
/// along z for every order k, then along y for orders j + k <= Order, then along x for i + j + k <= Order.
///
/// The first two passes have neighbors along x in the lanes of a pack, so that coefficients are read once and in
/// whole rows; the last pass has the orders i in the lanes.
template <int Degree, int Order, class FT>
struct Cell_contraction {
  using Lanes = Spline_pack<FT>;
  using Pack = typename Lanes::type;
  using Taylor = Bspline_taylor<Degree, Order, FT>;
  static constexpr int taps = Degree + 1, orders = Order + 1, width = Taylor::width;

  using Columns = Pack[orders][taps];      ///< [k][y]
  using Lines = FT[orders][orders][width]; ///< [k][j][x]

  /// Sums along z of a pack of columns whose first coefficients are at `c`, `c + row`, ..., one for each y.
  static void along_z(const FT* c, std::size_t row, std::size_t slab, const Taylor& bz, Columns& columns) {
    for (int y = 0; y < taps; ++y) {
      Pack sum[orders] = {};
      for (int z = 0; z < taps; ++z) {
        const auto pack = Lanes::load(c + std::size_t(z) * slab + std::size_t(y) * row);
        unrolled<orders>([&](auto k) { sum[k] += bz.rows[k][z] * pack; });
      }
      unrolled<orders>([&](auto k) { columns[k][y] = sum[k]; });
    }
  }

  /// Sums along y, which are stored in `lines` from x on.
  static void along_y(const Columns& columns, const Taylor& by, Lines& lines, int x) {
    unrolled<orders>([&](auto k) {
      Pack sum[orders - k] = {};
      for (int y = 0; y < taps; ++y) unrolled<orders - k>([&](auto j) { sum[j] += by.rows[j][y] * columns[k][y]; });
      unrolled<orders - k>([&](auto j) { Lanes::store(sum[j], lines[k][j] + x); });
    });
  }

  /// Sums along x, which are the Taylor coefficients.
  static void along_x(const Lines& lines, const Taylor& bx,
                      std::array<FT, std::size_t(number_of_monomials(Order))>& taylor) {
    FT transposed[taps][Lanes::round_up(orders)] = {}; // [x][i]
    for (int x = 0; x < taps; ++x)
      for (int i = 0; i < orders; ++i) transposed[x][i] = bx.rows[i][x];
    unrolled<orders>([&](auto k) {
      unrolled<orders - k>([&](auto j) {
        constexpr int count = orders - k - j, packs = Lanes::round_up(count) / Lanes::lanes;
        Pack sum[packs] = {};
        for (int x = 0; x < taps; ++x)
          unrolled<packs>([&](auto p) { sum[p] += lines[k][j][x] * Lanes::load(transposed[x] + p * Lanes::lanes); });
        unrolled<count>(
            [&](auto i) { taylor[std::size_t(monomial_index(i, j, k))] = sum[i / Lanes::lanes][i % Lanes::lanes]; });
      });
    });
  }
};

/// The same contraction in loops, which compile much faster, for orders that few points need.
template <int Degree, int Order, class FT>
void contract_in_loops(const FT* c, std::size_t row, std::size_t slab, const std::array<FT, 3>& t,
                       std::array<FT, std::size_t(number_of_monomials(Order))>& taylor) {
  constexpr std::size_t taps = Degree + 1;
  const Bspline_taylor<Degree, Order, FT> bx(t[0]), by(t[1]), bz(t[2]);
  taylor.fill(FT(0));
  for (std::size_t x = 0; x < taps; ++x)
    for (int k = 0; k <= Order; ++k) {
      std::array<FT, taps> column = {};
      for (std::size_t y = 0; y < taps; ++y)
        for (std::size_t z = 0; z < taps; ++z) column[y] += bz.rows[k][z] * c[x + y * row + z * slab];
      for (int j = 0; j + k <= Order; ++j) {
        FT line(0);
        for (std::size_t y = 0; y < taps; ++y) line += by.rows[j][y] * column[y];
        for (int i = 0; i + j + k <= Order; ++i) taylor[std::size_t(monomial_index(i, j, k))] += bx.rows[i][x] * line;
      }
    }
}

/// Taylor coefficients of total order <= `Order` of the tensor product spline, in lattice coordinates, at the offset
/// t in [0, 1]^3 of a cell. Its (n + 1)^3 coefficients begin at `*c` and are 1, `row` and `slab` apart along x, y,
/// and z.
template <int Degree, int Order, class FT>
void contract(const FT* c, std::size_t row, std::size_t slab, const std::array<FT, 3>& t,
              std::array<FT, std::size_t(number_of_monomials(Order))>& taylor) {
  if constexpr (Order > default_order) {
    contract_in_loops<Degree, Order>(c, row, slab, t, taylor);
  } else {
    using Contraction = Cell_contraction<Degree, Order, FT>;
    const Bspline_taylor<Degree, Order, FT> bx(t[0]), by(t[1]), bz(t[2]);
    typename Contraction::Lines lines;
    for (int x = 0; x < Contraction::width; x += Spline_pack<FT>::lanes) {
      typename Contraction::Columns columns;
      Contraction::along_z(c + x, row, slab, bz, columns);
      Contraction::along_y(columns, by, lines, x);
    }
    Contraction::along_x(lines, bx, taylor);
  }
}

} // namespace equiaffine::internal

#endif
