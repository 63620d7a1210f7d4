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
  double rms;                                ///< root mean square distance of moved points from the surface
  double greatest;                           ///< the largest of these distances
};

/// A finite group of maps, each of which moves a surface onto itself to within an rms distance. The group is closed
/// under products, and each map was verified in both directions.
template <class Kernel>
struct Symmetry_level_3 {
  std::vector<Affine_symmetry_3<Kernel>> maps; ///< the identity first
  double rms;                                  ///< the largest rms of its maps, relative to the size of the surface
  double greatest;                             ///< the largest distance of a moved point, relative to the size

  std::size_t order() const { return maps.size(); } ///< the number of its maps
};

/// What is known about the symmetries of a surface.
enum class Symmetry_verdict {
  /// The first level, or else the continuous group, holds to rounding at every tested point.
  EXACT,
  /// The first level, or else the continuous group, holds to within its rms, at most 1 % of the size; for affine
  /// maps in coordinates in which the solid is round.
  APPROXIMATE,
  /// No map except the identity holds to within 1 % of the size, as above, or to the tolerance for a function.
  NONE,
  /// None of the above was verified, for the given reason.
  UNDECIDED
};

/// The result of `affine_symmetries`.
template <class Kernel>
struct Affine_symmetries_3 {
  Symmetry_verdict verdict = Symmetry_verdict::UNDECIDED; ///< what is known
  std::string reason = {};                                ///< why the verdict is UNDECIDED, if it is
  /// Groups of increasing size and rms: a cube without a corner has 6 symmetries, and 48 to within 3 % of its size.
  std::vector<Symmetry_level_3<Kernel>> levels = {};
  /// The symmetries to within the tolerance: those of the last level whose rms is not above it, and without a
  /// tolerance those of the first level. Only the identity if there are no others, infinitely many, or if they are
  /// unknown.
  std::vector<Affine_symmetry_3<Kernel>> maps = {};
  Affine_slippage_3 continuous = {}; ///< Lie algebra of the continuous group
  bool is_decided = false;           ///< whether `maps` are all symmetries to within the tolerance
  Map_kind kind = Map_kind::AFFINE;  ///< kind of the maps: RIGID for affine maps of a mesh that does not bound a solid
  /// All rotations and reflections about the centroid were tried that move the surface onto itself to within this
  /// rms distance, relative to its size. Empty if no such search was made, for example because exact frames already
  /// decide.
  std::optional<double> complete_to = {};
  /// The distance between the points used to verify maps of a function, relative to the size; finer detail may lie
  /// between them. Empty for meshes, where each facet has a point.
  std::optional<double> spacing = {};
  /// If the surface continues beyond the box of its function: the number of `maps` that move its piece in the box
  /// onto itself. Others, if any, were verified where the images of points are in the box.
  std::optional<std::size_t> order_in_box = {};
  /// What may find more if nothing is decided, or only the identity was found; most promising first.
  std::vector<Registration_advice> advice = {};

  /// Whether the number of symmetries is unknown.
  bool is_undecided() const { return !is_decided && continuous.dimension() == 0; }

  /// The number of symmetries, including the identity and reflections. Empty if it is infinite or unknown. For a
  /// mesh that turns to within the error of its facets and has a finite group to rounding, it is the order of that
  /// group.
  std::optional<std::size_t> order() const {
    if (!is_decided || (continuous.dimension() > 0 && levels.empty())) return std::nullopt;
    return maps.size();
  }
};

} // namespace equiaffine

namespace equiaffine::internal {

// Defined in the library. They use TBB threads if `in_threads`.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// The symmetries of the zero set of a function, by affine frames at points, and by rotations of the whole surface.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_function(bool in_threads, const Surface_to_register& surface,
                                                               const Symmetry_options& options);

/// The symmetries of a mesh, by rotations of the whole surface; the rigid ones if affine ones cannot be found.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_triangles(bool in_threads, const Triangles_3& mesh,
                                                                const Symmetry_options& options);

/// The result of affine_symmetries(), and the level set if it was made.
struct Symmetries_of_surface {
  Affine_symmetries_3<Kernel_of_searches> result = {};
  std::optional<Surface_to_register> level_set = {};
};

/// The symmetries of a mesh. If they are undecided, or the mesh has no triangles, those of the level set returned by
/// `make_level_set`: by its triangles if it is a fit to points without faces.
Symmetries_of_surface symmetries_of_surface(bool in_threads, const Mesh_of_searches& mesh, Surface_origin origin,
                                            const std::function<Surface_to_register()>& make_level_set,
                                            const Symmetry_options& options);

