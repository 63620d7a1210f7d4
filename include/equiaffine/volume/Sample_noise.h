// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates the noise of the samples of a volume, and finds volumes whose samples are steps.
#ifndef EQUIAFFINE_VOLUME_SAMPLE_NOISE_H
#define EQUIAFFINE_VOLUME_SAMPLE_NOISE_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Volume_3.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
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

/// Finds the nodes of a block that have a value and, if there is an isovalue, a next node along an axis on the other side:
/// the nodes (i, j, k) of cells (i, j, k). A row of nodes is a row of words with a bit for each node.
template <class Kernel>
class Nodes_beside_level_set {
  using FT = typename Kernel::FT;
  using Word = std::uint64_t;

public:
  Nodes_beside_level_set(const Volume_view_3<Kernel>& volume, std::optional<FT> isovalue, const Cell_block& block)
      : isovalue_(isovalue), block_(block), words_((block.end[0] - block.first[0]) / 64 + 1) {
    const std::size_t nodes = block.end[0] - block.first[0] + 1; // one more than is asked for, along each axis
    planes_.resize(block.end[2] - block.first[2] + 1);
    std::vector<FT> samples(nodes * planes_.size());
    for (std::size_t j = block.first[1]; j <= block.end[1]; ++j) {
      Progress_observer::step();
      volume.copy_block({block.first[0], j, block.first[2]}, {nodes, 1, planes_.size()}, samples);
      for (std::size_t k = 0; k < planes_.size(); ++k)
        add_row(std::span(samples).subspan(k * nodes, nodes), planes_[k]);
    }
  }

  /// Calls visit(j, k, row) for all rows, where row[w] has the bits of the nodes 64 w to 64 w + 63 from the first one on.
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    const std::size_t nodes = block_.end[0] - block_.first[0], rows = block_.end[1] - block_.first[1];
    std::vector<Word> found(words_);
    for (std::size_t k = 0; k + 1 < planes_.size(); ++k)
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t w = 0; w < words_; ++w) {
          const Word* const side = &planes_[k].below[j * words_ + w];
          const Word next_i = *side >> 1 | (w + 1 == words_ ? 0 : side[1] << 63), next_j = side[words_],
                     next_k = planes_[k + 1].below[j * words_ + w];
          const Word differ = (*side ^ next_i) | (*side ^ next_j) | (*side ^ next_k);
          found[w] = planes_[k].finite[j * words_ + w] & (isovalue_ ? differ : ~Word(0));
        }
        found.back() &= (Word(1) << nodes % 64) - 1;
        visit(block_.first[1] + j, block_.first[2] + k, std::span<const Word>(found));
      }
  }

private:
  /// The words of a plane say of its nodes whether values are finite, and whether they are below the isovalue.
  struct Plane {
    std::vector<Word> finite, below;
  };

  void add_row(std::span<const FT> samples, Plane& plane) const {
    const FT isovalue = isovalue_.value_or(FT(0));
    for (std::size_t first = 0; first < samples.size(); first += 64) {
      Word finite = 0, below = 0;
      for (std::size_t i = first; i < std::min(first + 64, samples.size()); ++i) {
        const FT sample = samples[i];
        finite |= Word(sample - sample == FT(0)) << i % 64;
        below |= Word(sample < isovalue) << i % 64;
      }
      plane.finite.push_back(finite);
      plane.below.push_back(below);
    }
  }

  std::optional<FT> isovalue_;
  Cell_block block_;
  std::size_t words_;
  std::vector<Plane> planes_;
};

