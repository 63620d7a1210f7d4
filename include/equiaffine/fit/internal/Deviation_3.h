// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_DEVIATION_3_H
#define EQUIAFFINE_FIT_INTERNAL_DEVIATION_3_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/mesh/internal/Triangle_array_3.h>
#include <equiaffine/mesh/internal/Triangle_tree_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// How far other meshes are from a mesh, and this one from them, at vertices and centers of triangles.
class Deviation_3 {
public:
  explicit Deviation_3(const Triangle_array_3& mesh) : mesh_(mesh), tree_(tree_of(mesh)) {}

  /// The vertices beside which the meshes are farther from each other than a limit: those that are, the corners of
  /// triangles whose centers are, and those of the triangles nearest to what is in the other mesh. In order.
  template <class ConcurrencyTag>
  std::vector<std::uint32_t> far_vertices(const Triangle_array_3& other, double limit) const {
    std::vector<std::uint32_t> far;
    const auto corners_of = [&](std::size_t triangle) {
      const auto& corners = mesh_.triangles()[triangle];
      far.insert(far.end(), corners.begin(), corners.end());
    };
    const Triangle_tree_3 other_tree = tree_of(other);
    const std::size_t vertices = mesh_.points().size();
    const auto mine = distances<ConcurrencyTag>(mesh_, other_tree);
    for (std::size_t k = 0; k < mine.size(); ++k) {
      if (!(mine[k].first > limit)) continue;
      if (k < vertices) far.push_back(std::uint32_t(k));
      else corners_of(k - vertices);
    }
    for (const auto& [distance, nearest] : distances<ConcurrencyTag>(other, tree_))
      if (distance > limit) corners_of(nearest);
    std::sort(far.begin(), far.end());
    far.erase(std::unique(far.begin(), far.end()), far.end());
    return far;
  }

  /// The greatest distance of the other mesh from this one, and of this one from the other.
  template <class ConcurrencyTag>
  std::pair<double, double> greatest(const Triangle_array_3& other) const {
    const auto greatest_of = [](const auto& distances) {
      double result = 0;
      for (const auto& [distance, nearest] : distances) result = std::max(result, distance);
      return result;
    };
    return {greatest_of(distances<ConcurrencyTag>(other, tree_)),
            greatest_of(distances<ConcurrencyTag>(mesh_, tree_of(other)))};
  }

private:
  using Vector = Eigen::Vector3d;

  static Triangle_tree_3::Point_3 point_of(const Vector& p) { return {p[0], p[1], p[2]}; }

  static Triangle_tree_3 tree_of(const Triangle_array_3& mesh) {
    return Triangle_tree_3(mesh.points(), mesh.triangles(), point_of);
  }

  /// The distances of the vertices and then of the centers of the triangles of a mesh, and the nearest triangles; 0 for
  /// vertices in no triangle.
  template <class ConcurrencyTag>
  static std::vector<std::pair<double, std::size_t>> distances(const Triangle_array_3& mesh,
                                                               const Triangle_tree_3& tree) {
    const std::size_t vertices = mesh.points().size();
    std::vector<std::pair<double, std::size_t>> result(vertices + mesh.triangles().size());
    parallel_for<ConcurrencyTag>(
        0, result.size(),
        [&](std::size_t k) {
          if (k < vertices && mesh.neighbors(k).empty()) return;
          result[k] = tree.nearest(point_of(k < vertices ? mesh.points()[k] : mesh.center(k - vertices)));
        },
        64);
    return result;
  }

  const Triangle_array_3& mesh_;
  const Triangle_tree_3 tree_;
};

} // namespace equiaffine::internal

#endif
