// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_SURFACE_DISTANCES_H
#define EQUIAFFINE_SRC_REGISTRATION_SURFACE_DISTANCES_H

#include "registration/Area_samples_3.h"
#include "registration/Framed_function_3.h"
#include "registration/Mapped_function_3.h"
#include "registration/mesh_samples.h"
#include "registration/nearest_triangle.h"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The distance of any point from a surface, and the direction in which it grows.
class Surface_distances {
public:
  virtual ~Surface_distances() = default;
  virtual Signed_distance_3 operator()(const Eigen::Vector3d& p) const = 0;

  /// About the distance, fast, from far away, too.
  double about(const Eigen::Vector3d& p) const {
    return std::sqrt(nearest_triangle(tree_, to_CGAL(p)).squared_distance);
  }

protected:
  explicit Surface_distances(std::vector<Triangle_tree::Triangle_3> triangles) : tree_(tree_of(std::move(triangles))) {}

  const Triangle_tree& tree() const { return tree_; }

  /// The distance between a point p and the nearest one of a surface, whose normal is the direction if p is on it.
  static Signed_distance_3 distance_between(const Eigen::Vector3d& p, const Eigen::Vector3d& nearest,
                                            const Eigen::Vector3d& normal) {
    const Eigen::Vector3d way = p - nearest;
    const double distance = way.norm();
    if (distance > 1e-9) return {distance, way / distance};
    return {way.dot(normal), normal};
  }

private:
  Triangle_tree tree_; ///< of the triangles of a mesh, or of points as triangles
};

/// The distances from the triangles of a mesh.
class Mesh_distances final : public Surface_distances {
public:
  explicit Mesh_distances(const Triangles_3& mesh) : Surface_distances(triangles_with_area(mesh)) {}

  Signed_distance_3 operator()(const Eigen::Vector3d& p) const override {
    const auto found = nearest_triangle(tree(), to_CGAL(p));
    return distance_between(p, to_Eigen(found.point), unit_normal(tree().triangle(found.part)));
  }
};

/// The distances from the zero set of a function: those from its samples, which Newton's steps along the gradient make
/// exact near the surface.
class Function_distances final : public Surface_distances {
public:
  Function_distances(const Mapped_function_3& function, const Area_samples_3& samples)
      : Surface_distances(points_of(samples)), function_(function), spacing_(samples.spacing()) {}

  Signed_distance_3 operator()(const Eigen::Vector3d& p) const override {
    const auto found = nearest_triangle(tree(), to_CGAL(p));
    const Eigen::Vector3d sample = to_Eigen(found.point);
    const double bound = std::sqrt(found.squared_distance);
    if (bound > 4 * spacing_) return {bound, (p - sample) / bound};
    const auto [nearest, normal, is_zero] = nearest_zero(p, bound);
    if (is_zero && (p - nearest).norm() <= bound + 1e-12) return distance_between(p, nearest, normal);
    return distance_between(p, sample, normal);
  }

private:
  struct Zero {
    Eigen::Vector3d point, normal;
    bool has_converged;
  };

  /// Newton's steps, none longer than the way to the nearest sample. The last one is below 1/100 of the whole way.
  Zero nearest_zero(const Eigen::Vector3d& p, double bound) const {
    constexpr int most_steps = 8;
    Zero zero = {p, Eigen::Vector3d::UnitZ(), false};
    for (int n = 0; n < most_steps && !zero.has_converged; ++n) {
      const auto [value, gradient] = function_.first_order(zero.point);
      const double length = gradient.norm();
      if (!(length > 0) || !std::isfinite(value / length)) return zero;
      const double step = value / length;
      if (std::abs(step) > 2 * bound + 1e-12) return zero;
      zero.normal = gradient / length;
      zero.point -= step * zero.normal;
      zero.has_converged = std::abs(step) <= std::max(1e-13, 0.01 * (p - zero.point).norm()) || std::abs(step) < 1e-9;
    }
    return zero;
  }

  static std::vector<Triangle_tree::Triangle_3> points_of(const Area_samples_3& samples) {
    std::vector<Triangle_tree::Triangle_3> result;
    for (const Eigen::Vector3d& p : samples.points) result.emplace_back(to_CGAL(p), to_CGAL(p), to_CGAL(p));
    return result;
  }

  Mapped_function_3 function_;
  double spacing_;
};

} // namespace equiaffine::internal

#endif
