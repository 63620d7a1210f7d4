// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_SAMPLE_SIGNS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_SAMPLE_SIGNS_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/node_signs.h>
#include <equiaffine/number/Interval.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A box around the nodes of a block of the lattice and one node around them. Rounding is monotone: no coordinate of a
/// node, as computed, is outside of those at the corners.
template <class Kernel>
CGAL::Bbox_3 box_around(const Lattice_3<Kernel>& lattice, const Node_block& block) {
  using FT = typename Kernel::FT;
  const auto coordinate = [&](int c, bool is_upper) {
    std::array<FT, 3> node;
    for (std::size_t axis = 0; axis < 3; ++axis)
      node[axis] = (lattice.steps()[axis][c] > FT(0)) == is_upper ? FT(double(block[axis].end))
                                                                  : FT(double(block[axis].first) - 1);
    const auto bounds = CGAL::to_interval(lattice.point(node[0], node[1], node[2])[c]);
    return is_upper ? bounds.second : bounds.first;
  };
  return {coordinate(0, false), coordinate(1, false), coordinate(2, false),
          coordinate(0, true),  coordinate(1, true),  coordinate(2, true)};
}

/// Samples the signs at the nodes of blocks in one thread. Values are computed in batches and not kept.
template <class Traits>
class Block_sampler {
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  using Function = Lattice_function<Traits>;
  static constexpr bool has_samples = Function::has_samples;
  static constexpr std::size_t batch = 64, smallest_block = 4; // the number of nodes in all, and along an axis

public:
  Block_sampler(const Function& function, Node_signs& signs) : function_(function), signs_(signs) {}

  std::size_t evaluations() const { return evaluations_; }

  /// Samples at all nodes of a block.
  void sample_all(const Node_block& block) {
    if constexpr (has_samples) return read_samples(block);
    for (std::size_t k = block[2].first; k < block[2].end; ++k)
      for (std::size_t j = block[1].first; j < block[1].end; ++j)
        for (std::size_t i = block[0].first; i < block[0].end; i += batch)
          sample_batch(function_.traits(), {{{i, std::min(i + batch, block[0].end)}, {j, j + 1}, {k, k + 1}}});
  }

  /// Halves a block along all its long axes until the function's bounds on the block and one node around it have one
  /// sign, or the block is small and is sampled. The margin makes every cell that has a node in a skipped block free of
  /// the surface, also if the function has no value at some nodes there, of which its bounds know nothing.
  void sample_near_surface(const Node_block& block) { sample_part(function_.traits(), block); }

private:
  /// Takes the signs of the samples of a block, all planes at once for the sake of arrays in which k is fastest.
  void read_samples(const Node_block& block) {
    const std::size_t planes = block[2].size();
    std::vector<FT> values(batch * planes);
    for (std::size_t j = block[1].first; j < block[1].end; ++j)
      for (std::size_t i = block[0].first; i < block[0].end; i += batch) {
        const std::size_t n = std::min(batch, block[0].end - i);
        function_.copy_samples({i, j, block[2].first}, {n, 1, planes}, std::span(values).first(n * planes));
        for (std::size_t k = 0; k < planes; ++k)
          signs_.set(i, j, block[2].first + k, sign_word(&values[k * n], n, FT(0)));
      }
  }

  /// Samples a block of which `traits` has the values: deep in the recursion it is a part of the function.
  void sample_part(const Batch_function_traits_3<Traits>& traits, const Node_block& block) {
    Node_block in_whole = block;
    for (std::size_t a = 0; a < 3; ++a) {
      in_whole[a].first += function_.first()[a];
      in_whole[a].end += function_.first()[a];
    }
    const auto box = box_around(function_.lattice(), in_whole);
    const Interval bounds = traits.bounds(box);
    if (bounds.upper() < 0) return;
    if (bounds.lower() >= 0) return signs_.set_positive(block);
    const std::size_t longest = std::max({block[0].size(), block[1].size(), block[2].size()});
    if (longest <= smallest_block) return sample_batch(traits, block);
    if constexpr (RestrictableImplicitFunctionTraits_3<Traits>)
      if (auto part = traits.restricted(box))
        return sample_parts(Batch_function_traits_3<Traits>(*std::move(part)), block, longest);
    sample_parts(traits, block, longest);
  }

