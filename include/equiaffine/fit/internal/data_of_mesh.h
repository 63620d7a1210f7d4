// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_DATA_OF_MESH_H
#define EQUIAFFINE_FIT_INTERNAL_DATA_OF_MESH_H

#include <equiaffine/fit/internal/Data_points_3.h>
#include <equiaffine/fit/internal/Normalization_3.h>

#include <Eigen/Geometry>

#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Vertices of a mesh with the polygons between them. Neighbors are the ends of edges, and normals are the sums of
/// those of the faces around, weighted by area.
inline Normalized_data data_of_mesh(const std::vector<Eigen::Vector3d>& vertices,
                                    const std::vector<std::vector<Data_points_3::Index>>& faces) {
  std::vector<Data_points_3::Edge> edges;
  for (const auto& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k) edges.emplace_back(face[k], face[(k + 1) % face.size()]);
  for (auto& [i, j] : edges)
    if (j < i) std::swap(i, j);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  Normalized_data result;
  result.normalization = normalization_of(vertices, edges);
  Data_points_3& data = result.data;
  for (const auto& p : vertices) data.points.push_back(result.normalization(p));
  data.normals.assign(data.size(), Eigen::Vector3d::Zero());
  for (const auto& face : faces) {
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      area += (data.points[face[k]] - data.points[face[0]]).cross(data.points[face[k + 1]] - data.points[face[0]]);
    for (const auto i : face) data.normals[i] += area;
  }
  for (auto& normal : data.normals) normal.normalize();
  set_neighbors(data, std::move(edges));
  set_spacing(data, 1);
  return result;
}

} // namespace equiaffine::internal

#endif
