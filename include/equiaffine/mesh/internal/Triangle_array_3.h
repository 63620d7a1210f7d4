// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLE_ARRAY_3_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLE_ARRAY_3_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/mesh/internal/crossing_triangles.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Triangles between points with the neighbors of every point along edges.
class Triangle_array_3 {
public:
  using Vector = Eigen::Vector3d;

  Triangle_array_3(std::vector<Vector> points, std::vector<Index_triangle> triangles)
      : points_(std::move(points)), triangles_(std::move(triangles)), begin_(points_.size() + 1) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const auto& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k) {
        edges.push_back({t[k], t[(k + 1) % 3]});
        edges.push_back({t[(k + 1) % 3], t[k]});
      }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [from, to] : edges) ++begin_[from + 1], neighbors_.push_back(to);
    for (std::size_t v = 0; v < points_.size(); ++v) begin_[v + 1] += begin_[v];
  }

  const std::vector<Vector>& points() const { return points_; }
  const std::vector<Index_triangle>& triangles() const { return triangles_; }
  std::span<const std::uint32_t> neighbors(std::size_t v) const {
    return std::span(neighbors_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
  }

  /// Twice the area times the unit normal of a triangle whose corners are among other points.
  static Vector normal(const Index_triangle& t, const std::vector<Vector>& points) {
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
  }

  /// The center of a triangle.
  Vector center(std::size_t t) const {
    const auto& [a, b, c] = triangles_[t];
    return (points_[a] + points_[b] + points_[c]) / 3;
  }

  /// The sum of the normals of the triangles around every point.
  std::vector<Vector> vertex_normals() const {
    std::vector<Vector> sums(points_.size(), Vector::Zero());
    for (const auto& t : triangles_)
      for (const auto v : t) sums[v] += normal(t, points_);
    return sums;
  }

  /// The mean length of the edges at a point; 0 without any.
  double mean_edge(std::size_t v) const {
    double sum = 0;
    for (const auto u : neighbors(v)) sum += (points_[u] - points_[v]).norm();
    return neighbors(v).empty() ? 0 : sum / double(neighbors(v).size());
  }

private:
  std::vector<Vector> points_;
  std::vector<Index_triangle> triangles_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> neighbors_;
};

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
