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

/// A point of the source and one of the target with the frames that determined a map.
template <class Kernel>
struct Pair_of_frames_3 {
  std::array<typename Kernel::Point_3, 2> points;                 ///< of the source, and of the target
  std::array<std::array<typename Kernel::Vector_3, 3>, 2> frames; ///< two tangent vectors and a transversal one each
};

/// A map from (part of) the source to the target, with the evidence for it.
template <class Kernel>
struct Registered_map_3 {
  typename Kernel::Aff_transformation_3 map; ///< from the source to the target
  /// Base 10 logarithm of the number of false alarms: the expected number of equally good maps by chance among all
  /// that were tried.
  double log10_false_alarms;
  /// The fractions of the points of the source and of the target that lie on the other surface.
  std::array<double, 2> inliers;
  double rms; ///< root mean square distance of these points, in the unit of the target
  /// Empty if the map is one of a continuous family, or if whole surfaces or pieces were matched without curvature.
  std::optional<Pair_of_frames_3<Kernel>> pair;
  /// For maps between meshes: the fractions of the points of the source and of the target that lie off the other
  /// surface although that does not end there. They are evidence against the map, or show where the surfaces differ.
  std::optional<std::array<double, 2>> contradictions = {};
};

/// The result of `register_surfaces`.
template <class Kernel>
struct Surface_registration_3 {
  std::vector<Registered_map_3<Kernel>> maps; ///< best first; empty if there is no evidence for any
  std::size_t hypotheses = 0;                 ///< number of maps that were tried
  double size = 0;                            ///< root mean square distance of the points of the target from their
                                              ///< centroid
  std::size_t equally_good = 0;               ///< a lower bound on the number of other maps that fit as well as the
                                              ///< first of `maps`
  std::optional<double> next_best_rms;        ///< of the best map other than the first of `maps`, if any
  /// How the source slides over itself by maps of the kind. If the dimension is not 0, each of `maps` represents a
  /// continuous family.
  Affine_slippage_3 slippage;
  std::string reason = {}; ///< why maps between meshes were rejected, if known
  /// The scales of fits to the source and to the target, in the order in which they were tried; the last ones were
  /// successful.
  std::vector<std::array<double, 2>> scales = {};
  bool is_by_triangles = false; ///< whether `maps` come from triangles, without curvature
  /// The number of maps with evidence that are not in `maps`: too small a part of the surfaces agrees, the ratio of
  /// the sizes differs from that of the scales of the fits, or a large part of a closed mesh is off the other.
  std::size_t maps_left_out = 0;
  std::vector<Registration_advice> advice = {}; ///< what may find a map if there is none; most promising first

  bool found() const { return !maps.empty(); }                          ///< whether there is a map
  const Registered_map_3<Kernel>& best() const { return maps.front(); } ///< \pre found()
};

} // namespace equiaffine

