// SPDX-License-Identifier: GPL-3.0-or-later
// The distances from a surface given as a mesh or a function, and samples of the zero set of a function.
#ifndef EQUIAFFINE_SRC_REGISTRATION_SURFACE_DISTANCES_H
#define EQUIAFFINE_SRC_REGISTRATION_SURFACE_DISTANCES_H

#include "registration/Affine_map_3.h"
#include "registration/Framed_surface_3.h"
#include "registration/mesh_samples.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>

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

/// A function in other coordinates, restricted to its box, which is a parallelepiped there.
class Mapped_function_3 {
public:
  /// `map` goes from the coordinates of the function to the new ones.
  Mapped_function_3(Any_function_3 function, const Affine_map_3& map)
      : function_(std::move(function)), map_(map), inverse_(map.inverse()), box_(function_.bbox()) {
    for (int a = 0; a < 3; ++a) {
      lower_[a] = box_.min(a);
      sides_[a] = box_.max(a) - box_.min(a);
    }
  }

  const Affine_map_3& map() const { return map_; }
  Eigen::Vector3d center() const { return map_(lower_ + sides_ / 2); }

  /// The radius of the ball around the center that contains the box.
  double radius() const {
    double result = 0;
    for (int corner = 0; corner < 8; ++corner)
      result = std::max(
          result,
          (map_(lower_ + sides_.cwiseProduct(Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2 & 1))) - center())
              .norm());
    return result;
  }

  /// The value at relative coordinates, from 0 to 1, in the box.
  double value_in_box(const Eigen::Vector3d& parts) const {
    return function_.value(to_CGAL(lower_ + sides_.cwiseProduct(parts)));
  }

  std::vector<double> values(const std::vector<Eigen::Vector3d>& points) const {
    std::vector<Point_3> at;
    at.reserve(points.size());
    for (const Eigen::Vector3d& p : points) at.push_back(to_CGAL(inverse_(p)));
    std::vector<double> result(points.size());
    function_.values(at, result);
    return result;
  }

  /// The first and the last parameter of a line in the box.
  std::pair<double, double> part_in_box(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d from = inverse_(origin) - lower_, along = inverse_.matrix * direction;
    double first = -std::numeric_limits<double>::infinity(), last = -first;
    for (int a = 0; a < 3; ++a) {
      const double s = -from[a] / along[a], t = (sides_[a] - from[a]) / along[a];
      first = std::max(first, std::min(s, t));
      last = std::min(last, std::max(s, t));
    }
    return {first, last};
  }

  /// The value, and the gradient in the new coordinates; NaN outside of the box. If two arguments of a maximum are
  /// equal, its expansion is not finite, and finite differences are used.
  std::pair<double, Eigen::Vector3d> first_order(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = inverse_(p);
    if (!contains(q)) {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      return {nan, Eigen::Vector3d::Constant(nan)};
    }
    const auto jet = function_.first_order(to_CGAL(q));
    Eigen::Vector3d gradient = eigen_gradient(jet);
    if (!gradient.allFinite()) gradient = differences(q);
    return {jet.value(), inverse_.matrix.transpose() * gradient};
  }

  Eigen::Vector3d gradient(const Eigen::Vector3d& p) const { return first_order(p).second; }

  /// A zero on a segment whose ends have different signs, or nothing if there is a pole or a jump.
  std::optional<Eigen::Vector3d> zero_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    const Point_3 p = to_CGAL(inverse_(a)), q = to_CGAL(inverse_(b));
    const double f = function_.value(p), g = function_.value(q);
    if (!is_sign_change(f, g)) return std::nullopt;
    const auto found = function_.intersect_segment(p, q, f, g);
    if (!found.has_converged) return std::nullopt;
    return map_(Eigen::Vector3d(found.point.x(), found.point.y(), found.point.z()));
  }

private:
  using Point_3 = Any_function_3::Point_3;

  Eigen::Vector3d differences(const Eigen::Vector3d& q) const {
    const double step = 1e-6 * sides_.maxCoeff();
    const auto value = [&](const Eigen::Vector3d& p) { return function_.value(to_CGAL(p)); };
    Eigen::Vector3d result;
    for (int a = 0; a < 3; ++a) {
      const Eigen::Vector3d shift = step * Eigen::Vector3d::Unit(a);
      result[a] = (value(q + shift) - value(q - shift)) / (2 * step);
    }
    return result;
  }

  static Point_3 to_CGAL(const Eigen::Vector3d& p) { return Point_3(p[0], p[1], p[2]); }

  bool contains(const Eigen::Vector3d& p) const {
    return (p.array() >= lower_.array()).all() && ((p - lower_).array() <= sides_.array()).all();
  }

  Any_function_3 function_;
  Affine_map_3 map_, inverse_;
  CGAL::Bbox_3 box_;
  Eigen::Vector3d lower_, sides_;
};

