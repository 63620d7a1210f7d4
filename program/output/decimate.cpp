// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/displays.h"

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

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The number of bits of a cell's index along an axis.
constexpr int bits = 21;
constexpr double most_cells = (1 << bits) - 1;

bool is_finite(const Kernel::Point_3& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

/// The vertices of the triangles that have three finite corners, in order.
std::vector<std::uint32_t> shown_vertices(const Indexed_triangle_mesh_3<Kernel>& mesh) {
  std::vector<bool> is_shown(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles)
    if (is_finite(mesh.points[a]) && is_finite(mesh.points[b]) && is_finite(mesh.points[c]))
      is_shown[a] = is_shown[b] = is_shown[c] = true;
  std::vector<std::uint32_t> vertices;
  for (std::size_t v = 0; v < is_shown.size(); ++v)
    if (is_shown[v]) vertices.push_back(std::uint32_t(v));
  return vertices;
}

/// Maps the box of some points to one with its first corner at the origin and longest side 1, so that squared lengths
/// do not overflow or underflow.
class Unit_box {
public:
  Unit_box(const Points& points, const std::vector<std::uint32_t>& some) {
    for (const std::uint32_t v : some) box_ += points[v].bbox();
    const Kernel::Vector_3 last = from_first_corner({box_.xmax(), box_.ymax(), box_.zmax()});
    if (const double longest = std::max({last.x(), last.y(), last.z()}); longest > 0) side_ = longest;
  }

  Kernel::Vector_3 operator()(const Kernel::Point_3& p) const {
    const Kernel::Vector_3 v = from_first_corner(p);
    return {v.x() / side_, v.y() / side_, v.z() / side_};
  }

private:
  /// Half of the vector, since the whole vector may overflow.
  Kernel::Vector_3 from_first_corner(const Kernel::Point_3& p) const {
    return {p.x() / 2 - box_.xmin() / 2, p.y() / 2 - box_.ymin() / 2, p.z() / 2 - box_.zmin() / 2};
  }

  CGAL::Bbox_3 box_;
  double side_ = 1;
};

/// The area of the triangles with three finite corners.
double area_of(const Indexed_triangle_mesh_3<Kernel>& mesh, const Unit_box& unit) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Kernel::Vector_3 first = unit(mesh.points[a]);
    const auto normal = CGAL::cross_product(unit(mesh.points[b]) - first, unit(mesh.points[c]) - first);
    if (const double squared = normal.squared_length(); std::isfinite(squared)) area += std::sqrt(squared) / 2;
  }
  return area;
}

/// The index of a point's cell in a grid with `cells` cells along the longest side of the box.
std::uint64_t cell_of(const Kernel::Vector_3& p, double cells) {
  std::uint64_t cell = 0;
  for (int axis = 0; axis < 3; ++axis)
    cell = cell << bits | std::uint64_t(std::clamp(p[axis] * cells, 0.0, most_cells));
  return cell;
}

/// The cluster of each vertex, or none, and the representative vertex of each cluster.
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

Clusters clusters_of(const Points& points, const std::vector<std::uint32_t>& some, const Unit_box& unit, double cells) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> vertices;
  vertices.reserve(some.size());
  for (const std::uint32_t v : some) vertices.emplace_back(cell_of(unit(points[v]), cells), v);
  std::sort(vertices.begin(), vertices.end());
  Clusters clusters;
  clusters.cluster_of.assign(points.size(), none);
  for (auto first = vertices.begin(); first != vertices.end();) {
    auto end = first;
    for (; end != vertices.end() && end->first == first->first; ++end)
      clusters.cluster_of[end->second] = std::uint32_t(clusters.representative_of.size());
    clusters.representative_of.push_back(middle_one(points, unit, &*first, &*first + (end - first)));
    first = end;
  }
  return clusters;
}

/// The triangles between three different clusters, each once, without triangles with a corner in no cluster.
Triangles triangles_between(const Clusters& clusters, const Triangles& triangles) {
  Triangles result;
  for (const auto& triangle : triangles) {
    std::array<std::uint32_t, 3> t;
    for (std::size_t corner = 0; corner < 3; ++corner) t[corner] = clusters.cluster_of[triangle[corner]];
    if (std::find(t.begin(), t.end(), none) != t.end()) continue;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// The mesh of the representatives of clusters with a triangle, with their attributes.
Displayed_mesh mesh_of(const Clusters& clusters, Triangles triangles, const Points& points,
                       const Vertex_attributes& attributes) {
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
  const std::vector<std::uint32_t> shown = shown_vertices(mesh);
  const Unit_box unit(mesh.points, shown);
  Clusters clusters;
  Triangles triangles;
  const auto cut = [&](double cells) {
    clusters = {};
    triangles = {};
    clusters = clusters_of(mesh.points, shown, unit, cells);
    triangles = triangles_between(clusters, mesh.triangles);
  };
  // A plane meets up to 1.7 cells per squared cell size, and there are two triangles per cluster.
  double cells = std::clamp(std::sqrt(double(most_triangles) / (3.0 * area_of(mesh, unit))), 1.0, most_cells);
  cut(cells);
  // This is too coarse if a few large triangles have most of the area.
  while (triangles.size() < most_triangles / 3 && cells < most_cells) {
    cells = std::min(2 * cells, most_cells);
    cut(cells);
  }
  while (triangles.size() > most_triangles) {
    cells *= std::clamp(std::sqrt(0.9 * double(most_triangles) / double(triangles.size())), 0.25, 0.91);
    cut(cells);
  }
  return mesh_of(clusters, std::move(triangles), mesh.points, attributes);
}

} // namespace equiaffine