namespace equiaffine::internal {

// Defined in the library. They use TBB threads if `in_threads`.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// The result of register_surfaces(), and whether the best map moves all of each surface onto the other.
struct Registration_of_functions_3 {
  Surface_registration_3<Kernel_of_searches> result;
  bool is_equivalence = false;
};

/// Compares surfaces as they are. If frames of whole surfaces of exact functions give no map, these are compared
/// without frames.
Registration_of_functions_3 registration_of_functions(bool in_threads, const Surface_to_register& source,
                                                      const Surface_to_register& target,
                                                      const Registration_options& options);

/// Compares meshes without curvature, first as wholes, then as pieces.
Surface_registration_3<Kernel_of_searches> registration_of_triangles(bool in_threads, const Triangles_3& source,
                                                                     const Triangles_3& target,
                                                                     const Registration_options& options);

/// The result of register_surfaces(), and the surfaces at the scales that were compared last.
struct Registration_of_surfaces {
  Surface_to_register source, target;
  Surface_registration_3<Kernel_of_searches> result = {};
};

/// Compares frames of curvature first, at several scales if the scale is chosen from the data, and then triangles.
Registration_of_surfaces registration_of_surfaces(bool in_threads, Surface_to_register source,
                                                  Surface_to_register target, const Registration_options& options);

/// The same for surfaces fitted to data.
Surface_registration_3<Kernel_of_searches> registration_of_data(bool in_threads, const Surface_data_3& source,
                                                                const Surface_data_3& target,
                                                                const Registration_options& options);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

// Conversion of results to another kernel.

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

/// Finds the maps that move the surface `source`, or a part of it, onto the surface `target`. Each surface is given
/// by a function and a range of points on its zero set; points near it are moved onto it. The functions are of any
/// models of the concept, defined on their boxes.
///
/// A map is determined by the affine frame at one generic point of the source and that at its counterpart; for maps
/// that preserve angles, by the frames of the principal directions. Counterparts are found by their signatures:
/// first the nearest points of the target in a tree, then exactly, by Newton steps on the target. A map is judged by
/// the distances of points in both directions, refined by least squares, and accepted if the expected number of
/// equally good maps by chance is below 1e-6. Neither a minimum overlap nor the absence of clutter is assumed.
///
/// Points lie on the other surface if they are within the noise of the given points: the tolerance is 8 times their
/// median distance from the zero sets, at least 1e-5 and at most 3e-3 of the size of the target, because large parts
/// of unrelated surfaces can be aligned to within more. Points without a well-defined frame, such as an affine one
/// on quadrics, are not matched; surfaces with continuous symmetries have a slippage, see Surface_registration_3. A
/// fit (Fitted_function_traits_3) estimates its errors, so points with uncertain curvatures are tried later. Whole
/// surfaces of other functions without such frames, such as boxes, are matched like meshes. `fit` of the options is
/// ignored.
///
/// Takes 5 expansions for each of up to 6000 points of a surface, and a number of hypotheses that does not depend on
/// the number of points. The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit.
/// \throw Input_error if an option is invalid. \throw std::invalid_argument if a surface has no points.
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

/// The same for two meshes, models of CGAL's FaceGraph, or ranges of points without faces, or one of each. The map
/// is that of `equiaffine register`, bit for bit.
///
/// First, curvatures of fits to the vertices (Fitted_function_traits_3) are compared as above. Where the data do not
/// resolve the surface, curvatures are those at a scale, and can be compared only at equal scales. Without
/// `fit.scale`, and unless the curvatures of the surfaces themselves give a map, scales of 10, 14, 7 and 20 times
/// the mean distance of the points are tried, up to half of the diagonal: the same length for both, and, if the
/// distances differ by a fifth, each surface's own. A map at a scale is accepted if six separate regions of the size
/// of the scale agree, and if it changes lengths about as the scales differ. Maps between closed meshes are left out
/// if they leave 10 % of one mesh off the other. See `scales` and `maps_left_out` of the result.
///
/// Two meshes without such a map are compared by their triangles, without curvature (`is_by_triangles`), because
/// curvature does not help for boxes and other CAD parts. If the whole surfaces are equal, the map preserves the
/// centroid of the area, and an affine one the moments of the solid inside, so all rotations and reflections about
/// the centroid are searched by branch and bound. Otherwise pieces are matched by similarities. Two points with
/// their normals give a frame, and pairs of points with similar distances and angles are tried. A map is accepted if
/// the points in contact leave it no freedom, if at most 2 % of the points of one surface lie off the other although
/// that does not end there (`contradictions`), and if fewer than 1e-6 equally good maps are expected by chance.
/// `tolerance` is the rms distance between equal surfaces, relative to the size. By default it is what facets
/// explain, 0.3 % to 1 %, and 2e-5 for solids bounded by planes, whose facets are exact. Without a tolerance, two
/// different scans of an object, such as a fine and a coarse one, are matched if one map stands out: its rms is
/// below 1.5 % of the size (less for thin surfaces) and below half of that of every other map, and less than 10 % of
/// the points are off the other surface.
///
/// Takes 1 to 3 ms per vertex for a fit, up to 9 fits of each surface if there is no map, and then 5 to 40 s on one
/// core for triangles of surfaces that are not equal as wholes. Named parameters are in a chain for the source and a
/// second one for the target; parameters::joined() combines chains. `geom_traits` and `verbose` are accepted for
/// compatibility with CGAL, and ignored.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices of a mesh to points |
/// | `point_map` | property map | the elements | from elements of a range to points |
/// | `normal_map` | property map | estimated | from elements of a range to normals |
///
/// \throw Input_error if an option is invalid. \throw std::invalid_argument if a coordinate is not finite, a mesh
/// has no faces, or a range has no points.
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

/// The same for polygon soups: points, and polygons as ranges of point indices. Equal points count once.
/// \throw std::invalid_argument also if an index is out of range.
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
