// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_MESH_CONTRADICTIONS_H
#define EQUIAFFINE_REGISTRATION_MESH_CONTRADICTIONS_H

#include <array>

namespace equiaffine {

/// The evidence of two meshes against the map that has brought them together.
struct Mesh_contradictions {
  /// The points of each mesh that lie on the other one, as a part of all.
  std::array<double, 2> inliers = {0, 0};
  /// The points of each mesh that lie off the other one although it does not end there, as a part of these and of those
  /// that lie on it.
  std::array<double, 2> parts = {0, 0};
  double rms = 0; ///< the root of the mean squared distance of the points that lie on the other mesh
  /// Whether both meshes have symmetries that are exact, so that they are solids with these corners, and no samples of
  /// a smooth surface.
  bool are_exact_solids = false;
  bool are_closed = false; ///< whether neither mesh has a border, so that both end nowhere
};

} // namespace equiaffine

#endif
