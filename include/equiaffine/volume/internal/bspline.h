// SPDX-License-Identifier: GPL-3.0-or-later
// Cardinal B-splines, and the filters that compute their coefficients from a line of samples.
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_H
#define EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_H

#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Volume_options.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace equiaffine::internal {

/// A pack of the numbers that fill a register of the target, in the vector extension that g++ and clang share.
template <class FT>
struct Spline_pack {
#if defined(__AVX512F__)
  static constexpr int bytes = 64;
#elif defined(__AVX__)
  static constexpr int bytes = 32;
#else
  static constexpr int bytes = 16;
#endif
  static constexpr int lanes = bytes / int(sizeof(FT));
  typedef FT type __attribute__((vector_size(bytes)));

  static type load(const FT* from) {
    type pack;
    std::memcpy(&pack, from, sizeof pack);
    return pack;
  }
  static void store(const type& pack, FT* to) { std::memcpy(to, &pack, sizeof pack); }

  /// The smallest multiple of `lanes` that is at least n.
  static constexpr int round_up(int n) { return (n + lanes - 1) / lanes * lanes; }
};

/// The number of entries past the last coefficient that an evaluation may read without using their values: the size
/// of the largest pack of any target.
inline constexpr std::size_t overread = 16;

// Centered cardinal B-splines of odd degree n in one variable: their polynomials on a cell, and the local filters
// that turn samples at the integers into spline coefficients. Lengths are in steps of the grid.

/// The number of coefficients beyond each border of the samples. With floor(n / 2), every cell has n + 1
/// coefficients.
constexpr int spline_padding(int degree) { return degree / 2; }

/// The n + 1 B-splines that do not vanish on the cell [0, 1], as polynomials in s = t - 1/2: `basis[p][r]` is the
/// coefficient of s^p in the B-spline centered at r - floor(n / 2). Rows have `Width` >= n + 1 entries, padded with
/// zeros.
///
/// The Cox-de Boor recursion in the variable 2s has integer coefficients, so every entry is rounded once. Powers of
/// s, rather than of t, are at most 2^-p, so that Horner's scheme loses no accuracy at the end of the cell.
template <class FT, int Degree, int Width>
constexpr auto bspline_basis_polynomials() {
  static_assert(Degree % 2 == 1 && Degree <= 9 && Width > Degree);
  long long pieces[Degree + 1][Degree + 1] = {}; // [piece q on [q, q + 1]][power of 2s]
  pieces[0][0] = 1;
  long long denominator = 1; // 2^n n!
  for (int n = 1; n <= Degree; ++n) {
    denominator *= 2 * n;
    for (int q = n; q >= 0; --q) // P_q <- (2s + 1 + 2q) P_q + (2n + 1 - 2q - 2s) P_{q-1}, from the last piece down
      for (int p = n; p >= 0; --p) {
        long long sum = (1 + 2 * q) * pieces[q][p] + (p > 0 ? pieces[q][p - 1] : 0);
        if (q > 0) sum += (2 * n + 1 - 2 * q) * pieces[q - 1][p] - (p > 0 ? pieces[q - 1][p - 1] : 0);
        pieces[q][p] = sum;
      }
  }
  std::array<std::array<FT, Width>, Degree + 1> basis{};
  for (std::size_t p = 0; p <= Degree; ++p)
    for (std::size_t r = 0; r <= Degree; ++r) basis[p][r] = FT(pieces[Degree - r][p]) * FT(1LL << p) / FT(denominator);
  return basis;
}

/// The maximum degree of the polynomials that extend samples beyond a border.
inline constexpr int greatest_border_degree = 9;

