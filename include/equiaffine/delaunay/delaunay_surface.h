// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_DELAUNAY_SURFACE_H
#define EQUIAFFINE_DELAUNAY_DELAUNAY_SURFACE_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/delaunay/Any_function_3.h>
#include <equiaffine/delaunay/Facet_sizing.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/Isosurface_3.h>
#include <equiaffine/surface/Polyline_3.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine {

/// What every triangle of a Delaunay mesh satisfies. Lengths are absolute.
struct Delaunay_criteria {
  double angle = 30;   ///< least angle in degrees, at most 30
  double radius = 0;   ///< bound of the radius of surface Delaunay balls; 0: 1/50 of the diagonal of the clip domain
  double distance = 0; ///< bound of the distance of a triangle's circumcentre to the centre of that ball; 0: radius/10
};

/// A Delaunay mesh of the zero set of a function.
template <class Kernel>
struct Delaunay_surface_3 : Isosurface_3<Kernel> {
  bool is_certified = false; ///< no component of the surface was missed: there are no undecided boxes
  /// Where a part of the surface may have been missed, since neither its absence nor its regularity could be proved:
  /// around singular points, where the surface touches the border of the box, beside points where f is not defined, in
  /// noise that would need too many boxes, or everywhere for a function without bounds of its gradient. Also where a
  /// part was found and yet got no triangle, or a feature no edge, for being too near to others, where the mesh is not
  /// a manifold, and where a triangle straddles a parabolic curve that is a feature.
  std::vector<CGAL::Bbox_3> undecided_boxes;
  Parabolic_curves_3<Kernel> parabolic_curves; ///< if the mesh was asked to follow them
};

namespace internal {

/// A curve on the surface that becomes a chain of edges, and the point of it near one of the polyline, if there is one.
struct Feature_curve_3 {
  Polyline_3<Any_function_3::Kernel> polyline;
  std::function<std::optional<Any_function_3::Point_3>(const Any_function_3::Point_3&)> project;
  bool reaches_border = false; ///< of the clip domain, if an end is near it
};

/// Compiled in the target equiaffine::mesher. The criteria are complete.
Delaunay_surface_3<Any_function_3::Kernel> mesh_surface(const Any_function_3& function, const Clip_domain_3& domain,
                                                        const Delaunay_criteria& criteria, Facet_sizing sizing,
                                                        const std::vector<Feature_curve_3>& features);

/// Compiled there, too: triangles with points on both sides of a parabolic curve take the certificate away.
void report_straddling_triangles(Delaunay_surface_3<Any_function_3::Kernel>& mesh, const Any_function_3& function,
                                 double radius);

/// A copy with the points of another kernel.
template <class Kernel, class Other>
Polyline_3<Kernel> converted(const Polyline_3<Other>& curve) {
  Polyline_3<Kernel> copy{{}, curve.is_closed};
  for (const auto& p : curve.points)
    copy.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  return copy;
}

template <class Polylines>
std::vector<Feature_curve_3> given_features(const Any_function_3& function, const Polylines& curves, double reach) {
  const auto project = [function, reach](const Any_function_3::Point_3& p) {
    const auto found = project_to_surface(function, p, reach);
    return found.has_converged ? std::optional(found.point) : std::nullopt;
  };
  std::vector<Feature_curve_3> features;
  for (const auto& curve : curves) features.push_back({converted<Any_function_3::Kernel>(curve), project, false});
  return features;
}

} // namespace internal

