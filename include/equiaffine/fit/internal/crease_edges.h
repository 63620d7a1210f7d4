// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_CREASE_EDGES_H
#define EQUIAFFINE_FIT_INTERNAL_CREASE_EDGES_H

#include <equiaffine/base/Disjoint_sets.h>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// Marks the edges of a surface mesh that bend by more than an angle in degrees, where they follow each other as creases
/// do: sharp edges that are connected have ten of them for each loose end. Noise and thin triangles make edges sharp,
/// too, one here and one there. Edges that are marked already stay so.
template <class Mesh, class Edge_map>
void mark_creases(const Mesh& mesh, double angle, Edge_map is_marked) {
  constexpr std::size_t edges_per_end = 10;
  std::vector<char> is_sharp(mesh.num_edges());
  const auto sharp = boost::make_iterator_property_map(is_sharp.begin(), get(boost::edge_index, mesh));
  CGAL::Polygon_mesh_processing::detect_sharp_edges(mesh, angle, sharp);
  std::vector<std::size_t> degree(mesh.num_vertices());
  Disjoint_sets<std::size_t> chains(mesh.num_vertices());
  for (const auto e : mesh.edges()) {
    if (!is_sharp[e]) continue;
    for (int k = 0; k < 2; ++k) ++degree[mesh.vertex(e, k)];
    chains.unite(mesh.vertex(e, 0), mesh.vertex(e, 1));
  }
  std::vector<std::size_t> edges(mesh.num_vertices()), ends(mesh.num_vertices());
  for (const auto e : mesh.edges())
    if (is_sharp[e]) ++edges[chains.find(mesh.vertex(e, 0))];
  for (const auto v : mesh.vertices())
    if (degree[v] == 1) ++ends[chains.find(v)];
  for (const auto e : mesh.edges()) {
    const std::size_t chain = chains.find(mesh.vertex(e, 0));
    if (is_sharp[e] && edges[chain] >= edges_per_end * ends[chain]) put(is_marked, e, true);
  }
}

} // namespace equiaffine::internal

#endif