/// A local linear map from the samples f_0 .. f_{N-1} of a line to coefficients c_{-m} .. c_{N-1+m}, m = floor(n / 2).
///
/// Inside, c_i = sum_s weights[|s|] f_{i+s}, |s| <= radius. Near a border the missing samples are those of the
/// polynomial of degree d >= n through the d + 1 samples nearest to that border. This is linear in the samples: c_i =
/// sum_j border[m + i][j] f_j for i < radius, and the mirror image at the other end. Polynomials of degree n are
/// hence treated at the border as inside, which keeps the order of every derivative. For quasi-interpolation, d may
/// be min(n + 2, 9, N - 1): with d = n, the errors of affine curvatures at the border are a thousand times those
/// inside for a wave of 24 samples. A larger d magnifies noise. Steps are not polynomials and are extended by
/// constants (Volume_survey.h chooses). Other extensions lose the order: repeating or mirroring samples causes a kink
/// at the border and zeros cause a jump, so that the value has order 1 or 0 and fourth derivatives grow as h^-3 or
/// h^-4. Excluding the cells whose coefficients reach beyond the border would cost n - 1 cells per axis.
template <class FT, int Degree>
struct Line_filter {
  static constexpr int padding = spline_padding(Degree);
  int radius = 0;
  std::array<FT, padding + 1> weights{FT(1)};
  using Border = std::array<std::array<FT, greatest_border_degree + 1>, 2 * padding>;
  int border_degree = Degree; ///< d in lines of more than d nodes
  Border border{};            ///< the weights at the border for this d

  /// The filter with coefficients = samples. The spline of a polynomial p is the convolution of p with the B-spline:
  /// order 2.
  static constexpr Line_filter convolution() {
    Line_filter filter;
    filter.border = filter.border_weights(Degree);
    return filter;
  }

  /// Local quasi-interpolation of order n + 1, which reproduces polynomials of degree <= n.
  ///
  /// On these polynomials, the sum over the grid is the convolution with the B-spline (Strang and Fix 1971), that is,
  /// the operator (sinh(D/2) / (D/2))^(n+1). In terms of the central difference delta = 2 sinh(D/2), its inverse is
  /// (arcsinh(delta/2) / (delta/2))^(n+1), an even power series in delta. It is truncated after delta^(2m), because
  /// the next term annihilates polynomials of degree n.
  static constexpr Line_filter quasi_interpolation(int border_degree) {
    Line_filter filter;
    filter.radius = padding;
    filter.border_degree = border_degree;
    filter.weights = weights_of_differences(inverse_of_smoothing());
    filter.border = filter.border_weights(border_degree);
    return filter;
  }

  /// The same with the end samples repeated beyond the border.
  static constexpr Line_filter quasi_interpolation_of_steps() {
    Line_filter filter = quasi_interpolation(Degree);
    filter.border = {};
    for (int i = -padding; i < filter.radius; ++i)
      for (int s = -filter.radius; s <= filter.radius; ++s)
        filter.border[std::size_t(padding + i)][std::size_t(std::max(i + s, 0))] +=
            filter.weights[std::size_t(s < 0 ? -s : s)];
    return filter;
  }

  /// Filters a line whose elements are rows of `width` numbers: samples i = 0 .. count - 1 at `samples + i width`,
  /// coefficients i = -m .. count - 1 + m at `coefficients + (i + m) stride`. Precondition: count > Degree.
  void apply(const FT* samples, std::size_t count, std::size_t width, FT* coefficients, std::size_t stride) const {
    apply_to_part(samples, {0, count}, count, width, {0, count + 2 * std::size_t(padding)}, coefficients, stride);
  }

  /// The samples on which a part of the coefficients depends, in a line of `count` samples. Here and in
  /// apply_to_part(), index 0 is the first coefficient, c_{-m}.
  Line_part samples_of(const Line_part& part, std::size_t count) const {
    const auto r = std::size_t(radius), m = std::size_t(padding);
    const std::size_t used = std::min(count, std::size_t(border_degree) + 1); // by each coefficient at a border
    Line_part samples = {part.first < r + m ? 0 : part.first - r - m,
                         part.end + r < m ? 0 : std::min(part.end + r - m, count)};
    if (part.first < r + m) samples.end = std::max(samples.end, used);
    if (part.end + r > count + m) samples.first = std::min(samples.first, count - used);
    return samples;
  }

