// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_DATA_OF_MESH_H
#define EQUIAFFINE_SRC_FIT_DATA_OF_MESH_H

#include "fit/Data_points_3.h"
#include "fit/Normalization_3.h"
#include "fit/outliers.h"
#include <equiaffine/fit/internal/Creased_polygons_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The edges of polygons, once each.
inline std::vector<Data_points_3::Edge> edges_of(const std::vector<std::vector<Data_points_3::Index>>& faces) {
  std::vector<Data_points_3::Edge> edges;
  for (const auto& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k)
      edges.push_back(std::minmax<Data_points_3::Index>(face[k], face[(k + 1) % face.size()]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Vertices of a mesh with the polygons between them. Neighbors are the ends of edges, and normals are the sums of
/// those of the faces around, weighted by area. The surface comes apart at creases, edges that bend by more than an angle
/// in degrees: the points on them are data of each side, those of all sides but the largest one behind the vertices.
/// Outliers have no neighbors.
inline Normalized_data data_of_mesh(const std::vector<Eigen::Vector3d>& vertices,
                                    const std::vector<std::vector<Data_points_3::Index>>& faces,
                                    std::optional<double> feature_angle) {
  std::vector<Data_points_3::Edge> edges = edges_of(faces);
  Normalized_data result;
  result.normalization = normalization_of(vertices, edges);
  Data_points_3& data = result.data;
  for (const auto& p : vertices) data.points.push_back(result.normalization(p));
  set_neighbors(data, edges);
  const std::vector<char> is_outlier = outliers(data);
  std::vector<Eigen::Vector3d> without_outliers = vertices; // which would bend faces and make creases around them
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (is_outlier[i])
      without_outliers[i] = result.normalization.inverse(mean_of_neighbors(data, Data_points_3::Index(i)));
  Creased_polygons_3 mesh(without_outliers, faces);
  if (feature_angle) data.charts = mesh.split(mesh.creases(*feature_angle));
  data.points.clear();
  for (const auto& p : mesh.points()) data.points.push_back(result.normalization(p));
  data.normals.assign(data.size(), Eigen::Vector3d::Zero());
  for (const auto& face : mesh.faces()) {
    const Eigen::Vector3d area = double_area_of_polygon(data.points, face);
    for (const auto i : face) data.normals[i] += area;
  }
  for (auto& normal : data.normals) normal.normalize();
  const bool has_creases = !data.charts.empty();
  if (has_creases) edges = edges_of(mesh.faces());
  if (drop_outliers(is_outlier, edges) || has_creases) set_neighbors(data, std::move(edges));
  set_spacing(data, 1);
  const std::vector<char> is_on_border = mesh.borders();
  data.is_at_border = is_on_border;
  for (Data_points_3::Index i = 0; i < data.size(); ++i)
    if (is_on_border[i])
      for (const auto j : connected_ball(data, i, data.spacing[i])) data.is_at_border[j] = 1;
  return result;
}

/// Replaces the normals that the faces around the vertices have by given ones, but for those that differ by more than 60
/// degrees: at a crease a vertex has one normal, and two sides.
inline void improve_normals(Normalized_data& normalized, const std::vector<Eigen::Vector3d>& given) {
  constexpr double least_cosine = 0.5;
  const Eigen::Matrix3d inverse_transpose = normalized.normalization.matrix.inverse().transpose();
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Eigen::Vector3d normal = (inverse_transpose * given[i]).normalized();
    if (normal.dot(normalized.data.normals[i]) > least_cosine) normalized.data.normals[i] = normal;
  }
}

} // namespace equiaffine::internal

#endif
