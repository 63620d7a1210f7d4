// SPDX-License-Identifier: GPL-3.0-or-later
// Finds all maps that move a surface onto itself.
#ifndef EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_H
#define EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/Registration_options.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/internal/searches.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

/// A map that moves a surface onto itself.
template <class Kernel>
struct Affine_symmetry_3 {
  typename Kernel::Aff_transformation_3 map; ///< the map
  double rms;                                ///< the root of the mean squared distance of moved points from the surface
  double greatest;                           ///< the largest of these distances
};

/// A finite group of maps, each of which moves a surface onto itself to within an rms distance. All products are in the
/// group, and each map was verified, the other way round, too.
template <class Kernel>
struct Symmetry_level_3 {
  std::vector<Affine_symmetry_3<Kernel>> maps; ///< the identity first
  double rms;                                  ///< the largest of the maps, a part of the size of the surface
  double greatest;                             ///< the largest distance of any moved point, a part of the size

  std::size_t order() const { return maps.size(); } ///< the number of its maps
};

/// A verdict says what is known of the symmetries of a surface.
enum class Symmetry_verdict {
  /// The first level, or else the continuous group, holds to rounding at every point that was tried.
  EXACT,
  /// The first level, or else the continuous group, holds to within its rms: 1 % of the size at most, for affine maps
  /// in coordinates in which the solid is round.
  APPROXIMATE,
  /// No map but the identity holds to within 1 % of the size, as above, or to the tolerance for a function.
  NONE,
  /// None of these was verified, for the reason given.
  UNDECIDED
};

/// The result of `affine_symmetries`.
template <class Kernel>
struct Affine_symmetries_3 {
  Symmetry_verdict verdict = Symmetry_verdict::UNDECIDED; ///< what is known
  std::string reason = {};                                ///< why nothing more is known, if the verdict is UNDECIDED
  /// Groups, each larger than the one before and with a larger rms: a cube without a corner has 6 symmetries, and 48
  /// to within 3 % of its size.
  std::vector<Symmetry_level_3<Kernel>> levels = {};
  /// The symmetries to within the tolerance: those of the last level whose rms is not above it, and without a tolerance
  /// those of the first level. The identity alone, if there are no others, infinitely many, or they are not known.
  std::vector<Affine_symmetry_3<Kernel>> maps = {};
  Affine_slippage_3 continuous = {}; ///< the Lie algebra of the continuous group
  bool is_decided = false;           ///< whether `maps` are all symmetries to within the tolerance
  Map_kind kind = Map_kind::AFFINE;  ///< of the maps: RIGID for affine maps of a mesh that bounds no solid
  /// All rotations and reflections about the centroid were tried that move the surface onto itself to within this rms
  /// distance, a part of its size. None if they were not searched, for example because exact frames decide.
  std::optional<double> complete_to = {};
  /// The distance between the points by which maps of a function were verified, a part of the size: a narrower detail
  /// may lie between them. None for meshes, each of whose facets has a point.
  std::optional<double> spacing = {};
  /// If the surface goes on beyond the box of its function: the number of `maps` that move its piece in the box onto
  /// itself. Others, if any, were verified where the images of points are in the box.
  std::optional<std::size_t> order_in_box = {};
  /// What may find more if nothing is decided, or only the identity was found, the most promising first.
  std::vector<Registration_advice> advice = {};

  /// Whether it is not known how many symmetries there are.
  bool is_undecided() const { return !is_decided && continuous.dimension() == 0; }

  /// The number of symmetries, the identity and reflections counted. None if there are infinitely many, or if it is not
  /// known. A mesh that turns to within the error of its facets, and has a finite group to rounding, has the order of
  /// that group.
  std::optional<std::size_t> order() const {
    if (!is_decided || (continuous.dimension() > 0 && levels.empty())) return std::nullopt;
    return maps.size();
  }
};

} // namespace equiaffine

namespace equiaffine::internal {

// The library defines these functions. They run in the threads of TBB if `in_threads`.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// The symmetries of the zero set of a function, by affine frames at the points, and by rotations of the whole.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_function(bool in_threads, const Surface_to_register& surface,
                                                               const Symmetry_options& options);

/// The symmetries of a mesh, by rotations of the whole; the rigid ones if affine ones cannot be found.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_triangles(bool in_threads, const Triangles_3& mesh,
                                                                const Symmetry_options& options);

/// The result of affine_symmetries(), and the level set that was made, if it was.
struct Symmetries_of_surface {
  Affine_symmetries_3<Kernel_of_searches> result = {};
  std::optional<Surface_to_register> level_set = {};
};

/// The symmetries of a mesh. Where they are undecided, or the mesh has no triangles, those of the level set that
/// `make_level_set` returns: by its triangles if it is a fit to points without faces.
Symmetries_of_surface symmetries_of_surface(bool in_threads, const Mesh_of_searches& mesh, Surface_origin origin,
                                            const std::function<Surface_to_register()>& make_level_set,
                                            const Symmetry_options& options);

/// The same for data, to which the level set is fitted.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_data(bool in_threads, const Surface_data_3& data,
                                                           const Symmetry_options& options);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

// Results of searches become those of another kernel.

template <class Kernel>
std::vector<Affine_symmetry_3<Kernel>> in_kernel(const std::vector<Affine_symmetry_3<Kernel_of_searches>>& maps) {
  std::vector<Affine_symmetry_3<Kernel>> result;
  for (const auto& m : maps) result.push_back({in_kernel<Kernel>(m.map), m.rms, m.greatest});
  return result;
}

