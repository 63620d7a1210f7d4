// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes the zero set of a function by Delaunay refinement.
#ifndef EQUIAFFINE_DELAUNAY_DELAUNAY_SURFACE_H
#define EQUIAFFINE_DELAUNAY_DELAUNAY_SURFACE_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/delaunay/Delaunay_options.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/to_face_graph.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/internal/explain_sampler.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine {

/// A Delaunay mesh of the zero set of a function.
template <class Kernel>
struct Delaunay_surface_3 : Isosurface_3<Kernel> {
  bool is_certified = false; ///< no component of the surface was missed: there are no undecided boxes
  /// Boxes in which a part of the surface may have been missed, because neither its absence nor its regularity could be
  /// proved: around singular points, where the surface touches the border of the box, near points where f is undefined,
  /// where noise would require too many boxes, or everywhere if the function has no bounds of its gradient.
  ///
  /// Boxes are also added where a part of the surface has no triangle, or a feature has no edge, because other parts
  /// are too close; where points of features are closer to each other than a thousandth of the radius; where the mesh
  /// is not a manifold; and where a triangle straddles a parabolic curve that is a feature. If CGAL's mesher gave up
  /// because the surface has bends much smaller than facets, the whole box is undecided: some triangles are missing,
  /// and others violate the criteria.
  std::vector<CGAL::Bbox_3> undecided_boxes;
  Parabolic_curves_3<Kernel> parabolic_curves; ///< if the option `parabolic_curves` is set
};

} // namespace equiaffine

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// The criteria that every triangle of a Delaunay mesh satisfies, see Delaunay_options.
struct Delaunay_criteria {
  double angle, radius, distance;
};

/// The arguments of `delaunay_surface` except the function.
struct Meshing_request_3 {
  Clip_domain_3 domain;
  Delaunay_criteria criteria;
  Facet_sizing sizing;
  std::vector<Polyline_3<Any_function_3::Kernel>> feature_curves;
  bool follows_parabolic_curves; ///< the parabolic curves become features of a second mesh
};

/// The part of `delaunay_surface` that does not depend on the type of the function; compiled into the library.
Delaunay_surface_3<Any_function_3::Kernel> mesh_surface(const Any_function_3& function,
                                                        const Meshing_request_3& request);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine::internal {

/// The range of boxes and radii for which Delaunay meshing works.
class Delaunay_range {
public:
  /// The mesher computes polynomials of degree 6 in lengths, which must neither overflow nor underflow.
  static constexpr double least = 1e-40, greatest = 1e40;

  explicit Delaunay_range(const CGAL::Bbox_3& box) : diagonal_(std::hypot(box.x_span(), box.y_span(), box.z_span())) {
    for (int a = 0; a < 3; ++a)
      greatest_coordinate_ = std::max({greatest_coordinate_, std::abs(box.min(a)), std::abs(box.max(a))});
  }

  double diagonal() const { return diagonal_; }
  double greatest_coordinate() const { return greatest_coordinate_; }

  bool has_box() const { return diagonal_ >= least && std::max(diagonal_, greatest_coordinate_) <= greatest; }

  /// Rounding of the coordinates would spoil the shape of facets smaller than about a thousand units in the last
  /// place.
  double least_radius() const { return 1024 * std::numeric_limits<double>::epsilon() * greatest_coordinate_; }

private:
  double diagonal_, greatest_coordinate_ = 0;
};

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
  check_parameters<Parameters, Feature_curves_tag, Geom_traits_tag, Verbose_tag, OtherTags...>();
}

