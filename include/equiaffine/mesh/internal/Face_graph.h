// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_FACE_GRAPH_H
#define EQUIAFFINE_MESH_INTERNAL_FACE_GRAPH_H

#include <CGAL/Iterator_range.h>

namespace equiaffine {

/// A model of CGAL's concept VertexListGraph. Its vertices may have points.
template <class T>
concept Vertex_graph = requires(const T& t) {
  vertices(t);
};

/// A model of CGAL's concept FaceListGraph, such as CGAL::Surface_mesh.
template <class T>
concept Face_graph = requires(const T& t) {
  vertices(t);
  faces(t);
};

/// The vertices of a graph as a range. The concept requires a pair of iterators; CGAL's own meshes return ranges that
/// are pairs.
template <Vertex_graph Graph>
auto vertices_of(const Graph& graph) {
  return CGAL::make_range(vertices(graph));
}

/// The faces of a mesh as a range.
template <Face_graph Graph>
auto faces_of(const Graph& graph) {
  return CGAL::make_range(faces(graph));
}

} // namespace equiaffine

#endif
