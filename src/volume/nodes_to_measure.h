// SPDX-License-Identifier: GPL-3.0-or-later
// The nodes near a level set at which noise is measured, independent of the partition of the volume.
#ifndef EQUIAFFINE_SRC_VOLUME_NODES_TO_MEASURE_H
#define EQUIAFFINE_SRC_VOLUME_NODES_TO_MEASURE_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Volume_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

using Volume_view = Volume_view_3<Kernel_of_samples>;
using Volume_parts = Volume_parts_3<Kernel_of_samples>;

/// Finds the nodes of a block that have a value and, if there is an isovalue, a next node along an axis on the other
/// side: the nodes (i, j, k) of cells (i, j, k). Each row of nodes is a bit set in 64-bit words.
class Nodes_beside_level_set {
  using Word = std::uint64_t;

public:
  Nodes_beside_level_set(const Volume_view& volume, std::optional<double> isovalue, const Cell_block& block)
      : isovalue_(isovalue), block_(block), words_((block.end[0] - block.first[0]) / 64 + 1) {
    const std::size_t nodes = block.end[0] - block.first[0] + 1; // one more than the cells, along each axis
    planes_.resize(block.end[2] - block.first[2] + 1);
    std::vector<double> samples(nodes * planes_.size());
    for (std::size_t j = block.first[1]; j <= block.end[1]; ++j) {
      Progress_observer::step();
      volume.copy_block({block.first[0], j, block.first[2]}, {nodes, 1, planes_.size()}, samples);
      for (std::size_t k = 0; k < planes_.size(); ++k)
        add_row(std::span(samples).subspan(k * nodes, nodes), planes_[k]);
    }
  }

  /// Calls visit(j, k, row) for all rows, where row[w] has the bits of the nodes 64 w to 64 w + 63, counted from the
  /// first node of the block.
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
  /// For each node of a plane, whether its value is finite, and whether it is below the isovalue.
  struct Plane {
    std::vector<Word> finite, below;
  };

  void add_row(std::span<const double> samples, Plane& plane) const {
    const double isovalue = isovalue_.value_or(double(0));
    for (std::size_t first = 0; first < samples.size(); first += 64) {
      Word finite = 0, below = 0;
      for (std::size_t i = first; i < std::min(first + 64, samples.size()); ++i) {
        const double sample = samples[i];
        finite |= Word(sample - sample == double(0)) << i % 64;
        below |= Word(sample < isovalue) << i % 64;
      }
      plane.finite.push_back(finite);
      plane.below.push_back(below);
    }
  }

  std::optional<double> isovalue_;
  Cell_block block_;
  std::size_t words_;
  std::vector<Plane> planes_;
};

/// A pseudorandom number for each node of a lattice, independent of the partition of the lattice (Steele, Lea, Flood,
/// Fast splittable pseudorandom number generators, 2014).
inline std::uint64_t random_number_of(const std::array<std::size_t, 3>& node, const std::array<std::size_t, 3>& size) {
  std::uint64_t x = (std::uint64_t(node[2]) * size[1] + node[1]) * size[0] + node[0] + 1;
  x *= 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// \throw std::invalid_argument unless the samples at the nodes of the needed cells are known
inline void check_known_cells(const Volume_view& volume, const Cell_block& needed) {
  check_argument(clamped(needed, volume.cells()) == needed,
                 "a part of a volume lacks samples around its cells that are needed to measure noise or to choose the "
                 "smoothing: provide more of them, see cells_to_know()");
}

/// Nodes of each part of a volume that this process has.
using Nodes_of_parts = std::vector<std::vector<std::array<std::size_t, 3>>>;

/// The cells of each part that are at least `margin` nodes from the border of the volume, in blocks of a few planes.
inline std::vector<std::pair<std::size_t, Cell_block>> blocks_of_planes(const Volume_parts& volume,
                                                                        std::size_t margin) {
  constexpr std::size_t planes_at_once = Volume_view::planes_at_once; // one more plane is read
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

/// A few hundred or thousand nodes at which noise matters and can be measured: about `most` nodes near the level set,
/// chosen at random, or among all nodes if there is no isovalue or the level set is empty. All are at least `margin`
/// >= 1 nodes from the border.
inline Nodes_of_parts nodes_to_measure(bool in_threads, const Volume_parts& volume, std::optional<double> isovalue,
                                       std::size_t margin, std::size_t most) {
  const std::array<std::size_t, 3>& size = volume.lattice.size();
  CGAL_precondition(margin >= 1);
  Nodes_of_parts nodes(volume.parts.size());
  if (*std::min_element(size.begin(), size.end()) <= 2 * margin) return nodes;
  const auto blocks = blocks_of_planes(volume, margin);
  const auto for_each_row = [&](std::size_t block, const auto& visit) {
    const auto& [part, cells] = blocks[block];
    Nodes_beside_level_set(volume.parts[part].volume, isovalue, cells).for_each_row(visit);
  };
  std::vector<std::size_t> counts(blocks.size());
  parallel_for(in_threads, 0, blocks.size(), [&](std::size_t block) {
    for_each_row(block, [&](std::size_t, std::size_t, std::span<const std::uint64_t> row) {
      for (const std::uint64_t word : row) counts[block] += std::size_t(std::popcount(word));
    });
  });
  const auto gathered = volume.gather({double(std::accumulate(counts.begin(), counts.end(), std::size_t(0)))});
  const double count = std::accumulate(gathered.begin(), gathered.end(), 0.0);
  if (count == 0 && isovalue) return nodes_to_measure(in_threads, volume, std::nullopt, margin, most);
  const bool takes_all = count <= double(most);
  const auto bound = takes_all ? 0 : std::uint64_t(double(most) / count * 0x1p64);
  std::vector<std::vector<std::array<std::size_t, 3>>> chosen(blocks.size());
  parallel_for(in_threads, 0, blocks.size(), [&](std::size_t block) {
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

} // namespace equiaffine::internal

#endif
