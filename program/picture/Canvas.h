// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing of pictures: a canvas, the camera, and strokes on surfaces.
#ifndef EQUIAFFINE_PROGRAM_PICTURE_CANVAS_H
#define EQUIAFFINE_PROGRAM_PICTURE_CANVAS_H

#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace equiaffine {

/// Red, green and blue, proportional to light, 0 to 1.
using Light = std::array<float, 3>;

/// A picture as bytes, three per pixel, row by row from the top.
struct Picture {
  std::size_t width, height;
  std::vector<unsigned char> rgb;
};

/// The projection of a point: pixels to the right and downward, and the reciprocal of its distance, which is linear
/// along straight lines in perspective.
struct Screen_point {
  double x, y, nearness;
};

/// A white picture with a depth buffer. Every pixel is the mean of 3 x 3 samples. It uses no display, GPU or threads,
/// so the bytes are the same everywhere.
///
/// A canvas may be a band of rows of a larger picture: drawing bands one after the other needs less memory, and gives
/// the same bytes.
class Canvas {
public:
  /// Contains the rows from `first_row` on.
  Canvas(std::size_t width, std::size_t height, std::size_t first_row = 0);

  /// The number of rows of this width in 64 MB, at least one.
  static std::size_t rows_of_band(std::size_t width);

  /// `shade(weights, is_front)` returns the light at the point of the triangle in space with these barycentric weights;
  /// the front is the side from which the corners are counterclockwise.
  template <class Shade>
  void draw_triangle(const std::array<Screen_point, 3>& corners, Shade shade);

  /// A straight stroke with round ends, whose half-width in pixels changes from `first` to `last`. It is moved toward
  /// the eye by `lift`, a fraction of its distance, so that the surface does not hide it.
  void draw_stroke(const Screen_point& a, const Screen_point& b, double first, double last, const Light& light,
                   double lift);

  Picture picture() const;

private:
  static constexpr std::size_t samples_per_axis = 3;

  /// The range of samples whose centers are in [low, high] (in pixels), clamped to `size` samples from `first` on.
  struct Range {
    std::size_t begin, end;
    Range(double low, double high, std::size_t first, std::size_t size) {
      const auto clamped = [&](double index) {
        return std::size_t(std::clamp(index, double(first), double(first + size)));
      };
      begin = clamped(std::ceil(low * samples_per_axis - 0.5));
      end = clamped(std::floor(high * samples_per_axis - 0.5) + 1);
    }
  };
  static double center(std::size_t sample) { return (double(sample) + 0.5) / samples_per_axis; }

  /// The index of a sample in memory.
  std::size_t index(std::size_t row, std::size_t column) const { return (row - first_row_) * width_ + column; }

  std::size_t width_, height_, first_row_; // in samples
  std::vector<float> nearness_;
  std::vector<Light> light_;
};

template <class Shade>
void Canvas::draw_triangle(const std::array<Screen_point, 3>& corners, Shade shade) {
  constexpr double rounding = 1e-9; // so that no sample on a common edge is missed by both neighbors
  const auto& [a, b, c] = corners;
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 0)) return; // also for NaN
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  const Range columns(left, right, 0, width_), rows(top, bottom, first_row_, height_);
  for (std::size_t row = rows.begin; row < rows.end; ++row)
    for (std::size_t column = columns.begin; column < columns.end; ++column) {
      const double x = center(column), y = center(row);
      const double u = ((c.x - b.x) * (y - b.y) - (c.y - b.y) * (x - b.x)) / area;
      const double v = ((a.x - c.x) * (y - c.y) - (a.y - c.y) * (x - c.x)) / area;
      const double w = 1 - u - v;
      if (std::min({u, v, w}) < -rounding) continue;
      const double nearness = u * a.nearness + v * b.nearness + w * c.nearness;
      const std::size_t sample = index(row, column);
      if (!(float(nearness) > nearness_[sample])) continue;
      nearness_[sample] = float(nearness);
      const std::array<double, 3> weights = {u * a.nearness / nearness, v * b.nearness / nearness,
                                             w * c.nearness / nearness};
      light_[sample] = shade(weights, area < 0); // y points downward
    }
}

inline Kernel::Vector_3 unit(const Kernel::Vector_3& v) { return v / std::sqrt(v.squared_length()); }

inline CGAL::Bbox_3 box_of(const std::vector<Kernel::Point_3>& points) {
  CGAL::Bbox_3 box;
  for (const Kernel::Point_3& p : points) box += p.bbox();
  return box;
}

/// The number of cells per diameter of the grid that selects arrows, and the length of arrows in cells.
inline constexpr double arrow_cells = 16, arrow_length = 1.5;

/// The initial view of the page, with a margin around the surface for arrows if there are any.
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

  /// The components of a vector to the right, upward and toward the eye.
  Vector turned(const Vector& v) const { return {right_ * v, up_ * v, back_ * v}; }
  Vector towards_eye(const Kernel::Point_3& p) const { return unit(center_ + distance_ * back_ - p); }
  double radius() const { return radius_; }
  const Kernel::Point_3& center() const { return center_; }

private:
  /// Sets the smallest distance at which everything and a margin are visible.
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

/// Straight strokes on or above a surface.
class Line_drawing {
public:
  void add(const Screen_point& a, const Screen_point& b, double first, double last) {
    strokes_.push_back({a, b, first, last});
  }

  /// Draws them black with a white rim, to be visible on any color.
  void draw_with_rim(Canvas& canvas) const;

  void draw(Canvas& canvas, const Light& light) const;

private:
  static constexpr double lift = 2e-3;

  struct Stroke {
    Screen_point a, b;
    double first, last; // half-widths
  };
  std::vector<Stroke> strokes_;
};

Line_drawing curve_strokes(const Camera& camera, std::span<const Polyline_3<Kernel>> curves);

/// Whether the linear interpolation of vertex values changes its sign in a triangle; false if a value is NaN.
bool changes_sign(const std::vector<double>& numbers, const std::array<std::uint32_t, 3>& triangle);

/// The lines where the interpolation changes its sign; none without numbers.
Line_drawing zero_strokes(const Camera& camera, const Indexed_triangle_mesh_3<Kernel>& mesh,
                          const std::vector<double>& numbers);

/// Arrows at evenly spaced vertices: one in each cell of a grid.
Line_drawing arrow_strokes(const Camera& camera, const std::vector<Kernel::Point_3>& points,
                           const std::array<const std::vector<double>*, 3>& columns);

} // namespace equiaffine

#endif
