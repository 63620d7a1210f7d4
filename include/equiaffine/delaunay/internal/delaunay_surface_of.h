// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_DELAUNAY_SURFACE_OF_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_DELAUNAY_SURFACE_OF_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/delaunay/Delaunay_criteria.h>
#include <equiaffine/delaunay/Delaunay_surface_3.h>
#include <equiaffine/delaunay/Facet_sizing.h>
#include <equiaffine/delaunay/internal/Delaunay_range.h>
#include <equiaffine/delaunay/internal/mesh_surface.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/Polyline_3.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <cmath>
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

template <class Parameters, class... OtherTags>
constexpr void check_delaunay_parameters() {
  check_parameters<Parameters, Clip_tag, Facet_sizing_tag, Feature_curves_tag, Parabolic_features_tag, Geom_traits_tag,
                   Verbose_tag, OtherTags...>();
}

/// The function delaunay_surface() with all its named parameters in one chain, which may have others.
template <class Traits, class Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface_of(const Traits& traits, const Delaunay_criteria& criteria,
                                                          const Parameters& parameters) {
  const auto domain = get_parameter<Clip_tag>(parameters, Clip_domain_3(traits.bbox()));
  const auto sizing = get_parameter<Facet_sizing_tag>(parameters, Facet_sizing::UNIFORM);
  const auto curves = get_parameter<Feature_curves_tag>(parameters, std::vector<Polyline_3<Kernel_of<Traits>>>());
  constexpr bool has_parabolic_features = has_parameter<Parabolic_features_tag, Parameters>;
  const Delaunay_criteria completed = criteria.completed(domain);
  check_argument(completed.angle >= 0 && completed.angle <= 30,
                 "the least angle of a Delaunay mesh is not between 0 and 30 degrees: choose one that is");
  check_argument(
      completed.radius > 0 && std::isfinite(completed.radius) && completed.distance > 0 &&
          std::isfinite(completed.distance),
      "the radius or the distance of a Delaunay mesh is not a positive length: choose one, or 0 for the default");
  const Delaunay_range range(domain.bbox());
  check_argument(range.has_box(), "the box of a Delaunay mesh has a diagonal below 1e-40 or coordinates beyond 1e40: "
                                  "choose another unit");
  check_argument(completed.radius >= range.least_radius(),
                 "the radius of a Delaunay mesh is less than 2.3e-13 of the greatest coordinate of the box: choose a "
                 "larger one, or an origin nearer to the box");
  return convert_surface<Kernel_of<Traits>>(mesh_surface(
      Any_function_3::make(traits),
      {domain, completed, sizing, convert_polylines<Any_function_3::Kernel>(curves), has_parabolic_features}));
}

} // namespace equiaffine::internal

#endif
