// SPDX-License-Identifier: GPL-3.0-or-later
// Where Marching Cubes puts its vertices, and the numbers that they have in every part of a mesh.
#ifndef EQUIAFFINE_MARCHING_CUBES_VERTEX_POSITION_H
#define EQUIAFFINE_MARCHING_CUBES_VERTEX_POSITION_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace equiaffine {

/// The places at which Marching Cubes can put its vertices.
enum class Vertex_position {
  PROJECTED, ///< on the surface, to the last digits
  LINEAR     ///< where linear interpolation of the values at the ends of the grid edge vanishes, as the paper does
};

/// A number that a vertex of Marching Cubes has in every part of a mesh, so that parts can be merged. A vertex on an edge
/// has an id of the node of the lattice at which the edge begins, and one inside a cell has one of the node at which the
/// cell begins: `ids_per_node` times the number of the node, as of Lattice_3::index(), plus 0, 1 or 2 for the axis of the
/// edge, or 3 and more inside the cell, plus 16 for each further vertex there, of parts of the surface that touch.
using Vertex_id = std::uint64_t;

/// So many ids belong to a node of the lattice.
inline constexpr Vertex_id ids_per_node = 256;

/// The cell that begins at the node of an id, or the last one before that node at an end of a lattice with so many nodes.
/// A triangle belongs to the cell of its least id, and a vertex to that of the least id in its triangles.
inline std::array<std::size_t, 3> cell_of(Vertex_id id, const std::array<std::size_t, 3>& nodes) {
  const auto node = std::size_t(id / ids_per_node), row = node / nodes[0];
  return {std::min(node % nodes[0], nodes[0] - 2), std::min(row % nodes[1], nodes[1] - 2),
          std::min(row / nodes[1], nodes[2] - 2)};
}

} // namespace equiaffine

#endif
