// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_SHARED_FACE_GRAPH_H
#define EQUIAFFINE_SURFACE_INTERNAL_SHARED_FACE_GRAPH_H

namespace equiaffine {

/// A mesh as CGAL's concept FaceListGraph describes it, such as CGAL::Surface_mesh.
template <class T>
concept Face_graph = requires(const T& t) {
  vertices(t);
  faces(t);
};

} // namespace equiaffine

#endif
