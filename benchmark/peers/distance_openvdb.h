// SPDX-License-Identifier: GPL-3.0-or-later
// OpenVDB's distances to a mesh, in a separate translation unit.
#ifndef EQUIAFFINE_BENCHMARK_DISTANCE_OPENVDB_H
#define EQUIAFFINE_BENCHMARK_DISTANCE_OPENVDB_H

#include <array>
#include <cstddef>
#include <vector>

/// A mesh in units of the step of a lattice, whose node (0, 0, 0) is the origin.
struct Mesh_on_lattice {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

/// Signed distances by meshToSignedDistanceField in steps, at the nodes of a lattice of the given size, ordered as in
/// `Volume_3::values`. Beyond `band` steps they are the background value.
std::vector<float> openvdb_distances(const Mesh_on_lattice& mesh, const std::array<std::size_t, 3>& size, float band);

#endif
