// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_RANGE_H
#define EQUIAFFINE_VOLUME_INTERNAL_RANGE_H

#include <equiaffine/number/Interval.h>
#include <equiaffine/volume/internal/bspline_evaluation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// Collects the least and the greatest of many numbers, a pack at a time. A NaN among them changes neither and is
/// remembered; infinities are not expected.
template <class FT>
class Range {
  using Lanes = Spline_pack<FT>;

public:
  /// Adds `count` numbers. `number(load)` computes the next one, or the next pack of them, from what `load(p)` returns
  /// for pointers p to the operands of the first.
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

  /// An interval that contains all numbers even if each is wrong by `error`.
  Interval widened(FT error) const {
    return Interval::widened(double(least()) - double(error), double(greatest()) + double(error));
  }

private:
  using Pack = typename Lanes::type;

  // The numbers that fill whole packs are collected per lane, the rest of each call one by one.
  FT least_of_rest_ = std::numeric_limits<FT>::infinity(), greatest_of_rest_ = -least_of_rest_,
     zero_or_nan_of_rest_ = 0;
  Pack least_of_lanes_ = least_of_rest_ - Pack{}, greatest_of_lanes_ = -least_of_lanes_, zero_or_nan_of_lanes_ = {};
};

} // namespace equiaffine::internal

#endif
