// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_ON_BOX_H
#define EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_ON_BOX_H

#include <equiaffine/number/Interval.h>
#include <equiaffine/volume/internal/bspline_evaluation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// The least and the greatest of numbers, in packs. None of them is compared with NaN; infinity is not expected.
template <class FT>
class Range {
  using Lanes = Spline_pack<FT>;

public:
  /// `count` numbers; `number(at)` is made of at(p), what is at the pointer p, be it one number or a pack.
  template <class F>
  void add(std::size_t count, const F& number) {
    std::size_t x = 0;
    for (; x + Lanes::lanes <= count; x += Lanes::lanes) {
      const auto d = number([x](const FT* p) { return Lanes::load(p + x); });
      leasts_ = d < leasts_ ? d : leasts_;
      greatests_ = d > greatests_ ? d : greatests_;
      zeros_ += d - d;
    }
    for (; x < count; ++x) {
      const FT d = number([x](const FT* p) { return p[x]; });
      least_ = d < least_ ? d : least_;
      greatest_ = d > greatest_ ? d : greatest_;
      zero_ += d - d;
    }
  }

  FT least() const {
    FT least = least_;
    for (int lane = 0; lane < Lanes::lanes; ++lane) least = std::min(least, leasts_[lane]);
    return least;
  }
  FT greatest() const {
    FT greatest = greatest_;
    for (int lane = 0; lane < Lanes::lanes; ++lane) greatest = std::max(greatest, greatests_[lane]);
    return greatest;
  }
  FT size() const { return std::max(std::abs(least()), std::abs(greatest())); }
  bool is_empty() const { return least() > greatest(); }
  bool has_nan() const {
    FT zero = zero_;
    for (int lane = 0; lane < Lanes::lanes; ++lane) zero += zeros_[lane];
    return zero != 0;
  }

  /// Contains all numbers with an error of theirs.
  Interval widened(FT error) const {
    return Interval::widened(double(least()) - double(error), double(greatest()) + double(error));
  }

private:
  FT least_ = std::numeric_limits<FT>::infinity(), greatest_ = -least_, zero_ = 0;
  typename Lanes::type leasts_ = least_ - typename Lanes::type{}, greatests_ = -leasts_, zeros_ = {};
};

/// A box of the lattice: the cells that it meets, and where in the first it begins and in the last it ends, in [0, 1].
template <class FT>
struct Bspline_box {
  std::array<FT, 3> begin, end;
  std::array<std::size_t, 3> first, cells;

  bool has_at_most(std::size_t count) const { return *std::max_element(cells.begin(), cells.end()) <= count; }
};

/// The spline on a box alone, over knots that end there: its coefficients are values of the spline's blossom at
/// arguments in the box, so that their range exceeds that of the values by the square of the side only, and knows
/// nothing of coefficients beyond the border of the lattice, which extrapolation makes large. By knot insertion (Boehm:
/// Inserting new knots into B-spline curves, 1980), a convex combination in each step.
template <int Degree, class FT>
class Bspline_on_box {
  using Lanes = Spline_pack<FT>;
  using Pack_of_lines = typename Lanes::type;

public:
  static constexpr std::size_t most_cells = 9;
  /// Of a coefficient, relative to the largest of those that it is made of: 2n steps per axis.
  static constexpr FT relative_error = 3 * 2 * Degree * 8 * std::numeric_limits<FT>::epsilon();

  /// `*c` is the first coefficient that counts in the box, of at most `most_cells` cells per axis. Where the box has
  /// less than 2^-12 of a cell, it is taken as wide as that, which keeps the error of differences small.
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
    insert_knots(2, other, numbers_);
    insert_knots(1, numbers_, other);
    insert_knots(0, other, numbers_);
  }

  Interval value(FT error) const {
    Range<FT> range;
    range.add(count_[0] * count_[1] * count_[2], [this](const auto& at) { return at(numbers_.data()); });
    return range.widened(error);
  }

  /// Of the derivative along axis a, in lattice coordinates: `error` of that, and `error_of_coefficient`.
  Interval derivative(std::size_t a, FT error, FT error_of_coefficient) const {
    const std::array<std::size_t, 3> stride = {1, count_[0], count_[0] * count_[1]};
    const auto weights = weights_of_differences(a);
    Range<FT> range;
    if (a == 0) {
      for (std::size_t first = 0; first < count_[2] * stride[2]; first += stride[1])
        range.add(count_[0] - 1,
                  [&, p = &numbers_[first]](const auto& at) { return at(weights.data()) * (at(p + 1) - at(p)); });
    } else {
      for (std::size_t slab = 0; slab < (a == 1 ? count_[2] : 1); ++slab)
        for (std::size_t n = 0; n + 1 < count_[a]; ++n)
          range.add(stride[a], [&, p = &numbers_[slab * stride[2] + n * stride[a]], w = weights[n]](const auto& at) {
            return w * (at(p + stride[a]) - at(p));
          });
    }
    return range.widened(error + 2 * error_of_coefficient * *std::max_element(weights.begin(), weights.end()));
  }

