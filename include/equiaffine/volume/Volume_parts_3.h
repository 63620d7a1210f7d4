// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_VOLUME_PARTS_3_H
#define EQUIAFFINE_VOLUME_VOLUME_PARTS_3_H

#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Lattice_3.h>
#include <equiaffine/volume/Volume_view_3.h>

#include <CGAL/assertions.h>

#include <functional>
#include <vector>

namespace equiaffine {

/// The parts of a volume that are known here, and how the others, which may be on other machines, are asked. All machines
/// call the same algorithms with their parts, and get the same results, bit for bit, however the volume is cut.
template <class Kernel>
struct Volume_parts_3 {
  /// The samples of a part and around it, of which some cells belong to that part and to no other on any machine.
  struct Part {
    Volume_view_3<Kernel> volume; ///< see Volume_view_3::part()
    Cell_block cells;             ///< that belong to it
  };
  using Numbers = std::vector<double>; ///< what a machine tells the others

  Lattice_3<Kernel> lattice; ///< of the whole volume
  std::vector<Part> parts;   ///< those on this machine; there may be none
  /// Makes the numbers of all machines of those of this one: one machine's after the other's, in the same order everywhere.
  std::function<Numbers(Numbers)> gather = [](Numbers numbers) { return numbers; };

  /// The one part of a whole volume. \pre no part of it is unknown
  static Volume_parts_3 of(const Volume_view_3<Kernel>& volume) {
    CGAL_precondition(!volume.is_part());
    return {volume.lattice(), {{volume, volume.cells()}}};
  }
};

} // namespace equiaffine

#endif
