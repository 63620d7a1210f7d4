// SPDX-License-Identifier: GPL-3.0-or-later
// The local structure at the vertices of a mesh or at points, from fitted polynomials.
#ifndef EQUIAFFINE_FIT_FITTED_STRUCTURES_H
#define EQUIAFFINE_FIT_FITTED_STRUCTURES_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/assertions.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>
#include <Eigen/Core>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <ranges>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine {

/// The structure at a data point according to the fit around it. A point without a fit has the status OUTSIDE.
///
/// The error refers to the surface that was sampled. At a scale, it refers to the polynomials that dense exact data
/// would give, so it is due to noise and sampling only. An infinite error means that nothing is known.
template <class FT>
struct Fitted_structure_3 {
  Local_structure_3<FT> structure;    ///< normal, curvatures and their affine counterparts
  Local_structure_error_3<FT> error;  ///< estimated errors of the structure
  Local_structure_error_3<FT> noise;  ///< two standard deviations due to noise; at a scale, the error
  Local_structure_error_3<FT> detail; ///< at a scale: possible effect of the detail it omits; else the error
  FT scale;         ///< the scale of the curvatures if `is_at_scale`, else the radius of the ball that was fitted
  bool is_at_scale; ///< whether the curvatures are those at a scale, not those of the surface itself
  FT deviation;     ///< standard deviation of nearby data from a smooth surface, a length
};

} // namespace equiaffine

namespace equiaffine::internal {

/// The range of diagonals of the data for which curvatures can be computed. Beyond it affine curvatures and their
/// intermediate results overflow or underflow double precision, although the function of a fit still exists. A diagonal
/// of 0 is allowed: points that are all equal have no curvatures in any unit.
struct Extent_of_fit {
  static constexpr double least = 1e-40, greatest = 1e40;

  static constexpr bool has(double diagonal) { return diagonal == 0 || (least <= diagonal && diagonal <= greatest); }
};

/// Rejects named parameters that are neither common to all fits nor among `OtherTags`.
template <class Parameters, class... OtherTags>
constexpr void check_fit_parameters() {
  check_parameters<Parameters, Geom_traits_tag, Verbose_tag, OtherTags...>();
}

/// The same for meshes.
template <class Parameters, class... OtherTags>
constexpr void check_mesh_fit_parameters() {
  check_fit_parameters<Parameters, Vertex_point_tag, Vertex_normal_tag, OtherTags...>();
}

/// The same for points without faces.
template <class Parameters, class... OtherTags>
constexpr void check_point_fit_parameters() {
  check_fit_parameters<Parameters, Point_tag, Normal_tag, OtherTags...>();
}

/// The data of a fit as given by the user.
struct Fit_data_3 {
  enum class Kind {
    POINTS, ///< without polygons
    MESH,   ///< vertices and faces of a manifold
    SOUP    ///< arbitrary polygons
  };

