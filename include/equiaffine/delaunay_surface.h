// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_SURFACE_H
#define EQUIAFFINE_DELAUNAY_SURFACE_H

#include <equiaffine/Clip_domain_3.h>
#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/delaunay/Delaunay_criteria.h>
#include <equiaffine/delaunay/Delaunay_surface_3.h>
#include <equiaffine/delaunay/Facet_sizing.h>
#include <equiaffine/delaunay/internal/convert_surface.h>
#include <equiaffine/delaunay/internal/shared/Delaunay_range.h>
#include <equiaffine/delaunay/internal/shared/mesh_surface.h>
#include <equiaffine/surface/Any_function_3.h>
#include <equiaffine/surface/Polyline_3.h>

#include <cmath>
#include <vector>

namespace equiaffine {

/// Meshes the zero set of a function by Delaunay refinement (Boissonnat, Oudot: Provably good sampling and meshing of
/// surfaces, 2005). The result is a triangle mesh with vertices on the surface, angles of at least `criteria.angle`,
/// and normals along the gradient. Link with equiaffine::mesher.
///
/// CGAL's 3D Mesh Generation refines the mesh. It starts from points on every component of the surface, which are found
/// by subdividing the domain into boxes with the interval bounds of the function. If the result `is_certified`, no
/// component was missed, however small. A closed regular surface gives a closed oriented 2-manifold.
///
/// Features are made of edges of the mesh: the curves where the surface meets the border of the clip domain,
/// `feature_curves`, and the parabolic curves, with their crossings and their ends on the border, if they are asked
/// for. Where features are nearer to each other than the radius, or meet in sharp corners, edges are shorter, and
/// angles at the corners smaller. Features nearer to each other than a fiftieth of the radius may lose edges; the mesh
/// is then not certified, and need not be manifold there. Features much smaller than the radius may be missed.
/// Nodes of the surface, such as the apex of a cone, are vertices, and so are apexes where f has no gradient, such as
/// that of half a cone or the corner of a cube. The curves where the surface ends since f is not defined beyond become
/// features, too, to a hundredth of the radius. Near other singular points the mesh ends in facets of radius/8, whatever
/// their angles.
///
/// Named parameters: `clip` (the box of the function), `facet_sizing` (UNIFORM), `feature_curves` (none),
/// `parabolic_features` (no).
/// \throw std::invalid_argument unless the angle lies in [0, 30], the lengths are positive, or 0 for their defaults, and
/// finite, the box of the function has an interior and is finite, its diagonal is at least 1e-40 and its coordinates at
/// most 1e40, and the radius is at least 1024 epsilons of the greatest coordinate
///
/// The result is the same on every run. One thread computes it: 20,000 triangles take about 0.2 seconds, and 10 to 40
/// evaluations per triangle.
template <ImplicitFunctionTraits_3 Traits, class NamedParameters = internal::No_parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, const Delaunay_criteria& criteria = {},
                                                       const NamedParameters& parameters = {}) {
  internal::check_parameters<NamedParameters, internal::Clip_tag, internal::Facet_sizing_tag,
                             internal::Feature_curves_tag, internal::Parabolic_features_tag>();
  const auto domain = internal::get_parameter<internal::Clip_tag>(parameters, Clip_domain_3(traits.bbox()));
  const auto sizing = internal::get_parameter<internal::Facet_sizing_tag>(parameters, Facet_sizing::UNIFORM);
  const auto curves =
      internal::get_parameter<internal::Feature_curves_tag>(parameters, std::vector<Polyline_3<Kernel_of<Traits>>>());
  constexpr bool has_parabolic_features = internal::has_parameter<internal::Parabolic_features_tag, NamedParameters>;
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
  return internal::convert_surface<Kernel_of<Traits>>(
      mesh_surface(Any_function_3::make(traits),
                   {domain, completed, sizing, internal::convert_polylines<Any_function_3::Kernel>(curves),
                    has_parabolic_features}));
}

} // namespace equiaffine

#endif
