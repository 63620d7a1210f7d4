// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the maps that move one surface, or a part of it, onto another one.
#ifndef EQUIAFFINE_REGISTRATION_REGISTER_SURFACES_H
#define EQUIAFFINE_REGISTRATION_REGISTER_SURFACES_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/internal/searches.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>
#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

/// A point of the source and one of the target whose frames gave a map, which carries one frame to the other.
template <class Kernel>
struct Pair_of_frames_3 {
  std::array<typename Kernel::Point_3, 2> points;                 ///< of the source, and of the target
  std::array<std::array<typename Kernel::Vector_3, 3>, 2> frames; ///< two tangent vectors and a transversal one each
};

/// A map that moves the source, or a part of it, onto the target, and what there is to trust it.
template <class Kernel>
struct Registered_map_3 {
  typename Kernel::Aff_transformation_3 map; ///< from the source to the target
  /// The logarithm of the number of maps as good as this one that chance would make of all that were tried.
  double log10_false_alarms;
  /// The parts of the points of the source, and of the target, that lie on the other surface.
  std::array<double, 2> inliers;
  double rms; ///< the root of the mean squared distance of these points, in the unit of the target
  /// None if the map is one of a continuous family, or of whole surfaces or pieces that were matched without curvature.
  std::optional<Pair_of_frames_3<Kernel>> pair;
  /// The parts of the points of the source, and of the target, that lie off the other surface although that does not
  /// end there, for maps between meshes: they speak against the map, or tell where the surfaces differ.
  std::optional<std::array<double, 2>> contradictions = {};
};

/// The result of `register_surfaces`.
template <class Kernel>
struct Surface_registration_3 {
  std::vector<Registered_map_3<Kernel>> maps; ///< the best first; empty if there is no evidence for any
  std::size_t hypotheses = 0;                 ///< the number of maps that were tried
  double size = 0;                            ///< of the target: the rms distance of its points from their centroid
  std::size_t equally_good = 0;               ///< how many other maps, at least, fit as well as the first of `maps`
  std::optional<double> next_best_rms;        ///< of the best map that is not the first one of `maps`, if there was one
  /// How the source slides over itself by maps of the kind. If the dimension is not 0, each of `maps` represents a
  /// continuous family.
  Affine_slippage_3 slippage;
  std::string reason = {}; ///< why the maps between meshes that were tried are not accepted, if that is known

  bool found() const { return !maps.empty(); }                          ///< whether there is a map
  const Registered_map_3<Kernel>& best() const { return maps.front(); } ///< \pre found()
};

} // namespace equiaffine

namespace equiaffine::internal {

/// How many pairs are made, and of what points: of the `neighbors` nearest in invariants, the `best` of each point.
struct Candidate_limits {
  std::size_t neighbors, best;
  double greatest_mismatch; ///< of gradients, whose mismatch is 1 at most
};

/// The thresholds of the search for maps by affine frames. `benchmark_registration 84 thresholds` shows what most of them
/// are good for, with one of them halved or doubled at a time.
struct Frame_thresholds {
  // The points of the source with the greatest weights are tried first: certainty * min(quality, greatest_quality) *
  // (least_rarity + rarity) * exp(-loss_by_disagreement * disagreement) / (1 + loss_by_condition * condition) * slope.
  double greatest_quality = 0.15;
  double least_rarity = 0.05;
  double loss_by_disagreement = 3;
  double loss_by_condition = 0.002;

  // A pair costs mismatch + cost_of_rest * rest + cost_of_step * step. The step, in spacings, leads along the target to
  // where the invariants agree best, and the rest is how much they still differ there.
  double cost_of_rest = 0.3;
  double cost_of_step = 0.1;
  double longest_step = 3; ///< in spacings
  Candidate_limits usual = {24, 3, 0.6};
  Candidate_limits wrong_structure = {48, 8, 0.9}; ///< where no map was found by the usual ones

  // A counterpart costs residual / accidental_residual + mismatch / accidental_mismatch.
  double accidental_residual = 0.1;
  double accidental_mismatch = 0.3;
  double longest_way = 6; ///< from the candidate, in spacings

