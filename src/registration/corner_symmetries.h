// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_CORNER_SYMMETRIES_H
#define EQUIAFFINE_SRC_REGISTRATION_CORNER_SYMMETRIES_H

#include "registration/Affine_map_3.h"
#include "registration/mesh_samples.h"
#include <equiaffine/base/internal/Point_tree.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/mesh/internal/Triangles_3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A vertex whose angles do not add up to that of a plane or a half-plane, or at which a border bends. Corners depend on
/// the shape alone: however faces are cut into triangles, a symmetry moves corners to corners with the same angle.
struct Corner {
  Eigen::Vector3d point;
  double angle; ///< the sum of the angles of its triangles, and of that between edges of a border
  double error; ///< of the angle, by the rounding of coordinates
  bool is_on_border;
};

/// The sum of the angles between edges of the border at each vertex, 0 at those that have no two; `edges` are sorted.
inline std::vector<double> angles_of_borders(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges) {
  constexpr auto none = std::numeric_limits<std::size_t>::max();
  std::vector<double> angles(mesh.points.size());
  std::vector<std::size_t> neighbors(mesh.points.size(), none);
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next].ends == edges[i].ends) ++next;
    if (next - i != 1) continue;
    const std::array<std::size_t, 2> ends = {edges[i].ends[0], edges[i].ends[1]};
    for (const std::size_t k : {0U, 1U}) {
      const std::size_t v = ends[k];
      if (neighbors[v] == none) {
        neighbors[v] = ends[1 - k];
        continue;
      }
      const Eigen::Vector3d a = mesh.points[neighbors[v]] - mesh.points[v],
                            b = mesh.points[ends[1 - k]] - mesh.points[v];
      angles[v] += std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  return angles;
}

/// The corners of a mesh with these sorted edges, whose coordinates have a rounding error.
inline std::vector<Corner> corners_of(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges,
                                      double rounding) {
  constexpr double least_difference = 1e-3, greatest_error = 0.1, pi = std::numbers::pi;
  std::vector<double> angles(mesh.points.size()), errors(mesh.points.size());
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = mesh.points[triangle[k]], a = mesh.points[triangle[(k + 1) % 3]] - p,
                            b = mesh.points[triangle[(k + 2) % 3]] - p;
      angles[triangle[k]] += std::atan2(a.cross(b).norm(), a.dot(b));
      errors[triangle[k]] += 2 * rounding * (1 / a.norm() + 1 / b.norm());
    }
  const std::vector<double> of_borders = angles_of_borders(mesh, edges);
  std::vector<Corner> corners;
  for (std::size_t v = 0; v < angles.size(); ++v) {
    const bool is_on_border = of_borders[v] > 0;
    const double least = least_difference + errors[v];
    const bool is_flat = std::abs(angles[v] - (is_on_border ? pi : 2 * pi)) <= least;
    const bool is_straight = !is_on_border || std::abs(of_borders[v] - pi) <= least;
    if (!(angles[v] > 0) || (is_flat && is_straight) || !(errors[v] < greatest_error)) continue;
    corners.push_back({mesh.points[v], angles[v] + of_borders[v], 2 * errors[v] + 1e-9, is_on_border});
  }
  return corners;
}

/// The search for all rotations and reflections about the origin that move the corners of a mesh to each other. Two
/// corners that are not in line with the origin determine a map together with their images, which are among the few
/// corners at the same distance and with the same angle.
class Corner_symmetry_search {
public:
  /// Corners that are nearer to each other than `tolerance` are equal.
  Corner_symmetry_search(std::vector<Corner> corners, double tolerance)
      : corners_(std::move(corners)), tolerance_(tolerance) {
    std::stable_sort(corners_.begin(), corners_.end(),
                     [](const Corner& a, const Corner& b) { return a.point.squaredNorm() < b.point.squaredNorm(); });
    std::vector<Eigen::Vector3d> points;
    for (const Corner& c : corners_) points.push_back(c.point);
    tree_ = Point_tree<3>(points);
  }