/// The distance of a point from a surface, and the direction in which it increases.
class Surface_distances {
public:
  virtual ~Surface_distances() = default;
  virtual Signed_distance_3 operator()(const Eigen::Vector3d& p) const = 0;

  /// An approximate distance, fast, also from far away.
  double about(const Eigen::Vector3d& p) const {
    return std::sqrt(nearest_triangle(tree_, to_CGAL(p)).squared_distance);
  }

protected:
  explicit Surface_distances(std::vector<Triangle_tree::Triangle_3> triangles) : tree_(tree_of(std::move(triangles))) {}

  const Triangle_tree& tree() const { return tree_; }

  /// The distance between a point p and the nearest point of a surface. The direction is the normal if p is on the
  /// surface.
  static Signed_distance_3 distance_between(const Eigen::Vector3d& p, const Eigen::Vector3d& nearest,
                                            const Eigen::Vector3d& normal) {
    const Eigen::Vector3d way = p - nearest;
    const double distance = way.norm();
    if (distance > 1e-9) return {distance, way / distance};
    return {way.dot(normal), normal};
  }

private:
  Triangle_tree tree_; ///< triangles of a mesh, or points as triangles
};

class Mesh_distances final : public Surface_distances {
public:
  explicit Mesh_distances(const Triangles_3& mesh) : Surface_distances(triangles_with_area(mesh)) {}

  Signed_distance_3 operator()(const Eigen::Vector3d& p) const override {
    const auto found = nearest_triangle(tree(), to_CGAL(p));
    return distance_between(p, to_Eigen(found.point), unit_normal(tree().triangle(found.part)));
  }
};

/// The distances from the zero set of a function. Those from its samples are made exact near the surface by Newton
/// steps along the gradient.
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

  /// Newton steps, none longer than twice the distance to the nearest sample. The last one is below 1/100 of the
  /// total.
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

struct Ball_3 {
  Eigen::Vector3d center;
  double radius;
};

/// The signs of a function on the faces of its box.
struct Signs_on_box {
  bool has_positive = false, has_negative = false, has_zero = false;
  bool has_change = false; ///< between neighboring points, because a function may be undefined between others

  /// Whether the zero set intersects the box. It may do so along edges, where no sign changes within a face.
  bool are_cut() const { return has_change || (has_zero && has_positive && has_negative); }
};

inline Signs_on_box signs_on_box(const Mapped_function_3& function) {
  constexpr int steps = 48;
  Signs_on_box signs;
  std::array<double, steps + 1> row; // per j, the last nonzero value
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      row.fill(0);
      for (int i = 0; i <= steps; ++i) {
        double last = 0;
        for (int j = 0; j <= steps; ++j) {
          Eigen::Vector3d part(side, double(i) / steps, double(j) / steps);
          std::rotate(part.begin(), part.begin() + axis, part.end());
          const double value = function.value_in_box(part);
          signs.has_positive |= value > 0;
          signs.has_negative |= value < 0;
          double& above = row[std::size_t(j)];
          signs.has_zero |= value == 0;
          signs.has_change |= (value > 0 && std::min(above, last) < 0) || (value < 0 && std::max(above, last) > 0);
          if (value != 0) above = last = std::isnan(value) ? 0 : value;
        }
      }
    }
  return signs;
}

/// The intersections of a line with a surface, and the segments of the line inside the solid it bounds.
struct Line_of_samples {
  std::vector<Eigen::Vector3d> points, normals;
  std::vector<std::array<Eigen::Vector3d, 2>> inside;
};

/// Random lines intersect a surface uniformly in its area (M. Crofton; see L. Santalo, Integral Geometry and
/// Geometric Probability, 1976, 14.5). The lines are those through a ball.
class Sampling_lines {
public:
  Sampling_lines(const Mapped_function_3& function, bool is_inside_positive, const Ball_3& ball)
      : function_(function), inside_(is_inside_positive ? 1 : -1), ball_(ball) {}

  /// The area of a surface with `hits` intersections.
  double area(double hits, double lines) const {
    return 2 * std::numbers::pi * ball_.radius * ball_.radius * hits / lines;
  }