/// The same for data; the level set is fitted to them.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_data(bool in_threads, const Surface_data_3& data,
                                                           const Symmetry_options& options);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

// Conversion of results to another kernel.

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

/// Finds all maps of a kind that move a surface onto itself as a set of points, regardless of the side of its
/// normals. The surface is given by a function and points on its zero set.
///
/// On a smooth surface the maps come from affine frames, computed from exact derivatives, of a few points and of all
/// their possible images; products complete the group. All rotations and reflections about the centroid of the area,
/// which every symmetry of a whole surface preserves, are searched by branch and bound in these cases: there are too
/// few such frames, as on planes, cylinders and spheres; with `complete`; or with a `tolerance` above 1e-6. For
/// affine maps this search uses coordinates in which the solid inside is round, and sample points from random lines
/// (Crofton). Maps are refined by least squares.
///
/// The result is a group. EXACT means that each of its maps moves about 30,000 points onto the surface to within
/// rounding; `spacing` is the distance between these points. If a surface leaves the box of the function, the result
/// contains the symmetries that preserve its piece in the box, and others if they form a group; those were verified
/// where images are in the box, see `order_in_box`.
///
/// The order counts the exact maps, and those to within `tolerance`, relative to the size, if it is given or there
/// is no exact map. A larger tolerance never finds fewer. If the surface has continuous symmetries of the kind, the
/// result contains their generators, and no others are searched: an ellipsoid has infinitely many affine symmetries,
/// but 8 rigid ones if its axes differ. `fit` of the options is ignored.
///
/// Takes about 0.5 s for a smooth formula, otherwise 1 to 10 s on one core. The result is the same for
/// CGAL::Sequential_tag and CGAL::Parallel_tag.
/// \throw Input_error if an option is invalid. \throw std::invalid_argument if there are no points.
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

/// The same for a mesh, a model of CGAL's FaceGraph, or for a range of points without faces. The symmetries are
/// those of `equiaffine symmetries`, bit for bit.
///
/// A mesh is represented by its triangles; other faces are triangulated. Two corners, where the angles of the faces
/// do not add up to that of a plane, determine a map together with their images. In this way up to 1000 exact
/// symmetries are found; others come from a search of all rotations. Each map is verified at each vertex and facet,
/// or at millions of points of a very large mesh. EXACT means to the rounding of the coordinates as they were
/// written. A mesh that also turns about an axis, to within the distance between its facets and a smooth surface,
/// has `continuous` with an `rms`. Without a `tolerance` the order is that of the first level within 1 % of the
/// size, less for thin surfaces. Affine maps are found from moments of the solid, for which small holes are closed.
/// If a mesh does not bound a solid, the result contains its rigid symmetries, see `kind`. If these are undecided
/// and affine ones are requested, affine frames of a fit to the vertices (Fitted_function_traits_3) are tried, to
/// within 1e-3 without a `tolerance`. Points without faces are meshed by Marching Cubes on a fit to them.
///
/// Takes 1 to 10 s on one core for the triangles of a mesh, and 1 to 3 ms per point more for a fit. `geom_traits`
/// and `verbose` are accepted for compatibility with CGAL, and ignored.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices of a mesh to points |
/// | `point_map` | property map | the elements | from elements of a range to points |
/// | `normal_map` | property map | estimated | from elements of a range to normals |
///
/// \throw Input_error if an option is invalid. \throw std::invalid_argument if a coordinate is not finite, a mesh
/// has no faces or no area, or a range has no points.
template <class ConcurrencyTag = CGAL::Sequential_tag, internal::Mesh_or_points Data,
          internal::Parameter_chain... Parameters>
auto affine_symmetries(const Data& data, const Symmetry_options& options = {}, const Parameters&... given) {
  internal::check_data_parameters<Data, Parameters...>();
  options.check();
  return internal::in_kernel<internal::Kernel_of_data<Data, Parameters...>>(internal::symmetries_of_data(
      runs_in_threads<ConcurrencyTag>(), internal::surface_data(data, internal::joined_parameters(given...)), options));
}

/// The same for a polygon soup: points, and polygons as ranges of point indices. Equal points count once.
/// \throw std::invalid_argument also if an index is out of range.
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