  /// Halves a block along its long axes.
  void sample_parts(const Batch_function_traits_3<Traits>& traits, const Node_block& block, std::size_t longest) {
    const std::size_t half = (longest / 2 + smallest_block - 1) / smallest_block * smallest_block;
    for (std::size_t k = block[2].first; k < block[2].end; k += half)
      for (std::size_t j = block[1].first; j < block[1].end; j += half)
        for (std::size_t i = block[0].first; i < block[0].end; i += half)
          sample_part(traits, {{{i, std::min(i + half, block[0].end)},
                                {j, std::min(j + half, block[1].end)},
                                {k, std::min(k + half, block[2].end)}}});
  }

  /// Samples a block that has no more nodes than a batch, and those of each row in one word of Node_signs.
  void sample_batch(const Batch_function_traits_3<Traits>& traits, const Node_block& block) {
    const std::size_t n = compute_values(traits, block), row = block[0].size();
    Sign_word signs = sign_word(values_.data(), n, FT(0));
    const auto first_bits = [&](Node_signs::Word word) { return Node_signs::within(word, 0, row); };
    for (std::size_t k = block[2].first; k < block[2].end; ++k)
      for (std::size_t j = block[1].first; j < block[1].end; ++j) {
        signs_.set(block[0].first, j, k, {first_bits(signs.positive), first_bits(signs.undefined)});
        signs.positive >>= row % 64; // a row of 64 is the only one
        signs.undefined >>= row % 64;
      }
  }

  /// Returns the number of values.
  std::size_t compute_values(const Batch_function_traits_3<Traits>& traits, const Node_block& block) {
    std::size_t n = 0;
    for (std::size_t k = block[2].first; k < block[2].end; ++k)
      for (std::size_t j = block[1].first; j < block[1].end; ++j)
        for (std::size_t i = block[0].first; i < block[0].end; ++i) points_[n++] = function_.point({i, j, k});
    traits.values(std::span<const Point_3>(points_).first(n), std::span(values_).first(n));
    evaluations_ += n;
    return n;
  }

  const Function& function_;
  Node_signs& signs_;
  std::size_t evaluations_ = 0;
  std::array<Point_3, batch> points_{};
  std::array<FT, batch> values_{};
};

/// The signs of a function at the nodes of a lattice, and the evaluations that they took.
struct Sampled_signs {
  Node_signs signs;
  std::size_t evaluations;
};

/// If SkipsEmptySpace, the function is evaluated near its zero set only. This does not apply to functions that already
/// have their values at the nodes.
template <class ConcurrencyTag, bool SkipsEmptySpace, class Traits>
Sampled_signs sample_signs(const Lattice_function<Traits>& function) {
  constexpr std::size_t planes_per_slab = Lattice_function<Traits>::has_samples ? 16 : 8;
  const auto& size = function.size();
  Node_signs signs(size);
  std::vector<std::size_t> evaluations((size[2] + planes_per_slab - 1) / planes_per_slab); // per slab
  parallel_for<ConcurrencyTag>(0, evaluations.size(), [&](std::size_t s) {
    Block_sampler<Traits> sampler(function, signs);
    const Index_range planes = {planes_per_slab * s, std::min(size[2], planes_per_slab * (s + 1))};
    const Node_block slab = {{{0, size[0]}, {0, size[1]}, planes}};
    if constexpr (SkipsEmptySpace && !Lattice_function<Traits>::has_samples) sampler.sample_near_surface(slab);
    else sampler.sample_all(slab);
    evaluations[s] = sampler.evaluations();
  });
  return {std::move(signs), std::accumulate(evaluations.begin(), evaluations.end(), std::size_t(0))};
}

} // namespace equiaffine::internal

#endif
