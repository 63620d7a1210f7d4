// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/Canvas.h"

#include <equiaffine/base/Progress_observer.h>

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

} // namespace equiaffine
