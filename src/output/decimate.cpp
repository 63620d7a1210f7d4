// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/decimate.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

using Points = std::vector<Kernel::Point_3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// The coordinates of points where their box has its first corner at the origin and 1 as its longest side, so that no
/// square of a length leaves the range of numbers.
class Unit_box {
public:
  explicit Unit_box(const Points& points) {
    for (const auto& p : points) box_ += p.bbox();
    side_ = std::max({box_.x_span(), box_.y_span(), box_.z_span()});
  }

  Kernel::Vector_3 operator()(const Kernel::Point_3& p) const {
    return {(p.x() - box_.xmin()) / side_, (p.y() - box_.ymin()) / side_, (p.z() - box_.zmin()) / side_};
  }

private:
  CGAL::Bbox_3 box_;
  double side_;
};

double area_of(const Indexed_triangle_mesh_3<Kernel>& mesh, const Unit_box& unit) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Kernel::Vector_3 first = unit(mesh.points[a]);
    const auto normal = CGAL::cross_product(unit(mesh.points[b]) - first, unit(mesh.points[c]) - first);
    area += std::sqrt(normal.squared_length()) / 2;
  }
  return area;
}

/// The cell of a point among those of a grid with so many cells along the longest side of the box, as one number.
std::uint64_t cell_of(const Kernel::Vector_3& p, double cells) {
  constexpr int bits = 21;
  constexpr double last = (1 << bits) - 1;
  std::uint64_t cell = 0;
  for (int axis = 0; axis < 3; ++axis) cell = cell << bits | std::uint64_t(std::clamp(p[axis] * cells, 0.0, last));
  return cell;
}

/// Vertices in clusters: which cluster each vertex is in, and the vertex that stands for each cluster.
struct Clusters {
  std::vector<std::uint32_t> cluster_of, representative_of;
};

/// The vertex nearest to the mean of some vertices.
std::uint32_t middle_one(const Points& points, const Unit_box& unit,
                         const std::pair<std::uint64_t, std::uint32_t>* first,
                         const std::pair<std::uint64_t, std::uint32_t>* end) {
  Kernel::Vector_3 sum = CGAL::NULL_VECTOR;
  for (const auto* v = first; v != end; ++v) sum = sum + unit(points[v->second]);
  const Kernel::Vector_3 mean = sum / double(end - first);
  const auto distance = [&](const auto& v) { return (unit(points[v.second]) - mean).squared_length(); };
  return std::min_element(first, end, [&](const auto& v, const auto& w) { return distance(v) < distance(w); })->second;
}

Clusters clusters_of(const Points& points, const Unit_box& unit, double cells) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> vertices(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) vertices[v] = {cell_of(unit(points[v]), cells), std::uint32_t(v)};
  std::sort(vertices.begin(), vertices.end());
  Clusters clusters;
  clusters.cluster_of.resize(points.size());
  for (auto first = vertices.begin(); first != vertices.end();) {
    auto end = first;
    for (; end != vertices.end() && end->first == first->first; ++end)
      clusters.cluster_of[end->second] = std::uint32_t(clusters.representative_of.size());
    clusters.representative_of.push_back(middle_one(points, unit, &*first, &*first + (end - first)));
    first = end;
  }
  return clusters;
}

/// The triangles between three clusters, each of them once.
Triangles triangles_between(const Clusters& clusters, const Triangles& triangles) {
  Triangles result;
  for (const auto& triangle : triangles) {
    std::array<std::uint32_t, 3> t;
    for (std::size_t corner = 0; corner < 3; ++corner) t[corner] = clusters.cluster_of[triangle[corner]];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// The clusters that have a triangle, with the numbers of their representatives.
Displayed_mesh mesh_of(const Clusters& clusters, Triangles triangles, const Points& points,
                       const Vertex_attributes& attributes) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(clusters.representative_of.size(), none), kept;
  for (auto& triangle : triangles)
    for (auto& corner : triangle) {
      if (number[corner] == none) {
        number[corner] = std::uint32_t(kept.size());
        kept.push_back(clusters.representative_of[corner]);
      }
      corner = number[corner];
    }
  Displayed_mesh result;
  result.mesh.triangles = std::move(triangles);
  const auto pick = [&](const auto& all, auto& some) {
    some.reserve(kept.size());
    for (const std::uint32_t v : kept) some.push_back(all[v]);
  };
  pick(points, result.mesh.points);
  for (const auto& column : attributes.columns) {
    result.attributes.columns.push_back({column.name, {}});
    pick(column.values, result.attributes.columns.back().values);
  }
  if (attributes.status) pick(*attributes.status, result.attributes.status.emplace());
  return result;
}

} // namespace

Displayed_mesh decimate(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                        std::size_t most_triangles) {
  const Unit_box unit(mesh.points);
  // A plane meets up to 1.7 cells per square of their side, and a cluster has two triangles.
  double cells = std::sqrt(double(most_triangles) / (3.0 * area_of(mesh, unit)));
  while (true) {
    const Clusters clusters = clusters_of(mesh.points, unit, cells);
    Triangles triangles = triangles_between(clusters, mesh.triangles);
    if (triangles.size() <= most_triangles) return mesh_of(clusters, std::move(triangles), mesh.points, attributes);
    cells /= 1.1;
  }
}

} // namespace equiaffine
