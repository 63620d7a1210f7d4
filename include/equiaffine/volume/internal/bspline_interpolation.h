// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_INTERPOLATION_H
#define EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_INTERPOLATION_H

#include <equiaffine/volume/Spline_scheme.h>
#include <equiaffine/volume/internal/bspline.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

namespace equiaffine::internal {

/// The roots in (-1, 0) of the polynomial whose coefficients are the values of the B-spline at the integers.
template <class FT, int Degree>
inline constexpr std::array<FT, std::size_t(spline_padding(Degree))> bspline_poles = {};
template <class FT>
inline constexpr std::array<FT, 2> bspline_poles<FT, 5> = {FT(-0.430575347099973791851434783493520110),
                                                           FT(-0.0430962882032646536)};
template <class FT>
inline constexpr std::array<FT, 3> bspline_poles<FT, 7> = {FT(-0.535280430796438165542403781681646072),
                                                           FT(-0.122554615192326690515272264359357344),
                                                           FT(-0.00914869480960827692859302165164785342)};
template <class FT>
inline constexpr std::array<FT, 4> bspline_poles<FT, 9> = {
    FT(-0.607997389168625779007720823954289769), FT(-0.201750520193153238796064685055970435),
    FT(-0.0432226085404817521333211429794296883), FT(-0.00212130690318081842030489655784862342)};

/// The recursive filter from the samples of a line to the coefficients of the spline of odd degree n that has them as
/// values (Unser, Aldroubi, Eden: B-spline signal processing, 1993). As for Line_filter, the samples that are missing
/// at a border are those of the polynomial of degree n through the nearest n + 1; the recursion starts with its exact
/// sum for this polynomial, so that polynomials of degree n are reproduced to the border.
template <class FT, int Degree>
struct Interpolation_filter {
  static constexpr int padding = spline_padding(Degree);

  /// Filters a line as Line_filter::apply does.
  void apply(const FT* samples, std::size_t count, std::size_t width, FT* coefficients, std::size_t stride) const {
    static constexpr auto extension = Line_filter<FT, Degree>::convolution();
    extension.apply(samples, count, width, coefficients, stride);
    const std::size_t rows = count + 2 * std::size_t(padding);
    for (const FT z : bspline_poles<FT, Degree>) {
      run(coefficients, std::ptrdiff_t(stride), rows, width, z);
      run(coefficients + (rows - 1) * stride, -std::ptrdiff_t(stride), rows, width, z);
    }
  }

private:
  /// Runs y_i = (1 - z) x_i + z y_{i-1} in place over `rows` rows. The runs in both directions leave constants as they
  /// are, and together they invert the factor with the roots z and 1 / z of the polynomial of `bspline_poles`.
  static void run(FT* first, std::ptrdiff_t stride, std::size_t rows, std::size_t width, FT z) {
    const auto start = starting_weights(z);
    for (std::size_t x = 0; x < width; ++x) {
      FT sum = 0;
      for (int j = 0; j <= Degree; ++j) sum += start[std::size_t(j)] * first[j * stride + std::ptrdiff_t(x)];
      first[x] = sum;
    }
    for (std::size_t i = 1; i < rows; ++i) {
      FT* const row = first + std::ptrdiff_t(i) * stride;
      const FT* const last = row - stride;
      for (std::size_t x = 0; x < width; ++x) row[x] = (1 - z) * row[x] + z * last[x];
    }
  }

  /// The weights of x_0 .. x_n in y_0 = (1 - z) sum_t z^t x_{-t} for a polynomial x of degree n. By Newton's formula
  /// x_{-t} is the sum of binomial(-t, k) (Delta^k x)_0, and sum_t z^t binomial(-t, k) = (-1)^k z / (1 - z)^(k+1) for
  /// k > 0.
  static std::array<FT, Degree + 1> starting_weights(FT z) {
    std::array<FT, Degree + 1> weights{FT(1)}, binomial{FT(1)};
    FT power = z; // z / (1 - z)^k
    for (std::size_t k = 1; k <= Degree; ++k) {
      power /= 1 - z;
      for (std::size_t j = k; j > 0; --j) binomial[j] += binomial[j - 1];
      for (std::size_t j = 0; j <= k; ++j) weights[j] += (j % 2 ? -power : power) * binomial[j];
    }
    return weights;
  }
};

/// Calls f(filter) with the filter of a scheme. Only quasi-interpolation has a choice of the degree at the border.
template <class FT, int Degree, class F>
void with_line_filter(Spline_scheme scheme, int border_degree, F f) {
  using Filter = Line_filter<FT, Degree>;
  static constexpr auto convolution = Filter::convolution();
  static constexpr auto constant = Filter::quasi_interpolation_of_steps();
  static constexpr auto lesser = Filter::quasi_interpolation(Degree);
  static constexpr auto greater = Filter::quasi_interpolation(std::min(Degree + 2, greatest_border_degree));
  if (scheme == Spline_scheme::INTERPOLATION) f(Interpolation_filter<FT, Degree>());
  else if (scheme != Spline_scheme::QUASI_INTERPOLATION) f(convolution);
  else f(border_degree == 0 ? constant : border_degree > Degree ? greater : lesser);
}

/// Returns f(n) with a constant n for a degree of 5, 7 or 9.
template <class F>
auto with_degree(int degree, F f) {
  if (degree == 5) return f(std::integral_constant<int, 5>());
  if (degree == 7) return f(std::integral_constant<int, 7>());
  return f(std::integral_constant<int, 9>());
}

} // namespace equiaffine::internal

#endif