/// A number that looks random for each node of a lattice, and is the same whatever part of the lattice is looked at
/// (Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014).
inline std::uint64_t random_number_of(const std::array<std::size_t, 3>& node, const std::array<std::size_t, 3>& size) {
  std::uint64_t x = (std::uint64_t(node[2]) * size[1] + node[1]) * size[0] + node[0] + 1;
  x *= 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// \throw std::invalid_argument unless the samples are known at the nodes of some cells
template <class Kernel>
void check_known_cells(const Volume_view_3<Kernel>& volume, const Cell_block& needed) {
  check_argument(clamped(needed, volume.cells()) == needed,
                 "a part of a volume has not all samples around its cells that noise and smoothing are measured with: "
                 "give it more of them, see cells_to_know()");
}

/// Nodes of each part of a volume that is known here.
using Nodes_of_parts = std::vector<std::vector<std::array<std::size_t, 3>>>;

/// Blocks of few planes of the cells of each part, where they are at least `margin` nodes from the border of the volume.
template <class Kernel>
std::vector<std::pair<std::size_t, Cell_block>> blocks_of_planes(const Volume_parts_3<Kernel>& volume,
                                                                 std::size_t margin) {
  constexpr std::size_t planes_at_once = Volume_view_3<Kernel>::planes_at_once; // of which one more is read
  std::vector<std::pair<std::size_t, Cell_block>> blocks;
  for (std::size_t p = 0; p < volume.parts.size(); ++p) {
    Cell_block cells = volume.parts[p].cells;
    bool is_empty = false;
    for (std::size_t a = 0; a < 3; ++a) {
      cells.first[a] = std::max(cells.first[a], margin);
      cells.end[a] = std::min(cells.end[a], volume.lattice.size()[a] - margin);
      is_empty = is_empty || cells.first[a] >= cells.end[a];
    }
    for (std::size_t k = cells.first[2]; !is_empty && k < cells.end[2]; k += planes_at_once) {
      blocks.push_back({p, cells});
      blocks.back().second.first[2] = k;
      blocks.back().second.end[2] = std::min(k + planes_at_once, cells.end[2]);
    }
  }
  return blocks;
}

/// Some hundred or thousand nodes where noise matters and can be measured: about `most` of those beside the level set,
/// chosen at random, or of all if no isovalue is given or nothing has it; all at least `margin` >= 1 nodes from the border.
template <class ConcurrencyTag, class Kernel>
Nodes_of_parts nodes_to_measure(const Volume_parts_3<Kernel>& volume, std::optional<typename Kernel::FT> isovalue,
                                std::size_t margin, std::size_t most) {
  const std::array<std::size_t, 3>& size = volume.lattice.size();
  CGAL_precondition(margin >= 1);
  Nodes_of_parts nodes(volume.parts.size());
  if (*std::min_element(size.begin(), size.end()) <= 2 * margin) return nodes;
  const auto blocks = blocks_of_planes(volume, margin);
  const auto for_each_row = [&](std::size_t block, const auto& visit) {
    const auto& [part, cells] = blocks[block];
    Nodes_beside_level_set<Kernel>(volume.parts[part].volume, isovalue, cells).for_each_row(visit);
  };
  std::vector<std::size_t> counts(blocks.size());
  parallel_for<ConcurrencyTag>(0, blocks.size(), [&](std::size_t block) {
    for_each_row(block, [&](std::size_t, std::size_t, std::span<const std::uint64_t> row) {
      for (const std::uint64_t word : row) counts[block] += std::size_t(std::popcount(word));
    });
  });
  const auto gathered = volume.gather({double(std::accumulate(counts.begin(), counts.end(), std::size_t(0)))});
  const double count = std::accumulate(gathered.begin(), gathered.end(), 0.0);
  if (count == 0 && isovalue) return nodes_to_measure<ConcurrencyTag, Kernel>(volume, std::nullopt, margin, most);
  const bool takes_all = count <= double(most);
  const auto bound = takes_all ? 0 : std::uint64_t(double(most) / count * 0x1p64);
  std::vector<std::vector<std::array<std::size_t, 3>>> chosen(blocks.size());
  parallel_for<ConcurrencyTag>(0, blocks.size(), [&](std::size_t block) {
    if (counts[block] == 0) return;
    for_each_row(block, [&](std::size_t j, std::size_t k, std::span<const std::uint64_t> row) {
      for (std::size_t w = 0; w < row.size(); ++w)
        for (std::uint64_t bits = row[w]; bits != 0; bits &= bits - 1) {
          const std::array<std::size_t, 3> node = {
              blocks[block].second.first[0] + 64 * w + std::size_t(std::countr_zero(bits)), j, k};
          if (takes_all || random_number_of(node, size) < bound) chosen[block].push_back(node);
        }
    });
  });
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    auto& of_part = nodes[blocks[block].first];
    of_part.insert(of_part.end(), chosen[block].begin(), chosen[block].end());
  }
  return nodes;
}

/// The step of the samples' type, judged by some 65536 of them: 1 if all are integers, the step between floats of
/// median size if all are floats, else 0.
template <class Kernel>
double quantum_of(const Volume_parts_3<Kernel>& volume) {
  const std::array<std::size_t, 3>& size = volume.lattice.size();
  const std::size_t nodes = volume.lattice.number_of_nodes(), step = nodes / 65536 + 1;
  std::vector<double> finite;
  for (const auto& [part, cells] : volume.parts)
    for (std::size_t n = 0; n < nodes; n += step) {
      const std::array<std::size_t, 3> node = {n % size[0], n / size[0] % size[1], n / size[0] / size[1]};
      bool is_own = true;
      for (std::size_t a = 0; a < 3; ++a) {
        const Line_part own = own_nodes_of(cells, a, size[a]);
        is_own = is_own && own.first <= node[a] && node[a] < own.end;
      }
      if (!is_own) continue;
      const double value = double(part(node[0], node[1], node[2]));
      if (std::isfinite(value)) finite.push_back(value);
    }
  finite = volume.gather(std::move(finite));
  if (finite.empty()) return 0;
  if (std::all_of(finite.begin(), finite.end(), [](double x) { return x == std::nearbyint(x); })) return 1;
  if (!std::all_of(finite.begin(), finite.end(), [](double x) { return x == double(float(x)); })) return 0;
  return median_magnitude(std::move(finite)) * double(std::numeric_limits<float>::epsilon());
}

