// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_VOLUME_SHARED_VOLUME_H
#define EQUIAFFINE_PROGRAM_VOLUME_SHARED_VOLUME_H

#include "system/Shared_memory.h"
#include "system/kernel.h"
#include <equiaffine/volume/Volume_view_3.h>

#include <cstddef>
#include <memory>
#include <string>

namespace equiaffine {

/// Samples that a file has as they are in memory stay in the file, which then must not be cut short, or are read into
/// memory.
enum class Samples_in { FILE, MEMORY };

/// This is the place in a file where the samples of a volume lie one after the other, as they are in memory.
struct Raw_data {
  std::string path;
  std::size_t first; ///< the place of the first byte
};

/// A volume in the type of numbers of its file, in memory that a child process shares with its parent: the child
/// allocates and fills it, and the parent takes the lattice and the samples from it.
class Shared_volume {
public:
  /// Makes room for the samples of a lattice and returns the place of the first one. `type` is a position in raw_types.
  void* allocate(const Lattice_3<Kernel>& lattice, std::size_t type);

  /// Says instead that the parent finds the samples at that place of a file.
  void refer_to(const Lattice_3<Kernel>& lattice, std::size_t type, const Raw_data& data);

  Lattice_3<Kernel> lattice();

  /// The samples, where they are. A file must not be cut short as long as there is a copy of the view. Throws `Input_error`
  /// about the volume `path` if the samples are in a file and no longer there.
  Volume_view_3<Kernel> view(const std::string& path);

private:
  std::shared_ptr<Shared_memory> memory_ = std::make_shared<Shared_memory>();
};

} // namespace equiaffine

#endif
