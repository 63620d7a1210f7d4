// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares meshes and points for fits: removes outliers, splits meshes at creases, and determines normals and
// neighbors.
#ifndef EQUIAFFINE_SRC_FIT_FIT_INPUT_H
#define EQUIAFFINE_SRC_FIT_FIT_INPUT_H

#include "fit/Data_points_3.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/fit/internal/Creased_polygons_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

// False positive of GCC 14 for a copy of a vector in this header of CGAL.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Warray-bounds"
#pragma GCC diagnostic ignored "-Wstringop-overflow"
#endif
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

namespace equiaffine::internal {

inline Eigen::Vector3d mean_of_neighbors(const Data_points_3& data, Data_points_3::Index i) {
  const auto around = data.neighbors_of(i);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto j : around) mean += data.points[j] / double(around.size());
  return mean;
}

/// Whether a point is an outlier: its distance from the mean of its neighbors and their neighbors is more than 1.5
/// times their mean distance from it, and its distance from each neighbor is more than 1.5 times the median distance
/// between these and their neighbors. A corner of a solid, the apex of a flat cone, the center of a fan of long
/// triangles, and a border point are not outliers.
inline bool is_outlier(const Data_points_3& data, Data_points_3::Index i) {
  constexpr double much = 1.5;
  constexpr std::size_t enough = 3; // neighbors
  const auto& points = data.points;
  std::vector<Data_points_3::Index> around(data.neighbors_of(i).begin(), data.neighbors_of(i).end());
  if (around.size() < enough) return false;
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<double> distances;
  for (const auto j : data.neighbors_of(i)) {
    nearest = std::min(nearest, (points[j] - points[i]).norm());
    for (const auto k : data.neighbors_of(j)) {
      if (k == i) continue;
      distances.push_back((points[j] - points[k]).norm());
      around.push_back(k);
    }
  }
  if (distances.empty()) return false;
  const auto median = distances.begin() + std::ptrdiff_t(distances.size() / 2);
  std::nth_element(distances.begin(), median, distances.end());
  if (!(nearest > much * *median)) return false;
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto j : around) mean += points[j] / double(around.size());
  double radius = 0;
  for (const auto j : around) radius += (points[j] - mean).norm() / double(around.size());
  return (points[i] - mean).norm() > much * radius;
}

/// One flag per point.
inline std::vector<char> outliers(const Data_points_3& data) {
  std::vector<char> result(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) result[i] = is_outlier(data, Data_points_3::Index(i));
  return result;
}

/// Removes the edges of outliers, and returns whether there were any. Points without neighbors get no fit and do not
/// influence any.
inline bool drop_outliers(const std::vector<char>& is_outlier, std::vector<Data_points_3::Edge>& edges) {
  return std::erase_if(edges, [&](const auto& edge) {
           const auto is_one = [&](Data_points_3::Index i) { return i < is_outlier.size() && is_outlier[i]; };
           return is_one(edge.first) || is_one(edge.second);
         }) > 0;
}

