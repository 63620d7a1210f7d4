// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_SAMPLE_SIGNS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_SAMPLE_SIGNS_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/node_signs.h>
#include <equiaffine/number/Interval.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// The signs of a function at the nodes of a lattice. Values are computed in batches and not kept.
///
/// With SkipsEmptySpace, blocks of nodes are halved along all long axes until the function's bounds on the block and
/// one node around it have one sign or the block is small. The margin makes every cell that has a node in a skipped
/// block free of the surface, also if the function has no value at some nodes there, of which its bounds know nothing.
/// A function that has its values at the nodes already has nothing to skip.
template <class ConcurrencyTag, bool SkipsEmptySpace, class Traits>
class Sign_sampler {
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  using Function = Lattice_function<Traits>;
  static constexpr bool has_samples = Function::has_samples;
  static constexpr std::size_t slab = 8, smallest_block = 4; // nodes along an axis

public:
  Sign_sampler(const Function& function, Node_signs& signs) : function_(function), signs_(signs) {
    const auto& n = function.lattice().size();
    evaluations_.resize((n[2] + slab - 1) / slab);
    parallel_for<ConcurrencyTag>(0, evaluations_.size(), [&](std::size_t s) {
      Worker worker{*this, evaluations_[s], {}, {}};
      worker.sample({{{0, n[0]}, {0, n[1]}, {slab * s, std::min(n[2], slab * (s + 1))}}});
    });
  }

  std::size_t evaluations() const { return std::accumulate(evaluations_.begin(), evaluations_.end(), std::size_t(0)); }

private:
  struct Worker {
    const Sign_sampler& sampler;
    std::size_t& evaluations;
    std::array<Point_3, 64> points;
    std::array<FT, 64> values;

    void sample(const Node_block& block) {
      if constexpr (SkipsEmptySpace && !has_samples) {
        const Interval bounds = sampler.function_.traits().bounds(sampler.box_around(block));
        if (bounds.upper() < 0) return;
        if (bounds.lower() >= 0) return sampler.signs_.set_positive(block);
        const std::size_t longest = std::max({block[0].size(), block[1].size(), block[2].size()});
        if (longest <= smallest_block) return evaluate(block);
        const std::size_t half = (longest / 2 + smallest_block - 1) / smallest_block * smallest_block;
        for (std::size_t k = block[2].first; k < block[2].end; k += half)
          for (std::size_t j = block[1].first; j < block[1].end; j += half)
            for (std::size_t i = block[0].first; i < block[0].end; i += half)
              sample({{{i, std::min(i + half, block[0].end)},
                       {j, std::min(j + half, block[1].end)},
                       {k, std::min(k + half, block[2].end)}}});
      } else {
        for (std::size_t k = block[2].first; k < block[2].end; ++k)
          for (std::size_t j = block[1].first; j < block[1].end; ++j)
            for (std::size_t i = block[0].first; i < block[0].end; i += 64)
              evaluate({{{i, std::min(i + 64, block[0].end)}, {j, j + 1}, {k, k + 1}}});
      }
    }

    /// Of 64 nodes at most, in one word of each row.
    void evaluate(const Node_block& block) {
      const std::size_t n = compute(block), row = block[0].size();
      Sign_word signs = sign_word(values.data(), n, FT(0));
      const auto first_bits = [&](Node_signs::Word word) { return Node_signs::within(word, 0, row); };
      for (std::size_t k = block[2].first; k < block[2].end; ++k)
        for (std::size_t j = block[1].first; j < block[1].end; ++j) {
          sampler.signs_.set(block[0].first, j, k, {first_bits(signs.positive), first_bits(signs.undefined)});
          signs.positive >>= row % 64; // a row of 64 is the only one
          signs.undefined >>= row % 64;
        }
    }

    std::size_t compute(const Node_block& block) {
      std::size_t n = 0;
      for (std::size_t k = block[2].first; k < block[2].end; ++k)
        for (std::size_t j = block[1].first; j < block[1].end; ++j)
          for (std::size_t i = block[0].first; i < block[0].end; ++i, ++n)
            if constexpr (has_samples) values[n] = sampler.function_.traits().sample(i, j, k);
            else points[n] = sampler.function_.point({i, j, k});
      if constexpr (!has_samples) {
        sampler.function_.traits().values(std::span<const Point_3>(points).first(n), std::span(values).first(n));
        evaluations += n;
      }
      return n;
    }
  };

  /// Of the nodes of a block and one node around them. Rounding is monotone: no coordinate of a node, as computed, is
  /// outside of those at the corners.
  CGAL::Bbox_3 box_around(const Node_block& block) const {
    const auto& lattice = function_.lattice();
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

  const Function& function_;
  Node_signs& signs_;
  std::vector<std::size_t> evaluations_; // per slab of planes
};

} // namespace equiaffine::internal

#endif
