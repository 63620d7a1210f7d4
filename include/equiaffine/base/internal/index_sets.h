// SPDX-License-Identifier: GPL-3.0-or-later
// Disjoint sets and random subsets of the integers 0, ..., n - 1.
#ifndef EQUIAFFINE_BASE_INTERNAL_INDEX_SETS_H
#define EQUIAFFINE_BASE_INTERNAL_INDEX_SETS_H

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace equiaffine {

/// A partition of 0, ..., n - 1 into sets that can be merged, stored as a forest with path halving (Tarjan, van
/// Leeuwen: Worst-case analysis of set union algorithms, 1984).
template <class Index>
class Disjoint_sets {
public:
  explicit Disjoint_sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index(0)); }

  /// The smallest element of the set of `a`; it represents the set.
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }

  /// Merges the sets of `a` and `b`. Returns false if they already were the same set.
  bool unite(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

private:
  std::vector<Index> parent_;
};

/// Returns min(count, size) distinct integers below `size` in random order, determined by `seed`.
template <class Index = std::size_t>
std::vector<Index> random_subset(std::size_t size, std::size_t count, unsigned seed) {
  std::vector<Index> indices(size);
  std::iota(indices.begin(), indices.end(), Index(0));
  count = std::min(count, size);
  std::minstd_rand random(seed);
  for (std::size_t k = 0; k < count; ++k) std::swap(indices[k], indices[k + random() % (size - k)]);
  indices.resize(count);
  return indices;
}

} // namespace equiaffine

#endif
