// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_BOUNDS_H
#define EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_BOUNDS_H

#include <equiaffine/number/Interval.h>
#include <equiaffine/volume/internal/bspline.h>
#include <equiaffine/volume/internal/bspline_evaluation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// Tracks the minimum and the maximum of a sequence of numbers, a pack at a time. A NaN changes neither but is
/// recorded. Precondition: no number is infinite.
template <class FT>
class Range {
  using Lanes = Spline_pack<FT>;

public:
  /// Adds `count` numbers. `number(load)` computes the next number, or the next pack of numbers, from what `load(p)`
  /// returns for pointers p to the operands of the first one.
  template <class F>
  void add(std::size_t count, const F& number) {
    std::size_t x = 0;
    for (; x + Lanes::lanes <= count; x += Lanes::lanes) {
      const auto d = number([x](const FT* p) { return Lanes::load(p + x); });
      least_of_lanes_ = d < least_of_lanes_ ? d : least_of_lanes_;
      greatest_of_lanes_ = d > greatest_of_lanes_ ? d : greatest_of_lanes_;
      zero_or_nan_of_lanes_ += d - d;
    }
    for (; x < count; ++x) {
      const FT d = number([x](const FT* p) { return p[x]; });
      least_of_rest_ = d < least_of_rest_ ? d : least_of_rest_;
      greatest_of_rest_ = d > greatest_of_rest_ ? d : greatest_of_rest_;
      zero_or_nan_of_rest_ += d - d;
    }
  }

  FT least() const {
    FT least = least_of_rest_;
    for (int lane = 0; lane < Lanes::lanes; ++lane) least = std::min(least, least_of_lanes_[lane]);
    return least;
  }
  FT greatest() const {
    FT greatest = greatest_of_rest_;
    for (int lane = 0; lane < Lanes::lanes; ++lane) greatest = std::max(greatest, greatest_of_lanes_[lane]);
    return greatest;
  }
  FT greatest_magnitude() const { return std::max(std::abs(least()), std::abs(greatest())); }
  bool is_empty() const { return least() > greatest(); }
  bool has_nan() const {
    FT zero_or_nan = zero_or_nan_of_rest_;
    for (int lane = 0; lane < Lanes::lanes; ++lane) zero_or_nan += zero_or_nan_of_lanes_[lane];
    return zero_or_nan != 0;
  }

  /// An interval that contains all numbers even if each has an error of up to `error`.
  Interval widened(FT error) const {
    return Interval::widened(double(least()) - double(error), double(greatest()) + double(error));
  }

private:
  using Pack = typename Lanes::type;

  // The numbers that fill whole packs are tracked per lane, the remaining ones of each call one by one.
  FT least_of_rest_ = std::numeric_limits<FT>::infinity(), greatest_of_rest_ = -least_of_rest_,
     zero_or_nan_of_rest_ = 0;
  Pack least_of_lanes_ = least_of_rest_ - Pack{}, greatest_of_lanes_ = -least_of_lanes_, zero_or_nan_of_lanes_ = {};
};

/// A box of the lattice: the cells that it meets, and its begin in the first cell and its end in the last cell along
/// each axis, in [0, 1].
template <class FT>
struct Bspline_box {
  std::array<FT, 3> begin, end;
  std::array<std::size_t, 3> first, cells;

  /// Whether the box meets at most `count` cells along each axis.
  bool has_at_most(std::size_t count) const { return *std::max_element(cells.begin(), cells.end()) <= count; }
};

