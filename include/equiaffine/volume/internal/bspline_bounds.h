// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_BOUNDS_H
#define EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_BOUNDS_H

#include <equiaffine/number/Interval.h>
#include <equiaffine/volume/internal/Bspline_on_box.h>
#include <equiaffine/volume/internal/Range.h>
#include <equiaffine/volume/internal/bspline_evaluation.h>
#include <equiaffine/volume/internal/bspline_interpolation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

// Bounds of a tensor product spline and of its gradient on boxes come from its coefficients: B-splines are not negative
// and sum to one, so values lie in the range of the coefficients that count in a box, and derivatives in the range of
// differences of coefficients.
namespace equiaffine::internal {

/// The rounding error of a value computed by `contract`, relative to the largest coefficient; that of a d-th derivative
/// in lattice coordinates is at most (2n)^d times as large. The sum of the magnitudes of all terms is largest at |s| =
/// 1/2, and each term has been rounded 3n + 1 times in Horner's scheme, n times in s and n + 2 times in the
/// contraction, per axis.
template <int Degree, class FT>
constexpr FT relative_error_of_value() {
  constexpr auto basis = bspline_basis_polynomials<FT, Degree, Degree + 1>();
  FT sum = 0;
  for (std::size_t p = 0; p <= Degree; ++p)
    for (const FT b : basis[p]) sum += (b < 0 ? -b : b) / FT(1LL << p);
  return FT(3 * (5 * Degree + 3)) * std::numeric_limits<FT>::epsilon() * sum * sum * sum;
}

/// The bounds of an empty set of values: infinity, which is never a value.
inline Interval no_values() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return Interval(infinity, infinity);
}

/// Bounds of a spline and of its gradient on boxes, in lattice coordinates. They contain the numbers as computed, too.
template <class FT>
class Bspline_bounds {
public:
  using Box = Bspline_box<FT>;

  /// Prepares for a spline with `size` coefficients along each axis. Rounding may move a point by `slack` along each
  /// axis before the spline is evaluated there.
  Bspline_bounds(int degree, const std::array<std::size_t, 3>& size, const std::array<FT, 3>& slack)
      : degree_(degree), size_(size) {
    with_degree(degree, [this](auto n) { relative_error_ = relative_error_of_value<n, FT>(); });
    for (const FT s : slack) slack_ += 2 * s; // the point and the box are rounded
  }

  /// Returns an interval that contains the values at those points of the box that have one.
  Interval value(const FT* c, const Box& box) const {
    const Range<FT> range = range_of(c, box.first, count_of(box));
    if (range.has_nan() && has_no_values(c, box)) return no_values();
    const FT error = error_of_value(range);
    const Interval bound = range.widened(error);
    if (range.has_nan() || !box.has_at_most(most_cells)) return bound;
    return on_box(c, box, [&](const auto& spline) {
      return Interval::intersection(bound, spline.value(error + spline.relative_error * range.greatest_magnitude()));
    });
  }

  /// Returns intervals that contain the values and the first derivatives along the axes. If the box has points without
  /// a value, the bounds of the derivatives are the whole line.
  std::array<Interval, 4> first_order(const FT* c, const Box& box) const {
    std::array<Interval, 4> bounds;
    bounds.fill(Interval::whole());
    const Range<FT> range = range_of(c, box.first, count_of(box));
    const FT error = error_of_value(range), error_of_derivative = FT(2 * degree_) * error;
    bounds[0] = range.has_nan() && has_no_values(c, box) ? no_values() : range.widened(error);
    if (range.has_nan()) return bounds;
    if (!box.has_at_most(most_cells)) {
      for (std::size_t a = 0; a < 3; ++a) bounds[1 + a] = differences(c, box, a).widened(error_of_derivative);
      return bounds;
    }
    return on_box(c, box, [&](const auto& spline) {
      const FT error_of_coefficient = spline.relative_error * range.greatest_magnitude();
      bounds[0] = Interval::intersection(bounds[0], spline.value(error + error_of_coefficient));
      for (std::size_t a = 0; a < 3; ++a)
        bounds[1 + a] = spline.derivative(a, error_of_derivative, error_of_coefficient);
      return bounds;
    });
  }

  /// Whether there are points without a value in the box.
  bool has_nan(const FT* c, const Box& box) const { return range_of(c, box.first, count_of(box)).has_nan(); }

private:
  using Size = std::array<std::size_t, 3>;

  static constexpr std::size_t most_cells = Bspline_on_box<5, FT>::most_cells;

  /// The number of coefficients along each axis that count somewhere in the box.
  Size count_of(const Box& box) const {
    Size count = box.cells;
    for (std::size_t& n : count) n += std::size_t(degree_);
    return count;
  }

  /// The range of what `number(load, p)` computes for each coefficient `*p` in a block of `count` along each axis that
  /// begins at `first`; see Range::add for `load`.
  template <class F>
  Range<FT> range_of(const FT* c, const Size& first, const Size& count, const F& number) const {
    Range<FT> range;
    for (std::size_t k = 0; k < count[2]; ++k)
      for (std::size_t j = 0; j < count[1]; ++j) {
        const FT* const row = c + ((first[2] + k) * size_[1] + first[1] + j) * size_[0] + first[0];
        range.add(count[0], [&](const auto& load) { return number(load, row); });
      }
    return range;
  }

  /// The range of the coefficients of a block.
  Range<FT> range_of(const FT* c, const Size& first, const Size& count) const {
    return range_of(c, first, count, [](const auto& load, const FT* p) { return load(p); });
  }

  /// The error of a value by rounding of terms and of the point; differences of coefficients bound the slope.
  FT error_of_value(const Range<FT>& range) const {
    return range.is_empty()
               ? FT(0)
               : relative_error_ * range.greatest_magnitude() + slack_ * (range.greatest() - range.least());
  }

  /// The range of the differences of neighbors along the axis a.
  Range<FT> differences(const FT* c, const Box& box, std::size_t a) const {
    const std::size_t stride = a == 0 ? 1 : a == 1 ? size_[0] : size_[0] * size_[1];
    Size count = count_of(box);
    --count[a];
    return range_of(c, box.first, count,
                    [stride](const auto& load, const FT* p) { return load(p + stride) - load(p); });
  }

  /// f(the spline restricted to the box).
  template <class F>
  auto on_box(const FT* c, const Box& box, const F& f) const {
    const FT* const first = c + (box.first[2] * size_[1] + box.first[1]) * size_[0] + box.first[0];
    return with_degree(degree_,
                       [&](auto n) { return f(Bspline_on_box<n, FT>(first, size_[0], size_[0] * size_[1], box)); });
  }

  /// Whether no point of the box has a value: a coefficient that counts everywhere in the box is NaN.
  bool has_no_values(const FT* c, const Box& box) const {
    Size first, count;
    for (std::size_t a = 0; a < 3; ++a) {
      if (box.cells[a] > std::size_t(degree_) + 1) return false;
      first[a] = box.first[a] + box.cells[a] - 1;
      count[a] = std::size_t(degree_) + 2 - box.cells[a];
    }
    return range_of(c, first, count).has_nan();
  }

  int degree_;
  Size size_;
  FT relative_error_, slack_ = 0;
};

} // namespace equiaffine::internal

#endif
