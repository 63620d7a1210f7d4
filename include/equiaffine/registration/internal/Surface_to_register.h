// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces as input of the searches for maps in register_surfaces(), affine_symmetries() and the program.
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SURFACE_TO_REGISTER_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SURFACE_TO_REGISTER_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/internal/searches.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/number_utils.h>
#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <optional>
#include <ranges>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine {

template <class>
class Fitted_function_traits_3;
template <class>
class Sampled_function_traits_3;
template <ImplicitFunctionTraits_3>
class Level_set_traits_3;
template <ImplicitFunctionTraits_3>
class Transformed_function_traits_3;

} // namespace equiaffine

namespace equiaffine::internal {

/// The origin of the derivatives of a surface, which determines their accuracy.
enum class Surface_origin {
  FUNCTION,   ///< exact
  SPLINE,     ///< a spline through samples
  RAW_VOLUME, ///< a spline through unsmoothed samples of a volume
  DISTANCE,   ///< a spline through distances from facets
  FIT         ///< polynomials fitted to the vertices of a mesh, or to points
};

/// The origin for a type of function.
template <class Traits>
inline constexpr Surface_origin origin_of = Surface_origin::FUNCTION;
template <class Kernel>
inline constexpr Surface_origin origin_of<Sampled_function_traits_3<Kernel>> = Surface_origin::SPLINE;
template <class Kernel>
inline constexpr Surface_origin origin_of<Fitted_function_traits_3<Kernel>> = Surface_origin::FIT;
template <ImplicitFunctionTraits_3 Base>
inline constexpr Surface_origin origin_of<Level_set_traits_3<Base>> = origin_of<Base>;
template <ImplicitFunctionTraits_3 Base>
inline constexpr Surface_origin origin_of<Transformed_function_traits_3<Base>> = origin_of<Base>;

using Mesh_of_searches = Indexed_triangle_mesh_3<Kernel_of_searches>;

/// A surface to move onto another one, or onto itself.
struct Surface_to_register {
  Any_function_3 function;                       ///< its zero set is the surface
  std::optional<Any_function_3> unsmoothed = {}; ///< set if the function is a spline through smoothed samples
  Mesh_of_searches mesh = {};                    ///< points on the surface, with triangles if they are known
  Mesh_of_searches extracted = {};               ///< by Marching Cubes, if the surface is a fit to points without faces
  bool is_mesh = false;                          ///< whether the triangles are the surface, rather than the function
  Surface_origin origin = Surface_origin::FUNCTION;
  std::optional<double> given_scale = {}; ///< of a fit, if it was requested
  std::optional<double> scale = {};       ///< of the curvatures of a fit, unless they are those of the surface itself
  double spacing = 0;                     ///< mean distance of the points of a fit, in the unit of its scale
  /// Makes the surface at another scale, for a fit whose scale was chosen from the data. Throws `Input_error` if
  /// that is not possible.
  std::function<Surface_to_register(double scale)> at_scale = {};

