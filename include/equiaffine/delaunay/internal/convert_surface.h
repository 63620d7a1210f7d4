// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_CONVERT_SURFACE_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_CONVERT_SURFACE_H

#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/delaunay/Delaunay_surface_3.h>
#include <equiaffine/mesh/Polyline_3.h>

#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

template <class Kernel, class Point_3>
std::vector<typename Kernel::Point_3> convert_points(const std::vector<Point_3>& points) {
  std::vector<typename Kernel::Point_3> converted;
  converted.reserve(points.size());
  for (const Point_3& p : points) converted.push_back(convert_point<Kernel>(p));
  return converted;
}

/// Returns a range of polylines as a vector of polylines of another kernel.
template <class Kernel, class Polylines>
std::vector<Polyline_3<Kernel>> convert_polylines(const Polylines& curves) {
  std::vector<Polyline_3<Kernel>> converted;
  for (const auto& curve : curves) converted.push_back({convert_points<Kernel>(curve.points), curve.is_closed});
  return converted;
}

template <class Kernel, class Other>
Delaunay_surface_3<Kernel> convert_surface(Delaunay_surface_3<Other> surface) {
  if constexpr (std::is_same_v<Kernel, Other>) {
    return surface;
  } else {
    Delaunay_surface_3<Kernel> converted;
    converted.points = convert_points<Kernel>(surface.points);
    converted.triangles = std::move(surface.triangles);
    converted.vertex_status = std::move(surface.vertex_status);
    converted.repairs = surface.repairs;
    converted.function_evaluations = surface.function_evaluations;
    converted.sampling_seconds = surface.sampling_seconds;
    converted.projection_seconds = surface.projection_seconds;
    converted.is_certified = surface.is_certified;
    converted.undecided_boxes = std::move(surface.undecided_boxes);
    converted.parabolic_curves.polylines = convert_polylines<Kernel>(surface.parabolic_curves.polylines);
    converted.parabolic_curves.unconverged_points = surface.parabolic_curves.unconverged_points;
    return converted;
  }
}

} // namespace equiaffine::internal

#endif