/// The spline restricted to a box: its coefficients for knots that end at the sides of the box.
///
/// These coefficients are values of the spline's blossom (polar form) at arguments inside the box. Hence their range
/// exceeds that of the values only by the square of the side. Coefficients beyond the border of the lattice, which
/// are large by extrapolation, have no influence.
///
/// The sides t and s of the box are inserted as knots, n times each (Boehm: Inserting new knots into B-spline curves,
/// 1980). Every step is a convex combination of two coefficients. For one axis, n = 3, and a box that meets the cells
/// [0, 1] and [1, 2]:
///
///     knots           -2   -1    0 . t . 1 . s . 2    3    4
///                                   [---------]               the box
///     coefficient                  0        1        2        3        4
///     its arguments            -2 -1 0   -1 0 1    0 1 2    1 2 3    2 3 4
///     t inserted once          -1  0 t    0 1 t    1 2 t    1 2 3    2 3 4
///     t inserted twice          0  t t    1 t t    1 2 t    1 2 3    2 3 4
///     t inserted three times    t  t t    1 t t    1 2 t    1 2 3    2 3 4
///     s inserted three times    t  t t    1 t t    1 s t    1 s s    s s s
template <int Degree, class FT>
class Bspline_on_box {
  using Lanes = Spline_pack<FT>;
  using Pack = typename Lanes::type;

public:
  static constexpr std::size_t most_cells = 9;
  /// The rounding error of a coefficient on the box after 2n steps per axis, relative to the largest of the
  /// coefficients that it is computed from.
  static constexpr FT relative_error = 3 * 2 * Degree * 8 * std::numeric_limits<FT>::epsilon();

  /// `*c` is the first coefficient of the lattice that is relevant in the box, which has at most `most_cells` cells
  /// per axis; coefficients are 1, `row` and `slab` apart along x, y, and z. A box with less than 2^-12 of a cell
  /// along an axis is widened to that, which keeps the error of differences small.
  Bspline_on_box(const FT* c, std::size_t row, std::size_t slab, const Bspline_box<FT>& box) : cells_(box.cells) {
    constexpr FT thin = FT(1) / FT(1 << 12);
    for (std::size_t a = 0; a < 3; ++a) {
      count_[a] = cells_[a] + Degree;
      begin_[a] = std::min(box.begin[a], 1 - thin);
      end_[a] = std::max(box.end[a], cells_[a] == 1 ? begin_[a] + thin : thin);
    }
    std::array<FT, capacity> other;
    FT* line = other.data();
    for (std::size_t z = 0; z < count_[2]; ++z)
      for (std::size_t y = 0; y < count_[1]; ++y, line += count_[0])
        std::copy_n(c + z * slab + y * row, count_[0], line);
    insert_sides(2, other, coefficients_);
    insert_sides(1, coefficients_, other);
    insert_sides(0, other, coefficients_);
  }

  /// Contains the values, also if they are computed with an error of up to `error`.
  Interval value(FT error) const {
    Range<FT> range;
    range.add(count_[0] * count_[1] * count_[2], [this](const auto& load) { return load(coefficients_.data()); });
    return range.widened(error);
  }

  /// Contains the derivatives along axis a, in lattice coordinates, also if they are computed with an error of up to
  /// `error` from coefficients on the box with errors of up to `error_of_coefficient`.
  Interval derivative(std::size_t a, FT error, FT error_of_coefficient) const {
    const std::array<std::size_t, 3> stride = {1, count_[0], count_[0] * count_[1]};
    const auto weights = difference_weights(a);
    Range<FT> range;
    if (a == 0) {
      for (std::size_t first = 0; first < count_[2] * stride[2]; first += stride[1])
        range.add(count_[0] - 1, [&, p = &coefficients_[first]](const auto& load) {
          return load(weights.data()) * (load(p + 1) - load(p));
        });
    } else {
      for (std::size_t slab = 0; slab < (a == 1 ? count_[2] : 1); ++slab)
        for (std::size_t n = 0; n + 1 < count_[a]; ++n)
          range.add(stride[a], [&, p = &coefficients_[slab * stride[2] + n * stride[a]],
                                w = weights[n]](const auto& load) { return w * (load(p + stride[a]) - load(p)); });
    }
    return range.widened(error + 2 * error_of_coefficient * *std::max_element(weights.begin(), weights.end()));
  }

private:
  static constexpr std::size_t most_coefficients = most_cells + Degree; // along an axis
  static constexpr std::size_t capacity =
      most_coefficients * most_coefficients * most_coefficients + std::size_t(Lanes::lanes);
  using Coefficients = std::array<FT, capacity>;
  using Insertion_weights = std::array<Pack, std::size_t(Degree*(Degree + 1) / 2)>; // a triangle, row by row