  // The order and the end of the search.
  std::size_t most_points_to_try = 512, points_per_batch = 32, pairs_at_once = 8, most_hypotheses = 2000;
  /// So many hypotheses more are tried after a map that moves only a part of the source to within the noise: the surface
  /// may be nearly symmetric, and another map fit better.
  std::size_t more_hypotheses = 60;

  // A hypothesis has to reach these logarithms of the chance that it is an accident.
  std::size_t probes_at_first = 150; ///< by which a hypothesis is judged before it is refined
  double greatest_first_tolerance = 0.03;
  double first_log10 = -1.5;  ///< hypotheses that are no better are not refined
  double second_log10 = -4;   ///< those that are no better after a few steps are given up
  double accepted_log10 = -6; ///< a map that is better is no accident

  /// The tolerance of surfaces without noise is that of splines through samples. Smooth surfaces that have nothing in
  /// common can be moved onto each other to within 1e-2 of their size, and large parts of them to within 1e-3 or less.
  double exact_tolerance = 1e-5, greatest_tolerance = 3e-3, rounding = 1e-8;
};

/// The named parameters of register_surfaces, and thresholds that benchmarks vary. The tolerance is beside the size of
/// the target.
struct Registration_request : Map_request {
  std::size_t number_of_maps = 1;
  double least_overlap = 0.05;
  Frame_thresholds thresholds = {};
};

template <class Parameters, class... OtherTags>
constexpr void check_registration_parameters() {
  check_map_parameters<Parameters, Number_of_maps_tag, Least_overlap_tag, OtherTags...>();
}

template <class Parameters>
Registration_request registration_request(const Parameters& parameters) {
  Registration_request request = {map_request(parameters)};
  request.number_of_maps = get_parameter<Number_of_maps_tag>(parameters, request.number_of_maps);
  request.least_overlap = get_parameter<Least_overlap_tag>(parameters, request.least_overlap);
  check_argument(request.number_of_maps > 0, "the number of maps to find is at least 1");
  check_argument(request.least_overlap >= 0 && request.least_overlap <= 1,
                 "the least overlap is a part of a surface, from 0 to 1");
  return request;
}

// The library defines these functions. They run in the threads of TBB if `in_threads`.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// A surface as register_surfaces() is given it, with a function with the same zero set on which maps are refined.
struct Refined_surface_3 : Surface_with_points_3 {
  Any_function_3 refined;
};

/// The result of register_surfaces(), and whether the best map moves all of each surface onto the other.
struct Registration_of_functions_3 {
  Surface_registration_3<Kernel_of_searches> result;
  bool is_equivalence = false;
};

/// Whole surfaces of exact functions whose frames give no map are tried without frames.
Registration_of_functions_3 registration_of_functions(bool in_threads, const Refined_surface_3& source,
                                                      const Refined_surface_3& target,
                                                      const Registration_request& request);

/// Meshes are tried as wholes, and then as pieces.
Surface_registration_3<Kernel_of_searches> registration_of_triangles(bool in_threads, const Triangles_3& source,
                                                                     const Triangles_3& target,
                                                                     const Registration_request& request);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

// Results of searches become those of another kernel.

template <class Kernel>
Pair_of_frames_3<Kernel> in_kernel(const Pair_of_frames_3<Kernel_of_searches>& pair) {
  using FT = typename Kernel::FT;
  Pair_of_frames_3<Kernel> result;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& p = pair.points[side];
    result.points[side] = typename Kernel::Point_3(FT(p.x()), FT(p.y()), FT(p.z()));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = pair.frames[side][k];
      result.frames[side][k] = typename Kernel::Vector_3(FT(v.x()), FT(v.y()), FT(v.z()));
    }
  }
  return result;
}

template <class Kernel>
Surface_registration_3<Kernel> in_kernel(Surface_registration_3<Kernel_of_searches> found) {
  Surface_registration_3<Kernel> result;
  for (const auto& m : found.maps) {
    auto& copy = result.maps.emplace_back();
    copy = {in_kernel<Kernel>(m.map), m.log10_false_alarms, m.inliers, m.rms, {}, m.contradictions};
    if (m.pair) copy.pair = in_kernel<Kernel>(*m.pair);
  }
  result.hypotheses = found.hypotheses;
  result.equally_good = found.equally_good;
  result.size = found.size;
  result.next_best_rms = found.next_best_rms;
  result.slippage = std::move(found.slippage);
  result.reason = std::move(found.reason);
  return result;
}

