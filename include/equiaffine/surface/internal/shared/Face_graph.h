// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_SHARED_FACE_GRAPH_H
#define EQUIAFFINE_SURFACE_INTERNAL_SHARED_FACE_GRAPH_H

namespace equiaffine {

/// A graph as CGAL's concept VertexListGraph describes it, whose vertices may have points.
template <class T>
concept Vertex_graph = requires(const T& t) {
  vertices(t);
};

/// A mesh as CGAL's concept FaceListGraph describes it, such as CGAL::Surface_mesh.
template <class T>
concept Face_graph = requires(const T& t) {
  vertices(t);
  faces(t);
};

} // namespace equiaffine

#endif
