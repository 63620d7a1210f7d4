// SPDX-License-Identifier: GPL-3.0-or-later
// Checks proposed symmetries of the zero set of a function at points on all of it.
#ifndef EQUIAFFINE_SRC_REGISTRATION_SYMMETRY_CHECK_H
#define EQUIAFFINE_SRC_REGISTRATION_SYMMETRY_CHECK_H

#include "registration/Framed_surface_3.h"
#include "registration/Surface_distances.h"
#include "registration/slippage.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// How far a map moves points of a surface off it.
struct Checked_map {
  /// Distances of images in the box from the surface, in the unit of space; infinite where the function is
  /// undefined.
  double rms = 0, greatest = 0;
  double inside = 0;                     ///< fraction of the images in the box
  bool is_exact = false;                 ///< whether each of these is on the surface up to rounding
  std::vector<Eigen::Vector3d> off = {}; ///< images off the surface, up to a maximum number
};

/// Checks whether maps move the zero set of a function onto itself, by points on all of it in its box.
class Symmetry_check {
public:
  static Symmetry_check of(bool in_threads, const Any_function_3& function) {
    constexpr std::size_t points = 30000;
    Symmetry_check result(function);
    Area_samples_3 samples = function_samples(in_threads, Mapped_function_3(function, {}), points);
    result.is_cut_ = samples.is_cut;
    result.size_ = size_of_points(samples.points);
    if (!samples.points.empty()) result.spacing_ = samples.spacing() / result.size_;
    result.points_ = std::move(samples.points);
    result.errors_.resize(result.points_.size());
    parallel_for(
        in_threads, 0, result.points_.size(),
        [&](std::size_t i) { result.errors_[i] = result.error_at(result.points_[i]); }, 64);
    return result;
  }

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  double size() const { return size_; }
  double spacing() const { return spacing_; } ///< relative to the size
  bool is_cut() const { return is_cut_; }     ///< whether the surface continues beyond the box

  /// The center of the box.
  Eigen::Vector3d center() const {
    return {(box_.min(0) + box_.max(0)) / 2, (box_.min(1) + box_.max(1)) / 2, (box_.min(2) + box_.max(2)) / 2};
  }

  /// Checks a map with the first `count` points.
  Checked_map check(bool in_threads, const Affine_map_3& map,
                    std::size_t count = std::numeric_limits<std::size_t>::max()) const {
    const std::size_t points = std::min(count, points_.size());
    std::vector<double> distances(points, std::numeric_limits<double>::quiet_NaN());
    std::vector<char> are_exact(points);
    parallel_for(
        in_threads, 0, points,
        [&](std::size_t i) {
          const Eigen::Vector3d image = in_box(map(points_[i]));
          if (!function_.contains(image)) return;
          const auto [distance, normal] = function_.distance(image);
          const double limit = least_limit * size_ + errors_[i];
          const bool is_undefined = std::isnan(distance) && std::isnan(function_.first_order(image).value());
          distances[i] = is_undefined ? std::numeric_limits<double>::infinity() : std::abs(distance);
          are_exact[i] = distances[i] <= limit || changes_sign(image, limit);
          if (are_exact[i]) distances[i] = std::min(distances[i], limit);
        },
        64);
    constexpr std::size_t most_off = 500;
    Checked_map result = {.is_exact = true};
    for (std::size_t i = 0; i < distances.size(); ++i) {
      if (std::isnan(distances[i])) continue; // the image is not in the box, or f has no gradient there
      result.inside += 1;
      result.rms += distances[i] * distances[i];
      result.greatest = std::max(result.greatest, distances[i]);
      result.is_exact &= are_exact[i] != 0;
      if (!are_exact[i] && result.off.size() < most_off) result.off.push_back(map(points_[i]));
    }
    result.rms = std::sqrt(result.rms / std::max(1.0, result.inside));
    result.inside /= std::max(1.0, double(points));
    return result;
  }

  /// Checks the flows of infinitesimal maps by motions of finite lengths. Velocities do not detect jumps of a
  /// function, nor places where it is undefined.
  Checked_map check_flows(bool in_threads, const std::vector<Infinitesimal_map_3>& velocities) const {
    Checked_map result = {.is_exact = true};
    for (const Infinitesimal_map_3& velocity : velocities) {
      double greatest = velocity.matrix.norm() * size_; // the matrix of a translation is zero, so velocities count, too
      for (const Eigen::Vector3d& p : points_)
        greatest = std::max(greatest, (velocity.matrix * p + velocity.translation).norm());
      for (const double length : {-1.1, -0.31, 0.31, 1.1}) {
        const Checked_map moved = check(in_threads, flow(velocity, length * size_ / greatest));
        result.rms = std::max(result.rms, moved.rms);
        result.greatest = std::max(result.greatest, moved.greatest);
        result.is_exact &= moved.is_exact;
        result.off.insert(result.off.end(), moved.off.begin(), moved.off.end());
      }
    }
    return result;
  }

private:
  static constexpr double least_limit = 1e-11; ///< relative to the size

  explicit Symmetry_check(const Any_function_3& function) : function_(function), box_(function.bbox()) {}

  /// The point, moved into the box if it is outside by rounding.
  Eigen::Vector3d in_box(Eigen::Vector3d p) const {
    for (int a = 0; a < 3; ++a) {
      const double rounding = 1e-10 * (box_.max(a) - box_.min(a));
      if (p[a] > box_.min(a) - rounding && p[a] < box_.max(a) + rounding)
        p[a] = std::clamp(p[a], box_.min(a), box_.max(a));
    }
    return p;
  }

  /// Whether there is a zero within a distance along an axis; requires no gradient.
  bool changes_sign(const Eigen::Vector3d& p, double distance) const {
    const auto value = [&](const Eigen::Vector3d& q) { return function_.first_order(in_box(q)).value(); };
    for (int a = 0; a < 3; ++a) {
      const Eigen::Vector3d step = distance * Eigen::Vector3d::Unit(a);
      const double before = value(p - step), after = value(p + step);
      if ((before <= 0 && after >= 0) || (before >= 0 && after <= 0)) return true;
    }
    return false;
  }

  /// A bound on the rounding error of the distance at a point of the surface.
  double error_at(const Eigen::Vector3d& p) const {
    constexpr double factor = 32;
    const auto [distance, normal] = function_.distance(p);
    double error = std::abs(distance);
    for (const double side : {-1e-9, 1e-9}) {
      const Eigen::Vector3d step = side * size_ * normal.unitOrthogonal();
      const double there = std::abs(function_.distance(in_box(p + step)).distance);
      if (std::isfinite(there)) error = std::max(error, there);
    }
    return std::isfinite(error) ? std::min(factor * error, 1e-8 * size_) : 0;
  }

  Framed_function_3 function_;
  CGAL::Bbox_3 box_;
  double size_ = 0, spacing_ = 0;
  bool is_cut_ = false;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> errors_;
};

} // namespace equiaffine::internal

#endif
