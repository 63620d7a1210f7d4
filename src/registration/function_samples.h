// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_FUNCTION_SAMPLES_H
#define EQUIAFFINE_SRC_REGISTRATION_FUNCTION_SAMPLES_H

#include "registration/Area_samples_3.h"
#include "registration/Mapped_function_3.h"
#include <equiaffine/base/internal/parallel_for.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace equiaffine::internal {

struct Ball_3 {
  Eigen::Vector3d center;
  double radius;
};

/// The signs of a function on the faces of its box.
struct Signs_on_box {
  bool has_positive = false, has_negative = false, has_zero = false;
  bool has_change = false; ///< between points that are neighbors: a function may be undefined between others

  /// Whether the zero set meets the box. It may do so along edges, on whose faces the sign does not change.
  bool are_cut() const { return has_change || (has_zero && has_positive && has_negative); }
};

inline Signs_on_box signs_on_box(const Mapped_function_3& function) {
  constexpr int steps = 48;
  Signs_on_box signs;
  std::array<double, steps + 1> row; // for each j the last value that is not zero
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

/// The points in which a line meets a surface, and its segments inside of the solid that this bounds.
struct Line_of_samples {
  std::vector<Eigen::Vector3d> points, normals;
  std::vector<std::array<Eigen::Vector3d, 2>> inside;
};

/// Random lines meet a surface uniformly in its area (M. Crofton; see L. Santalo, Integral Geometry and Geometric
/// Probability, 1976, 14.5). The lines are those through a ball.
class Sampling_lines {
public:
  Sampling_lines(const Mapped_function_3& function, bool is_inside_positive, const Ball_3& ball)
      : function_(function), inside_(is_inside_positive ? 1 : -1), ball_(ball) {}

  /// The area of a surface that lines meet `hits` times.
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

/// Samples the zero set of a function by lines through a ball, until there are `count` points, or few after very many
/// lines.
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

/// Samples the zero set of a function twice: a ball around the box of the function may be much larger than the surface,
/// and one around the first samples is not.
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
