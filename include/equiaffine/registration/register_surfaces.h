// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the maps that move one surface, or a part of it, onto another one.
#ifndef EQUIAFFINE_REGISTRATION_REGISTER_SURFACES_H
#define EQUIAFFINE_REGISTRATION_REGISTER_SURFACES_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/Registration_options.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/internal/searches.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

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
  /// The scales of fits to the source and to the target that were tried one after the other, the last ones with
  /// success.
  std::vector<std::array<double, 2>> scales = {};
  bool is_by_triangles = false; ///< whether triangles gave `maps`, without their curvature
  /// How many maps with evidence are not among `maps`, since too small a part of the surfaces agrees, or the sizes of
  /// the surfaces have another ratio than the scales of their fits, or since a large part of a closed mesh is off the
  /// other.
  std::size_t maps_left_out = 0;
  std::vector<Registration_advice> advice = {}; ///< what may find a map if there is none, the most promising first

  bool found() const { return !maps.empty(); }                          ///< whether there is a map
  const Registered_map_3<Kernel>& best() const { return maps.front(); } ///< \pre found()
};

} // namespace equiaffine

namespace equiaffine::internal {

// The library defines these functions. They run in the threads of TBB if `in_threads`.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// The result of register_surfaces(), and whether the best map moves all of each surface onto the other.
struct Registration_of_functions_3 {
  Surface_registration_3<Kernel_of_searches> result;
  bool is_equivalence = false;
};

/// Compares surfaces as they are. Whole surfaces of exact functions whose frames give no map are tried without frames.
Registration_of_functions_3 registration_of_functions(bool in_threads, const Surface_to_register& source,
                                                      const Surface_to_register& target,
                                                      const Registration_options& options);

/// Meshes are tried as wholes, and then as pieces, without curvature.
Surface_registration_3<Kernel_of_searches> registration_of_triangles(bool in_threads, const Triangles_3& source,
                                                                     const Triangles_3& target,
                                                                     const Registration_options& options);

/// The result of register_surfaces(), and the surfaces as they were compared last, at the scales that were tried.
struct Registration_of_surfaces {
  Surface_to_register source, target;
  Surface_registration_3<Kernel_of_searches> result = {};
};

/// Frames of curvature are compared first, at one scale after the other where the data choose the scale, then
/// triangles.
Registration_of_surfaces registration_of_surfaces(bool in_threads, Surface_to_register source,
                                                  Surface_to_register target, const Registration_options& options);

/// The same for surfaces that are fitted to data.
Surface_registration_3<Kernel_of_searches> registration_of_data(bool in_threads, const Surface_data_3& source,
                                                                const Surface_data_3& target,
                                                                const Registration_options& options);

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
  result.scales = std::move(found.scales);
  result.is_by_triangles = found.is_by_triangles;
  result.maps_left_out = found.maps_left_out;
  result.advice = std::move(found.advice);
  return result;
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
/// the noise, which is that of the given points: the tolerance is 8 times their median distance from the zero sets, at
/// least 1e-5 of the size of the target, and at most 3e-3 of it, since large parts of unrelated surfaces can be moved
/// onto each other to within more. Where the frame of a point is not determined, as the affine one on quadrics, it is
/// not matched: surfaces with continuous symmetries have a slippage, see Surface_registration_3. A fit
/// (Fitted_function_traits_3) estimates its errors: points where its curvatures are uncertain are tried later. Whole
/// surfaces of other functions without such frames, as boxes, are matched as meshes are. `fit` of the options does not
/// matter.
///
/// Takes 5 expansions for each of up to 6000 points of a surface, and a number of hypotheses that does not depend on
/// the number of points. The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit.
/// \throw Input_error if an option makes no sense. \throw std::invalid_argument if a surface has no points.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Source, std::ranges::input_range Points,
          ImplicitFunctionTraits_3 Target, std::ranges::input_range Target_points>
Surface_registration_3<Kernel_of<Target>> register_surfaces(const Source& source, const Points& source_points,
                                                            const Target& target, const Target_points& target_points,
                                                            const Registration_options& options = {}) {
  options.check();
  return internal::in_kernel<Kernel_of<Target>>(
      internal::registration_of_surfaces(runs_in_threads<ConcurrencyTag>(),
                                         internal::surface_of_function(source, source_points),
                                         internal::surface_of_function(target, target_points), options)
          .result);
}

/// The same for two meshes, models of CGAL's FaceGraph, or ranges of points without faces, or one of each: the map is
/// that of `equiaffine register`, bit for bit.
///
/// Curvatures are compared first, as above, those of fits to the vertices (Fitted_function_traits_3). Where the data do
/// not resolve the surface, curvatures are those at a scale, and can be compared at the same scale only: without
/// `fit.scale`, and unless both surfaces have a map by curvatures of their own, scales of 10, 14, 7 and 20 times the
/// mean distance of the points are tried, up to half of the diagonal, the same length for both and, if the distances
/// differ by a fifth, each surface's own. A map at a scale is accepted if six separate parts of the size of the scale
/// agree and if it changes lengths about as the scales differ. Maps between closed meshes by which 10 % of one of them
/// are off the other are left out. `scales` and `maps_left_out` of the result tell of it.
///
/// Two meshes without such a map are compared by their triangles, without any curvature (`is_by_triangles`): boxes and
/// other CAD parts have none to go by. If the whole surfaces are equal, the map keeps the centroid of the area, and an
/// affine one the moments of the solid inside, so that all rotations and reflections about the centroid are searched by
/// branch and bound. Else pieces are matched by similarities: two points with their normals give a frame, pairs of
/// points with about the same distance and angles are tried, and a map is accepted if the points in contact leave it no
/// freedom, at most 2 % of the points of one surface lie off the other although that does not end there
/// (`contradictions`), and fewer than 1e-6 as good maps are expected by chance. The `tolerance` is the rms distance of
/// surfaces that are equal, a part of the size; by default it is what facets explain, 0.3 % to 1 %, and 2e-5 for solids
/// of planes, which have no other facets. Without one, two scans of an object that are not equal, such as a fine and a
/// coarse one, are matched if one map stands out: its rms is below 1.5 % of the size, less for thin surfaces, and less
/// than half of that of every other map, and less than 10 % of the points are off the other surface.
///
/// Takes 1 to 3 ms per vertex for a fit, up to 9 fits of each surface if there is no map, and then 5 to 40 s on one
/// core for triangles whose wholes are not equal. Named parameters are in a chain for the source and a second one for
/// the target; parameters::joined() makes one chain of several:
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices of a mesh to points |
/// | `point_map` | property map | the elements | from elements of a range to points |
/// | `normal_map` | property map | estimated | from elements of a range to normals |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// \throw Input_error if an option makes no sense. \throw std::invalid_argument if a coordinate is not finite, a mesh
/// has no faces, or a range no points.
template <class ConcurrencyTag = CGAL::Sequential_tag, internal::Mesh_or_points Source, internal::Mesh_or_points Target,
          internal::Parameter_chain Parameters = internal::No_parameters,
          internal::Parameter_chain Target_parameters = internal::No_parameters>
auto register_surfaces(const Source& source, const Target& target, const Registration_options& options = {},
                       const Parameters& given = {}, const Target_parameters& given_of_target = {}) {
  internal::check_data_parameters<Source, Parameters>();
  internal::check_data_parameters<Target, Target_parameters>();
  options.check();
  return internal::in_kernel<internal::Kernel_of_data<Target, Target_parameters>>(internal::registration_of_data(
      runs_in_threads<ConcurrencyTag>(), internal::surface_data(source, internal::joined_parameters(given)),
      internal::surface_data(target, internal::joined_parameters(given_of_target)), options));
}

/// The same for points with polygons between them, each a range of positions of points. Equal points count once.
/// \throw std::invalid_argument also if a polygon has the position of no point.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          std::ranges::input_range Polygons, std::ranges::input_range Target_points,
          std::ranges::input_range Target_polygons>
auto register_surfaces(const Points& points, const Polygons& polygons, const Target_points& target_points,
                       const Target_polygons& target_polygons, const Registration_options& options = {}) {
  using Kernel_of_points = typename CGAL::Kernel_traits<std::ranges::range_value_t<Target_points>>::Kernel;
  options.check();
  return internal::in_kernel<Kernel_of_points>(internal::registration_of_data(
      runs_in_threads<ConcurrencyTag>(), internal::surface_data_of_soup(points, polygons),
      internal::surface_data_of_soup(target_points, target_polygons), options));
}

} // namespace equiaffine

#endif
