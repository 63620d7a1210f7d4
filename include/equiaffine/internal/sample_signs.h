// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_SAMPLE_SIGNS_H
#define EQUIAFFINE_INTERNAL_SAMPLE_SIGNS_H

#include <equiaffine/Interval.h>
#include <equiaffine/internal/lattice_function.h>
#include <equiaffine/internal/node_signs.h>
#include <equiaffine/internal/parallel_for.h>

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
/// With SkipsEmptySpace, blocks of nodes are halved until the function's bounds on the block and one node around it
/// have one sign or the block is small. The margin makes every cell that has a node in a skipped block free of the
/// surface, also if the function has no value at some nodes there, of which its bounds know nothing. A function that
/// has its values at the nodes already has nothing to skip.
template <class ConcurrencyTag, bool SkipsEmptySpace, class Traits>
class Sign_sampler {
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  using Function = Lattice_function<Traits>;
  using Range = std::array<std::size_t, 2>; // first, end
  using Block = std::array<Range, 3>;
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

    void sample(const Block& block) {
      if constexpr (SkipsEmptySpace && !has_samples) {
        const Interval bounds = sampler.function_.traits().bounds(sampler.box_around(block));
        if (bounds.upper() < 0) return;
        if (bounds.lower() >= 0) {
          for (std::size_t k = block[2][0]; k < block[2][1]; ++k)
            for (std::size_t j = block[1][0]; j < block[1][1]; ++j)
              sampler.signs_.set_positive(block[0][0], block[0][1], j, k);
          return;
        }
        std::size_t longest = 0;
        for (std::size_t axis = 1; axis < 3; ++axis)
          if (length(block[axis]) > length(block[longest])) longest = axis;
        if (length(block[longest]) <= smallest_block) return evaluate(block);
        Block lower = block, upper = block;
        lower[longest][1] = upper[longest][0] = middle(block[longest]);
        sample(lower);
        sample(upper);
      } else {
        for (std::size_t k = block[2][0]; k < block[2][1]; ++k)
          for (std::size_t j = block[1][0]; j < block[1][1]; ++j)
            for (std::size_t i = block[0][0]; i < block[0][1]; i += 64)
              evaluate({{{i, std::min(i + 64, block[0][1])}, {j, j + 1}, {k, k + 1}}});
      }
    }

    static std::size_t length(const Range& r) { return r[1] - r[0]; }
    static std::size_t middle(const Range& r) {
      return r[0] + (length(r) / 2 + smallest_block - 1) / smallest_block * smallest_block;
    }

    /// Of 64 nodes at most, in one word of each row.
    void evaluate(const Block& block) {
      const std::size_t n = compute(block), row = length(block[0]);
      Sign_word signs = sign_word(values.data(), n, FT(0));
      const auto first_bits = [&](Node_signs::Word word) { return Node_signs::within(word, 0, row); };
      for (std::size_t k = block[2][0]; k < block[2][1]; ++k)
        for (std::size_t j = block[1][0]; j < block[1][1]; ++j) {
          sampler.signs_.set(block[0][0], j, k, {first_bits(signs.positive), first_bits(signs.undefined)});
          signs.positive >>= row % 64; // a row of 64 is the only one
          signs.undefined >>= row % 64;
        }
    }

    std::size_t compute(const Block& block) {
      std::size_t n = 0;
      for (std::size_t k = block[2][0]; k < block[2][1]; ++k)
        for (std::size_t j = block[1][0]; j < block[1][1]; ++j)
          for (std::size_t i = block[0][0]; i < block[0][1]; ++i, ++n)
            if constexpr (has_samples) values[n] = sampler.function_.traits().sample(i, j, k);
            else points[n] = sampler.function_.point({i, j, k});
      if constexpr (!has_samples) {
        sampler.function_.traits().values(std::span<const Point_3>(points).first(n), std::span(values).first(n));
        evaluations += n;
      }
      return n;
    }
  };

  static Interval interval(const FT& x) {
    const auto [lower, upper] = CGAL::to_interval(x);
    return {lower, upper};
  }

  /// Of the nodes of a block and one node around them.
  CGAL::Bbox_3 box_around(const Block& block) const {
    const auto& lattice = function_.lattice();
    std::array<Interval, 3> box;
    for (int c = 0; c < 3; ++c) {
      Interval sum = interval(lattice.origin()[c]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (const auto& step = lattice.steps()[axis][c]; step != FT(0))
          sum += Interval(double(block[axis][0]) - 1, double(block[axis][1])) * interval(step);
      box[std::size_t(c)] = sum;
    }
    return {box[0].lower(), box[1].lower(), box[2].lower(), box[0].upper(), box[1].upper(), box[2].upper()};
  }

  const Function& function_;
  Node_signs& signs_;
  std::vector<std::size_t> evaluations_; // per slab of planes
};

} // namespace equiaffine::internal

#endif
