// SPDX-License-Identifier: GPL-3.0-or-later
// The criteria that a Delaunay mesh has to meet, and how the size of its facets varies.
#ifndef EQUIAFFINE_DELAUNAY_DELAUNAY_CRITERIA_H
#define EQUIAFFINE_DELAUNAY_DELAUNAY_CRITERIA_H

#include <equiaffine/surface/Clip_domain_3.h>

namespace equiaffine {

/// The criteria that every triangle of a Delaunay mesh satisfies. Lengths are absolute.
struct Delaunay_criteria {
  double angle = 30;   ///< least angle in degrees, at most 30
  double radius = 0;   ///< bound of the radius of surface Delaunay balls; 0: 1/50 of the diagonal of the clip domain
  double distance = 0; ///< bound of the distance of a triangle's circumcenter to the center of that ball; 0: radius/10

  /// A fiftieth of the diagonal of the clip domain.
  static double default_radius(const Clip_domain_3& domain) { return domain.diagonal() / 50; }

  /// Returns these criteria with the defaults in place of lengths that are 0.
  Delaunay_criteria completed(const Clip_domain_3& domain) const {
    Delaunay_criteria result = *this;
    if (result.radius == 0) result.radius = default_radius(domain);
    if (result.distance == 0) result.distance = result.radius / 10;
    return result;
  }
};

/// How the size of facets varies over a surface.
enum class Facet_sizing {
  UNIFORM,   ///< the same size everywhere
  EUCLIDEAN, ///< at most a quarter of the smaller radius of curvature
  AFFINE     ///< equal affine area: proportional to |K_e|^(-1/8), since the affine area is |K_e|^(1/4) dA
};

} // namespace equiaffine

#endif
