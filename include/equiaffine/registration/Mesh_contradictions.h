// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_MESH_CONTRADICTIONS_H
#define EQUIAFFINE_REGISTRATION_MESH_CONTRADICTIONS_H

#include <array>

namespace equiaffine {

/// The evidence of two meshes against the map that has brought them together.
struct Mesh_contradictions {
  /// The points of each mesh that lie off the other one although it does not end there, as a part of these and of those
  /// that lie on it.
  std::array<double, 2> parts = {0, 0};
  bool are_closed = false; ///< whether neither mesh has a border, so that both end nowhere
};

} // namespace equiaffine

#endif