  /// The weights by which a knot is inserted n times in the first cell of a line, as in the figure. In insertion k =
  /// 1 .. n, coefficient i exchanges its smallest argument, u = i + k - n, for the knot, by a convex combination with
  /// coefficient i + 1, which has v = i + 1 instead. There is no knot beyond the end of the line, so v is clamped to
  /// it.
  static Insertion_weights insertion_weights(FT knot, FT end_of_line) {
    Insertion_weights weights;
    std::size_t n = 0;
    for (int k = 1; k <= Degree; ++k)
      for (int i = 0; i <= Degree - k; ++i) {
        const FT u = FT(i + k - Degree), v = std::min(FT(i + 1), end_of_line);
        weights[n++] = (knot - u) / (v - u) + Pack{};
      }
    return weights;
  }

  /// Inserts a knot n times at one end of a pack of lines; `coefficient(i)` is the i-th coefficient from that end.
  template <class F>
  static void insert_knot(const Insertion_weights& weights, const F& coefficient) {
    std::array<Pack, Degree + 1> c;
    unrolled<Degree + 1>([&](auto i) { c[i] = coefficient(i); });
    unrolled<Degree>([&](auto k) {
      constexpr int first = k * Degree - k * (k - 1) / 2;
      unrolled<Degree - k>([&](auto i) { c[i] += weights[first + i] * (c[i + 1] - c[i]); });
    });
    unrolled<Degree>([&](auto i) { coefficient(i) = c[i]; });
  }

  /// Inserts both sides of the box in the lines along `axis`. In `from` this axis is the slowest, so that neighboring
  /// lines fill a pack; in `to` it is the fastest. Three calls restore the order of the axes.
  void insert_sides(std::size_t axis, Coefficients& from, Coefficients& to) const {
    const std::size_t count = count_[axis], lines = count_[(axis + 1) % 3] * count_[(axis + 2) % 3];
    const auto weights_of_begin = insertion_weights(begin_[axis], std::numeric_limits<FT>::infinity());
    const auto weights_of_end =
        insertion_weights(1 - end_[axis], FT(cells_[axis]) - begin_[axis]);         // from the other end
    std::fill_n(from.begin() + std::ptrdiff_t(count * lines), Lanes::lanes, FT(0)); // the last pack reads that far
    for (std::size_t first = 0; first < lines; first += Lanes::lanes) {
      std::array<Pack, most_coefficients> pack_of_lines;
      for (std::size_t n = 0; n < count; ++n) pack_of_lines[n] = Lanes::load(&from[n * lines + first]);
      insert_knot(
          weights_of_begin, [&](std::size_t i) -> auto& { return pack_of_lines[i]; });
      insert_knot(
          weights_of_end, [&](std::size_t i) -> auto& { return pack_of_lines[count - 1 - i]; });
      const std::size_t used_lanes = std::min(lines - first, std::size_t(Lanes::lanes));
      for (std::size_t lane = 0; lane < used_lanes; ++lane)
        for (std::size_t i = 0; i < count; ++i) to[(first + lane) * count + i] = pack_of_lines[i][lane];
    }
  }

  /// The factors that turn differences of neighboring coefficients into coefficients of the derivative along axis a:
  /// n over the distance from the smallest argument of one to the largest argument of the other.
  std::array<FT, most_coefficients> difference_weights(std::size_t a) const {
    const FT last = FT(cells_[a] - 1) + end_[a];
    std::array<FT, most_coefficients> weights{};
    for (std::size_t i = 0; i + 1 < count_[a]; ++i) {
      const FT from = i < Degree ? begin_[a] : FT(i + 1 - Degree), to = i + 1 < cells_[a] ? FT(i + 1) : last;
      weights[i] = Degree / (to - from);
    }
    return weights;
  }

