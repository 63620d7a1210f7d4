// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_VOLUME_SHARED_VOLUME_H
#define EQUIAFFINE_SRC_VOLUME_SHARED_VOLUME_H

#include "system/Shared_memory.h"
#include "system/kernel.h"
#include <equiaffine/Volume_3.h>

#include <cstddef>

namespace equiaffine {

/// A volume in the type of numbers of its file, in memory that a child process shares with its parent: the child
/// allocates and fills it, and the parent takes the lattice and the samples from it.
class Shared_volume {
public:
  /// Makes room for the samples of a lattice and returns the place of the first one. `type` is a position in raw_types.
  void* allocate(const Lattice_3<Kernel>& lattice, std::size_t type);

  Lattice_3<Kernel> lattice();

  /// The samples as doubles; they are converted here, by the parent, and copied nowhere else.
  Volume_3<Kernel> to_volume();

private:
  Shared_memory memory_;
};

} // namespace equiaffine

#endif
