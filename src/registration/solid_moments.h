// SPDX-License-Identifier: GPL-3.0-or-later
// The moments of the solid bounded by a mesh, which may have holes and inconsistent orientations.
#ifndef EQUIAFFINE_SRC_REGISTRATION_SOLID_MOMENTS_H
#define EQUIAFFINE_SRC_REGISTRATION_SOLID_MOMENTS_H

#include "registration/mesh_samples.h"
#include <equiaffine/base/internal/index_sets.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// The moments of the solids bounded by the components of a mesh. They are equivariant under affine maps, and do not
/// depend on the orientations of the facets.
class Solid_moments {
public:
  Solid_moments(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges)
      : mesh_(mesh), edges_(edges), component_(mesh.triangles.size()), is_turned_(mesh.triangles.size()) {
    orient();
  }

  /// Returns the moments with holes closed by fans of triangles; nothing if that changes the shape of the solid by more
  /// than a tolerance, or if there is no solid.
  std::optional<Moments_3> moments(const Eigen::Vector3d& origin, double tolerance) const {
    const auto open = sums(origin, false), closed = sums(origin, true);
    if (!(closed.measure > 0) || closed.covariance.llt().info() != Eigen::Success) return std::nullopt;
    if (!(open.measure > 0) || open.covariance.llt().info() != Eigen::Success) return std::nullopt;
    const Affine_map_3 change = whitening_map(closed) * whitening_map(open).inverse();
    const Eigen::Matrix3d difference = change.matrix * change.matrix.transpose() - Eigen::Matrix3d::Identity();
    if (!(difference.norm() < tolerance && change.translation.norm() < tolerance)) return std::nullopt;
    return closed;
  }

private:
  bool is_degenerate(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return a == b || b == c || c == a;
  }

  /// Orients the triangles of each component consistently across edges with two triangles.
  void orient() {
    struct Neighbor {
      std::uint32_t triangle;
      bool is_turned;
    };
    const std::size_t count = mesh_.triangles.size();
    std::vector<std::vector<Neighbor>> neighbors(count);
    for (std::size_t i = 0, next = 0; i < edges_.size(); i = next) {
      while (next < edges_.size() && edges_[next].ends == edges_[i].ends) ++next;
      if (next - i != 2 || edges_[i].triangle == edges_[i + 1].triangle) continue;
      const bool is_turned = edges_[i].is_forward == edges_[i + 1].is_forward;
      neighbors[edges_[i].triangle].push_back({edges_[i + 1].triangle, is_turned});
      neighbors[edges_[i + 1].triangle].push_back({edges_[i].triangle, is_turned});
    }
    constexpr auto none = std::uint32_t(-1);
    component_.assign(count, none);
    std::vector<std::uint32_t> open;
    for (std::uint32_t first = 0; first < count; ++first) {
      if (component_[first] != none) continue;
      component_[first] = components_;
      open.push_back(first);
      while (!open.empty()) {
        const std::uint32_t t = open.back();
        open.pop_back();
        for (const auto& [triangle, is_turned] : neighbors[t]) {
          if (component_[triangle] != none) continue;
          component_[triangle] = components_;
          is_turned_[triangle] = is_turned_[t] != is_turned;
          open.push_back(triangle);
        }
      }
      ++components_;
    }
  }

  std::array<std::uint32_t, 3> oriented(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return is_turned_[t] ? std::array{a, c, b} : std::array{a, b, c};
  }

  /// The sums over the components, each taken with positive volume.
  Moments_3 sums(const Eigen::Vector3d& origin, bool with_fans) const {
    std::vector<Moment_sums_3> parts(components_, Moment_sums_3(origin));
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto [a, b, c] = oriented(t);
      parts[component_[t]].add_cone(mesh_.points[a], mesh_.points[b], mesh_.points[c]);
    }
    if (with_fans) add_fans(parts);
    Moment_sums_3 all(origin);
    for (const Moment_sums_3& part : parts) all.add(part, part.measure() < 0 ? -1 : 1);
    return all.moments();
  }

  /// Closes each border of a component by a fan of triangles around its centroid.
  void add_fans(std::vector<Moment_sums_3>& parts) const {
    std::map<std::array<std::uint32_t, 3>, int> excess; // of a directed edge of a component over its reverse
    const auto is_forward = [&](const Edge_of_triangle& e) { return e.is_forward != is_turned_[e.triangle]; };
    for (std::size_t i = 0, next = 0; i < edges_.size(); i = next) {
      while (next < edges_.size() && edges_[next].ends == edges_[i].ends) ++next;
      const Edge_of_triangle &e = edges_[i], &f = edges_[next - 1];
      const bool is_matched = next - i == 2 && component_[e.triangle] == component_[f.triangle] &&
                              is_forward(e) != is_forward(f) && !is_degenerate(e.triangle) &&
                              !is_degenerate(f.triangle);
      if (is_matched) continue;
      for (std::size_t k = i; k < next; ++k)
        if (!is_degenerate(edges_[k].triangle))
          excess[{component_[edges_[k].triangle], edges_[k].ends[0], edges_[k].ends[1]}] +=
              is_forward(edges_[k]) ? 1 : -1;
    }
    Disjoint_sets<std::uint32_t> loops(mesh_.points.size());
    for (const auto& [edge, count] : excess)
      if (count != 0) loops.unite(edge[1], edge[2]);
    struct Border {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double length = 0;
    };
    std::map<std::array<std::uint32_t, 2>, Border> borders;
    for (const auto& [edge, count] : excess) {
      if (count == 0) continue;
      const Eigen::Vector3d &a = mesh_.points[edge[1]], &b = mesh_.points[edge[2]];
      Border& border = borders[{edge[0], loops.find(edge[1])}];
      border.sum += (b - a).norm() * (a + b) / 2;
      border.length += (b - a).norm();
    }
    for (const auto& [edge, count] : excess) {
      if (count == 0) continue;
      const Border& border = borders[{edge[0], loops.find(edge[1])}];
      if (!(border.length > 0)) continue;
      const Eigen::Vector3d center = border.sum / border.length;
      const auto first = count > 0 ? edge[2] : edge[1], second = count > 0 ? edge[1] : edge[2];
      for (int n = 0; n < std::abs(count); ++n)
        parts[edge[0]].add_cone(center, mesh_.points[first], mesh_.points[second]);
    }
  }

  const Triangles_3& mesh_;
  const std::vector<Edge_of_triangle>& edges_;
  std::vector<std::uint32_t> component_;
  std::vector<bool> is_turned_;
  std::uint32_t components_ = 0;
};

} // namespace equiaffine::internal

#endif