template <class ConcurrencyTag, class Source, class Points, class Target, class Target_points, class Parameters>
Registration_of_functions_3 registration_of(const Source& source, const Points& source_points, const Target& target,
                                            const Target_points& target_points, const Parameters& parameters) {
  const auto function = Any_function_3::make(source), target_function = Any_function_3::make(target);
  Refined_surface_3 from = {{function, vectors_of(source_points)}, function};
  Refined_surface_3 to = {{target_function, vectors_of(target_points)}, target_function};
  if constexpr (has_parameter<Refined_functions_tag, Parameters>) {
    const auto& [refined_source, refined_target] = given_parameter<Refined_functions_tag>(parameters);
    from.refined = Any_function_3::make(refined_source);
    to.refined = Any_function_3::make(refined_target);
  }
  return registration_of_functions(runs_in_threads<ConcurrencyTag>(), from, to, registration_request(parameters));
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Finds the maps that move the surface `source`, or a part of it, onto the surface `target`. Each surface is a
/// function and a range of points on its zero set, which are moved onto it if they are near; the functions are of any
/// models of the concept, and defined on their boxes.
///
/// The affine frame at one generic point of the source and that at its counterpart give the map, or the frames of the
/// principal directions for maps that keep angles. Counterparts are found by their signatures: the nearest ones among
/// the points of the target, by a tree, then exactly, by Newton's steps on the target. A map is judged by the distances
/// of points both ways, refined by least squares, and accepted if fewer than 1e-6 as good ones are expected by chance:
/// neither an overlap nor the absence of other things is assumed. Points lie on the other surface if they are within
/// the noise, which is that of the given points: `tolerance` is 8 times their median distance from the zero sets, at
/// least 1e-5 of the size of the target, and at most 3e-3 of it, since large parts of unrelated surfaces can be moved
/// onto each other to within more. Where the frame of a point is not determined, as the affine one on quadrics, it is
/// not matched: surfaces with continuous symmetries have a slippage, see Surface_registration_3. A fit
/// (Fitted_function_traits_3) estimates its errors: points where its curvatures are uncertain are tried later. Whole
/// surfaces of other functions without such frames, as boxes, are matched as meshes are.
///
/// Takes 5 expansions for each of up to 6000 points of a surface, and a number of hypotheses that does not depend on
/// the number of points. The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `map_kind` | Map_kind | AFFINE | the kind of maps that are sought |
/// | `reflections` | `bool` | `true` | whether maps may have a negative determinant |
/// | `number_of_maps` | `std::size_t` | 1 | the greatest number of maps; with more than 1 the search goes on |
/// | `least_overlap` | `double` | 0.05 | part of the points of one surface that lies on the other |
/// | `tolerance` | `double` | see above | distance of equal surfaces, a part of the size of the target |
/// | `refined_functions` | `std::pair` | source and target | functions on which maps are refined and judged |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// `refined_functions` are unsmoothed ones where those by which points are matched are smoothed, since smoothing does
/// not commute with affine maps.
/// \throw std::invalid_argument if a surface has no points, or a parameter makes no sense.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Source, std::ranges::input_range Points,
          ImplicitFunctionTraits_3 Target, std::ranges::input_range Target_points,
          internal::Parameter_chain... Parameters>
Surface_registration_3<Kernel_of<Target>> register_surfaces(const Source& source, const Points& source_points,
                                                            const Target& target, const Target_points& target_points,
                                                            const Parameters&... given) {
  internal::check_registration_parameters<internal::Joined_parameters<Parameters...>,
                                          internal::Refined_functions_tag>();
  const auto parameters = internal::joined_parameters(given...);
  return internal::in_kernel<Kernel_of<Target>>(
      internal::registration_of<ConcurrencyTag>(source, source_points, target, target_points, parameters).result);
}

/// The same for the triangles of two meshes, without any curvature: boxes and other CAD parts have none to go by.
///
/// If the whole surfaces are equal, the map keeps the centroid of the area, and an affine one the moments of the solid
/// inside, so that all rotations and reflections about the centroid are searched by branch and bound. Else pieces are
/// matched by similarities: two points with their normals give a frame, pairs of points with about the same distance
/// and angles are tried, and a map is accepted if the points in contact leave it no freedom, at most 2 % of the points
/// of one surface lie off the other although that does not end there (`contradictions`), and fewer than 1e-6 as good
/// maps are expected by chance. The `tolerance` is the rms distance of surfaces that are equal, a part of the size; by
/// default it is what facets explain, 0.3 % to 1 %, and 2e-5 for solids of planes, which have no other facets. Without
/// one, two scans of an object that are not equal, such as a fine and a coarse one, are matched if one map stands out:
/// its rms is below 1.5 % of the size, less for thin surfaces, and less than half of that of every other map, and less
/// than 10 % of the points are off the other surface.
///
/// Takes some 5 to 40 s on one core if the wholes are not equal. The last argument has `vertex_point_map` and
/// `geom_traits` for the target; parameters::joined() makes one argument of several. The one before it has
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `map_kind` | Map_kind | AFFINE | the kind of maps that are sought |
/// | `reflections` | `bool` | `true` | whether maps may have a negative determinant |
/// | `number_of_maps` | `std::size_t` | 1 | the greatest number of maps; with more than 1 the search goes on |
/// | `least_overlap` | `double` | 0.05 | part of the points of one surface that lies on the other |
/// | `tolerance` | `double` | see above | rms distance of equal surfaces, a part of the size |
/// | `vertex_point_map` | property map | the mesh's own | from vertices of the source to points |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// \throw std::invalid_argument if a coordinate is not finite, a mesh has no faces, or a parameter makes no sense.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Source, Face_graph Target,
          internal::Parameter_chain Parameters = internal::No_parameters,
          internal::Parameter_chain Target_parameters = internal::No_parameters>
auto register_surfaces(const Source& source, const Target& target, const Parameters& given = {},
                       const Target_parameters& given_of_target = {}) {
  internal::check_registration_parameters<internal::Joined_parameters<Parameters>, internal::Vertex_point_tag>();
  internal::check_parameters<internal::Joined_parameters<Target_parameters>, internal::Vertex_point_tag,
                             internal::Geom_traits_tag>();
  const auto parameters = internal::joined_parameters(given);
  const auto target_parameters = internal::joined_parameters(given_of_target);
  using Point = Point_of_vertices<const Target, internal::Joined_parameters<Target_parameters>>;
  using Kernel_of_points = typename CGAL::Kernel_traits<Point>::Kernel;
  return internal::in_kernel<Kernel_of_points>(internal::registration_of_triangles(
      runs_in_threads<ConcurrencyTag>(), internal::triangles_of_graph(source, parameters),
      internal::triangles_of_graph(target, target_parameters), internal::registration_request(parameters)));
}

/// The same for points with polygons between them, each a range of positions of points. Equal points count once.
/// \throw std::invalid_argument also if a polygon has the position of no point.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          std::ranges::input_range Polygons, std::ranges::input_range Target_points,
          std::ranges::input_range Target_polygons, internal::Parameter_chain... Parameters>
auto register_surfaces(const Points& points, const Polygons& polygons, const Target_points& target_points,
                       const Target_polygons& target_polygons, const Parameters&... given) {
  internal::check_registration_parameters<internal::Joined_parameters<Parameters...>>();
  const auto parameters = internal::joined_parameters(given...);
  using Kernel_of_points = typename CGAL::Kernel_traits<std::ranges::range_value_t<Target_points>>::Kernel;
  return internal::in_kernel<Kernel_of_points>(internal::registration_of_triangles(
      runs_in_threads<ConcurrencyTag>(), internal::triangles_of_soup(points, polygons),
      internal::triangles_of_soup(target_points, target_polygons), internal::registration_request(parameters)));
}

/// \cond
// A call that is mistaken, see base/named_parameters.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Source, Face_graph Target, class... Others>
void register_surfaces(const Source&, const Target&,
                       const Others&...) requires(!(internal::Parameter_chain<Others> && ...) ||
                                                  sizeof...(Others) > 2) {
  internal::explain_parameters<Others...>();
  static_assert(sizeof...(Others) <= 2, "there is one chain of named parameters for the source and one for the target: "
                                        "parameters::joined() makes one of several");
}
/// \endcond

} // namespace equiaffine

#endif
