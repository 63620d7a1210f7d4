// SPDX-License-Identifier: GPL-3.0-or-later
// What all searches of maps share: their named parameters, the surfaces that they are given, and how their results become
// those of another kernel. The functions of the library that search name no type of Eigen among their parameters, since
// its namespace has another name in the library.
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SEARCHES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SEARCHES_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/Map_kind.h>

#include <CGAL/Aff_transformation_3.h>
#include <Eigen/Core>

#include <optional>
#include <vector>

namespace equiaffine::internal {

using Kernel_of_searches = Any_function_3::Kernel;

/// The zero set of a function, and points near it.
struct Surface_with_points_3 {
  Any_function_3 function;
  std::vector<Eigen::Vector3d> points;
};

/// The coordinates of a range of CGAL's points, as doubles.
template <class Points>
std::vector<Eigen::Vector3d> vectors_of(const Points& points) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& p : points) result.push_back(coordinates_of(p));
  return result;
}

/// The greatest condition of the linear part of a map between surfaces. With it, the rounding of coordinates to 1e-16 makes
/// errors of 1e-12, as large as those that maps between formulas have anyway.
inline constexpr double greatest_condition = 1e4;

/// The named parameters of every search for maps.
struct Map_request {
  Map_kind kind = Map_kind::AFFINE;
  bool allows_reflections = true;
  std::optional<double> tolerance = {}; ///< a part of a size; if there is none, the data tell
};

template <class Parameters, class... OtherTags>
constexpr void check_map_parameters() {
  check_parameters<Parameters, Map_kind_tag, Reflections_tag, Tolerance_tag, Geom_traits_tag, Verbose_tag,
                   OtherTags...>();
}

template <class Parameters>
Map_request map_request(const Parameters& parameters) {
  Map_request request;
  request.kind = get_parameter<Map_kind_tag>(parameters, request.kind);
  request.allows_reflections = get_parameter<Reflections_tag>(parameters, request.allows_reflections);
  if constexpr (has_parameter<Tolerance_tag, Parameters>)
    request.tolerance = given_parameter<Tolerance_tag>(parameters);
  check_argument(!request.tolerance || (*request.tolerance > 0 && *request.tolerance < 0.1),
                 "the tolerance of maps is a part of a size, from 0 to 0.1");
  return request;
}

/// The result of a search in another kernel.
template <class Kernel>
typename Kernel::Aff_transformation_3 in_kernel(const Kernel_of_searches::Aff_transformation_3& map) {
  const auto m = [&](int i, int j) { return typename Kernel::FT(map.m(i, j)); };
  return {m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3), m(2, 0), m(2, 1), m(2, 2), m(2, 3)};
}

} // namespace equiaffine::internal

#endif