  std::array<std::size_t, 3> cells_, count_; ///< the number of cells and of coefficients along each axis
  std::array<FT, 3> begin_, end_;            ///< as in Bspline_box
  Coefficients coefficients_;
};

// Bounds of a tensor product spline and of its gradient on boxes follow from its coefficients: B-splines are
// nonnegative and sum to one, so values lie in the range of the coefficients that are relevant in a box, and
// derivatives in the range of differences of coefficients.

/// The rounding error of a value computed by `contract`, relative to the largest coefficient; that of a d-th
/// derivative in lattice coordinates is at most (2n)^d times as large. The sum of the magnitudes of all terms is
/// largest at |s| = 1/2. Each term is rounded 3n + 1 times in Horner's scheme, n times in s, and n + 2 times in the
/// contraction, per axis.
template <int Degree, class FT>
constexpr FT relative_error_of_value() {
  constexpr auto basis = bspline_basis_polynomials<FT, Degree, Degree + 1>();
  FT sum = 0;
  for (std::size_t p = 0; p <= Degree; ++p)
    for (const FT b : basis[p]) sum += (b < 0 ? -b : b) / FT(1LL << p);
  return FT(3 * (5 * Degree + 3)) * std::numeric_limits<FT>::epsilon() * sum * sum * sum;
}

/// The bounds of an empty set of values: infinity, which never is a value.
inline Interval no_values() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return Interval(infinity, infinity);
}

/// Bounds of a spline and of its gradient on boxes, in lattice coordinates. They also contain the computed numbers.
template <class FT>
class Bspline_bounds {
public:
  using Box = Bspline_box<FT>;

  /// For a spline with `size` coefficients along each axis. Rounding may move a point by `slack` along each axis
  /// before the spline is evaluated there.
  Bspline_bounds(int degree, const std::array<std::size_t, 3>& size, const std::array<FT, 3>& slack)
      : degree_(degree), size_(size) {
    with_degree(degree, [this](auto n) { relative_error_ = relative_error_of_value<n, FT>(); });
    for (const FT s : slack) slack_ += 2 * s; // both the point and the box are rounded
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

  /// The number of coefficients along each axis that are relevant in the box.
  Size count_of(const Box& box) const {
    Size count = box.cells;
    for (std::size_t& n : count) n += std::size_t(degree_);
    return count;
  }

  /// The range of `number(load, p)` over the coefficients `*p` in a block of `count` along each axis that begins at
  /// `first`; see Range::add for `load`.
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

  /// The error of a value by rounding of terms and of the point. Differences of coefficients bound the slope.
  FT error_of_value(const Range<FT>& range) const {
    return range.is_empty()
               ? FT(0)
               : relative_error_ * range.greatest_magnitude() + slack_ * (range.greatest() - range.least());
  }

  /// The range of the differences of neighbors along axis a.
  Range<FT> differences(const FT* c, const Box& box, std::size_t a) const {
    const std::size_t stride = a == 0 ? 1 : a == 1 ? size_[0] : size_[0] * size_[1];
    Size count = count_of(box);
    --count[a];
    return range_of(c, box.first, count,
                    [stride](const auto& load, const FT* p) { return load(p + stride) - load(p); });
  }

  /// Returns f(the spline restricted to the box).
  template <class F>
  auto on_box(const FT* c, const Box& box, const F& f) const {
    const FT* const first = c + (box.first[2] * size_[1] + box.first[1]) * size_[0] + box.first[0];
    return with_degree(degree_,
                       [&](auto n) { return f(Bspline_on_box<n, FT>(first, size_[0], size_[0] * size_[1], box)); });
  }

  /// Whether no point of the box has a value, because a coefficient that is relevant everywhere in the box is NaN.
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
