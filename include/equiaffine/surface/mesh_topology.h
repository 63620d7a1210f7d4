// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_MESH_TOPOLOGY_H
#define EQUIAFFINE_SURFACE_MESH_TOPOLOGY_H

#include <equiaffine/base/disjoint_sets.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine {

/// What a list of triangles is as a topological space.
struct Mesh_topology {
  /// Every edge is in one triangle, or in two that pass it in opposite directions, and the triangles around every point
  /// form one fan or one closed ring. Points in no triangle and triangles with a repeated index violate this.
  bool is_manifold = true;
  std::size_t edges = 0;
  std::size_t boundary_edges = 0;          ///< edges in exactly one triangle
  std::size_t components = 0;              ///< connected by points; a point in no triangle counts
  std::ptrdiff_t euler_characteristic = 0; ///< points - edges + triangles
};

namespace internal {

/// The link of a point: for every triangle at the point its opposite edge, in the triangle's direction.
class Link {
public:
  using Index = std::uint32_t;

  void reset(Index center) {
    center_ = center;
    edges_.clear();
  }

  void add(const std::array<Index, 3>& triangle, std::size_t corner) {
    edges_.emplace_back(triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]);
  }

  /// Adds the edges from the center to greater indices; tells whether the link is one path or one circle.
  bool count_edges(Mesh_topology& topology) {
    neighbors_.clear();
    for (const auto& [a, b] : edges_) {
      neighbors_.push_back(a);
      neighbors_.push_back(b);
    }
    std::sort(neighbors_.begin(), neighbors_.end());
    for (auto first = neighbors_.begin(); first != neighbors_.end();) {
      const auto last = std::upper_bound(first, neighbors_.end(), *first);
      if (*first > center_) {
        ++topology.edges;
        if (last - first == 1) ++topology.boundary_edges;
      }
      first = last;
    }
    return is_path_or_circle();
  }

private:
  bool is_path_or_circle() {
    if (edges_.empty() || std::binary_search(neighbors_.begin(), neighbors_.end(), center_)) return false;
    std::sort(edges_.begin(), edges_.end());
    ends_.clear();
    for (const auto& [a, b] : edges_) {
      if (a == b) return false;
      ends_.push_back(b);
    }
    std::sort(ends_.begin(), ends_.end());
    const auto same_begin = [](const auto& e, const auto& f) { return e.first == f.first; };
    if (std::adjacent_find(edges_.begin(), edges_.end(), same_begin) != edges_.end() ||
        std::adjacent_find(ends_.begin(), ends_.end()) != ends_.end())
      return false;
    // Now a union of disjoint paths and circles: one, if a walk from the beginning of a path passes every edge.
    Index here = edges_.front().first;
    for (const auto& edge : edges_)
      if (!std::binary_search(ends_.begin(), ends_.end(), edge.first)) here = edge.first;
    const Index start = here;
    for (std::size_t passed = 0;;) {
      const auto edge = std::lower_bound(edges_.begin(), edges_.end(), std::pair(here, Index(0)));
      if (edge == edges_.end() || edge->first != here) return passed == edges_.size();
      here = edge->second;
      ++passed;
      if (here == start) return passed == edges_.size();
    }
  }

  Index center_ = 0;
  std::vector<std::pair<Index, Index>> edges_;
  std::vector<Index> neighbors_, ends_; // scratch
};

/// The triangles at every point: entry 3 t + c stands for corner c of triangle t, those of point v lie at
/// first[v] .. first[v + 1].
struct Corner_lists {
  Corner_lists(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t number_of_points)
      : first(number_of_points + 2), corners(3 * triangles.size()) {
    for (const auto& triangle : triangles)
      for (const std::uint32_t v : triangle) ++first[v + 2];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) corners[first[triangles[t][c] + 1]++] = 3 * t + c;
    first.pop_back();
  }

  std::vector<std::size_t> first, corners;
};

inline std::size_t number_of_components(std::span<const std::array<std::uint32_t, 3>> triangles,
                                        std::size_t number_of_points) {
  Disjoint_sets<std::uint32_t> sets(number_of_points);
  std::size_t components = number_of_points;
  for (const auto& triangle : triangles)
    for (std::size_t c = 1; c < 3; ++c)
      if (sets.unite(triangle[0], triangle[c])) --components;
  return components;
}

} // namespace internal

/// Topology from the indices alone: points with equal coordinates are different points. Time nearly linear, memory 32
/// bytes per triangle.
/// \pre indices are below `number_of_points`
inline Mesh_topology mesh_topology(std::span<const std::array<std::uint32_t, 3>> triangles,
                                   std::size_t number_of_points) {
  CGAL_precondition(std::all_of(triangles.begin(), triangles.end(), [&](const auto& t) {
    return t[0] < number_of_points && t[1] < number_of_points && t[2] < number_of_points;
  }));
  Mesh_topology topology;
  const internal::Corner_lists lists(triangles, number_of_points);
  internal::Link link;
  for (std::size_t v = 0; v < number_of_points; ++v) {
    link.reset(std::uint32_t(v));
    for (std::size_t i = lists.first[v]; i < lists.first[v + 1]; ++i)
      link.add(triangles[lists.corners[i] / 3], lists.corners[i] % 3);
    if (!link.count_edges(topology)) topology.is_manifold = false;
  }
  topology.components = internal::number_of_components(triangles, number_of_points);
  topology.euler_characteristic =
      std::ptrdiff_t(number_of_points) - std::ptrdiff_t(topology.edges) + std::ptrdiff_t(triangles.size());
  return topology;
}

} // namespace equiaffine

#endif
