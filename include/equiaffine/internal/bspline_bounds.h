// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_BSPLINE_BOUNDS_H
#define EQUIAFFINE_INTERNAL_BSPLINE_BOUNDS_H

#include <equiaffine/Interval.h>
#include <equiaffine/internal/bspline_evaluation.h>
#include <equiaffine/internal/parallel_for.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

// Derivatives of a B-spline of degree n are B-splines of lower degree whose coefficients are differences of its own. As
// B-splines are not negative and sum to one, the range of those that do not vanish on a cell contains the values there.
namespace equiaffine::internal {

/// The rounding error of a value computed by `contract`, relative to the largest coefficient; that of a d-th derivative
/// in index space is at most (2n)^d times as large. Sums of the sizes of all terms are bounded, at |s| = 1/2, and each
/// term has been rounded 3n + 1 times in Horner's scheme, n times in s and n + 2 times in the contraction, per axis.
template <int Degree, class FT>
constexpr FT relative_error_of_value() {
  constexpr auto basis = bspline_basis_polynomials<FT, Degree, Degree + 1>();
  FT sum = 0;
  for (int p = 0; p <= Degree; ++p)
    for (const FT b : basis[p]) sum += (b < 0 ? -b : b) / FT(1LL << p);
  return FT(3 * (5 * Degree + 3)) * std::numeric_limits<FT>::epsilon() * sum * sum * sum;
}

template <class FT>
struct Coefficient_range {
  FT least = std::numeric_limits<FT>::infinity(), greatest = -least; // of numbers; none is compared with NaN
  bool is_finite = true;

  bool is_empty() const { return least > greatest; }
  FT size() const { return std::max(std::abs(least), std::abs(greatest)); }

  void add(const Coefficient_range& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
    is_finite = is_finite && other.is_finite;
  }
};

/// Of the differences of order 0, 1 (along the step s) or 2 (along s and t) that start at the coefficients from `*c`
/// on, `count` along x, y and z; they are finite or NaN.
template <int Order, class FT>
Coefficient_range<FT> range_of_differences(const FT* c, std::size_t row, std::size_t slab,
                                           const std::array<std::size_t, 3>& count, std::size_t s = 0,
                                           std::size_t t = 0) {
  using Lanes = Pack<FT>;
  const auto difference = [s, t](const auto& at) {
    if constexpr (Order == 0) return at(0);
    else if constexpr (Order == 1) return at(s) - at(0);
    else return (at(s + t) - at(s)) - (at(t) - at(0));
  };
  Coefficient_range<FT> range;
  typename Lanes::type least = range.least - typename Lanes::type{}, greatest = -least, zero = {};
  FT zero_at_end = 0;
  for (std::size_t z = 0; z < count[2]; ++z)
    for (std::size_t y = 0; y < count[1]; ++y) {
      const FT* line = c + z * slab + y * row;
      std::size_t x = 0;
      for (; x + Lanes::lanes <= count[0]; x += Lanes::lanes) {
        const auto d = difference([&](std::size_t n) { return Lanes::load(line + x + n); });
        least = d < least ? d : least;
        greatest = d > greatest ? d : greatest;
        zero += d - d;
      }
      for (; x < count[0]; ++x) {
        const FT d = difference([&](std::size_t n) { return line[x + n]; });
        range.least = d < range.least ? d : range.least;
        range.greatest = d > range.greatest ? d : range.greatest;
        zero_at_end += d - d;
      }
    }
  range.is_finite = zero_at_end == 0;
  for (int lane = 0; lane < Lanes::lanes; ++lane) range.add({least[lane], greatest[lane], zero[lane] == 0});
  return range;
}

/// The ranges of coefficients, and of their differences along x, y and z, in blocks of 8 x 8 x 8: for boxes of many.
template <class FT>
class Coefficient_blocks {
public:
  using Ranges = std::array<Coefficient_range<FT>, 4>;