/// delaunay_surface() with all its named parameters in one chain, which may contain further ones.
template <class Traits, class Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface_of(const Traits& traits, const Delaunay_options& options,
                                                          const Parameters& parameters) {
  options.check();
  const Clip_domain_3 domain = clip_domain(options.clip, traits.bbox());
  const Delaunay_options completed = options.completed(traits.bbox());
  const Delaunay_criteria criteria = {completed.angle, *completed.radius, *completed.distance};
  const auto curves = get_parameter<Feature_curves_tag>(parameters, std::vector<Polyline_3<Kernel_of<Traits>>>());
  const Delaunay_range range(domain.bbox());
  check_argument(range.has_box(), "the box of a Delaunay mesh has a diagonal below 1e-40 or coordinates beyond 1e40: "
                                  "choose another unit");
  check_argument(criteria.radius >= range.least_radius(),
                 "the radius of a Delaunay mesh is less than 2.3e-13 times the largest coordinate of the box: choose a "
                 "larger radius, or an origin nearer to the box");
  return convert_surface<Kernel_of<Traits>>(mesh_surface(
      Any_function_3::make(traits),
      {domain, criteria, options.sizing, convert_polylines<Any_function_3::Kernel>(curves), options.parabolic_curves}));
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Meshes the zero set of a function by Delaunay refinement (Boissonnat, Oudot: Provably good sampling and meshing of
/// surfaces, 2005). The result is a triangle mesh with vertices on the surface, angles of at least `options.angle`,
/// and normals along the gradient.
///
/// CGAL's 3D Mesh Generation refines the mesh. It starts from points on every component of the surface, which are
/// found by subdividing the domain into boxes with the interval bounds of the function. If the result `is_certified`,
/// no component was missed, however small. The mesh of a closed regular surface is a closed oriented 2-manifold.
///
/// Features consist of edges of the mesh: the curves where the surface meets the border of the clip domain,
/// `feature_curves`, and, with the option `parabolic_curves`, the parabolic curves with their crossings and their
/// ends on the border. Where features are closer to each other than the radius, or meet in sharp corners, edges are
/// shorter, and angles at the corners are smaller. Features closer to each other than a fiftieth of the radius may
/// lose edges; the mesh is then not certified and may not be a manifold there. Features much smaller than the radius
/// may be missed.
///
/// Conical singular points of the surface, such as the apex of a cone, become vertices of the mesh. So are apexes where
/// f has no gradient, such as that of half a cone or the corner of a cube. The curves where the surface ends because f
/// is undefined beyond them also become features, with an accuracy of a hundredth of the radius. Near other singular
/// points, the mesh ends with facets of size radius/8, whose angles are not bounded.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `feature_curves` | range of Polyline_3 | none | curves on the surface that edges follow |
///
/// The named parameters `geom_traits` and `verbose` are accepted for compatibility with CGAL and ignored. Segments of
/// `feature_curves` should be short compared to the facets; the mesh has its own vertices on them.
/// \throw Input_error for bad options
/// \throw std::invalid_argument unless the clip domain is finite and has an interior, the diagonal of its box is at
/// least 1e-40, the diagonal and the coordinates are at most 1e40, and the radius is at least 1024 epsilons of the
/// largest coordinate
///
/// The result is the same on every run. It is computed by one thread: 20,000 triangles take about 0.2 seconds, with
/// 10 to 40 evaluations per triangle.
template <ImplicitFunctionTraits_3 Traits, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, const Delaunay_options& options = {},
                                                       const Parameters&... given) {
  internal::check_delaunay_parameters<internal::Joined_parameters<Parameters...>>();
  return internal::delaunay_surface_of(traits, options, internal::joined_parameters(given...));
}

/// The same for the level set f = isovalue. Its points and triangles are appended to the caller's containers, see
/// to_polygon_soup(). The returned object contains everything except the mesh.
template <ImplicitFunctionTraits_3 Traits, class Points, class Triangles, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>>
delaunay_surface(const Traits& traits, const typename Traits::FT& isovalue, Points& points, Triangles& triangles,
                 const Delaunay_options& options = {}, const Parameters&... given) {
  internal::check_delaunay_parameters<internal::Joined_parameters<Parameters...>>();
  auto surface = internal::delaunay_surface_of(Level_set_traits_3<Traits>(traits, isovalue), options,
                                               internal::joined_parameters(given...));
  to_polygon_soup(surface, points, triangles);
  return internal::without_mesh(std::move(surface));
}

/// The same for the zero set, which is added to a model of CGAL's MutableFaceGraph, see to_face_graph(). Further
/// named parameters are
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `vertex_status_map` | writable property map | none | from vertices to Point_status |
template <ImplicitFunctionTraits_3 Traits, Face_graph Graph, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>>
delaunay_surface(const Traits& traits, Graph& graph, const Delaunay_options& options = {}, const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_delaunay_parameters<Joined, internal::Vertex_point_tag, internal::Vertex_status_tag>();
  const Joined parameters = internal::joined_parameters(given...);
  auto surface = internal::delaunay_surface_of(traits, options, parameters);
  internal::copy_to_graph(surface, graph, parameters);
  return internal::without_mesh(std::move(surface));
}

/// \cond
// Explains wrong arguments, see explain_sampler.h.
template <class Traits, class... Others>
void delaunay_surface(const Traits&,
                      const Others&...) requires Mistaken_for_sampler<Delaunay_options, Traits, Others...> {
  explain_sampler<Delaunay_options, Traits, Others...>();
}
/// \endcond

} // namespace equiaffine

#endif