template <class Kernel>
Affine_symmetries_3<Kernel> in_kernel(Affine_symmetries_3<Kernel_of_searches> found) {
  Affine_symmetries_3<Kernel> result{found.verdict, std::move(found.reason)};
  for (const auto& level : found.levels)
    result.levels.push_back({in_kernel<Kernel>(level.maps), level.rms, level.greatest});
  result.maps = in_kernel<Kernel>(found.maps);
  result.continuous = std::move(found.continuous);
  result.is_decided = found.is_decided;
  result.kind = found.kind;
  result.complete_to = found.complete_to;
  result.spacing = found.spacing;
  result.order_in_box = found.order_in_box;
  result.advice = std::move(found.advice);
  return result;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Finds all maps of a kind that move a surface, given by a function and points on its zero set, onto itself as a set
/// of points, whichever way its normals point.
///
/// On a smooth surface they come from affine frames of a few points and of all their possible images, by exact
/// derivatives; products complete the group. Where there are too few such frames, as on planes, cylinders and spheres,
/// with `complete`, or with a `tolerance` above 1e-6, all rotations and reflections about the centroid of the area,
/// which every symmetry of a whole surface keeps, are searched by branch and bound, for affine maps in coordinates in
/// which the solid inside is round, with points by random lines (Crofton). Maps are refined by least squares.
///
/// What is stated is a group, and EXACT means that the images of some 30,000 points by each of its maps are on the
/// surface to rounding; `spacing` says how far these points are apart. A surface that leaves the box of the function
/// has the symmetries that keep its piece in the box, and others if they are a group, which were verified where images
/// are in the box; see `order_in_box`.
///
/// The order counts the maps that are exact, and those to within `tolerance`, a part of the size, if it is given or
/// none is exact. A larger tolerance never finds fewer. Where the surface has continuous symmetries of the kind, the
/// result has their generators, and no others are sought: an ellipsoid has infinitely many affine symmetries, but 8
/// rigid ones if its axes differ. `fit` of the options does not matter.
///
/// Takes some 0.5 s for a smooth formula, else 1 to 10 s on one core. The result is the same for CGAL::Sequential_tag
/// and CGAL::Parallel_tag.
/// \throw Input_error if an option makes no sense. \throw std::invalid_argument if there are no points.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, std::ranges::input_range Points>
Affine_symmetries_3<Kernel_of<Traits>> affine_symmetries(const Traits& traits, const Points& points,
                                                         const Symmetry_options& options = {}) {
  options.check();
  const auto surface = [&] { return internal::surface_of_function(traits, points); };
  return internal::in_kernel<Kernel_of<Traits>>(internal::symmetries_of_surface(runs_in_threads<ConcurrencyTag>(), {},
                                                                                internal::origin_of<Traits>, surface,
                                                                                options)
                                                    .result);
}

/// The same for a mesh, a model of CGAL's FaceGraph, or for a range of points without faces: the symmetries are those
/// of `equiaffine symmetries`, bit for bit.
///
/// A mesh is its triangles; other faces are cut into triangles. Two corners, at which the angles of the faces do not
/// add up to that of a plane, determine a map together with their images, so that up to 1000 exact symmetries are
/// found; others come from all rotations. Each map is verified at each vertex and facet, or at millions of points of a
/// very large mesh. EXACT means to the rounding of the coordinates, as they were written; a mesh that also turns about
/// an axis to within the distance between its facets and a smooth surface has `continuous` with an `rms`. Without a
/// `tolerance` the order is that of the first level within 1 % of the size, less for thin surfaces. Small holes are
/// closed for the moments by which affine maps are found; if a mesh bounds no solid, its rigid symmetries are the
/// result, see `kind`. If these are undecided and affine ones are sought, affine frames of a fit to the vertices
/// (Fitted_function_traits_3) are tried, to within 1e-3 without a `tolerance`. Points without faces become a mesh by
/// Marching Cubes on a fit to them.
///
/// Takes 1 to 10 s on one core for the triangles of a mesh, and 1 to 3 ms per point more for a fit.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices of a mesh to points |
/// | `point_map` | property map | the elements | from elements of a range to points |
/// | `normal_map` | property map | estimated | from elements of a range to normals |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// \throw Input_error if an option makes no sense. \throw std::invalid_argument if a coordinate is not finite, a mesh
/// has no faces or no area, or a range no points.
template <class ConcurrencyTag = CGAL::Sequential_tag, internal::Mesh_or_points Data,
          internal::Parameter_chain... Parameters>
auto affine_symmetries(const Data& data, const Symmetry_options& options = {}, const Parameters&... given) {
  internal::check_data_parameters<Data, Parameters...>();
  options.check();
  return internal::in_kernel<internal::Kernel_of_data<Data, Parameters...>>(internal::symmetries_of_data(
      runs_in_threads<ConcurrencyTag>(), internal::surface_data(data, internal::joined_parameters(given...)), options));
}

/// The same for points with polygons between them, each a range of positions of points. Equal points count once.
/// \throw std::invalid_argument also if a polygon has the position of no point.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          std::ranges::input_range Polygons>
auto affine_symmetries(const Points& points, const Polygons& polygons,
                       const Symmetry_options& options = {}) requires(!ImplicitFunctionTraits_3<Points> &&
                                                                      !Face_graph<Points>) {
  using Kernel_of_points = typename CGAL::Kernel_traits<std::ranges::range_value_t<Points>>::Kernel;
  options.check();
  return internal::in_kernel<Kernel_of_points>(internal::symmetries_of_data(
      runs_in_threads<ConcurrencyTag>(), internal::surface_data_of_soup(points, polygons), options));
}

} // namespace equiaffine

#endif
