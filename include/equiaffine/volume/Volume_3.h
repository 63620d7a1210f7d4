// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_VOLUME_3_H
#define EQUIAFFINE_VOLUME_VOLUME_3_H

#include <equiaffine/volume/Lattice_3.h>

#include <vector>

namespace equiaffine {

/// A sampled function: one value per node of a lattice, stored with i fastest. A NaN marks a node without a value.
template <class Kernel>
struct Volume_3 {
  Lattice_3<Kernel> lattice;               ///< where the nodes are
  std::vector<typename Kernel::FT> values; ///< one per node, i fastest

  /// The value at node (i, j, k).
  const typename Kernel::FT& operator()(std::size_t i, std::size_t j, std::size_t k) const {
    return values[lattice.index(i, j, k)];
  }
};

} // namespace equiaffine

#endif
