// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_FEATURE_BALLS_H
#define EQUIAFFINE_SRC_DELAUNAY_FEATURE_BALLS_H

#include "delaunay/Border_curves_3.h"
#include "delaunay/Facet_sizing_field.h"
#include "delaunay/Feature_curve_3.h"
#include "delaunay/Feature_ends_3.h"
#include "delaunay/Memoized_function_3.h"
#include "delaunay/Protecting_balls_3.h"
#include <equiaffine/surface/Clip_domain_3.h>

#include <optional>
#include <vector>

namespace equiaffine::internal {

using Feature_balls = Protecting_balls_3<Any_function_3::Kernel>;

/// Balls along all features: the given curves, and the curves in which the surface meets the border of the domain.
/// `radius` bounds the size of facets. Points of features that are nearer to others than a thousandth of it are left out.
inline Feature_balls cover_features(const Memoized_function_3& function, const Clip_domain_3& domain, double radius,
                                    const Facet_sizing_field& size, const std::vector<Feature_curve_3>& given) {
  using Point_3 = Any_function_3::Point_3;
  constexpr double spacing_in_sizes = 0.8; // lets the facets beside features have the angles of others
  const auto spacing = [&](const Point_3& p) { return spacing_in_sizes * size(p); };
  const auto keep = [](const Point_3& p) { return std::optional(p); };
  Feature_balls balls(radius / 1000);
  Feature_ends_3 ends(domain, radius);
  for (Feature_curve_3 curve : given) {
    if (curve.reaches_border) ends.extend(curve);
    const auto project = [&domain, to_curve = curve.project](const Point_3& p) {
      const auto q = to_curve(p);
      return q && domain.contains(*q) ? q : std::nullopt;
    };
    const auto project_end = [&](const Point_3& p) { return ends.is_on_border(p) ? std::optional(p) : project(p); };
    balls.cover(curve.polyline, spacing, project, project_end);
  }
  Border_curves_3 border(function, domain, radius);
  for (const auto& curve : border.find())
    for (const auto& piece : ends.split(curve)) {
      const auto project = [&border, axis = curve.axis](const Point_3& p) { return border.project(p, axis); };
      balls.cover(piece, spacing, project, keep);
    }
  balls.complete();
  return balls;
}

} // namespace equiaffine::internal

#endif
