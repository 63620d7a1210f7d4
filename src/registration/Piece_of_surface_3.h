// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_PIECE_OF_SURFACE_3_H
#define EQUIAFFINE_SRC_REGISTRATION_PIECE_OF_SURFACE_3_H

#include "registration/Area_samples_3.h"
#include "registration/mesh_samples.h"
#include "registration/nearest_triangle.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The point of a piece that is nearest to another point.
struct Point_of_piece {
  Eigen::Vector3d point, normal;
  bool is_on_border; ///< the surface may go on there
};

/// The samples by which a map between pieces is judged.
constexpr std::size_t samples_of_piece = 4000;

/// A mesh as a part of the boundary of a solid, which goes on beyond the border of the mesh.
class Piece_of_surface_3 {
public:
  /// Takes a mesh with its sorted edges. Points are on the border to within `border_width`.
  /// \pre the mesh has an area.
  Piece_of_surface_3(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges, std::size_t count,
                     double border_width)
      : samples_(mesh_samples(mesh, edges, count)), volume_(volume_moments(mesh, samples_.area.centroid).measure),
        tree_(tree_of(triangles_with_area(mesh))), border_(border_of(mesh, edges)), border_width_(border_width),
        is_oriented_(has_orientation(edges)) {}

  const Area_samples_3& samples() const { return samples_; }
  bool is_closed() const { return !border_; }
  double volume() const { return volume_; }         ///< that a closed mesh bounds, below 0 if it is inside out
  bool is_oriented() const { return is_oriented_; } ///< whether neighbors have the same side

  /// Whether a point is on the border is left out for those nearer than `touching`.
  Point_of_piece nearest(const Eigen::Vector3d& p, double touching) const {
    const auto found = nearest_triangle(tree_, to_CGAL(p));
    const bool is_on_border = border_ && found.squared_distance > touching * touching &&
                              nearest_triangle(*border_, found.point).squared_distance < border_width_ * border_width_;
    return {to_Eigen(found.point), unit_normal(tree_.triangle(found.part)), is_on_border};
  }

private:
  /// The edges of one triangle only, as triangles with two equal corners.
  static std::optional<Triangle_tree> border_of(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges) {
    std::vector<Triangle_tree::Triangle_3> border;
    for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
      while (next < edges.size() && edges[next].ends == edges[i].ends) ++next;
      if (next - i > 1) continue;
      const auto a = to_CGAL(mesh.points[edges[i].ends[0]]), b = to_CGAL(mesh.points[edges[i].ends[1]]);
      border.emplace_back(a, b, b);
    }
    if (border.empty()) return std::nullopt;
    return tree_of(std::move(border));
  }

  /// Whether at most one in a hundred edges has two triangles on different sides.
  static bool has_orientation(const std::vector<Edge_of_triangle>& edges) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
      wrong += edges[i].ends == edges[i + 1].ends && edges[i].is_forward == edges[i + 1].is_forward;
    return 100 * wrong <= edges.size();
  }

  Area_samples_3 samples_;
  double volume_;
  Triangle_tree tree_;
  std::optional<Triangle_tree> border_;
  double border_width_;
  bool is_oriented_;
};

} // namespace equiaffine::internal

#endif
