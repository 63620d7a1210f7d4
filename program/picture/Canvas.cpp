// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/Canvas.h"

#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/display/color_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

namespace equiaffine {

Canvas::Canvas(std::size_t width, std::size_t height, std::size_t first_row)
    : width_(samples_per_axis * width), height_(samples_per_axis * height), first_row_(samples_per_axis * first_row),
      nearness_(width_ * height_, 0.F), light_(width_ * height_, Light{1, 1, 1}) {}

std::size_t Canvas::rows_of_band(std::size_t width) {
  constexpr std::size_t bytes_per_pixel = samples_per_axis * samples_per_axis * (sizeof(float) + sizeof(Light));
  return std::max<std::size_t>(64'000'000 / (bytes_per_pixel * width), 1);
}

void Canvas::draw_stroke(const Screen_point& a, const Screen_point& b, double first, double last, const Light& light,
                         double lift) {
  const double widest = std::max(first, last), dx = b.x - a.x, dy = b.y - a.y, squared_length = dx * dx + dy * dy;
  if (!std::isfinite(squared_length)) return;
  const Range columns(std::min(a.x, b.x) - widest, std::max(a.x, b.x) + widest, 0, width_);
  const Range rows(std::min(a.y, b.y) - widest, std::max(a.y, b.y) + widest, first_row_, height_);
  for (std::size_t row = rows.begin; row < rows.end; ++row)
    for (std::size_t column = columns.begin; column < columns.end; ++column) {
      const double x = center(column) - a.x, y = center(row) - a.y;
      const double along = squared_length > 0 ? std::clamp((x * dx + y * dy) / squared_length, 0., 1.) : 0.;
      if (std::hypot(x - along * dx, y - along * dy) > first + along * (last - first)) continue;
      const double nearness = (a.nearness + along * (b.nearness - a.nearness)) * (1 + lift);
      const std::size_t sample = index(row, column);
      if (!(float(nearness) > nearness_[sample])) continue;
      nearness_[sample] = float(nearness);
      light_[sample] = light;
    }
}

Picture Canvas::picture() const {
  constexpr std::size_t n = samples_per_axis;
  Picture picture{width_ / n, height_ / n, {}};
  picture.rgb.reserve(3 * picture.width * picture.height);
  for (std::size_t row = 0; row < picture.height; ++row) {
    Progress_observer::step();
    for (std::size_t column = 0; column < picture.width; ++column)
      for (std::size_t channel = 0; channel < 3; ++channel) {
        float sum = 0;
        for (std::size_t sample = 0; sample < n * n; ++sample)
          sum += light_[(n * row + sample / n) * width_ + n * column + sample % n][channel];
        const float mean = std::clamp(sum / float(n * n), 0.F, 1.F);
        picture.rgb.push_back(static_cast<unsigned char>(std::lround(255 * std::pow(mean, 1 / 2.2F))));
      }
  }
  return picture;
}

void Line_drawing::draw_with_rim(Canvas& canvas) const {
  constexpr double rim = 1;
  for (const auto& [a, b, first, last] : strokes_) canvas.draw_stroke(a, b, first + rim, last + rim, {1, 1, 1}, lift);
  for (const auto& [a, b, first, last] : strokes_) canvas.draw_stroke(a, b, first, last, {0, 0, 0}, 2 * lift);
}

void Line_drawing::draw(Canvas& canvas, const Light& light) const {
  for (const auto& [a, b, first, last] : strokes_) canvas.draw_stroke(a, b, first, last, light, lift / 2);
}

Line_drawing curve_strokes(const Camera& camera, std::span<const Polyline_3<Kernel>> curves) {
  constexpr double half_width = 1.4;
  Line_drawing strokes;
  for (const auto& curve : curves) {
    const std::size_t n = curve.points.size();
    for (std::size_t i = 0; i + (curve.is_closed ? 0 : 1) < n; ++i)
      strokes.add(camera(curve.points[i]), camera(curve.points[(i + 1) % n]), half_width, half_width);
  }
  return strokes;
}

bool changes_sign(const std::vector<double>& numbers, const std::array<std::uint32_t, 3>& triangle) {
  std::size_t negative = 0;
  for (const std::uint32_t vertex : triangle) {
    if (std::isnan(numbers[vertex])) return false;
    negative += numbers[vertex] < 0;
  }
  return negative == 1 || negative == 2;
}

Line_drawing zero_strokes(const Camera& camera, const Indexed_triangle_mesh_3<Kernel>& mesh,
                          const std::vector<double>& numbers) {
  constexpr double half_width = 0.8;
  Line_drawing strokes;
  if (numbers.empty()) return strokes;
  for (const auto& triangle : mesh.triangles) {
    if (!changes_sign(numbers, triangle)) continue;
    std::vector<Kernel::Point_3> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = triangle[k], j = triangle[(k + 1) % 3];
      if ((numbers[i] < 0) == (numbers[j] < 0)) continue;
      const auto& [low, high] = std::minmax(i, j); // the same point for both triangles at an edge
      const double part = numbers[low] / (numbers[low] - numbers[high]);
      ends.push_back(mesh.points[low] + part * (mesh.points[high] - mesh.points[low]));
    }
    strokes.add(camera(ends[0]), camera(ends[1]), half_width, half_width);
  }
  return strokes;
}

Line_drawing arrow_strokes(const Camera& camera, const std::vector<Kernel::Point_3>& points,
                           const std::array<const std::vector<double>*, 3>& columns) {
  const double cell = 2 * camera.radius() / arrow_cells;
  std::set<std::array<long, 3>> taken;
  std::vector<std::pair<Kernel::Point_3, Kernel::Vector_3>> arrows;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Kernel::Vector_3 arrow((*columns[0])[i], (*columns[1])[i], (*columns[2])[i]);
    const Kernel::Vector_3 place = (points[i] - camera.center()) / cell;
    const double length = std::sqrt(arrow.squared_length());
    if (!std::isfinite(length)) continue;
    if (!taken.insert({std::lround(place.x()), std::lround(place.y()), std::lround(place.z())}).second) continue;
    arrows.emplace_back(points[i], arrow);
    lengths.push_back(length);
  }
  Line_drawing strokes;
  if (arrows.empty()) return strokes;
  const double usual = std::max(quantile(lengths, 50), std::numeric_limits<double>::min());
  for (const auto& [base, arrow] : arrows) {
    const double scale = arrow_length * cell / std::max(usual, std::sqrt(arrow.squared_length()));
    const Screen_point neck = camera(base + 0.6 * scale * arrow);
    strokes.add(camera(base), neck, 1, 1);
    strokes.add(neck, camera(base + scale * arrow), 3.2, 0.2);
  }
  return strokes;
}

} // namespace equiaffine
