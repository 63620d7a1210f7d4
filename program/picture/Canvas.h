// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_PICTURE_CANVAS_H
#define EQUIAFFINE_PROGRAM_PICTURE_CANVAS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace equiaffine {

/// Red, green and blue, proportional to light, 0 to 1.
using Light = std::array<float, 3>;

/// A picture as bytes, three per pixel, row by row from the top.
struct Picture {
  std::size_t width, height;
  std::vector<unsigned char> rgb;
};

/// The place at which a point of space is seen: pixels to the right and downwards, and the reciprocal of its distance,
/// which is linear along straight lines of a picture in perspective.
struct Screen_point {
  double x, y, nearness;
};

/// A white picture on which what is nearer hides what is behind it, in any order of drawing. Every pixel is the mean of
/// 3 x 3 samples. No display, graphics processor or thread is involved: the same bytes everywhere.
///
/// A canvas may be a band of the rows of a larger picture: bands need less memory, one after the other, and have the same
/// bytes as the whole.
class Canvas {
public:
  /// Has the rows from `first_row` on.
  Canvas(std::size_t width, std::size_t height, std::size_t first_row = 0);

  /// The rows of that width that take 64 MB, at least one.
  static std::size_t rows_of_band(std::size_t width);

  /// `shade(weights, is_front)` is the light at the point of the triangle with these barycentric weights, in space;
  /// the front is the side from which the corners are counterclockwise.
  template <class Shade>
  void draw_triangle(const std::array<Screen_point, 3>& corners, Shade shade);

  /// A straight stroke with round ends, whose half-width in pixels goes from `first` to `last`. It is lifted by
  /// `lift`, a fraction of its distance, lest the surface on which it lies hide it.
  void draw_stroke(const Screen_point& a, const Screen_point& b, double first, double last, const Light& light,
                   double lift);

  Picture picture() const;

private:
  static constexpr std::size_t samples_per_axis = 3;

  /// The samples from `first` on whose centers lie in [low, high], in pixels.
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

  /// The place in memory of a sample.
  std::size_t index(std::size_t row, std::size_t column) const { return (row - first_row_) * width_ + column; }

  std::size_t width_, height_, first_row_; // in samples
  std::vector<float> nearness_;
  std::vector<Light> light_;
};

template <class Shade>
void Canvas::draw_triangle(const std::array<Screen_point, 3>& corners, Shade shade) {
  constexpr double rounding = 1e-9; // neither neighbor may leave out a sample on their common edge
  const auto& [a, b, c] = corners;
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 0)) return; // NaN is refused, too
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
      light_[sample] = shade(weights, area < 0); // y points downwards
    }
}

} // namespace equiaffine

#endif