  /// Returns the maps but the identity; nothing if there are too few corners, or too many that are alike.
  std::optional<std::vector<Affine_map_3>> run(bool in_threads, bool allows_reflections) const {
    const auto base = choose_base();
    if (!base) return std::nullopt;
    const auto [first, second] = *base;
    std::vector<Affine_map_3> maps;
    const std::vector<std::size_t> images = alike(first), others = alike(second);
    if (double(images.size()) * double(others.size()) > most_pairs) return std::nullopt;
    const Eigen::Matrix3d frame = frame_of(first, second);
    const double distance = (corners_[first].point - corners_[second].point).norm();
    std::vector<std::vector<Affine_map_3>> found(images.size());
    parallel_for(in_threads, 0, images.size(), [&](std::size_t n) {
      for (const std::size_t j : others) {
        if (std::abs((corners_[images[n]].point - corners_[j].point).norm() - distance) > 4 * tolerance_) continue;
        Eigen::Matrix3d image = frame_of(images[n], j);
        for (const double side : {1.0, -1.0}) {
          if (side < 0 && !allows_reflections) continue;
          image.col(2) *= side;
          if (const auto map = refined(image * frame.transpose())) found[n].push_back(*map);
        }
      }
    });
    for (const auto& some : found) maps.insert(maps.end(), some.begin(), some.end());
    std::erase_if(maps, [](const Affine_map_3& m) { return (m.matrix - Eigen::Matrix3d::Identity()).norm() < 1e-4; });
    return maps;
  }

private:
  static constexpr std::size_t most_alike = 3000, most_verified = 5000;
  static constexpr double most_pairs = 4e6, least_sine = 0.2;

  bool are_alike(const Corner& a, const Corner& b) const {
    return std::abs(a.angle - b.angle) <= a.error + b.error &&
           std::abs(a.point.norm() - b.point.norm()) <= 2 * tolerance_;
  }

  /// The corners that may be images of a corner.
  std::vector<std::size_t> alike(std::size_t i) const {
    const double radius = corners_[i].point.norm();
    const auto begin = std::lower_bound(corners_.begin(), corners_.end(), radius - 2 * tolerance_,
                                        [](const Corner& c, double r) { return c.point.norm() < r; });
    std::vector<std::size_t> result;
    for (auto c = begin; c != corners_.end() && c->point.norm() <= radius + 2 * tolerance_; ++c)
      if (are_alike(*c, corners_[i])) result.push_back(std::size_t(c - corners_.begin()));
    return result;
  }

  /// Returns the two corners with the fewest corners like them.
  std::optional<std::array<std::size_t, 2>> choose_base() const {
    constexpr std::size_t most_tried = 400; // corners at the same distance make the count of all of them slow
    if (corners_.size() < 3) return std::nullopt;
    const double greatest = corners_.back().point.norm();
    std::vector<std::pair<std::size_t, std::size_t>> order;
    const std::size_t step = 1 + corners_.size() / most_tried;
    for (std::size_t i = corners_.size() % step; i < corners_.size(); i += step)
      if (corners_[i].point.norm() > 0.1 * greatest) order.emplace_back(alike(i).size(), corners_.size() - i);
    std::stable_sort(order.begin(), order.end());
    for (const auto& [count, from_end] : order) {
      if (count > most_alike) break;
      const std::size_t first = corners_.size() - order.front().second, other = corners_.size() - from_end;
      const Eigen::Vector3d &p = corners_[first].point, &q = corners_[other].point;
      if (p.cross(q).norm() > least_sine * p.norm() * q.norm()) return std::array{first, other};
    }
    return std::nullopt;
  }

  /// An orthonormal frame of two corners.
  Eigen::Matrix3d frame_of(std::size_t i, std::size_t j) const {
    Eigen::Matrix3d frame;
    frame.col(0) = corners_[i].point.normalized();
    frame.col(2) = corners_[i].point.cross(corners_[j].point).normalized();
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
  }

  /// Returns the map that moves corners nearest to their images (K. Arun et al., Least-squares fitting of two 3-D point
  /// sets, 1987), if there is one for each of them.
  std::optional<Affine_map_3> refined(const Eigen::Matrix3d& matrix) const {
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    const double limit = 8 * tolerance_; // the two corners of the base make the errors of others larger
    const std::size_t count = std::min(corners_.size(), most_verified);
    for (std::size_t n = 0; n < count; ++n) {
      const Corner& c = corners_[corners_.size() - 1 - n * corners_.size() / count];
      const Eigen::Vector3d p = matrix * c.point;
      const auto nearest = tree_.neighbors(p, 1);
      const Corner& image = corners_[nearest[0].index];
      if (nearest[0].distance > limit || !are_alike(c, image)) return std::nullopt;
      products += image.point * c.point.transpose();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    const Eigen::Matrix3d v = svd.matrixV();
    if ((u * v.transpose()).determinant() * matrix.determinant() < 0) u.col(2) *= -1;
    return Affine_map_3{u * v.transpose(), Eigen::Vector3d::Zero()};
  }

  std::vector<Corner> corners_; ///< by their distance from the origin
  double tolerance_;
  Point_tree<3> tree_;
};

} // namespace equiaffine::internal

#endif