private:
  static constexpr std::size_t most = most_cells + Degree, capacity = most * most * most + std::size_t(Lanes::lanes);
  using Numbers = std::array<FT, capacity>;
  using Weights = std::array<Pack_of_lines, std::size_t(Degree*(Degree + 1) / 2)>;

  /// Step k = 1 .. n inserts a knot for the k-th time: coefficient i with the arguments i + k - n .. i gets that knot
  /// for the least of them, u, for which coefficient i + 1 has v = i + 1, or the end of the line if that is nearer.
  static Weights insertion_weights(FT knot, FT end_of_line) {
    Weights weights;
    std::size_t n = 0;
    for (int k = 1; k <= Degree; ++k)
      for (int i = 0; i <= Degree - k; ++i) {
        const FT u = FT(i + k - Degree), v = std::min(FT(i + 1), end_of_line);
        weights[n++] = (knot - u) / (v - u) + Pack_of_lines{};
      }
    return weights;
  }

  /// At the end of lines where `at(0)` is.
  template <class F>
  static void insert_knot(const Weights& weights, const F& at) {
    std::array<Pack_of_lines, Degree + 1> c;
    unrolled<Degree + 1>([&](auto i) { c[i] = at(i); });
    unrolled<Degree>([&](auto k) {
      constexpr int first = k * Degree - k * (k - 1) / 2;
      unrolled<Degree - k>([&](auto i) { c[i] += weights[first + i] * (c[i + 1] - c[i]); });
    });
    unrolled<Degree>([&](auto i) { at(i) = c[i]; });
  }

  /// At both ends of the lines along `axis`, the slowest one of `from`; it is the fastest one of the result.
  void insert_knots(std::size_t axis, Numbers& from, Numbers& to) const {
    const std::size_t count = count_[axis], width = count_[(axis + 1) % 3] * count_[(axis + 2) % 3];
    const Weights at_begin = insertion_weights(begin_[axis], std::numeric_limits<FT>::infinity());
    const Weights at_end = insertion_weights(1 - end_[axis], FT(cells_[axis]) - begin_[axis]);
    std::fill_n(from.begin() + std::ptrdiff_t(count * width), Lanes::lanes, FT(0)); // read by the last pack, unused
    for (std::size_t first = 0; first < width; first += Lanes::lanes) {
      std::array<Pack_of_lines, most> line;
      for (std::size_t n = 0; n < count; ++n) line[n] = Lanes::load(&from[n * width + first]);
      insert_knot(
          at_begin, [&](std::size_t i) -> auto& { return line[i]; });
      insert_knot(
          at_end, [&](std::size_t i) -> auto& { return line[count - 1 - i]; });
      const std::size_t lines = std::min(width - first, std::size_t(Lanes::lanes));
      for (std::size_t l = 0; l < lines; ++l)
        for (std::size_t i = 0; i < count; ++i) to[(first + l) * count + i] = line[i][l];
    }
  }

  /// n over the distance of the knots that a difference belongs to.
  std::array<FT, most> weights_of_differences(std::size_t a) const {
    const FT last = FT(cells_[a] - 1) + end_[a];
    std::array<FT, most> weights{};
    for (std::size_t i = 0; i + 1 < count_[a]; ++i) {
      const FT from = i < Degree ? begin_[a] : FT(i + 1 - Degree), to = i + 1 < cells_[a] ? FT(i + 1) : last;
      weights[i] = Degree / (to - from);
    }
    return weights;
  }

  std::array<std::size_t, 3> cells_, count_;
  std::array<FT, 3> begin_, end_;
  Numbers numbers_;
};

} // namespace equiaffine::internal

#endif
