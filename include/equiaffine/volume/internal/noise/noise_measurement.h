// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_NOISE_NOISE_MEASUREMENT_H
#define EQUIAFFINE_VOLUME_INTERNAL_NOISE_NOISE_MEASUREMENT_H

#include <equiaffine/Progress_observer.h>
#include <equiaffine/Volume_view_3.h>
#include <equiaffine/base/internal/shared/parallel_for.h>
#include <equiaffine/base/internal/shared/quantile.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The least |x| that at least the given fraction of all |x| do not exceed; 0 if there are none.
inline double quantile_of_magnitudes(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  for (double& x : values) x = std::abs(x);
  const auto n = std::size_t(fraction * double(values.size() - 1));
  return nth_smallest(std::move(values), n);
}

inline double median_magnitude(std::vector<double> values) { return quantile_of_magnitudes(std::move(values), 0.5); }

/// The quantiles of |x| for a normal variable x, over its standard deviation.
inline constexpr double median_over_deviation = 0.67448975019608174, quantile_80_over_deviation = 1.2815515655446004;

/// Finds the nodes of a volume that have a value and, if there is an isovalue, a next node along an axis on the other
/// side. A row of nodes is a row of words with a bit for each node.
template <class Kernel>
class Nodes_beside_level_set {
  using FT = typename Kernel::FT;
  using Word = std::uint64_t;

public:
  Nodes_beside_level_set(const Volume_view_3<Kernel>& volume, std::optional<FT> isovalue)
      : volume_(volume), isovalue_(isovalue), words_((volume.lattice().size()[0] + 63) / 64) {}

  /// Calls visit(j, k, row) for the rows of the planes from `first` up to, but without, `end`, where row[w] has the bits of
  /// the nodes 64 w to 64 w + 63.
  template <class Visit>
  void for_each_row(std::size_t first, std::size_t end, const Visit& visit) const {
    const auto [nx, ny, nz] = volume_.lattice().size();
    std::vector<Word> found(words_);
    const std::vector<Plane> planes = read(first, std::min(end + 1, nz));
    for (std::size_t k = first; k < end; ++k) {
      const Plane& here = planes[k - first];
      for (std::size_t j = 0; j < ny; ++j) {
        const Word* const side = &here.below[j * words_];
        for (std::size_t w = 0; w < words_; ++w) {
          const bool is_last = w + 1 == words_;
          Word differ = side[w] ^ (side[w] >> 1 | (is_last ? 0 : side[w + 1] << 63));
          if (is_last) differ &= ~(Word(1) << (nx - 1) % 64);
          if (j + 1 < ny) differ |= side[w] ^ side[w + words_];
          if (k + 1 < nz && isovalue_) differ |= side[w] ^ planes[k + 1 - first].below[j * words_ + w];
          found[w] = here.finite[j * words_ + w] & (isovalue_ ? differ : ~Word(0));
        }
        visit(j, k, std::span<const Word>(found));
      }
    }
  }

private:
  /// The words of a plane say of its nodes whether values are finite, and whether they are below the isovalue.
  struct Plane {
    std::vector<Word> finite, below;
  };

  std::vector<Plane> read(std::size_t first_plane, std::size_t end) const {
    const auto [nx, ny, nz] = volume_.lattice().size();
    const FT isovalue = isovalue_.value_or(FT(0));
    std::vector<Plane> planes(end - first_plane);
    std::vector<FT> samples(nx * planes.size());
    for (std::size_t j = 0; j < ny; ++j) {
      Progress_observer::step();
      volume_.copy_block({0, j, first_plane}, {nx, 1, planes.size()}, samples);
      for (std::size_t k = 0; k < planes.size(); ++k)
        for (std::size_t first = 0; first < nx; first += 64) {
          Word finite = 0, below = 0;
          for (std::size_t i = first; i < std::min(first + 64, nx); ++i) {
            const FT sample = samples[k * nx + i];
            finite |= Word(sample - sample == FT(0)) << i % 64;
            below |= Word(sample < isovalue) << i % 64;
          }
          planes[k].finite.push_back(finite);
          planes[k].below.push_back(below);
        }
    }
    return planes;
  }

  const Volume_view_3<Kernel>& volume_;
  std::optional<FT> isovalue_;
  std::size_t words_;
};

