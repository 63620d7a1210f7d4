// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_DELAUNAY_SURFACE_OF_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_DELAUNAY_SURFACE_OF_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/delaunay/Delaunay_criteria.h>
#include <equiaffine/delaunay/Delaunay_surface_3.h>
#include <equiaffine/delaunay/Facet_sizing.h>
#include <equiaffine/delaunay/internal/Delaunay_range.h>
#include <equiaffine/delaunay/internal/convert_surface.h>
#include <equiaffine/delaunay/internal/mesh_surface.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/Polyline_3.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <cmath>
#include <vector>

namespace equiaffine::internal {

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
