// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/Line_drawing.h"

#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/display/color_map.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

namespace equiaffine {

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
      const auto& [low, high] = std::minmax(i, j); // both triangles at an edge find the same point
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