/// Some hundred or thousand nodes where noise matters and can be measured: about `most` of those beside the level set,
/// or of all if no isovalue is given or nothing has it; all at least `margin` nodes from the border.
template <class ConcurrencyTag, class Kernel>
std::vector<std::array<std::size_t, 3>> nodes_to_measure(const Volume_view_3<Kernel>& volume,
                                                         std::optional<typename Kernel::FT> isovalue,
                                                         std::size_t margin, std::size_t most) {
  const std::array<std::size_t, 3>& size = volume.lattice().size();
  if (*std::min_element(size.begin(), size.end()) <= 2 * margin) return {};
  const std::size_t end = size[0] - margin;
  const auto within_margins = [&](std::uint64_t word, std::size_t w) {
    for (std::size_t i = 64 * w; i < margin && i < 64 * (w + 1); ++i) word &= ~(std::uint64_t(1) << i % 64);
    if (64 * w >= end) return std::uint64_t(0);
    return 64 * (w + 1) <= end ? word : word & ((std::uint64_t(1) << end % 64) - 1);
  };
  const Nodes_beside_level_set<Kernel> nodes_beside(volume, isovalue);
  std::vector<std::size_t> first(size[2] + 1); // the numbers of the first such node of each plane; before that, counts
  const auto for_each_row = [&](std::size_t k, std::size_t end_of_planes, const auto& visit) {
    nodes_beside.for_each_row(k, end_of_planes,
                              [&](std::size_t j, std::size_t plane, std::span<const std::uint64_t> row) {
                                if (j >= margin && j + margin < size[1]) visit(j, plane, row);
                              });
  };
  constexpr std::size_t planes_at_once = Volume_view_3<Kernel>::planes_at_once; // of which one more is read
  const std::size_t blocks = (size[2] - 2 * margin + planes_at_once - 1) / planes_at_once;
  parallel_for<ConcurrencyTag>(0, blocks, [&](std::size_t n) {
    const std::size_t k = margin + n * planes_at_once;
    for_each_row(k, std::min(k + planes_at_once, size[2] - margin),
                 [&](std::size_t, std::size_t plane, std::span<const std::uint64_t> row) {
                   for (std::size_t w = 0; w < row.size(); ++w)
                     first[plane + 1] += std::size_t(std::popcount(within_margins(row[w], w)));
                 });
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  const std::size_t count = first.back();
  if (count == 0 && isovalue) return nodes_to_measure<ConcurrencyTag, Kernel>(volume, std::nullopt, margin, most);
  const std::size_t step = count / most + 1;
  std::vector<std::vector<std::array<std::size_t, 3>>> chosen(blocks);
  parallel_for<ConcurrencyTag>(0, blocks, [&](std::size_t block) {
    const std::size_t k = margin + block * planes_at_once,
                      end_of_planes = std::min(k + planes_at_once, size[2] - margin);
    std::size_t n = first[k];
    const auto chosen_before = [&](std::size_t number) { return (number + step - 1 - step / 2) / step; };
    if (chosen_before(n) == chosen_before(first[end_of_planes])) return;
    for_each_row(k, end_of_planes, [&](std::size_t j, std::size_t plane, std::span<const std::uint64_t> row) {
      for (std::size_t w = 0; w < row.size(); ++w)
        for (std::uint64_t bits = within_margins(row[w], w); bits != 0; bits &= bits - 1)
          if (n++ % step == step / 2) chosen[block].push_back({64 * w + std::size_t(std::countr_zero(bits)), j, plane});
    });
  });
  std::vector<std::array<std::size_t, 3>> nodes;
  for (const auto& of_block : chosen) nodes.insert(nodes.end(), of_block.begin(), of_block.end());
  return nodes;
}

/// The step of the samples' type, judged by some 65536 of them: 1 if all are integers, the step between floats of
/// median size if all are floats, else 0.
template <class Kernel>
double quantum_of(const Volume_view_3<Kernel>& volume) {
  bool are_integers = true, are_floats = true;
  std::vector<double> finite;
  const auto [nx, ny, nz] = volume.lattice().size();
  const std::size_t nodes = volume.lattice().number_of_nodes(), step = nodes / 65536 + 1;
  for (std::size_t n = 0; n < nodes; n += step) {
    const double value = double(volume(n % nx, n / nx % ny, n / nx / ny));
    if (!std::isfinite(value)) continue;
    are_integers = are_integers && value == std::nearbyint(value);
    are_floats = are_floats && value == double(float(value));
    finite.push_back(value);
  }
  if (finite.empty()) return 0;
  if (are_integers) return 1;
  return are_floats ? median_magnitude(finite) * double(std::numeric_limits<float>::epsilon()) : 0;
}

/// The standard deviation of white noise at some nodes, each at least 6 nodes from the border: from the median of the
/// differences of order 12 along the axes.
template <class Kernel>
double white_noise_deviation(const Volume_view_3<Kernel>& volume,
                             const std::vector<std::array<std::size_t, 3>>& nodes) {
  constexpr std::array<double, 7> half = {924, -792, 495, -220, 66, -12, 1}; // binomial(12, k), signs alternating
  constexpr double norm = 1644.4390289215653;                                // sqrt(binomial(24, 12))
  constexpr std::size_t reach = half.size() - 1;
  std::array<typename Kernel::FT, 2 * reach + 1> line;
  std::vector<double> differences;
  for (const auto& node : nodes)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto first = node;
      first[axis] -= reach;
      volume.copy_line(first, axis, line);
      double sum = half[0] * double(line[reach]);
      for (std::size_t n = 1; n <= reach; ++n) sum += half[n] * (double(line[reach + n]) + double(line[reach - n]));
      if (std::isfinite(sum)) differences.push_back(sum / norm);
    }
  return median_magnitude(std::move(differences)) / median_over_deviation;
}

} // namespace equiaffine::internal

#endif