  Coefficient_blocks(const FT* c, const std::array<std::size_t, 3>& size) {
    for (std::size_t a = 0; a < 3; ++a) size_[a] = (size[a] - 1) / side + 1;
    blocks_.resize(size_[0] * size_[1] * size_[2]);
    const std::array<std::size_t, 3> strides = {1, size[0], size[0] * size[1]};
    parallel_for<CGAL::Parallel_if_available_tag>(0, blocks_.size(), [&](std::size_t n) {
      const std::array<std::size_t, 3> block = {n % size_[0], n / size_[0] % size_[1], n / size_[0] / size_[1]};
      std::array<std::size_t, 3> count;
      for (std::size_t a = 0; a < 3; ++a) count[a] = std::min(side, size[a] - side * block[a]);
      const FT* first = c + side * (block[0] + block[1] * strides[1] + block[2] * strides[2]);
      blocks_[n][0] = range_of_differences<0>(first, strides[1], strides[2], count);
      for (std::size_t a = 0; a < 3; ++a) {
        auto starts = count;
        if (side * block[a] + count[a] == size[a]) --starts[a];
        blocks_[n][1 + a] = range_of_differences<1>(first, strides[1], strides[2], starts, strides[a]);
      }
    });
  }

  /// Contains the ranges of those from `first` to `last`.
  Ranges ranges(const std::array<std::size_t, 3>& first, const std::array<std::size_t, 3>& last) const {
    Ranges ranges;
    for (std::size_t k = first[2] / side; k <= last[2] / side; ++k)
      for (std::size_t j = first[1] / side; j <= last[1] / side; ++j)
        for (std::size_t i = first[0] / side; i <= last[0] / side; ++i)
          for (std::size_t n = 0; n < 4; ++n) ranges[n].add(blocks_[(k * size_[1] + j) * size_[0] + i][n]);
    return ranges;
  }

private:
  static constexpr std::size_t side = 8;

  std::array<std::size_t, 3> size_;
  std::vector<Ranges> blocks_;
};

/// Infinity, which no number is.
inline Interval no_values() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return Interval(infinity, infinity);
}

/// A box in lattice coordinates, and the first and the last coefficients that count there.
template <class FT>
struct Bspline_box {
  std::array<FT, 3> lower, upper;
  std::array<std::size_t, 3> first, last;

  bool has_at_most(std::size_t count) const {
    return last[0] - first[0] < count && last[1] - first[1] < count && last[2] - first[2] < count;
  }
};

/// Bounds of a spline and of its gradient on boxes, in lattice coordinates; also of the numbers as computed. The
/// coefficients, `size` along each axis, are given to each call, always the same ones; copies share what is kept of
/// them.
template <class FT>
class Bspline_bounds {
public:
  using Box = Bspline_box<FT>;

  Bspline_bounds(int degree, FT relative_error_of_value, const std::array<std::size_t, 3>& size)
      : degree_(degree), relative_error_(relative_error_of_value), size_(size) {}

  Coefficient_range<FT> values(const FT* c, const Box& box) const {
    return is_large(box) ? blocks(c).ranges(box.first, box.last)[0] : range_of<0>(c, box);
  }

  /// Of values in a range of coefficients.
  Interval bound(const Coefficient_range<FT>& range) const {
    return range.is_empty() ? no_values() : widened(range, relative_error_ * range.size());
  }

