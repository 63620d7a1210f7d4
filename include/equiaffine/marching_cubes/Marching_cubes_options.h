// SPDX-License-Identifier: GPL-3.0-or-later
// The options of Marching Cubes, and vertex ids for merging the parts of a mesh.
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

  /// One number per axis. \throw Input_error if one is negative
  template <class X, class Y, class Z>
  Resolution(const X& nx, const Y& ny, const Z& nz) : nodes_{count(nx), count(ny), count(nz)} {}

  /// The same from an array.
  Resolution(const std::array<std::size_t, 3>& nodes) : nodes_(nodes) {}

  const std::array<std::size_t, 3>& nodes() const { return nodes_; } ///< along x, y, and z

private:
  template <class Number>
  static std::size_t count(const Number& n) {
    static_assert(std::is_integral_v<Number>, "a resolution is a number of nodes: give integers");
    if constexpr (std::is_signed_v<Number>)
      internal::check_field(n >= 0, "resolution", double(n), "is negative", "give 2 or more nodes, such as 64");
    return static_cast<std::size_t>(n);
  }

  std::array<std::size_t, 3> nodes_;
};

/// Where Marching Cubes places its vertices.
enum class Vertex_position {
  PROJECTED, ///< on the surface, up to rounding
  LINEAR     ///< at the zero of the linear interpolant along the edge of the grid, as in the paper
};

/// Options of marching_cubes().
struct Marching_cubes_options {
  /// The number of nodes along each axis, 2 or more, for functions without a lattice of their own.
  Resolution resolution = 64;
  Vertex_position vertices = Vertex_position::PROJECTED; ///< where vertices are placed

  /// \throw Input_error about the field for an invalid value
  void check() const {
    const std::size_t least = *std::min_element(resolution.nodes().begin(), resolution.nodes().end());
    internal::check_field(least >= 2, "resolution", double(least), "is less than 2 nodes",
                          "give 2 or more, such as 64");
  }
};

/// Options of marching_cubes_in_slabs() and marching_cubes_of_block().
struct Slab_options {
  Marching_cubes_options sampling = {}; ///< the options for the whole mesh
  std::size_t planes_per_slab = 64;     ///< the number of planes of nodes in a slab, 1 or more

  /// \throw Input_error about the field for an invalid value
  void check() const {
    internal::check_member("sampling", sampling);
    internal::check_field(planes_per_slab > 0, "planes_per_slab", double(planes_per_slab), "is not positive",
                          "give 1 or more, such as 64");
  }
};

/// An id of a vertex of Marching Cubes that is the same in every part of a mesh, so that parts can be merged. It is
/// `ids_per_node` times the index (Lattice_3::index()) of the node at which the edge or the cell of the vertex
/// begins, plus 0, 1, or 2 for the axis of the edge, or 3 and more for a vertex inside the cell. Each further vertex
/// at the same position, where parts of the surface touch, adds 16.
using Vertex_id = std::uint64_t;

/// The number of ids reserved for each node of the lattice.
inline constexpr Vertex_id ids_per_node = 256;

/// The cell that begins at the node of an id, or the last cell before that node at an end of the lattice, which has
/// `nodes` nodes. A triangle belongs to the cell of its smallest id, a vertex to the cell of the smallest id in its
/// triangles.
inline std::array<std::size_t, 3> cell_of(Vertex_id id, const std::array<std::size_t, 3>& nodes) {
  const auto node = std::size_t(id / ids_per_node), row = node / nodes[0];
  return {std::min(node % nodes[0], nodes[0] - 2), std::min(row % nodes[1], nodes[1] - 2),
          std::min(row / nodes[1], nodes[2] - 2)};
}

} // namespace equiaffine

#endif