/// The zero set of a function, by Delaunay refinement (Boissonnat, Oudot: Provably good sampling and meshing of
/// surfaces, 2005): a triangle mesh with vertices on the surface, angles of at least `criteria.angle`, and normals
/// along the gradient. Link with equiaffine::mesher.
///
/// The refinement is that of CGAL's 3D Mesh Generation. It starts from points on every component of the surface, which
/// a subdivision of the domain into boxes finds with the interval bounds of the function: when `is_certified`, none was
/// missed, however small. A closed regular surface gives a closed oriented 2-manifold.
///
/// Features are made of edges of the mesh: the curves where the surface meets the border of the clip domain,
/// `feature_curves`, and the parabolic curves, with their crossings and their ends on the border, if they are asked
/// for. Where features are nearer to each other than the radius, or meet in sharp corners, edges are shorter, and
/// angles at the corners smaller. Of features nearer than a fiftieth of that, segments may be no edges, which takes the
/// certificate away, and the mesh need not be manifold there. Features much smaller than the radius may be missed.
/// Nodes of the surface, as the apex of a cone, are vertices; near other singular points the mesh ends in facets of
/// radius/8, whatever their angles, and so it does where f ceases to be defined.
///
/// Named parameters: `clip` (the box of the function), `facet_sizing` (UNIFORM), `feature_curves` (none),
/// `parabolic_features` (no).
/// Deterministic; one thread. Time: for 20,000 triangles about 0.2 seconds and 10 to 40 evaluations per triangle.
template <ImplicitFunctionTraits_3 Traits, class NamedParameters = internal::No_parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, Delaunay_criteria criteria = {},
                                                       const NamedParameters& parameters = {}) {
  internal::check_parameters<NamedParameters, internal::Clip_tag, internal::Facet_sizing_tag,
                             internal::Feature_curves_tag, internal::Parabolic_features_tag>();
  using Surface = Delaunay_surface_3<Kernel_of<Traits>>;
  const auto domain = internal::get_parameter<internal::Clip_tag>(parameters, Clip_domain_3(traits.bbox()));
  const auto sizing = internal::get_parameter<internal::Facet_sizing_tag>(parameters, Facet_sizing::UNIFORM);
  if (criteria.radius == 0) criteria.radius = domain.diagonal() / 50;
  if (criteria.distance == 0) criteria.distance = criteria.radius / 10;
  CGAL_precondition(criteria.angle >= 0 && criteria.angle <= 30);
  CGAL_precondition(criteria.radius > 0 && criteria.distance > 0);
  const auto function = internal::Any_function_3::make(traits);
  const auto curves =
      internal::get_parameter<internal::Feature_curves_tag>(parameters, std::vector<Polyline_3<Kernel_of<Traits>>>());
  auto features = internal::given_features(function, curves, criteria.radius);
  auto mesh = internal::mesh_surface(function, domain, criteria, sizing, features);
  if constexpr (internal::has_parameter<internal::Parabolic_features_tag, NamedParameters>) {
    auto parabolic = parabolic_curves(mesh, function);
    const auto project = [=](const internal::Any_function_3::Point_3& p) {
      return internal::project_to_parabolic_curve(function, p, criteria.radius * criteria.radius);
    };
    for (const auto& curve : parabolic.polylines) features.push_back({curve, project, true});
    const std::size_t evaluations = mesh.function_evaluations;
    const double seconds = mesh.sampling_seconds;
    mesh = internal::mesh_surface(function, domain, criteria, sizing, features);
    mesh.function_evaluations += evaluations;
    mesh.sampling_seconds += seconds;
    mesh.parabolic_curves = std::move(parabolic);
    internal::report_straddling_triangles(mesh, function, criteria.radius);
  }
  if constexpr (std::is_same_v<Surface, decltype(mesh)>) {
    return mesh;
  } else {
    Surface result;
    for (const auto& p : mesh.points) result.points.emplace_back(p.x(), p.y(), p.z());
    result.triangles = std::move(mesh.triangles);
    result.vertex_status = std::move(mesh.vertex_status);
    result.function_evaluations = mesh.function_evaluations;
    result.sampling_seconds = mesh.sampling_seconds;
    result.projection_seconds = mesh.projection_seconds;
    result.is_certified = mesh.is_certified;
    result.undecided_boxes = std::move(mesh.undecided_boxes);
    for (const auto& curve : mesh.parabolic_curves.polylines)
      result.parabolic_curves.polylines.push_back(internal::converted<Kernel_of<Traits>>(curve));
    result.parabolic_curves.unconverged_points = mesh.parabolic_curves.unconverged_points;
    return result;
  }
}

} // namespace equiaffine

#endif
