// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle mesh with the neighbors of its points, and the test for triangles that intersect each other.
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLE_ARRAY_3_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLE_ARRAY_3_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
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

using Index_triangle = std::array<std::uint32_t, 3>;
using Triangle_pair = std::pair<std::uint32_t, std::uint32_t>; ///< the smaller index is first

/// Tests whether two triangles intersect in more than their shared corners and edges. Predicates are exact.
class Crossing_test_3 {
public:
  Crossing_test_3(std::span<const Eigen::Vector3d> points, std::span<const Index_triangle> triangles)
      : points_(points), triangles_(triangles) {}

  /// Whether triangles s and t intersect. Degenerate triangles intersect nothing.
  bool operator()(std::uint32_t s, std::uint32_t t) const {
    const auto [first, shared] = shared_first(triangles_[s], triangles_[t]);
    const Index_triangle second = shared_first(triangles_[t], triangles_[s]).first;
    if (shared == 3 || is_flat(first) || is_flat(second)) return shared == 3;
    if (shared == 2) return is_fold(first, second[2]);
    if (shared == 1) return meets(first, second[1], second[2]) || meets(second, first[1], first[2]);
    return CGAL::do_intersect(triangle(first), triangle(second));
  }

private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

  Kernel::Point_3 point(std::uint32_t v) const { return {points_[v][0], points_[v][1], points_[v][2]}; }
  Kernel::Triangle_3 triangle(const Index_triangle& t) const { return {point(t[0]), point(t[1]), point(t[2])}; }

  /// The corners of a triangle, starting with those shared with another triangle, and the number of shared corners.
  static std::pair<Index_triangle, int> shared_first(Index_triangle t, const Index_triangle& other) {
    const auto is_shared = [&](std::uint32_t v) { return std::find(other.begin(), other.end(), v) != other.end(); };
    const auto end = std::stable_partition(t.begin(), t.end(), is_shared);
    return {t, int(end - t.begin())};
  }

  bool is_flat(const Index_triangle& t) const { return CGAL::collinear(point(t[0]), point(t[1]), point(t[2])); }

  bool meets(const Index_triangle& t, std::uint32_t from, std::uint32_t to) const {
    const Kernel::Segment_3 segment(point(from), point(to));
    return !segment.is_degenerate() && CGAL::do_intersect(triangle(t), segment);
  }

  /// Whether two triangles with a common edge overlap.
  bool is_fold(const Index_triangle& t, std::uint32_t apex) const {
    const auto a = point(t[0]), b = point(t[1]), c = point(t[2]), d = point(apex);
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

  std::span<const Eigen::Vector3d> points_;
  std::span<const Index_triangle> triangles_;
};

using Triangle_box_3 = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

inline Triangle_box_3 box_of(std::uint32_t t, std::span<const Eigen::Vector3d> points,
                             std::span<const Index_triangle> triangles) {
  CGAL::Bbox_3 box;
  for (const auto v : triangles[t]) {
    const Eigen::Vector3d& p = points[v];
    box += CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
  }
  return {box, t};
}

/// Returns all pairs of triangles that intersect, in order. Takes about n log n time plus the time for pairs of
/// intersecting boxes.
inline std::vector<Triangle_pair> crossing_triangles(std::span<const Eigen::Vector3d> points,
                                                     std::span<const Index_triangle> triangles) {
  std::vector<Triangle_box_3> boxes;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) boxes.push_back(box_of(t, points, triangles));
  const Crossing_test_3 cross(points, triangles);
  std::vector<Triangle_pair> found;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Triangle_box_3& a, const Triangle_box_3& b) {
    if (cross(a.info(), b.info())) found.push_back(std::minmax(a.info(), b.info()));
  });
  std::sort(found.begin(), found.end());
  return found;
}

/// The same for pairs with at least one marked triangle.
inline std::vector<Triangle_pair> crossing_triangles(std::span<const Eigen::Vector3d> points,
                                                     std::span<const Index_triangle> triangles,
                                                     const std::vector<char>& is_marked) {
  std::vector<Triangle_box_3> marked, all;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    all.push_back(box_of(t, points, triangles));
    if (is_marked[t]) marked.push_back(all.back());
  }
  if (2 * marked.size() > all.size()) return crossing_triangles(points, triangles);
  const Crossing_test_3 cross(points, triangles);
  std::vector<Triangle_pair> found;
  CGAL::box_intersection_d(marked.begin(), marked.end(), all.begin(), all.end(),
                           [&](const Triangle_box_3& a, const Triangle_box_3& b) {
                             const auto s = a.info(), t = b.info();
                             if (s == t || (is_marked[t] && t < s)) return;
                             if (cross(s, t)) found.push_back(std::minmax(s, t));
                           });
  std::sort(found.begin(), found.end());
  return found;
}

/// A triangle mesh with the edge-adjacent neighbors of every point.
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

  /// The normal of a triangle with the given points; its length is twice the area.
  static Vector normal(const Index_triangle& t, const std::vector<Vector>& points) {
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
  }

  /// The center of a triangle.
  Vector center(std::size_t t) const {
    const auto& [a, b, c] = triangles_[t];
    return (points_[a] + points_[b] + points_[c]) / 3;
  }

  /// For each point the sum of the normals of its triangles.
  std::vector<Vector> vertex_normals() const {
    std::vector<Vector> sums(points_.size(), Vector::Zero());
    for (const auto& t : triangles_)
      for (const auto v : t) sums[v] += normal(t, points_);
    return sums;
  }

  /// The mean length of the edges at a point; 0 if there are none.
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

/// The points and triangles of a mesh, with vertices in their order.
/// \throw std::invalid_argument if a face is not a triangle, or a coordinate is not finite
template <class Mesh, class Parameters>
Triangle_array_3 triangle_array_of(const Mesh& mesh, const Parameters& parameters) {
  Indexed_polygons faces = indexed_polygons_of_graph(mesh, parameters);
  std::vector<Index_triangle> triangles;
  for (const auto& face : faces.polygons) {
    check_argument(face.size() == 3, "a face of the mesh is not a triangle: triangulate the faces first");
    triangles.push_back({face[0], face[1], face[2]});
  }
  return Triangle_array_3(std::move(faces.points), std::move(triangles));
}

} // namespace equiaffine::internal

#endif