/// The edges of polygons, each once.
inline std::vector<Data_points_3::Edge> edges_of(const std::vector<std::vector<Data_points_3::Index>>& faces) {
  std::vector<Data_points_3::Edge> edges;
  for (const auto& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k)
      edges.push_back(std::minmax<Data_points_3::Index>(face[k], face[(k + 1) % face.size()]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Prepares a mesh. Neighbors are the ends of edges, and normals are area-weighted sums of face normals. The surface
/// is split at creases, that is, edges that bend by more than an angle in degrees: points on creases are duplicated
/// for each side. The copies for all sides but the largest follow the vertices. Outliers have no neighbors.
inline Normalized_data data_of_mesh(const std::vector<Eigen::Vector3d>& vertices,
                                    const std::vector<std::vector<Data_points_3::Index>>& faces, double feature_angle) {
  std::vector<Data_points_3::Edge> edges = edges_of(faces);
  Normalized_data result;
  result.normalization = normalization_of(vertices, edges);
  Data_points_3& data = result.data;
  for (const auto& p : vertices) data.points.push_back(result.normalization(p));
  set_neighbors(data, edges);
  const std::vector<char> is_outlier = outliers(data);
  std::vector<Eigen::Vector3d> without_outliers = vertices; // outliers would bend faces, and cause creases around them
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (is_outlier[i])
      without_outliers[i] = result.normalization.inverse(mean_of_neighbors(data, Data_points_3::Index(i)));
  Creased_polygons_3 mesh(without_outliers, faces);
  data.charts = mesh.split(mesh.creases(feature_angle));
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

/// Replaces normals computed from faces by given ones, except for those that differ by more than 60 degrees: at a
/// crease a vertex has one normal, but two sides.
inline void improve_normals(Normalized_data& normalized, const std::vector<Eigen::Vector3d>& given) {
  constexpr double least_cosine = 0.5;
  const Eigen::Matrix3d inverse_transpose = normalized.normalization.matrix.inverse().transpose();
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Eigen::Vector3d normal = (inverse_transpose * given[i]).normalized();
    if (normal.dot(normalized.data.normals[i]) > least_cosine) normalized.data.normals[i] = normal;
  }
}

constexpr std::size_t number_of_nearest = 16;

/// The edge length of a triangulation by equilateral triangles if a disk of radius 1 contains one vertex on average:
/// sqrt(2 pi / sqrt(3)). The mean distance to the n nearest points is then 2/3 sqrt(n).
constexpr double mesh_edge = 1.9046;

/// Returns the edges from every point to its nearest neighbors.
inline std::vector<Data_points_3::Edge> edges_to_nearest(bool in_threads, const std::vector<Eigen::Vector3d>& points) {
  const Point_tree_3 tree(points);
  std::vector<std::vector<Data_points_3::Index>> nearest(points.size());
  parallel_for(
      in_threads, 0, points.size(), [&](std::size_t i) { nearest[i] = tree.nearest(points[i], number_of_nearest + 1); },
      256);
  std::vector<Data_points_3::Edge> edges;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const auto j : nearest[i])
      if (j != i) edges.emplace_back(Data_points_3::Index(i), j);
  return edges;
}

/// Sets the normals to the directions of smallest spread of the neighbors.
inline void set_normals_by_neighbors(bool in_threads, Data_points_3& data) {
  data.normals.assign(data.size(), Eigen::Vector3d::Zero());
  parallel_for(
      in_threads, 0, data.size(),
      [&](std::size_t i) {
        const auto around = data.neighbors_of(Data_points_3::Index(i));
        Eigen::Vector3d mean = data.points[i];
        for (const auto j : around) mean += data.points[j];
        mean /= double(around.size() + 1);
        Eigen::Matrix3d spread = (data.points[i] - mean) * (data.points[i] - mean).transpose();
        for (const auto j : around) spread += (data.points[j] - mean) * (data.points[j] - mean).transpose();
        data.normals[i] = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
      },
      256);
}

/// Flips normals so that neighbors agree, along a minimum spanning tree of differences of direction for each
/// component, starting at its highest point, whose normal points up (Hoppe et al. 1992, section 3.3).
inline void orient_normals(Data_points_3& data) {
  using Index = Data_points_3::Index;
  std::vector<Index> highest_first(data.size());
  std::iota(highest_first.begin(), highest_first.end(), Index(0));
  std::stable_sort(highest_first.begin(), highest_first.end(),
                   [&](Index i, Index j) { return data.points[i][2] > data.points[j][2]; });
  std::vector<bool> is_oriented(data.size());
  using Step = std::tuple<double, Index, Index>; // difference, point, previous point
  std::priority_queue<Step, std::vector<Step>, std::greater<Step>> steps;
  for (const Index start : highest_first) {
    if (is_oriented[start]) continue;
    if (data.normals[start][2] < 0) data.normals[start] *= -1;
    steps.emplace(0., start, start);
    while (!steps.empty()) {
      const auto [difference, i, from] = steps.top();
      steps.pop();
      if (is_oriented[i]) continue;
      is_oriented[i] = true;
      if (data.normals[i].dot(data.normals[from]) < 0) data.normals[i] *= -1;
      for (const Index j : data.neighbors_of(i))
        if (!is_oriented[j]) steps.emplace(1 - std::abs(data.normals[i].dot(data.normals[j])), j, i);
    }
  }
}

/// Prepares distinct points without faces. Neighbors are the nearest points, first in the given coordinates, and
/// then in those in which the edges found first have no preferred direction. Outliers have no neighbors. Normals are
/// estimated unless given.
inline Normalized_data data_of_points(bool in_threads, const std::vector<Eigen::Vector3d>& points,
                                      const std::vector<Eigen::Vector3d>& normals = {},
                                      Normal_orientation orientation = Normal_orientation::UNORIENTED) {
  Normalized_data result;
  Data_points_3& data = result.data;
  result.normalization = normalization_of(points, edges_to_nearest(in_threads, points));
  for (const auto& p : points) data.points.push_back(result.normalization(p));
  std::vector<Data_points_3::Edge> edges = edges_to_nearest(in_threads, data.points);
  set_neighbors(data, edges);
  if (drop_outliers(outliers(data), edges)) set_neighbors(data, std::move(edges));
  set_spacing(data, mesh_edge / (2. / 3 * std::sqrt(double(number_of_nearest))));
  if (normals.empty()) set_normals_by_neighbors(in_threads, data);
  else {
    const Eigen::Matrix3d inverse_transpose = result.normalization.matrix.inverse().transpose();
    for (const auto& normal : normals) data.normals.push_back((inverse_transpose * normal).normalized());
  }
  if (normals.empty() || orientation == Normal_orientation::UNORIENTED) orient_normals(data);
  return result;
}

/// The data points, and the data point of each given point. `positions` is empty for a mesh: its vertices come
/// first, in their order, followed by the copies at creases.
struct Fit_input_3 {
  Normalized_data data;
  std::vector<std::uint32_t> positions;
};

inline Fit_input_3 fit_input_of_mesh(const Fit_data_3& given, double feature_angle) {
  Fit_input_3 result;
  result.data = data_of_mesh(given.points, given.polygons, feature_angle);
  improve_normals(result.data, given.normals);
  return result;
}

/// Merges equal points: keeps the first of each in `points`, and returns the new index of every point.
inline std::vector<std::uint32_t> merge_equal_points(std::vector<Eigen::Vector3d>& points,
                                                     std::vector<Eigen::Vector3d>& normals) {
  const std::vector<std::uint32_t> first = first_of_equal(points);
  std::vector<std::uint32_t> positions(points.size());
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (first[i] != i) {
      positions[i] = positions[first[i]];
      continue;
    }
    points[kept] = points[i];
    if (!normals.empty()) normals[kept] = normals[i];
    positions[i] = kept++;
  }
  points.resize(kept);
  if (!normals.empty()) normals.resize(kept);
  return positions;
}

inline Fit_input_3 fit_input_of_points(bool in_threads, Fit_data_3 given, Normal_orientation orientation) {
  Fit_input_3 result;
  result.positions = merge_equal_points(given.points, given.normals);
  result.data = data_of_points(in_threads, given.points, given.normals, orientation);
  return result;
}

using Soup_point = CGAL::Simple_cartesian<double>::Point_3;

/// Returns the index in `repaired` of each point. Points that are no longer in any polygon are appended.
inline std::vector<std::uint32_t> positions_after_repair(const std::vector<Soup_point>& points,
                                                         std::vector<Soup_point>& repaired) {
  std::map<Soup_point, std::uint32_t> position;
  for (std::size_t i = 0; i < repaired.size(); ++i) position.emplace(repaired[i], std::uint32_t(i));
  std::vector<std::uint32_t> result;
  for (const Soup_point& p : points) {
    const auto [place, is_new] = position.emplace(p, std::uint32_t(repaired.size()));
    if (is_new) repaired.push_back(p);
    result.push_back(place->second);
  }
  return result;
}

/// The data points are the distinct points in any order. A point where sheets meet is duplicated for each sheet. Its
/// result is that of the first copy, or at a crease of the largest part.
inline Fit_input_3 fit_input_of_soup(const Fit_data_3& given, double feature_angle) {
  std::vector<Soup_point> points;
  for (const auto& p : given.points) points.emplace_back(p[0], p[1], p[2]);
  std::vector<Soup_point> repaired = points;
  std::vector<std::vector<std::uint32_t>> polygons = given.polygons;
  CGAL::Polygon_mesh_processing::repair_polygon_soup(repaired, polygons);
  CGAL::Polygon_mesh_processing::orient_polygon_soup(repaired, polygons);

  Fit_input_3 result;
  result.positions = positions_after_repair(points, repaired);
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& p : repaired) vertices.push_back(coordinates_of(p));
  result.data = data_of_mesh(vertices, polygons, feature_angle);
  return result;
}

inline Fit_input_3 fit_input(bool in_threads, Fit_data_3 given, const Fit_options& options) {
  if (given.kind == Fit_data_3::Kind::MESH) return fit_input_of_mesh(given, options.feature_angle);
  if (given.kind == Fit_data_3::Kind::SOUP) return fit_input_of_soup(given, options.feature_angle);
  return fit_input_of_points(in_threads, std::move(given), options.normal_orientation);
}

} // namespace equiaffine::internal

#endif
