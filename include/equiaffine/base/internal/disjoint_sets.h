// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_DISJOINT_SETS_H
#define EQUIAFFINE_BASE_INTERNAL_DISJOINT_SETS_H

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace equiaffine {

/// A partition of the numbers below n into sets that can be united, stored as a forest with path halving (Tarjan, van
/// Leeuwen: Worst-case analysis of set union algorithms, 1984).
template <class Index>
class Disjoint_sets {
public:
  explicit Disjoint_sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index(0)); }

  /// The least number of the set of `a`, which stands for the set.
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }

  /// Unites the sets of `a` and `b`. Returns false if they are the same set already.
  bool unite(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

private:
  std::vector<Index> parent_;
};

} // namespace equiaffine

#endif