  /// Does a part of apply(): `samples` points to the first of the `given` samples, which include samples_of(part),
  /// and `coefficients` to the first coefficient of the part. The coefficients have the same bits for every part.
  void apply_to_part(const FT* samples, const Line_part& given, std::size_t count, std::size_t width,
                     const Line_part& part, FT* coefficients, std::size_t stride) const {
    if (count > std::size_t(border_degree))
      apply_border(border, samples, given, count, width, part, coefficients, stride);
    else apply_border(border_weights(int(count) - 1), samples, given, count, width, part, coefficients, stride);

    const std::size_t reach = std::size_t(radius) + std::size_t(padding), all = count + 2 * std::size_t(padding);
    const std::size_t first = std::max(part.first, reach), end = std::min(part.end, all - reach);
    if (first >= end) return;
    const FT* const center = samples + (first - std::size_t(padding) - given.first) * width;
    FT* const row = coefficients + (first - part.first) * stride;
    const bool is_packed = stride == width; // then all rows are contiguous
    const std::size_t rows = is_packed ? 1 : end - first, length = is_packed ? (end - first) * width : width;
    for (std::size_t i = 0; i < rows; ++i)
      if (radius == 0) combine<0>(center + i * width, width, length, row + i * stride);
      else combine<padding>(center + i * width, width, length, row + i * stride);
  }

private:
  using Pack = Spline_pack<FT>;
  using Weights = std::array<FT, padding + 1>;

  /// The coefficients of the power series (arcsinh(delta/2) / (delta/2))^(n+1) in delta^2.
  static constexpr Weights inverse_of_smoothing() {
    Weights series{FT(1)};
    Weights arcsinh{FT(1)};
    for (std::size_t k = 1; k <= padding; ++k) // arcsinh(x)/x = sum_k a_k x^2k, a_k / a_{k-1} = -(2k-1)^2 / (2k (2k+1))
      arcsinh[k] = -arcsinh[k - 1] * FT((2 * k - 1) * (2 * k - 1)) / FT(4 * 2 * k * (2 * k + 1));
    for (int power = 0; power <= Degree; ++power)
      for (std::size_t k = padding + 1; k-- > 0;) {
        FT sum = 0;
        for (std::size_t l = 0; l <= k; ++l) sum += arcsinh[l] * series[k - l];
        series[k] = sum;
      }
    return series;
  }

  /// The weights of the samples in sum_k series[k] delta^2k f, where delta^2 f_i = f_{i-1} - 2 f_i + f_{i+1}.
  static constexpr Weights weights_of_differences(const Weights& series) {
    Weights weights{};
    std::array<FT, padding + 2> difference{FT(1)}; // the right half of delta^2k, which is symmetric
    for (std::size_t k = 0; k <= padding; ++k) {
      for (std::size_t s = 0; s <= k; ++s) weights[s] += series[k] * difference[s];
      FT left = difference[1]; // the left neighbor of the entry at s = 0, by symmetry
      for (std::size_t s = 0; s <= k + 1 && s <= padding; ++s) {
        const FT center = difference[s];
        difference[s] = left - 2 * center + difference[s + 1];
        left = center;
      }
    }
    return weights;
  }

  /// Writes `length` weighted sums of each number and those up to `Reach` times `width` before and after it.
  template <int Reach>
  void combine(const FT* center, std::size_t width, std::size_t length, FT* sums) const {
    const Weights w = weights; // a local copy, which the sums cannot alias
    std::size_t x = 0;
    for (; x + std::size_t(Pack::lanes) <= length; x += std::size_t(Pack::lanes)) {
      typename Pack::type sum = w[0] * Pack::load(center + x);
      for (int s = 1; s <= Reach; ++s)
        sum += w[std::size_t(s)] *
               (Pack::load(center + x - std::size_t(s) * width) + Pack::load(center + x + std::size_t(s) * width));
      Pack::store(sum, sums + x);
    }
    for (; x < length; ++x) {
      FT sum = w[0] * center[x];
      for (int s = 1; s <= Reach; ++s)
        sum += w[std::size_t(s)] * ((center - std::size_t(s) * width)[x] + (center + std::size_t(s) * width)[x]);
      sums[x] = sum;
    }
  }

