// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_ISOSURFACE_SLAB_3_H
#define EQUIAFFINE_MARCHING_CUBES_ISOSURFACE_SLAB_3_H

#include <equiaffine/marching_cubes/Vertex_id.h>
#include <equiaffine/mesh/Isosurface_3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace equiaffine {

/// The part of a mesh between planes of nodes: the vertices on edges that begin in the planes from `first_plane` to
/// `end_plane` - 1, and in the cells above these, with the triangles of these cells. What a slab has follows in the
/// whole mesh on what the slab before has.
///
/// Where the mesh of a block of cells was asked for, `first_plane` and `end_plane` number layers of cells, the triangles
/// are those that belong to them, and the vertices are those of these triangles that no slab before has.
template <class Kernel>
struct Isosurface_slab_3 {
  std::size_t first_plane;                      ///< the first plane of nodes, numbered along k
  std::size_t end_plane;                        ///< the plane of nodes behind the last one
  std::size_t first_vertex;                     ///< the number in the whole mesh of the first vertex
  std::size_t first_triangle;                   ///< the number in the whole mesh of the first triangle
  std::vector<typename Kernel::Point_3> points; ///< of the vertices
  std::vector<Point_status> vertex_status;      ///< one per point, as in Isosurface_3
  /// The numbers in the whole mesh of three vertices each, which are of this slab, of the next one, or of earlier ones.
  std::vector<std::array<std::size_t, 3>> triangles;
  /// One per point, where the mesh of a block of cells was asked for.
  std::vector<Vertex_id> vertex_ids = {};
  /// The least id in the triangles of the whole mesh at each point, with vertex ids. Of the blocks that have a vertex, one has
  /// the cell of this id: to that block the vertex belongs.
  std::vector<Vertex_id> least_ids = {};
};

/// The numbers of a mesh that was made slab by slab are counted here.
struct Isosurface_totals {
  std::size_t vertices = 0;             ///< of the whole mesh
  std::size_t triangles = 0;            ///< of the whole mesh
  std::size_t function_evaluations = 0; ///< of f, with or without derivatives; more than one for nodes near seams
};

} // namespace equiaffine

#endif