  /// The function used to refine and judge maps: smoothing does not commute with affine maps.
  const Any_function_3& refined() const { return unsmoothed ? *unsmoothed : function; }
  const Mesh_of_searches& shown() const { return mesh.triangles.empty() ? extracted : mesh; }
};

/// A mesh, or points without triangles. The points may have unit normals.
struct Surface_data_3 {
  Mesh_of_searches mesh;
  std::vector<Kernel_of_searches::Vector_3> normals = {};
};

/// The diagonal of the bounding box of points.
inline double diagonal_of(const std::vector<Kernel_of_searches::Point_3>& points) {
  CGAL::Bbox_3 box;
  for (const auto& p : points) box += p.bbox();
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

/// A mesh moved by a map, with normals on the same side.
inline Mesh_of_searches moved_mesh(Mesh_of_searches mesh, const Kernel_of_searches::Aff_transformation_3& map) {
  for (auto& p : mesh.points) p = map(p);
  if (determinant_of(map) < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

// Defined in the library. They use TBB threads if `in_threads`.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// The distances of points from the image of a surface under the inverse of `back`, to first order; NaN outside of
/// the image of its domain.
std::vector<double> distances_from_image(bool in_threads, const std::vector<Kernel_of_searches::Point_3>& points,
                                         const Any_function_3& surface,
                                         const Kernel_of_searches::Aff_transformation_3& back = CGAL::IDENTITY);

/// The mean distance of points from their six nearest neighbors.
double mean_spacing(bool in_threads, const std::vector<Kernel_of_searches::Point_3>& points);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

// Conversion of arguments of users to surfaces and data.

template <class Points>
std::vector<Kernel_of_searches::Point_3> points_of_range(const Points& points) {
  std::vector<Kernel_of_searches::Point_3> result;
  for (const auto& p : points)
    result.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  return result;
}

template <class Traits, class Points>
Surface_to_register surface_of_function(const Traits& traits, const Points& points) {
  return {.function = Any_function_3::make(traits), .mesh = {points_of_range(points), {}}, .origin = origin_of<Traits>};
}

/// A mesh or points, as users pass them.
template <class Data>
concept Mesh_or_points = Face_graph<Data> ||(std::ranges::input_range<Data> && !ImplicitFunctionTraits_3<Data>);

inline Surface_data_3 checked_mesh(Mesh_of_searches mesh) {
  check_argument(!mesh.triangles.empty(), "the mesh has no faces: give faces, or only its points");
  return {std::move(mesh)};
}

/// Checks the named parameters of a mesh or of points.
template <class Data, class... Parameters>
constexpr void check_data_parameters() {
  using All = Joined_parameters<Parameters...>;
  if constexpr (Face_graph<Data>) check_parameters<All, Vertex_point_tag, Geom_traits_tag, Verbose_tag>();
  else check_parameters<All, Point_tag, Normal_tag, Geom_traits_tag, Verbose_tag>();
}

template <Face_graph Graph, class Parameters>
Surface_data_3 surface_data(const Graph& graph, const Parameters& parameters) {
  return checked_mesh(triangle_mesh_of<Kernel_of_searches>(graph, parameters));
}

/// Normals are used only if each of them has a direction.
template <class Points, class Parameters>
Surface_data_3 surface_data(const Points& range, const Parameters& parameters) requires(!Face_graph<Points>) {
  const auto point_of = point_of_element(range, parameters);
  std::vector<Eigen::Vector3d> points, normals;
  for (const auto& element : range) {
    points.push_back(coordinates_of(point_of(element)));
    if constexpr (has_parameter<Normal_tag, Parameters>)
      normals.push_back(coordinates_of(get(given_parameter<Normal_tag>(parameters), element)));
  }
  check_points(points);
  check_argument(!points.empty(), "the surface has no points: give points on it");
  Surface_data_3 data;
  for (const auto& p : points) data.mesh.points.emplace_back(p[0], p[1], p[2]);
  for (const auto& n : normals) {
    const double length = std::hypot(n[0], n[1], n[2]);
    if (std::isnormal(length)) data.normals.emplace_back(n[0] / length, n[1] / length, n[2] / length);
  }
  if (data.normals.size() != points.size()) data.normals.clear();
  return data;
}

template <class Points, class Polygons>
Surface_data_3 surface_data_of_soup(const Points& points, const Polygons& polygons) {
  const Triangles_3 triangles = triangles_of(indexed_polygons_of_soup(points, polygons));
  Mesh_of_searches mesh{{}, triangles.triangles};
  for (const auto& p : triangles.points) mesh.points.emplace_back(p[0], p[1], p[2]);
  return checked_mesh(std::move(mesh));
}

template <class Data, class Parameters>
auto kernel_of_data(const Data& data, const Parameters& parameters) {
  if constexpr (Face_graph<Data>)
    return typename CGAL::Kernel_traits<Point_of_vertices<const Data, Parameters>>::Kernel();
  else
    return typename CGAL::Kernel_traits<
        std::decay_t<decltype(point_of_element(data, parameters)(*std::ranges::begin(data)))>>::Kernel();
}

/// The kernel of the points of a mesh or of a range.
template <class Data, class... Parameters>
using Kernel_of_data =
    decltype(kernel_of_data(std::declval<const Data&>(), std::declval<const Joined_parameters<Parameters...>&>()));

} // namespace equiaffine::internal

#endif
