// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_FITTED_STRUCTURES_H
#define EQUIAFFINE_FIT_FITTED_STRUCTURES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/fit/internal/Fit_request.h>
#include <equiaffine/fit/internal/fitted_structures_of.h>
#include <equiaffine/function/internal/explain_misuse.h>
#include <equiaffine/mesh/internal/Face_graph.h>

#include <CGAL/tags.h>

#include <ranges>
#include <vector>

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
/// those of polynomials in space of degree 4, or of `degree`, fitted within 1.14 of the scale. `scale` is that scale;
/// `scale(std::nullopt)` lets the data choose: none where they resolve the surface, else the smallest at which K is
/// known to 20 % at half of the vertices, at most an eighth of the diagonal. Without the parameter, or with 0,
/// curvatures are the surface's own. Fits are made at most 0.02 of the scale apart, and errors are 2 to 2.5 times the
/// standard deviation that noise and sampling make of the numbers at that scale, as halves of scans tell. At a scale that
/// the data choose they also count what the scale mixes where the data are exact, such as a jump of the curvature.
///
/// A mesh that is mapped by an affine map of determinant 1 gets the same affine curvatures to within rounding, since
/// neighborhoods are balls in coordinates in which the edges have no preferred direction; an edge counts as at most
/// three times as long as the lower quartile of those at its vertex. `scale` and `noise` are lengths there, divided by the
/// factor of volumes to the power 1/3. Creases are those of the given coordinates.
///
/// Statuses: OUTSIDE for a vertex that no fit belongs to, since it has no faces, or fewer than some 20 vertices are
/// connected with it, or since it is an outlier: away from its neighbors and theirs by more than 1.5 times their mean
/// distance from their mean. PARABOLIC for one whose K_e is zero within its estimated error, as on a plane or a cylinder.
///
/// Fits do not reach over creases: edges that bend by more than `feature_angle`, by default 60 degrees, and that follow
/// each other for ten mean edges, and ten more for each loose end, since noise makes edges sharp, too. Each side has
/// its own curvature, and a vertex on a crease has that of the side with the most area around it. At creases that are
/// less sharp a fit exists, and its error says that it means nothing.
///
/// \throw std::invalid_argument if a coordinate is not finite, the diagonal of the points is below 1e-40 or beyond
/// 1e40, or a parameter makes no sense, as a scale beyond a third of the diagonal of the data, or one within which most
/// vertices have too few others.
///
/// Takes about 1 ms per vertex, also at a scale; memory is linear in the number of vertices. The numbers are the same
/// for CGAL::Sequential_tag and CGAL::Parallel_tag. Normals that come with a mesh help where its faces are coarse
/// beside the surface. Named parameters come in one chain or several, equiaffine's and CGAL's:
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `vertex_normal_map` | property map | made of the faces | from vertices to normals |
/// | `noise` | `std::optional<double>` | estimated | standard deviation of the points from the surface, a length |
/// | `scale` | `std::optional<double>` | 0 | a length; 0: none; `std::nullopt`: the data choose |
/// | `ball_radius` | `double` | not given | CGAL's name of `scale`, which counts if both are given |
/// | `degree` | `std::optional<int>` | chosen by the data | 4, 5, 6, or of heights 8, 10 |
/// | `feature_angle` | `std::optional<double>` | 60 | angle of creases in degrees; `std::nullopt`: no creases |
/// | `orientation` | Orientation_of_level_set | ALONG_GRADIENT | AGAINST_GRADIENT turns normals round |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Graph& mesh, const Parameters&... given) {
  internal::check_mesh_fit_parameters<internal::Joined_parameters<Parameters...>, internal::Orientation_tag>();
  return internal::fitted_structures_of_graph<ConcurrencyTag>(mesh, internal::joined_parameters(given...));
}

/// Returns the local structure at one vertex, from the fit around it: that of the overload for all vertices to within
/// the estimated error, since most of these have the fit around a vertex nearby. This takes the choice of how to fit,
/// some hundred fits, unless a `scale` is given. The named parameters are those of that overload.
template <class Vertex, Face_graph Graph, internal::Parameter_chain... Parameters>
Fitted_structure_3<double> fitted_structure(const Vertex& v, const Graph& mesh, const Parameters&... given) {
  internal::check_mesh_fit_parameters<internal::Joined_parameters<Parameters...>, internal::Orientation_tag>();
  return internal::fitted_structure_of_vertex(v, mesh, internal::joined_parameters(given...));
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
/// | `normal_orientation` | Normal_orientation | ORIENTED | whether given normals are of one side |
/// | `noise` | `std::optional<double>` | estimated | standard deviation of the points from the surface, a length |
/// | `scale` | `std::optional<double>` | 0 | a length; 0: none; `std::nullopt`: the data choose |
/// | `ball_radius` | `double` | not given | CGAL's name of `scale`, which counts if both are given |
/// | `degree` | `std::optional<int>` | chosen by the data | 4, 5, 6, or of heights 8, 10 |
/// | `orientation` | Orientation_of_level_set | ALONG_GRADIENT | AGAINST_GRADIENT turns normals round |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Points& points,
                                                          const Parameters&... given) requires(!Face_graph<Points>) {
  internal::check_point_fit_parameters<internal::Joined_parameters<Parameters...>, internal::Orientation_tag>();
  return internal::fitted_structures_of_points<ConcurrencyTag>(points, internal::joined_parameters(given...));
}

/// Returns the local structure at points with polygons between them, in the order of the points. A polygon is a range
/// of positions of points. It need not be a mesh: equal points count once, polygons whose orientations contradict are
/// turned to agree with the first one of what is connected with them, and the surface comes apart where it is not a
/// manifold.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `noise` | `std::optional<double>` | estimated | standard deviation of the points from the surface, a length |
/// | `scale` | `std::optional<double>` | 0 | a length; 0: none; `std::nullopt`: the data choose |
/// | `ball_radius` | `double` | not given | CGAL's name of `scale`, which counts if both are given |
/// | `degree` | `std::optional<int>` | chosen by the data | 4, 5, 6, or of heights 8, 10 |
/// | `feature_angle` | `std::optional<double>` | 60 | angle of creases in degrees; `std::nullopt`: no creases |
/// | `orientation` | Orientation_of_level_set | ALONG_GRADIENT | AGAINST_GRADIENT turns normals round |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// \throw std::invalid_argument also if a polygon has the position of no point.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          std::ranges::input_range Polygons, internal::Parameter_chain... Parameters>
std::vector<Fitted_structure_3<double>> fitted_structures(const Points& points, const Polygons& polygons,
                                                          const Parameters&... given) {
  internal::check_fit_parameters<internal::Joined_parameters<Parameters...>, internal::Orientation_tag,
                                 internal::Feature_angle_tag>();
  return internal::fitted_structures_of_soup<ConcurrencyTag>(points, polygons, internal::joined_parameters(given...));
}

/// \cond
// Calls that are mistaken, see explain_misuse.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Elements, class First, class... Others>
void fitted_structures(const Elements&, const First&, const Others&...) requires(
    (Face_graph<Elements> || std::ranges::input_range<Elements>)&&!(
        (internal::Parameter_chain<First> || (std::ranges::input_range<First> && !Face_graph<Elements>)) &&
        (internal::Parameter_chain<Others> && ...))) {
  if constexpr (Face_graph<Elements> || !std::ranges::input_range<First>) internal::explain_parameters<First>();
  internal::explain_parameters<Others...>();
}
/// \endcond

} // namespace equiaffine

#endif
