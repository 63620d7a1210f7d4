// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes works on a `Grid`, which is a Lattice_function or an Array_grid and knows values and positions:
//
// FT, Point                       types of a number and a position
// isovalue()                      the value that the surface has
// cell_values({i, j, k})          the values at the corners of a cell
// edge_vertex({i, j, k}, axis)    the vertex on an edge at whose ends the values have different signs, or else
// edges(grid_edges)               the ends of many edges and the values there
// point({i, j, k}, offset)        a position in a cell, where `offset` is in steps of the grid
// coordinates(point)              an array of three numbers
// is_left_handed()                whether the steps along i, j, k are a left-handed system
// is_nearer_to_end(edge, point)   whether a point on an edge is nearer to the end of the edge than to its beginning
// moved(point, axis, steps)       a point, moved along an axis by a fraction of a step
// index_in_whole({i, j, k})       the number of a node in the grid that this one is a part of
// is_at_cut(edge)                 whether that grid goes on beyond a side on which an edge lies
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_GRID_ELEMENTS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_GRID_ELEMENTS_H

#include <array>
#include <cstddef>

namespace equiaffine::internal {

/// The edge of a grid that begins at a node.
struct Grid_edge {
  std::array<std::size_t, 3> node;
  std::size_t axis;
};

/// A vertex on an edge of a grid, where the linear interpolant of the values at the ends is the isovalue.
template <class Point>
struct Edge_vertex {
  Point point;
  bool is_at_node;
};

/// A vertex inside a cell.
template <class FT>
struct Inner_vertex {
  std::array<std::size_t, 3> cell;
  std::array<FT, 3> offset; ///< from the first node of the cell, in steps of the grid
};

} // namespace equiaffine::internal

#endif
