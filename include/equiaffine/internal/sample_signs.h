// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_SAMPLE_SIGNS_H
#define EQUIAFFINE_INTERNAL_SAMPLE_SIGNS_H

#include <equiaffine/Batch_function_traits_3.h>
#include <equiaffine/internal/node_signs.h>
#include <equiaffine/internal/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// The signs of a function at the nodes of a lattice. Values are computed in batches and not kept.
///
/// With SkipsEmptySpace, blocks of nodes are halved until the function's bounds on the block and one node around it
/// have one sign or the block is small. The margin makes every cell that has a node in a skipped block free of the
/// surface, also if the function has no value at some nodes there, of which its bounds know nothing.
template <class ConcurrencyTag, bool SkipsEmptySpace, class Traits>
class Sign_sampler {
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  using Lattice = Lattice_3<Kernel_of<Traits>>;
  using Range = std::array<std::size_t, 2>; // first, end
  static constexpr std::size_t block = 8;   // nodes along each axis

public:
  Sign_sampler(const Batch_function_traits_3<Traits>& traits, const Lattice& lattice, Node_signs& signs)
      : traits_(traits), lattice_(lattice), signs_(signs) {
    const auto& n = lattice.size();
    evaluations_.resize((n[2] + block - 1) / block);
    parallel_for<ConcurrencyTag>(0, evaluations_.size(), [&](std::size_t slab) {
      Worker worker{*this, evaluations_[slab], {}, {}};
      worker.sample({0, n[0]}, {0, n[1]}, {block * slab, std::min(n[2], block * (slab + 1))});
    });
  }

  std::size_t evaluations() const {
    std::size_t sum = 0;
    for (const std::size_t n : evaluations_) sum += n;
    return sum;
  }

private:
  struct Worker {
    const Sign_sampler& sampler;
    std::size_t& evaluations;
    std::vector<Point_3> points;
    std::vector<FT> values;

    void sample(const Range& i, const Range& j, const Range& k) {
      if constexpr (SkipsEmptySpace) {
        const Interval bounds = sampler.traits_.bounds(sampler.box_around(i, j, k));
        if (bounds.upper() < 0) return;
        if (bounds.lower() >= 0) return fill_positive(i, j, k);
        const std::size_t ni = i[1] - i[0], nj = j[1] - j[0];
        if (ni > block && ni >= nj) {
          const std::size_t middle = halved(i);
          sample({i[0], middle}, j, k);
          return sample({middle, i[1]}, j, k);
        }
        if (nj > block) {
          const std::size_t middle = halved(j);
          sample(i, {j[0], middle}, k);
          return sample(i, {middle, j[1]}, k);
        }
      }
      evaluate(i, j, k);
    }

    static std::size_t halved(const Range& r) { return (r[0] + (r[1] - r[0]) / 2 + block - 1) / block * block; }

    void fill_positive(const Range& i, const Range& j, const Range& k) {
      for (std::size_t z = k[0]; z < k[1]; ++z)
        for (std::size_t y = j[0]; y < j[1]; ++y)
          for (std::size_t x = i[0], n = 0; x < i[1]; x += n) {
            n = std::min(i[1] - x, 64 - x % 64);
            sampler.signs_.set(x, y, z, {Node_signs::within(~Node_signs::Word(0), 0, n), 0});
          }
    }

    /// Row by row, or small blocks at once.
    void evaluate(const Range& i, const Range& j, const Range& k) {
      const std::size_t n = i[1] - i[0];
      const bool is_small = n <= block;
      for (std::size_t z = k[0]; z < k[1]; ++z)
        for (std::size_t y = j[0]; y < j[1]; y = is_small ? j[1] : y + 1) {
          const std::size_t end = is_small ? j[1] : y + 1;
          compute(i, {y, end}, z);
          for (std::size_t row = y; row < end; ++row)
            for (std::size_t x = i[0], m = 0; x < i[1]; x += m) {
              m = std::min(i[1] - x, 64 - x % 64);
              sampler.signs_.set(x, row, z, sign_word(&values[(row - y) * n + x - i[0]], m, FT(0)));
            }
        }
    }

    void compute(const Range& i, const Range& j, std::size_t k) {
      values.clear();
      points.clear();
      for (std::size_t y = j[0]; y < j[1]; ++y)
        for (std::size_t x = i[0]; x < i[1]; ++x)
          if constexpr (LatticeImplicitFunctionTraits_3<Traits>) values.push_back(sampler.traits_.sample(x, y, k));
          else points.push_back(sampler.lattice_.point(FT(double(x)), FT(double(y)), FT(double(k))));
      if constexpr (!LatticeImplicitFunctionTraits_3<Traits>) {
        values.resize(points.size());
        sampler.traits_.values(points, std::span<FT>(values));
        evaluations += points.size();
      }
    }
  };

  CGAL::Bbox_3 box_around(const Range& i, const Range& j, const Range& k) const {
    CGAL::Bbox_3 box;
    for (int corner = 0; corner < 8; ++corner) {
      const auto end = [&](const Range& r, int bit) {
        return corner & bit ? FT(double(r[1])) : FT(double(r[0])) - FT(1);
      };
      box += lattice_.point(end(i, 1), end(j, 2), end(k, 4)).bbox();
    }
    return box;
  }

  const Batch_function_traits_3<Traits>& traits_;
  const Lattice& lattice_;
  Node_signs& signs_;
  std::vector<std::size_t> evaluations_; // per slab of planes
};

} // namespace equiaffine::internal

#endif
