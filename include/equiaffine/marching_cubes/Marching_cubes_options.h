// SPDX-License-Identifier: GPL-3.0-or-later
// The options of Marching Cubes, and the numbers that vertices have in every part of a mesh.
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_OPTIONS_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_OPTIONS_H

#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace equiaffine {

/// The number of nodes of a grid along each axis: `64`, or `{64, 64, 32}`.
class Resolution {
public:
  /// The same number along each axis. \throw Input_error if it is negative
  template <class Number>
  Resolution(const Number& n) requires(std::is_arithmetic_v<Number>) : Resolution(n, n, n) {}

  /// A number for each axis. \throw Input_error if one is negative
  template <class X, class Y, class Z>
  Resolution(const X& nx, const Y& ny, const Z& nz) : nodes_{count(nx), count(ny), count(nz)} {}

  /// The same from an array.
  Resolution(const std::array<std::size_t, 3>& nodes) : nodes_(nodes) {}

  const std::array<std::size_t, 3>& nodes() const { return nodes_; } ///< along x, y and z

private:
  template <class Number>
  static std::size_t count(const Number& n) {
    static_assert(std::is_integral_v<Number>, "a resolution counts nodes: give it whole numbers");
    if constexpr (std::is_signed_v<Number>)
      internal::check_field(n >= 0, "resolution", double(n), "is not a number of nodes", "give 2 or more, such as 64");
    return static_cast<std::size_t>(n);
  }

  std::array<std::size_t, 3> nodes_;
};

/// The places at which Marching Cubes can put its vertices.
enum class Vertex_position {
  PROJECTED, ///< on the surface, to the last digits
  LINEAR     ///< where linear interpolation of the values at the ends of the grid edge vanishes, as the paper does
};

/// Options of marching_cubes().
struct Marching_cubes_options {
  /// Nodes along each axis, 2 or more, for functions without a lattice of their own.
  Resolution resolution = 64;
  Vertex_position vertices = Vertex_position::PROJECTED; ///< where vertices are put

  /// \throw Input_error for a value that makes no sense, about the field
  void check() const {
    const std::size_t least = *std::min_element(resolution.nodes().begin(), resolution.nodes().end());
    internal::check_field(least >= 2, "resolution", double(least), "is less than 2 nodes",
                          "give 2 or more, such as 64");
  }
};

/// Options of marching_cubes_in_slabs() and marching_cubes_of_block().
struct Slab_options {
  Marching_cubes_options sampling = {}; ///< as for the whole mesh
  std::size_t planes_per_slab = 64; ///< planes of nodes that a slab has, 1 or more

  /// \throw Input_error for a value that makes no sense, about the field
  void check() const {
    internal::check_member("sampling", sampling);
    internal::check_field(planes_per_slab > 0, "planes_per_slab", double(planes_per_slab), "is not above 0",
                          "give 1 or more, such as 64");
  }
};

/// A number that a vertex of Marching Cubes has in every part of a mesh, so that parts can be merged. A vertex on an
/// edge has an id of the node of the lattice at which the edge begins, and one inside a cell has one of the node at
/// which the cell begins: `ids_per_node` times the number of the node, as of Lattice_3::index(), plus 0, 1 or 2 for the
/// axis of the edge, or 3 and more inside the cell, plus 16 for each further vertex there, of parts of the surface that
/// touch.
using Vertex_id = std::uint64_t;

/// The number of ids that belong to a node of the lattice.
inline constexpr Vertex_id ids_per_node = 256;

/// The cell that begins at the node of an id, or the last one before that node at an end of a lattice with so many
/// nodes. A triangle belongs to the cell of its least id, and a vertex to that of the least id in its triangles.
inline std::array<std::size_t, 3> cell_of(Vertex_id id, const std::array<std::size_t, 3>& nodes) {
  const auto node = std::size_t(id / ids_per_node), row = node / nodes[0];
  return {std::min(node % nodes[0], nodes[0] - 2), std::min(row % nodes[1], nodes[1] - 2),
          std::min(row / nodes[1], nodes[2] - 2)};
}

} // namespace equiaffine

#endif