  Kind kind;
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::vector<std::uint32_t>> polygons = {}; ///< as indices of points
  std::vector<Eigen::Vector3d> normals = {};             ///< one per point, or empty if they should be estimated
};


/// The points are the vertices in their order.
template <Face_graph Graph, class Parameters>
Fit_data_3 fit_data_of_graph(const Graph& graph, const Parameters& parameters) {
  check_coordinates<Point_of_vertices<const Graph, Parameters>>();
  Indexed_polygons mesh = indexed_polygons_of_graph(graph, parameters);
  Fit_data_3 data = {Fit_data_3::Kind::MESH, std::move(mesh.points), std::move(mesh.polygons)};
  if constexpr (has_parameter<Vertex_normal_tag, Parameters>)
    for (const auto v : vertices_of(graph))
      data.normals.push_back(coordinates_of(get(given_parameter<Vertex_normal_tag>(parameters), v)));
  return data;
}

template <std::ranges::input_range Points, class Parameters>
Fit_data_3 fit_data_of_points(Points&& range, const Parameters& parameters) {
  Fit_data_3 data = {Fit_data_3::Kind::POINTS};
  const auto point_of = point_of_element(range, parameters);
  check_coordinates<std::decay_t<decltype(point_of(*std::ranges::begin(range)))>>();
  for (const auto& element : range) {
    data.points.push_back(coordinates_of(point_of(element)));
    if constexpr (has_parameter<Normal_tag, Parameters>)
      data.normals.push_back(coordinates_of(get(given_parameter<Normal_tag>(parameters), element)));
  }
  check_points(data.points);
  return data;
}

template <std::ranges::input_range Points, std::ranges::input_range Polygons>
Fit_data_3 fit_data_of_soup(const Points& points, const Polygons& polygons) {
  Indexed_polygons soup = indexed_polygons_of_soup(points, polygons);
  return {Fit_data_3::Kind::SOUP, std::move(soup.points), std::move(soup.polygons)};
}

// Defined in the library, where the fits are computed. They use TBB threads if `in_threads`. Their parameters
// contain no Eigen types, because the library renames the namespace of Eigen.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Returns the structure at each of the given points.
/// \throw Input_error if an option is invalid
std::vector<Fitted_structure_3<double>>
structures_of_data(bool in_threads, Fit_data_3 given, const Fit_options& options, Orientation_of_level_set orientation);

/// Returns the structure at one vertex of a mesh.
/// \throw Input_error if an option is invalid
Fitted_structure_3<double> structure_of_vertex(Fit_data_3 given, const Fit_options& options,
                                               Orientation_of_level_set orientation, std::size_t i);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

// The public functions below with all named parameters in one chain, which may contain parameters that they do not
// use.

template <class ConcurrencyTag, class Graph, class Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures_of_graph(const Graph& mesh, const Fit_options& options,
                                                                   Orientation_of_level_set orientation,
                                                                   const Parameters& parameters) {
  return structures_of_data(runs_in_threads<ConcurrencyTag>(), fit_data_of_graph(mesh, parameters), options,
                            orientation);
}

template <class Vertex, class Graph, class Parameters>
Fitted_structure_3<double> fitted_structure_of_vertex(const Vertex& v, const Graph& mesh, const Fit_options& options,
                                                      Orientation_of_level_set orientation,
                                                      const Parameters& parameters) {
  const auto all = vertices_of(mesh);
  const auto place = std::find(std::begin(all), std::end(all), v);
  CGAL_precondition_msg(place != std::end(all), "the vertex is not in the mesh");
  const auto i = std::size_t(std::distance(std::begin(all), place));
  return structure_of_vertex(fit_data_of_graph(mesh, parameters), options, orientation, i);
}

template <class ConcurrencyTag, class Points, class Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures_of_points(Points&& points, const Fit_options& options,
                                                                    Orientation_of_level_set orientation,
                                                                    const Parameters& parameters) {
  return structures_of_data(runs_in_threads<ConcurrencyTag>(), fit_data_of_points(points, parameters), options,
                            orientation);
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Returns the local structure at the vertices of a mesh, a model of CGAL's FaceGraph, in their order, from
/// polynomials fitted to the vertices around each. The structure belongs to the surface sampled by the vertices:
/// faces only define which vertices are neighbors and the side of the normals. It is evaluated at the point of the
/// fit that is nearest along its gradient.
///
/// Where the data resolve the surface, the curvatures are those of the surface itself. The kind of fit is chosen from
/// the data: where they lie close to a smooth surface, height functions of degree up to 12 over a tangent plane;
/// elsewhere implicit polynomials in space of degree up to 6, which can follow strong bends. Degree and radius are
/// chosen by trial fits at up to 200 places. The pair is chosen that agrees best with the next degree and with smaller
/// balls, which reveal detail that all degrees miss (Lepski, On a problem of adaptive estimation in Gaussian white
/// noise, 1991), and has the smallest residuals. On exact data, whose noise is below 1e-4 of the spacing, the higher of
/// the two degrees is used, and its error is estimated with a smaller ball.
///
/// The estimated error is a factor times sqrt(d^2 + s^2). Here d is the largest difference to other fits at the vertex
/// and around it, and s is the standard deviation of the number if residuals are white noise. The other fits include
/// the next degree of the same parity, because a centrally symmetric shape within one ball looks the same to degrees 4
/// and 5. For K, d is D^0.88 e^0.12, and at least e, where D is the typical difference at nearby vertices, and e is
/// that at the vertex itself. The factor depends on the quantity and the noise. It is calibrated by
/// benchmark/fit/calibrate-fits such that estimates below one half cover the errors at 95 % of the vertices of surfaces
/// with known curvatures.
///
/// Scans and coarse meshes have meaningful curvatures only at a scale. By definition, see doc/conventions.md, these are
/// the curvatures of polynomials in space of degree 4, or of `degree`, fitted within 1.14 times the scale. By default
/// the scale is chosen from the data: none where they resolve the surface, else the smallest one at which K is known to
/// 20 % at half of the vertices, at most an eighth of the diagonal. A scale of 0 gives the curvatures of the surface
/// itself. Fits are at most 0.02 times the scale apart. Errors are 2 to 2.5 times the standard deviation due to noise
/// and sampling at that scale, as measured on halves of scans. At a scale chosen from the data they also include, for
/// exact data, the effect of different shapes within one neighborhood, such as a jump of the curvature.
///
/// An affine map of determinant 1 of the mesh does not change the affine curvatures beyond rounding, because
/// neighborhoods are balls in coordinates in which the edges have no preferred direction. An edge counts as at most
/// three times as long as the lower quartile of the edges at its vertex. `scale` and `noise` are lengths in these
/// coordinates, divided by the cube root of their volume factor. Creases are found in the given coordinates.
///
/// A vertex is OUTSIDE if it has no fit: it has no faces, fewer than 18 vertices are connected with it, or it is
/// an outlier. A vertex is an outlier if its distance from the mean of its neighbors and their neighbors exceeds 1.5
/// times their mean distance from that mean. A vertex is PARABOLIC if its K_e is zero within its estimated error, as on
/// a plane or a cylinder.
///
/// Fits do not extend across creases. Creases are edges that bend by more than `feature_angle`, by default 60 degrees,
/// and form chains at least ten mean edge lengths long, plus ten for each end where the chain stops, because noise
/// makes single edges sharp. Each side has its own curvature; a vertex on a crease has that of the side with the
/// largest area around it. At less sharp creases fits exist, but their large error estimates show that they are
/// meaningless.
///
/// \throw Input_error if an option is invalid, for example if the scale is larger than a third of the diagonal of
/// the data, or if most vertices have too few neighbors within it. \throw std::invalid_argument if a coordinate is
/// not finite, or the diagonal of the points is below 1e-40 or above 1e40.
///
/// Takes about 1 ms per vertex, also at a scale; memory is linear in the number of vertices. CGAL::Sequential_tag and
/// CGAL::Parallel_tag give the same numbers. Normals given with a mesh improve the fits where its faces are large
/// compared with the features of the surface. AGAINST_GRADIENT flips the normals.
///
/// Named parameters of equiaffine and of CGAL can be in one chain or several. `geom_traits` and `verbose` are
/// accepted for compatibility with CGAL, and ignored.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `vertex_normal_map` | property map | computed from the faces | from vertices to normals |
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Graph& mesh, const Fit_options& options,
                                                          Orientation_of_level_set orientation,
                                                          const Parameters&... given) {
  internal::check_mesh_fit_parameters<internal::Joined_parameters<Parameters...>>();
  return internal::fitted_structures_of_graph<ConcurrencyTag>(mesh, options, orientation,
                                                              internal::joined_parameters(given...));
}
/// The same with normals on the side of the mesh.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Graph& mesh, const Fit_options& options = {},
                                                          const Parameters&... given) {
  return fitted_structures<ConcurrencyTag>(mesh, options, Orientation_of_level_set::ALONG_GRADIENT, given...);
}

