// SPDX-License-Identifier: GPL-3.0-or-later
// The local structure at the vertices of a mesh or at points, from polynomials that are fitted to them.
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

/// The structure that a fit around a data point gives it. A point that no fit belongs to has the status OUTSIDE.
///
/// The error is that of what the numbers stand for: those of the surface that was sampled, or at a scale those of the
/// polynomials of dense exact data, which noise and sampling alone make wrong. An infinite error means that nothing is
/// known.
template <class FT>
struct Fitted_structure_3 {
  Local_structure_3<FT> structure;   ///< the numbers
  Local_structure_error_3<FT> error; ///< their estimated errors
  Local_structure_error_3<FT> noise; ///< two standard deviations of what noise makes; at a scale, the error
  Local_structure_error_3<FT>
      detail; ///< at a scale: how much detail that the scale leaves out may make; else the error
  FT scale;   ///< the scale of the curvatures if they are those at a scale, else the radius of the ball that was fitted
  bool is_at_scale; ///< whether the curvatures are those at a scale, and not the surface's own
  FT deviation;     ///< the standard deviation of data around the point from a smooth surface, a length
};

} // namespace equiaffine

namespace equiaffine::internal {

/// The diagonals of boxes of points whose curvatures fits give: affine curvatures, and what they are computed from,
/// leave double precision in other units, where the function of a fit still exists. Points that are all equal have no
/// curvatures in any unit.
struct Extent_of_fit {
  static constexpr double least = 1e-40, greatest = 1e40;

  static constexpr bool has(double diagonal) { return diagonal == 0 || (least <= diagonal && diagonal <= greatest); }
};

/// Refuses named parameters that are neither those of every fit nor among `OtherTags`.
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

/// The data of a fit, as a user gave them.
struct Fit_data_3 {
  enum class Kind {
    POINTS, ///< without polygons
    MESH,   ///< vertices and faces of a manifold
    SOUP    ///< polygons that may be anything
  };

