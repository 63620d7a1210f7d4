// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_DISJOINT_SETS_H
#define EQUIAFFINE_BASE_INTERNAL_DISJOINT_SETS_H

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace equiaffine::internal {

/// The numbers below n in sets that can be united, as a forest with path halving (Tarjan, van Leeuwen 1984).
template <class Index>
class Disjoint_sets {
public:
  explicit Disjoint_sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index(0)); }

  /// One number for all of a set.
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }

  /// False if they are in one set already.
  bool unite(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

private:
  std::vector<Index> parent_;
};

} // namespace equiaffine::internal

#endif
