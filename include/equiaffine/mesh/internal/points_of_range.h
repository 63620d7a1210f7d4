// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_POINTS_OF_RANGE_H
#define EQUIAFFINE_MESH_INTERNAL_POINTS_OF_RANGE_H

#include <equiaffine/base/named_parameters.h>

#include <type_traits>
#include <utility>

namespace equiaffine {

/// Does not compile for points whose coordinates are no floating-point numbers, else returns true, so that a static
/// assertion can call it before anything else fails.
template <class Point>
constexpr bool check_coordinates() {
  static_assert(
      std::is_floating_point_v<std::decay_t<decltype(std::declval<const Point&>().x())>>,
      "the points have coordinates that are not doubles, as those of Epeck: equiaffine works with kernels such "
      "as Epick and Simple_cartesian<double>; CGAL::copy_face_graph copies a mesh to one of them");
  return true;
}

/// Something from the elements of a range to their points: the map that is given, or that of the range, as
/// CGAL::Point_set_3 has one, or nothing where the elements are the points.
template <class Range, class Parameters>
auto point_of_element([[maybe_unused]] const Range& range, const Parameters& parameters) {
  if constexpr (internal::has_parameter<internal::Point_tag, Parameters>)
    return [map = internal::given_parameter<internal::Point_tag>(parameters)](const auto& element) {
      return get(map, element);
    };
  else if constexpr (requires { range.point_map(); })
    return [map = range.point_map()](const auto& element) { return get(map, element); };
  else return [](const auto& element) { return element; };
}

} // namespace equiaffine

#endif
