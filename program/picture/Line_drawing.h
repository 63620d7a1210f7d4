// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_PICTURE_LINE_DRAWING_H
#define EQUIAFFINE_PROGRAM_PICTURE_LINE_DRAWING_H

#include "picture/Camera.h"
#include "picture/Canvas.h"
#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/Polyline_3.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace equiaffine {

/// Straight strokes on or above a surface.
class Line_drawing {
public:
  void add(const Screen_point& a, const Screen_point& b, double first, double last) {
    strokes_.push_back({a, b, first, last});
  }

  /// Draws them dark with a white rim, so that they are seen on any color.
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

/// Returns whether the linear interpolation of a number per vertex changes its sign in a triangle. Where the number of
/// a corner is not known, it returns false.
bool changes_sign(const std::vector<double>& numbers, const std::array<std::uint32_t, 3>& triangle);

/// The lines on which that interpolation changes its sign; none without numbers.
Line_drawing zero_strokes(const Camera& camera, const Indexed_triangle_mesh_3<Kernel>& mesh,
                          const std::vector<double>& numbers);

/// Arrows at vertices that are spread evenly in space: one in each cell of a grid.
Line_drawing arrow_strokes(const Camera& camera, const std::vector<Kernel::Point_3>& points,
                           const std::array<const std::vector<double>*, 3>& columns);

} // namespace equiaffine

#endif