/// Returns the local structure at one vertex, from the fit around it. It agrees, within the estimated error, with the
/// result of fitted_structures(), in which most vertices share the fit of a nearby vertex. The choice of what to fit
/// takes about a hundred fits, unless a scale above 0 is given. The named parameters are those of that overload.
template <class Vertex, Face_graph Graph, internal::Parameter_chain... Parameters>
Fitted_structure_3<double> fitted_structure(const Vertex& v, const Graph& mesh, const Fit_options& options = {},
                                            const Parameters&... given) {
  internal::check_mesh_fit_parameters<internal::Joined_parameters<Parameters...>>();
  return internal::fitted_structure_of_vertex(v, mesh, options, Orientation_of_level_set::ALONG_GRADIENT,
                                              internal::joined_parameters(given...));
}

/// Returns the local structure at points without faces, in their order. Neighbors are the 16 nearest points, so two
/// sheets of a surface merge if they are closer than the points on each of them. Normals are estimated from the
/// neighbors and oriented consistently along a spanning tree, unless `normal_map` is given. Equal points count once.
/// A range such as CGAL::Point_set_3 provides its own point map. `geom_traits` and `verbose` are accepted for
/// compatibility with CGAL, and ignored.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `point_map` | property map | the elements | from elements to points |
/// | `normal_map` | property map | estimated | from elements to normals |
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Points& points, const Fit_options& options,
                                                          Orientation_of_level_set orientation,
                                                          const Parameters&... given) requires(!Face_graph<Points>) {
  internal::check_point_fit_parameters<internal::Joined_parameters<Parameters...>>();
  return internal::fitted_structures_of_points<ConcurrencyTag>(points, options, orientation,
                                                               internal::joined_parameters(given...));
}
/// The same with normals on the side of the given ones.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Points& points, const Fit_options& options = {},
                                                          const Parameters&... given) requires(!Face_graph<Points>) {
  return fitted_structures<ConcurrencyTag>(points, options, Orientation_of_level_set::ALONG_GRADIENT, given...);
}

