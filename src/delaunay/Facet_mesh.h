// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_FACET_MESH_H
#define EQUIAFFINE_SRC_DELAUNAY_FACET_MESH_H

#include "delaunay/Surface_complex.h"
#include "delaunay/orient_triangles.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/delaunay/Delaunay_surface_3.h>
#include <equiaffine/mesh/mesh_topology.h>
#include <equiaffine/surface/internal/curve_step.h>

#include <CGAL/Kernel/global_functions_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The facets of a triangulation that approximate the surface, as triangles between numbered points.
struct Facet_mesh {
  using Numbers = std::unordered_map<const void*, std::uint32_t>;

  Delaunay_surface_3<Any_function_3::Kernel> surface;
  Numbers numbers;                 ///< number of the point, by the address of the vertex
  std::vector<bool> is_on_feature; ///< per point
  Mesh_topology topology;

  Numbers::const_iterator find(Surface_vertex vertex) const { return numbers.find(&*vertex); }
  bool has(Surface_vertex vertex) const { return find(vertex) != numbers.end(); }
};

/// Returns the number of a vertex. A vertex gets the next number when this is called for it for the first time.
inline std::uint32_t number_of(Surface_vertex vertex, Facet_mesh& mesh) {
  const auto [entry, is_new] = mesh.numbers.try_emplace(&*vertex, std::uint32_t(mesh.numbers.size()));
  if (is_new) {
    const auto& p = vertex->point();
    mesh.surface.points.emplace_back(p.x(), p.y(), p.z());
    mesh.is_on_feature.push_back(vertex->in_dimension() < 2);
  }
  return entry->second;
}

/// Returns the facets as triangles that are counterclockwise seen from where f is positive. Beside a crease, where
/// gradients do not show that side, a triangle is oriented as its neighbors are.
inline Facet_mesh read_facets(const Surface_complex& complex, const Memoized_function_3& function) {
  using Vector_3 = Any_function_3::Vector_3;
  Facet_mesh mesh;
  auto& [points, triangles] = static_cast<Indexed_triangle_mesh_3<Any_function_3::Kernel>&>(mesh.surface);
  std::vector<Vector_3> gradients;
  for (auto facet = complex.facets_in_complex_begin(); facet != complex.facets_in_complex_end(); ++facet) {
    Progress_observer::step();
    std::array<std::uint32_t, 3> triangle;
    for (int i = 0; i < 3; ++i)
      triangle[std::size_t(i)] = number_of(facet->first->vertex((facet->second + 1 + i) & 3), mesh);
    while (gradients.size() < points.size())
      gradients.push_back(gradient_of<Vector_3>(function.first_order(points[gradients.size()])));
    const auto& [a, b, c] = triangle;
    const Vector_3 normal = CGAL::cross_product(points[b] - points[a], points[c] - points[a]);
    if (normal * (gradients[a] + gradients[b] + gradients[c]) < 0) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
  }
  mesh.surface.vertex_status.assign(points.size(), Point_status::REGULAR);
  mesh.topology = mesh_topology(triangles, points.size());
  if (mesh.topology.is_manifold) return mesh;
  orient_triangles(triangles);
  mesh.topology = mesh_topology(triangles, points.size());
  return mesh;
}

} // namespace equiaffine::internal

#endif
