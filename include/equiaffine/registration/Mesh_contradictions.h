// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_MESH_CONTRADICTIONS_H
#define EQUIAFFINE_REGISTRATION_MESH_CONTRADICTIONS_H

#include <array>

namespace equiaffine {

/// What two meshes that a map has brought together say against it.
struct Mesh_contradictions {
  /// Of the points of each mesh that lie on the other one, or off it although it does not end there, the part off it.
  std::array<double, 2> parts = {0, 0};
  bool are_closed = false; ///< whether neither mesh has a border, so that both end nowhere
};

} // namespace equiaffine

#endif
