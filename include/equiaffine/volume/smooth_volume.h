// SPDX-License-Identifier: GPL-3.0-or-later
// Smooths the samples of a volume by local polynomial fits.
#ifndef EQUIAFFINE_VOLUME_SMOOTH_VOLUME_H
#define EQUIAFFINE_VOLUME_SMOOTH_VOLUME_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>
#include <equiaffine/volume/Volume_survey.h>
#include <equiaffine/volume/internal/separable_filter.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The value at `center` of the polynomial of degree <= `degree` that fits the samples f_0 .. f_{count-1} by least
/// squares with weights (1 - u^2)^4, u = (j - center) / reach, is linear in the samples. This function returns its
/// coefficients, weight_j sum_k p_k(center) p_k(j), with the orthonormal polynomials p_k from Stieltjes' recurrence.
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
    for (std::size_t j = 0; j < count; ++j) { // p_{k+1} before normalization
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

/// A smoothing filter of lines: node i gets the value of the polynomial of degree 7 that fits the samples around it.
/// The fit is weighted by a bell with a standard deviation of `scale` steps that ends at sqrt(11) scale. Polynomials
/// of degree 7 are reproduced, so the error has order 8; a scale of 1 changes nothing. Near a border the window stays
/// within the line, and the bell extends to the other end of the window. If the border degree is 0, the samples are
/// extended beyond the border by constants instead (Volume_survey.h), because polynomials through steps would move
/// them.
template <class FT>
class Smoothing_filter {
public:
  static constexpr int padding = 0;
  static constexpr int degree = 7;

  /// The number of nodes on each side of the center of the window, in a long line.
  static std::size_t radius_of(FT scale) { return scale > 1 ? std::size_t(std::ceil(reach_of(scale))) - 1 : 0; }

  /// Makes a filter for lines of `count` nodes, which limit its window. Precondition: scale > 1.
  Smoothing_filter(FT scale, std::size_t count, int border_degree)
      : Smoothing_filter(scale, count, border_degree, {0, count}) {}

  /// The same for lines that are known in part.
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

  /// The union of the windows of some nodes.
  Line_part samples_of(const Line_part& nodes) const {
    const auto first_of = [&](std::size_t i) { return std::min(i - std::min(i, radius_), count_ - window()); };
    return {first_of(nodes.first), first_of(nodes.end - 1) + window()};
  }

  /// The nodes whose whole windows are known.
  Line_part smoothed_nodes() const {
    const auto has_known_window = [&](std::size_t i) {
      const Line_part used = samples_of({i, i + 1});
      return known_.first <= used.first && used.end <= known_.end;
    };
    Line_part nodes = known_; // windows are monotone in their nodes: the ends suffice
    while (nodes.first < nodes.end && !has_known_window(nodes.first)) ++nodes.first;
    while (nodes.first < nodes.end && !has_known_window(nodes.end - 1)) --nodes.end;
    return nodes;
  }

  /// Filters the known part of a line whose elements are rows of `width` numbers, i = 0 .. count - 1: from
  /// `samples + i width` to `result + i stride`. The result is NaN where the window is not entirely known.
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
      const bool is_near_end = i + radius_ >= count_; // if true, samples are read in reverse
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
  std::vector<std::vector<FT>> weights_; // of node i < radius_, then of the inner nodes
};

/// The smoothed samples of a volume at its known nodes, i fastest. They are NaN where a sample in the window is
/// unknown. \pre the scale is greater than 1
template <class ConcurrencyTag, class Kernel>
std::vector<typename Kernel::FT> smoothed_samples(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale,
                                                  int border_degree) {
  using Filter = Smoothing_filter<typename Kernel::FT>;
  const auto filter = [&](std::size_t a) {
    return Filter(scale, volume.lattice().size()[a], border_degree, nodes_of(volume.cells(), a));
  };
  const std::array<Filter, 3> filters = {filter(0), filter(1), filter(2)};
  std::array<std::size_t, 3> size;
  for (std::size_t a = 0; a < 3; ++a) size[a] = nodes_of(volume.cells(), a).size();
  std::vector<typename Kernel::FT> result;
  resize_with_large_pages(result, size[0] * size[1] * size[2]);
  Separable_filter<ConcurrencyTag, Kernel, Filter>(size, 0, result.data())({&filters[0], &filters[1], &filters[2]},
                                                                           volume);
  return result;
}

/// The known part of a volume, smoothed. \pre the scale is greater than 1
template <class ConcurrencyTag, class Kernel>
Volume_view_3<Kernel> smoothed_part(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale,
                                    int border_degree) {
  using FT = typename Kernel::FT;
  const Cell_block& known = volume.cells();
  const auto samples =
      std::make_shared<const std::vector<FT>>(smoothed_samples<ConcurrencyTag>(volume, scale, border_degree));
  const std::ptrdiff_t step = sizeof(FT), row = step * std::ptrdiff_t(nodes_of(known, 0).size()),
                       slab = row * std::ptrdiff_t(nodes_of(known, 1).size());
  Cell_block cells;
  for (std::size_t a = 0; a < 3; ++a) {
    const Line_part nodes =
        Smoothing_filter<FT>(scale, volume.lattice().size()[a], border_degree, nodes_of(known, a)).smoothed_nodes();
    check_argument(nodes.size() >= 2,
                   "too few samples of a part of a volume to smooth it: provide more of them, see cells_to_know()");
    cells.first[a] = nodes.first;
    cells.end[a] = nodes.end - 1;
  }
  const std::ptrdiff_t offset = std::ptrdiff_t(cells.first[0] - known.first[0]) * step +
                                std::ptrdiff_t(cells.first[1] - known.first[1]) * row +
                                std::ptrdiff_t(cells.first[2] - known.first[2]) * slab;
  return Volume_view_3<Kernel>::part(volume.lattice(), cells, samples->data() + offset / step, {step, row, slab},
                                     samples);
}

/// Whether a scale changes a volume. \throw std::invalid_argument unless it is finite and not negative
template <class FT>
bool smooths(const FT& scale) {
  check_argument(scale >= 0 && scale - scale == 0,
                 "the scale of the smoothing of a volume is negative or not finite: give a number of at least 0");
  return scale > 1;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Returns a volume with less noise: along each axis, every sample is replaced by the value of the polynomial of
/// degree 7 that fits its neighbors by weighted least squares. The weights are a bell with the standard deviation
/// `scale` >= 0, in steps of the lattice, that ends at 3.3 times this distance (Savitzky, Golay 1964 with other
/// weights). Smooth functions change by O(h^8), because polynomials of degree 7 are reproduced, also at the border. A
/// scale of 1 or less changes nothing. White noise in fourth derivatives decreases as scale^-5.5. A node whose window
/// contains a sample that is not finite gets a value that is not finite.
///
/// If most lines of the volume end in steps, for example in a mask, the samples are extended beyond the border by
/// constants: polynomials through steps would move the surface between them.
///
/// \throw std::invalid_argument unless the scale is finite and not negative, and there is one value per node
///
/// Takes 20 scale operations per node. The result does not depend on the number of threads.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Volume_3<Kernel> smooth_volume(Volume_3<Kernel> volume, const typename Kernel::FT& scale) {
  const auto view = Volume_view_3<Kernel>::of(volume);
  if (!internal::smooths(scale)) return volume;
  const Volume_options options;
  const int border_degree =
      internal::elected_border_degree(internal::border_votes(view, options, view.cells()), options.spline_degree);
  volume.values = internal::smoothed_samples<ConcurrencyTag>(view, scale, border_degree);
  return volume;
}

/// The same for samples of any type. The result has numbers of the kernel, or is the volume itself if the scale
/// changes nothing. For a part of a volume, it has the nodes whose windows lie in the part, and `votes` of all parts
/// decide how samples are extended beyond the border (Volume_survey.h). \throw std::invalid_argument if there are no
/// such nodes
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Volume_view_3<Kernel> smooth_volume(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale,
                                    const Border_votes& votes) {
  if (!internal::smooths(scale)) return volume;
  const int border_degree = internal::elected_border_degree(votes, Volume_options().spline_degree);
  if (volume.is_part()) return internal::smoothed_part<ConcurrencyTag>(volume, scale, border_degree);
  return Volume_3<Kernel>{volume.lattice(), internal::smoothed_samples<ConcurrencyTag>(volume, scale, border_degree)};
}

/// The same with the votes of the known ends of lines.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Volume_view_3<Kernel> smooth_volume(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale) {
  if (!internal::smooths(scale)) return volume;
  return smooth_volume<ConcurrencyTag>(volume, scale, internal::border_votes(volume, Volume_options(), volume.cells()));
}

} // namespace equiaffine

#endif