  /// Of the value and the gradient. Where there is a coefficient NaN, nothing is known of the latter. In boxes of few
  /// cells they also are bounded from the center, by bounds of the second derivatives; `taylor(u)` is the expansion of
  /// order 1 at lattice coordinates u in the box.
  template <class Taylor>
  std::array<Interval, 4> first_order(const FT* c, const Box& box, const Taylor& taylor) const {
    typename Coefficient_blocks<FT>::Ranges ranges;
    if (is_large(box)) ranges = blocks(c).ranges(box.first, box.last);
    else ranges = {range_of<0>(c, box), range_of<1>(c, box, 0), range_of<1>(c, box, 1), range_of<1>(c, box, 2)};
    std::array<Interval, 4> bounds = {bound(ranges[0]), Interval::whole(), Interval::whole(), Interval::whole()};
    if (!ranges[0].is_finite) {
      if (has_no_values(c, box)) bounds[0] = no_values();
      return bounds;
    }
    const FT error = relative_error_ * ranges[0].size();
    for (std::size_t a = 0; a < 3; ++a) bounds[1 + a] = widened(ranges[1 + a], FT(2 * degree_) * error);
    if (box.has_at_most(std::size_t(2 * degree_))) bound_from_center(c, box, error, taylor, bounds);
    return bounds;
  }

private:
  static Interval widened(const Coefficient_range<FT>& range, FT error) {
    return Interval::widened(double(range.least) - double(error), double(range.greatest) + double(error));
  }

  static bool is_large(const Box& box) { return !box.has_at_most(32); }

  /// Whether one of the coefficients that count everywhere in the box is NaN.
  bool has_no_values(const FT* c, Box box) const {
    const auto reach = std::size_t(degree_);
    if (!box.has_at_most(2 * reach + 1)) return false;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t first = box.first[a];
      box.first[a] = box.last[a] - reach;
      box.last[a] = first + reach;
    }
    return !range_of<0>(c, box).is_finite;
  }

  /// Of the derivatives along the given axes.
  template <int Order>
  Coefficient_range<FT> range_of(const FT* c, const Box& box, std::size_t a = 0, std::size_t b = 0) const {
    const std::array<std::size_t, 3> strides = {1, size_[0], size_[0] * size_[1]};
    std::array<std::size_t, 3> count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      c += box.first[axis] * strides[axis];
      count[axis] = box.last[axis] - box.first[axis] + 1;
    }
    if (Order > 0) --count[a];
    if (Order > 1) --count[b];
    return range_of_differences<Order>(c, strides[1], strides[2], count, strides[a], strides[b]);
  }

  /// By the mean value theorem, for the value and for each derivative.
  template <class Taylor>
  void bound_from_center(const FT* c, const Box& box, FT error, const Taylor& taylor,
                         std::array<Interval, 4>& bounds) const {
    std::array<FT, 3> center;
    std::array<Interval, 3> offset;
    for (std::size_t a = 0; a < 3; ++a) {
      center[a] = (box.lower[a] + box.upper[a]) / 2;
      offset[a] = Interval(double(box.lower[a]), double(box.upper[a])) - Interval(center[a]);
    }
    const auto jet = taylor(center);
    std::array<Interval, 4> sum;
    for (std::size_t n = 0; n < 4; ++n) {
      const double rounding = (n == 0 ? 2 : 4 * degree_) * double(error); // of what is computed here, and there
      sum[n] = Interval::widened(double(jet.coefficients()[n]) - rounding, double(jet.coefficients()[n]) + rounding);
    }
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a; b < 3; ++b) {
        const Interval second = widened(range_of<2>(c, box, a, b), error);
        sum[1 + a] += second * offset[b];
        if (a != b) sum[1 + b] += second * offset[a];
      }
    for (std::size_t a = 0; a < 3; ++a) {
      bounds[1 + a] = Interval::intersection(bounds[1 + a], sum[1 + a]);
      sum[0] += bounds[1 + a] * offset[a];
    }
    bounds[0] = Interval::intersection(bounds[0], sum[0]);
  }

  const Coefficient_blocks<FT>& blocks(const FT* c) const {
    std::call_once(blocks_->once, [&] { blocks_->ranges.emplace(c, size_); });
    return *blocks_->ranges;
  }

  struct Blocks {
    std::once_flag once;
    std::optional<Coefficient_blocks<FT>> ranges;
  };

  int degree_;
  FT relative_error_;
  std::array<std::size_t, 3> size_;
  std::shared_ptr<Blocks> blocks_ = std::make_shared<Blocks>(); // made when first needed
};

} // namespace equiaffine::internal

#endif