  /// Computes the coefficients at and beyond the borders, in a part of the line.
  void apply_border(const Border& at_border, const FT* samples, const Line_part& given, std::size_t count,
                    std::size_t width, const Line_part& part, FT* coefficients, std::size_t stride) const {
    const std::size_t rows = std::size_t(radius) + std::size_t(padding);
    const std::size_t last = count - 1 + 2 * std::size_t(padding);
    const std::size_t used = std::min(count, std::size_t(border_degree) + 1);
    const auto sum_up = [&](std::size_t coefficient, std::size_t end, const auto& sample) {
      if (coefficient < part.first || coefficient >= part.end) return;
      FT* const row = coefficients + (coefficient - part.first) * stride;
      const auto weights_of_end = at_border[end]; // a local copy, which the sums cannot alias
      const auto from = [&](std::size_t j) { return samples + (sample(j) - given.first) * width; };
      std::size_t x = 0;
      for (; x + std::size_t(Pack::lanes) <= width; x += std::size_t(Pack::lanes)) {
        typename Pack::type sum = {};
        for (std::size_t j = 0; j < used; ++j) sum += weights_of_end[j] * Pack::load(from(j) + x);
        Pack::store(sum, row + x);
      }
      for (; x < width; ++x) {
        FT sum = 0;
        for (std::size_t j = 0; j < used; ++j) sum += weights_of_end[j] * from(j)[x];
        row[x] = sum;
      }
    };
    for (std::size_t end = 0; end < rows; ++end) {
      sum_up(end, end, [](std::size_t j) { return j; });
      sum_up(last - end, end, [&](std::size_t j) { return count - 1 - j; });
    }
  }

  /// The weight of f_j in the value at the integer x of the polynomial through f_0 .. f_d (Lagrange). Numerator and
  /// denominator are products of integers and exact.
  static constexpr FT lagrange(int d, int j, int x) {
    FT numerator = 1;
    FT denominator = 1;
    for (int i = 0; i <= d; ++i)
      if (i != j) {
        numerator *= FT(x - i);
        denominator *= FT(j - i);
      }
    return numerator / denominator;
  }

  /// The weights of the samples in the coefficients at a border, for the polynomial of degree d.
  constexpr Border border_weights(int d) const {
    Border result{};
    for (int i = -padding; i < radius; ++i)
      for (int j = 0; j <= d; ++j) {
        FT sum = 0;
        for (int s = -radius; s <= radius; ++s) sum += weights[std::size_t(s < 0 ? -s : s)] * lagrange(d, j, i + s);
        result[std::size_t(padding + i)][std::size_t(j)] = sum;
      }
    return result;
  }
};

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

/// The recursive filter from the samples of a line to the coefficients of the spline of odd degree n that
/// interpolates them (Unser, Aldroubi, Eden: B-spline signal processing, 1993). As for Line_filter, the missing
/// samples at a border are those of the polynomial of degree n through the nearest n + 1 samples. The recursion
/// starts with its exact sum for this polynomial, so that polynomials of degree n are reproduced up to the border.
template <class FT, int Degree>
struct Interpolation_filter {
  static constexpr int padding = spline_padding(Degree);

  /// Filters a line, see Line_filter::apply.
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
  /// Runs y_i = (1 - z) x_i + z y_{i-1} in place over `rows` rows. The runs in both directions preserve constants,
  /// and together they invert the factor with the roots z and 1 / z of the polynomial of `bspline_poles`.
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

/// Calls f(filter) with the filter of a scheme. Only quasi-interpolation depends on the border degree.
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

namespace equiaffine {

/// The centered cardinal B-spline of odd degree n <= 9 at t. Its knots are the integers from -(n + 1) / 2 to (n + 1)
/// / 2, and it is 0 outside; its integer shifts sum to 1. Evaluated by the cell polynomials that the splines of this
/// library use.
template <int Degree, class FT>
FT bspline(FT t) {
  static constexpr auto basis = internal::bspline_basis_polynomials<FT, Degree, Degree + 1>();
  const int cell = int(std::floor(t)), r = internal::spline_padding(Degree) - cell;
  if (r < 0 || r > Degree) return 0;
  FT value = 0;
  for (int p = Degree; p >= 0; --p) value = value * (t - FT(cell) - FT(0.5)) + basis[std::size_t(p)][std::size_t(r)];
  return value;
}

} // namespace equiaffine

#endif
