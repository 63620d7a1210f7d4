// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_PICTURE_CAMERA_H
#define EQUIAFFINE_PROGRAM_PICTURE_CAMERA_H

#include "picture/Canvas.h"
#include "system/kernel.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace equiaffine {

inline Kernel::Vector_3 unit(const Kernel::Vector_3& v) { return v / std::sqrt(v.squared_length()); }

inline CGAL::Bbox_3 box_of(const std::vector<Kernel::Point_3>& points) {
  CGAL::Bbox_3 box;
  for (const Kernel::Point_3& p : points) box += p.bbox();
  return box;
}

/// Arrows are spread over a grid of this many cells per diameter of the surface, and that much longer than a cell.
inline constexpr double arrow_cells = 16, arrow_length = 1.5;

/// The first view of the page, with room around the surface for arrows where there are some.
class Camera {
public:
  using Vector = Kernel::Vector_3;

  Camera(const std::vector<Kernel::Point_3>& points, const std::array<double, 3>& up_direction, std::size_t width,
         std::size_t height, bool has_arrows)
      : width_(double(width)), height_(double(height)),
        margin_(1.05 + (has_arrows ? 2 * arrow_length / arrow_cells : 0)) {
    const CGAL::Bbox_3 box = box_of(points);
    center_ =
        Kernel::Point_3((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
    const Vector axis(up_direction[0], up_direction[1], up_direction[2]);
    const Vector front = unit(cross_product(std::abs(axis.x()) < 0.9 ? Vector(1, 0, 0) : Vector(0, 1, 0), axis));
    back_ = unit(front + 0.5 * cross_product(axis, front) + 0.62 * axis);
    right_ = unit(cross_product(axis, back_));
    up_ = cross_product(back_, right_);
    fit(points);
  }

  Screen_point operator()(const Kernel::Point_3& p) const {
    const Vector v = p - center_;
    const double nearness = 1 / (distance_ - back_ * v), scale = 0.5 * height_ / half_view * nearness;
    return {0.5 * width_ + scale * (right_ * v), 0.5 * height_ - scale * (up_ * v), nearness};
  }

  /// Gives the components of a vector to the right, upwards and towards the eye.
  Vector turned(const Vector& v) const { return {right_ * v, up_ * v, back_ * v}; }
  Vector towards_eye(const Kernel::Point_3& p) const { return unit(center_ + distance_ * back_ - p); }
  double radius() const { return radius_; }
  const Kernel::Point_3& center() const { return center_; }

private:
  /// Sets the least distance from which everything and a margin is seen.
  void fit(const std::vector<Kernel::Point_3>& points) {
    double least = 0;
    for (const Kernel::Point_3& p : points) {
      const Vector v = p - center_;
      const double across = std::abs(right_ * v) * height_ / width_, along = std::abs(up_ * v);
      least = std::max(least, back_ * v + margin_ * std::max(across, along) / half_view);
      radius_ = std::max(radius_, std::sqrt(v.squared_length()));
    }
    distance_ = std::max(least, 1.2 * radius_);
    if (!(distance_ > 0)) distance_ = 1;
  }

  static inline const double half_view = std::tan(std::numbers::pi / 14); // the tangent of half the angle of view
  double width_, height_, margin_, distance_ = 1, radius_ = 0;
  Kernel::Point_3 center_;
  Vector right_, up_, back_;
};

} // namespace equiaffine

#endif