/// The standard deviation of white noise at some nodes, each at least 6 nodes from the border: from the median of the
/// differences of order 12 along the axes.
template <class Kernel>
double white_noise_deviation(const Volume_parts_3<Kernel>& volume, const Nodes_of_parts& nodes) {
  constexpr std::array<double, 7> half = {924, -792, 495, -220, 66, -12, 1}; // binomial(12, k), signs alternating
  constexpr double norm = 1644.4390289215653;                                // sqrt(binomial(24, 12))
  constexpr std::size_t reach = half.size() - 1;
  std::array<typename Kernel::FT, 2 * reach + 1> line;
  std::vector<double> differences;
  for (std::size_t p = 0; p < nodes.size(); ++p)
    for (const auto& node : nodes[p])
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto first = node;
        first[axis] -= reach;
        volume.parts[p].volume.copy_line(first, axis, line);
        double sum = half[0] * double(line[reach]);
        for (std::size_t n = 1; n <= reach; ++n) sum += half[n] * (double(line[reach + n]) + double(line[reach - n]));
        if (std::isfinite(sum)) differences.push_back(sum / norm);
      }
  return median_magnitude(volume.gather(std::move(differences))) / median_over_deviation;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Errors of the samples of a volume, in the unit of the samples.
struct Sample_noise {
  double deviation; ///< standard deviation of the white noise in them, rounding to their type included
  double quantum;   ///< the step of their type: 1 for integers, for floats the step at the median size, else 0
};

/// Estimates the noise beside the level set f = isovalue, or everywhere if there is none, from differences of order 12
/// along the axes, which are next to nothing for a smooth function: their median, in units of the median for white
/// noise of deviation 1. Details of the function with a wavelength of a few samples count as noise, too. Integers have
/// at least the noise of rounding, 1 / sqrt(12). For other samples the deviation is 0 if the volume has less than 13
/// nodes along an axis. Takes the time of some passes over the samples.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_view_3<Kernel>& volume,
                            std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  return estimate_noise<ConcurrencyTag>(Volume_parts_3<Kernel>::of(volume), isovalue);
}

/// The same for a volume in parts, of which samples are known up to 6 nodes beyond their cells. \throw
/// std::invalid_argument unless they are
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_parts_3<Kernel>& volume,
                            std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  constexpr std::size_t reach = 6;
  for (const auto& [part, cells] : volume.parts)
    internal::check_known_cells(part, widened(cells, reach, cells_of(volume.lattice.size())));
  const double deviation = internal::white_noise_deviation(
      volume, internal::nodes_to_measure<ConcurrencyTag>(volume, isovalue, reach, 40000));
  const double quantum = internal::quantum_of(volume);
  return {std::max(deviation, quantum == 1 ? 1 / std::sqrt(12.0) : 0), quantum};
}

/// The same for a volume of numbers of the kernel. \throw std::invalid_argument unless there are as many values as nodes
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Sample_noise estimate_noise(const Volume_3<Kernel>& volume,
                            std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  return estimate_noise<ConcurrencyTag>(Volume_view_3<Kernel>::of(volume), isovalue);
}

/// Returns the number of distinct values in up to 4096 rows of the samples, if it is 256 or less: then they are steps,
/// such as those of a mask, and curvatures without smoothing are those of the steps. It is the same however the volume
/// is cut.
template <class Kernel>
std::optional<std::size_t> number_of_few_values(const Volume_parts_3<Kernel>& volume) {
  constexpr std::size_t most_values = 256, most_rows = 4096;
  const auto [nx, ny, nz] = volume.lattice.size();
  const std::size_t step = 1 + ny * nz / most_rows;
  std::set<double> values;
  for (const auto& [part, cells] : volume.parts) {
    std::vector<double> row(cells.end[0] + 1 - cells.first[0]);
    for (std::size_t n = 0; n < ny * nz && values.size() <= most_values; n += step) {
      const std::size_t j = n % ny, k = n / ny;
      if (j < cells.first[1] || cells.end[1] < j || k < cells.first[2] || cells.end[2] < k) continue;
      part.copy_line({cells.first[0], j, k}, 0, row);
      for (std::size_t i = 0; i < row.size(); ++i)
        if (std::isfinite(row[i]) && (i == 0 || row[i] != row[i - 1])) values.insert(row[i]);
    }
  }
  const std::vector<double> of_all = volume.gather({values.begin(), values.end()});
  values.insert(of_all.begin(), of_all.end());
  if (values.size() > most_values) return std::nullopt;
  return values.size();
}

} // namespace equiaffine

#endif