  Line_of_samples operator()(std::size_t n) const {
    const auto [u, v, w, x] = quasirandom<4>(n);
    const double z = 2 * u - 1, r = std::sqrt(1 - z * z), angle = 2 * std::numbers::pi * v;
    const Eigen::Vector3d direction(r * std::cos(angle), r * std::sin(angle), z);
    const Eigen::Vector3d across = direction.unitOrthogonal(), other = direction.cross(across);
    const double distance = ball_.radius * std::sqrt(w), turn = 2 * std::numbers::pi * x;
    const Eigen::Vector3d origin = ball_.center + distance * (std::cos(turn) * across + std::sin(turn) * other);
    return march(origin, direction);
  }

private:
  static constexpr double steps_per_radius = 64;

  Line_of_samples march(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    Line_of_samples result;
    const auto in_box = function_.part_in_box(origin, direction);
    const double half = std::sqrt(std::max(0.0, std::pow(ball_.radius, 2) - (origin - ball_.center).squaredNorm()));
    const double first = std::max(in_box.first, -half), last = std::min(in_box.second, half);
    if (!(last > first)) return result;
    const auto steps = std::size_t(std::ceil((last - first) / ball_.radius * steps_per_radius));
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i <= steps; ++i)
      points.push_back(origin + (first + (last - first) * double(i) / double(steps)) * direction);
    const std::vector<double> values = function_.values(points);
    for (std::size_t i = 0; i < steps; ++i) {
      const double a = inside_ * values[i], b = inside_ * values[i + 1];
      if (a >= 0 && b >= 0) result.inside.push_back({points[i], points[i + 1]});
      if (!((a < 0) != (b < 0)) || std::isnan(a) || std::isnan(b)) continue;
      const auto zero = function_.zero_between(points[i], points[i + 1]);
      if (!zero) continue;
      result.inside.push_back({*zero, a < 0 ? points[i + 1] : points[i]});
      const Eigen::Vector3d normal = -inside_ * function_.gradient(*zero);
      if (!(normal.norm() > 0)) continue;
      result.points.push_back(*zero);
      result.normals.push_back(normal.normalized());
    }
    return result;
  }

  const Mapped_function_3& function_;
  double inside_;
  Ball_3 ball_;
};

/// Samples the zero set of a function by lines through a ball, until there are `count` points, or fewer after very
/// many lines.
inline Area_samples_3 function_samples(bool in_threads, const Mapped_function_3& function, const Ball_3& ball,
                                       std::size_t count) {
  constexpr std::size_t lines_at_once = 4000, most_lines = 1000000;
  const Signs_on_box signs = signs_on_box(function);
  const Sampling_lines lines(function, signs.has_negative, ball);
  Area_samples_3 result;
  result.is_cut = signs.are_cut();
  Moment_sums_3 area(ball.center), volume(ball.center);
  bool has_inside = false;
  std::size_t done = 0;
  while (result.points.size() < count && done < most_lines) {
    std::vector<Line_of_samples> found(lines_at_once);
    parallel_for(
        in_threads, 0, found.size(), [&](std::size_t i) { found[i] = lines(done + i); }, 16);
    for (const Line_of_samples& line : found) {
      for (const Eigen::Vector3d& p : line.points) area.add_point(p);
      for (const auto& [a, b] : line.inside) volume.add_segment(a, b);
      has_inside |= !line.inside.empty();
      result.points.insert(result.points.end(), line.points.begin(), line.points.end());
      result.normals.insert(result.normals.end(), line.normals.begin(), line.normals.end());
    }
    done += lines_at_once;
  }
  if (result.points.empty()) return result;
  result.area = area.moments();
  result.area.measure = lines.area(double(result.points.size()), double(done));
  if (has_inside && !(signs.has_positive && signs.has_negative)) result.volume = volume.moments();
  return result;
}

/// Samples the zero set of a function twice: the ball around the box of the function may be much larger than the
/// surface, unlike the ball around the first samples.
inline Area_samples_3 function_samples(bool in_threads, const Mapped_function_3& function, std::size_t count) {
  constexpr double margin = 1.25;
  const Ball_3 all = {function.center(), function.radius()};
  const auto first = function_samples(in_threads, function, all, count / 4);
  if (first.points.empty()) return first;
  if (first.is_cut) return function_samples(in_threads, function, all, count);
  Ball_3 ball = {first.area.centroid, 0};
  for (const Eigen::Vector3d& p : first.points) ball.radius = std::max(ball.radius, margin * (p - ball.center).norm());
  return function_samples(in_threads, function, ball, count);
}

} // namespace equiaffine::internal

#endif
