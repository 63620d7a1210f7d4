// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_LOCAL_POLYNOMIAL_H
#define EQUIAFFINE_VOLUME_INTERNAL_LOCAL_POLYNOMIAL_H

#include <equiaffine/volume/internal/Line_part.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace equiaffine::internal {

/// The value at `center` of the polynomial of degree <= `degree` that fits the samples f_0 .. f_{count-1} by least
/// squares with weights (1 - u^2)^4, u = (j - center) / reach, is linear in the samples; this returns its coefficients.
/// They are weight_j sum_k p_k(center) p_k(j) with the orthonormal polynomials p_k, which Stieltjes' recurrence makes.
/// Precondition: |u| < 1, count > degree.
template <class FT>
std::vector<FT> local_polynomial_weights(std::size_t count, FT center, FT reach, int degree) {
  std::vector<FT> weight(count), p(count), last(count), result(count);
  FT total = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const FT u = (FT(j) - center) / reach, v = (1 - u) * (1 + u);
    weight[j] = v * v * v * v;
    total += weight[j];
  }
  std::fill(p.begin(), p.end(), 1 / std::sqrt(total));
  FT p_center = p[0], last_center = 0, b = 0;
  for (int k = 0;; ++k) {
    for (std::size_t j = 0; j < count; ++j) result[j] += weight[j] * p_center * p[j];
    if (k == degree) return result;
    FT a = 0, norm = 0;
    for (std::size_t j = 0; j < count; ++j) a += weight[j] * (FT(j) - center) * p[j] * p[j];
    for (std::size_t j = 0; j < count; ++j) { // p_{k+1} before it is normalized
      last[j] = ((FT(j) - center) - a) * p[j] - b * last[j];
      norm += weight[j] * last[j] * last[j];
    }
    last_center = -a * p_center - b * last_center;
    std::swap(p, last);
    std::swap(p_center, last_center);
    b = std::sqrt(norm);
    for (FT& x : p) x /= b;
    p_center /= b;
  }
}

/// A filter of lines that smooths: node i gets the value of the polynomial of degree 7 that fits the samples around it.
/// The fit is weighted by a bell of standard deviation `scale` steps that ends at sqrt(11) scale. Hence polynomials of
/// degree 7 stay as they are and the error is that of order 8; a scale of 1 changes nothing. Near a border the window
/// stays within the line, and the bell reaches to its other end. If the border degree is 0, the samples go on beyond
/// the border as constants instead (border_degree.h): polynomials through steps would move them.
template <class FT>
class Smoothing_filter {
public:
  static constexpr int padding = 0;
  static constexpr int degree = 7;

  /// The number of nodes that the window has on each side of its center, in a long line.
  static std::size_t radius_of(FT scale) { return scale > 1 ? std::size_t(std::ceil(reach_of(scale))) - 1 : 0; }

  /// Makes a filter for lines of `count` nodes, which limit its window. Precondition: scale > 1.
  Smoothing_filter(FT scale, std::size_t count, int border_degree)
      : Smoothing_filter(scale, count, border_degree, {0, count}) {}

  /// The same for lines of which only a part is known.
  Smoothing_filter(FT scale, std::size_t count, int border_degree, const Line_part& known)
      : count_(count), known_(known), radius_(std::min(radius_of(scale), (count - 1) / 2)) {
    const FT reach = reach_of(scale);
    const FT excess = std::min(reach, FT(radius_ + 1)) - FT(radius_);
    for (std::size_t i = 0; i <= radius_; ++i)
      weights_.push_back(local_polynomial_weights(window(), FT(i), FT(window() - 1 - i) + excess,
                                                  std::min(degree, int(window()) - 1)));
    if (border_degree == 0)
      for (std::size_t i = 0; i < radius_; ++i) {
        const auto beyond = weights_[radius_].begin() + std::ptrdiff_t(radius_ - i);
        weights_[i].assign(beyond, weights_[radius_].end());
        weights_[i][0] += std::accumulate(weights_[radius_].begin(), beyond, FT(0));
      }
  }

  /// The nodes in the windows of some nodes.
  Line_part samples_of(const Line_part& nodes) const {
    const auto first_of = [&](std::size_t i) { return std::min(i - std::min(i, radius_), count_ - window()); };
    return {first_of(nodes.first), first_of(nodes.end - 1) + window()};
  }

  /// The nodes whose windows are known.
  Line_part smoothed_nodes() const {
    const auto has_known_window = [&](std::size_t i) {
      const Line_part used = samples_of({i, i + 1});
      return known_.first <= used.first && used.end <= known_.end;
    };
    Line_part nodes = known_; // windows move on with their nodes, so that those of the nodes between are known
    while (nodes.first < nodes.end && !has_known_window(nodes.first)) ++nodes.first;
    while (nodes.first < nodes.end && !has_known_window(nodes.end - 1)) --nodes.end;
    return nodes;
  }

  /// Filters the known part of a line whose elements are rows of `width` numbers, i = 0 .. count - 1: from
  /// `samples + i width` to `result + i stride`. Where a window is not known, the result is NaN.
  void apply(const FT* samples, std::size_t count, std::size_t width, FT* result, std::size_t stride) const {
    const Line_part nodes = smoothed_nodes();
    for (std::size_t n = 0; n < count; ++n) {
      FT* const row = result + n * stride;
      const std::size_t i = known_.first + n;
      if (i < nodes.first || i >= nodes.end) {
        std::fill_n(row, width, std::numeric_limits<FT>::quiet_NaN());
        continue;
      }
      std::fill_n(row, width, FT(0));
      const bool is_near_end = i + radius_ >= count_; // if true, samples are taken in reverse
      const std::vector<FT>& weights = weights_[std::min({i, count_ - 1 - i, radius_})];
      const std::size_t first = (is_near_end ? count_ - 1 : i < radius_ ? 0 : i - radius_) - known_.first;
      for (std::size_t j = 0; j < weights.size(); ++j) {
        const FT* const from = samples + (is_near_end ? first - j : first + j) * width;
        for (std::size_t x = 0; x < width; ++x) row[x] += weights[j] * from[x];
      }
    }
  }

private:
  static FT reach_of(FT scale) { return std::sqrt(FT(11)) * scale; } // the variance of (1 - u^2)^4 is 1 / 11

  std::size_t window() const { return 2 * radius_ + 1; }

  std::size_t count_;
  Line_part known_;
  std::size_t radius_;
  std::vector<std::vector<FT>> weights_; // of node i < radius_, then of inner nodes
};

} // namespace equiaffine::internal

#endif