/// Returns the local structure at the points of a polygon soup, in their order. A polygon is a range of point
/// indices. The soup need not be a mesh: equal points count once, inconsistently oriented polygons are flipped to
/// match the first one of their component, and the surface is cut open where it is not a manifold. `geom_traits` and
/// `verbose` are accepted for compatibility with CGAL, and ignored.
/// \throw std::invalid_argument also if an index is out of range.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          std::ranges::input_range Polygons, internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Points& points, const Polygons& polygons,
                                                          const Fit_options& options,
                                                          Orientation_of_level_set orientation, const Parameters&...) {
  internal::check_fit_parameters<internal::Joined_parameters<Parameters...>>();
  return internal::structures_of_data(runs_in_threads<ConcurrencyTag>(), internal::fit_data_of_soup(points, polygons),
                                      options, orientation);
}
/// The same with normals on the side of the polygons.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          std::ranges::input_range Polygons, internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Points& points, const Polygons& polygons,
                                                          const Fit_options& options = {}, const Parameters&... given) {
  return fitted_structures<ConcurrencyTag>(points, polygons, options, Orientation_of_level_set::ALONG_GRADIENT,
                                           given...);
}

/// \cond
// Overload for invalid calls, see base/named_parameters.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Elements, class First, class... Others>
void fitted_structures(const Elements&, const First&, const Others&...) requires(
    (Face_graph<Elements> || (std::ranges::input_range<Elements> && !std::ranges::input_range<First>)) &&
    !std::convertible_to<First, Fit_options>) {
  internal::explain_options<First>();
}
/// \endcond

} // namespace equiaffine

#endif
