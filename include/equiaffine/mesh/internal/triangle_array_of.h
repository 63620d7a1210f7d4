// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLE_ARRAY_OF_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLE_ARRAY_OF_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/mesh/internal/Triangle_array_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The points and triangles of a mesh, vertices in their order.
/// \throw std::invalid_argument if a face is not a triangle, or a coordinate is not finite.
template <class Mesh, class Parameters>
Triangle_array_3 triangle_array_of(const Mesh& mesh, const Parameters& parameters) {
  Indexed_polygons faces = indexed_polygons_of_graph(mesh, parameters);
  std::vector<Index_triangle> triangles;
  for (const auto& face : faces.polygons) {
    check_argument(face.size() == 3, "a face of the mesh is not a triangle: cut faces into triangles before");
    triangles.push_back({face[0], face[1], face[2]});
  }
  return Triangle_array_3(std::move(faces.points), std::move(triangles));
}

} // namespace equiaffine::internal

#endif
