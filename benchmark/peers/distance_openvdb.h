// SPDX-License-Identifier: GPL-3.0-or-later
// OpenVDB's distances to a mesh. OpenVDB has a translation unit of its own.
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

/// Signed distances by meshToSignedDistanceField in steps, at the nodes of a lattice of the given size as in
/// `Volume_3::values`; farther than `band` steps they are its background values.
std::vector<float> openvdb_distances(const Mesh_on_lattice& mesh, const std::array<std::size_t, 3>& size, float band);

#endif