  Kind kind;
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::vector<std::uint32_t>> polygons = {}; ///< of positions of points
  std::vector<Eigen::Vector3d> normals = {};             ///< one for each point, or none if they are to be estimated
};

// Meshes and points of CGAL become arrays.

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

// The library defines these functions, which do the work of fits. They run in the threads of TBB if `in_threads`. Their
// parameters name no type of Eigen, whose namespace has another name in the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Returns the structure at each of the given points.
/// \throw Input_error if an option makes no sense
std::vector<Fitted_structure_3<double>>
structures_of_data(bool in_threads, Fit_data_3 given, const Fit_options& options, Orientation_of_level_set orientation);

/// Returns the structure at one vertex of a mesh.
/// \throw Input_error if an option makes no sense
Fitted_structure_3<double> structure_of_vertex(Fit_data_3 given, const Fit_options& options,
                                               Orientation_of_level_set orientation, std::size_t i);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

// The functions below with all their named parameters in one chain, which may have others.

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
  CGAL_precondition_msg(place != std::end(all), "the vertex is none of the mesh");
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

/// Returns the local structure at the vertices of a mesh, a model of CGAL's FaceGraph, in their order, from polynomials
/// that are fitted to the vertices around each. The numbers belong to the surface that the vertices are samples of:
/// facets only say which vertices are neighbors, and on which side normals are. They are those of the point of the fit
/// that is nearest along its gradient.
///
/// Where the data resolve the surface, its own curvatures come out. The data choose what to fit: heights over a tangent
/// plane, of degree up to 12, where they lie on a smooth surface, to within little, else polynomials in space (up to
/// 6), which can go round a corner. Trials at up to 200 places tell degree and radius: those whose results agree best
/// with the next degree and with smaller balls, which see what all degrees leave out (Lepski, On a problem of adaptive
/// estimation in Gaussian white noise, 1991), and whose residuals leave the least deviation. The estimated error is a
/// factor times the root of the sum of two squares: of the greatest difference to other fits there and around, and of
/// the standard deviation of the number if residuals are white noise. The factor depends on the quantity and the noise;
/// benchmark/fit/calibrate-fits makes it, such that estimates below a half cover the errors at 95 % of the vertices of
/// surfaces whose curvatures are known. Among the others around is the next degree of the same parity, since a shape
/// with a center of symmetry that lies in one ball looks the same to the degrees 4 and 5, whatever they miss. For K the
/// differences around count with the power 0.88, and those at the vertex with the rest. On exact data, whose noise is
/// below 1e-4 of the spacing, the greater degree answers, and a smaller ball tells its error.
///
/// Scans and coarse meshes have sensible curvatures at a scale only. These are by definition, see doc/conventions.md,
/// those of polynomials in space of degree 4, or of `degree`, fitted within 1.14 of the scale. By default the data
/// choose: no scale where they resolve the surface, else the smallest one at which K is known to 20 % at half of the
/// vertices, at most an eighth of the diagonal. With a scale of 0 curvatures are the surface's own. Fits are made at
/// most 0.02 of the scale apart, and errors are 2 to 2.5 times the standard deviation that noise and sampling make of
/// the numbers at that scale, as halves of scans tell. At a scale that the data choose they also count what the scale
/// mixes where the data are exact, such as a jump of the curvature.
///
/// A mesh that is mapped by an affine map of determinant 1 gets the same affine curvatures to within rounding, since
/// neighborhoods are balls in coordinates in which the edges have no preferred direction; an edge counts as at most
/// three times as long as the lower quartile of those at its vertex. `scale` and `noise` are lengths there, divided by
/// the factor of volumes to the power 1/3. Creases are those of the given coordinates.
///
/// Statuses: OUTSIDE for a vertex that no fit belongs to, since it has no faces, or fewer than some 20 vertices are
/// connected with it, or since it is an outlier: away from its neighbors and theirs by more than 1.5 times their mean
/// distance from their mean. PARABOLIC for one whose K_e is zero within its estimated error, as on a plane or a
/// cylinder.
///
/// Fits do not reach over creases: edges that bend by more than `feature_angle`, by default 60 degrees, and that follow
/// each other for ten mean edges, and ten more for each loose end, since noise makes edges sharp, too. Each side has
/// its own curvature, and a vertex on a crease has that of the side with the most area around it. At creases that are
/// less sharp a fit exists, and its error says that it means nothing.
///
/// \throw Input_error if an option makes no sense, such as a scale beyond a third of the diagonal of the data, or one
/// within which most vertices have too few others. \throw std::invalid_argument if a coordinate is not finite, or the
/// diagonal of the points is below 1e-40 or beyond 1e40.
///
/// Takes about 1 ms per vertex, also at a scale; memory is linear in the number of vertices. The numbers are the same
/// for CGAL::Sequential_tag and CGAL::Parallel_tag. Normals that come with a mesh help where its faces are coarse
/// beside the surface. Named parameters come in one chain or several, equiaffine's and CGAL's:
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `vertex_normal_map` | property map | made of the faces | from vertices to normals |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// With AGAINST_GRADIENT the structure is that of the surface with normals on the other side.
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

/// Returns the local structure at one vertex, from the fit around it: that of the overload for all vertices to within
/// the estimated error, since most of these have the fit around a vertex nearby. This takes the choice of how to fit,
/// some hundred fits, unless there is a scale above 0. The named parameters are those of that overload.
template <class Vertex, Face_graph Graph, internal::Parameter_chain... Parameters>
Fitted_structure_3<double> fitted_structure(const Vertex& v, const Graph& mesh, const Fit_options& options = {},
                                            const Parameters&... given) {
  internal::check_mesh_fit_parameters<internal::Joined_parameters<Parameters...>>();
  return internal::fitted_structure_of_vertex(v, mesh, options, Orientation_of_level_set::ALONG_GRADIENT,
                                              internal::joined_parameters(given...));
}

/// Returns the local structure at points without faces, in their order. Neighbors are the 16 nearest points, so that
/// two sheets of a surface that are closer than the points on each of them become one. Normals are estimated from the
/// neighbors and turned to agree along a spanning tree, unless `normal_map` gives them. Equal points count once.
/// A range such as CGAL::Point_set_3 has its own map of points.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `point_map` | property map | the elements | from elements to points |
/// | `normal_map` | property map | estimated | from elements to normals |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
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

/// Returns the local structure at points with polygons between them, in the order of the points. A polygon is a range
/// of positions of points. It need not be a mesh: equal points count once, inconsistently oriented polygons are flipped
/// to match the first one of their component, and the surface is cut open where it is not a manifold.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// \throw std::invalid_argument also if a polygon has the position of no point.
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
// A call that is mistaken, see base/named_parameters.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Elements, class First, class... Others>
void fitted_structures(const Elements&, const First&, const Others&...) requires(
    (Face_graph<Elements> || (std::ranges::input_range<Elements> && !std::ranges::input_range<First>)) &&
    !std::convertible_to<First, Fit_options>) {
  internal::explain_options<First>();
}
/// \endcond

} // namespace equiaffine

#endif
