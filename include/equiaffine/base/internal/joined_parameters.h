// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_JOINED_PARAMETERS_H
#define EQUIAFFINE_BASE_INTERNAL_JOINED_PARAMETERS_H

#include <equiaffine/base/internal/Named_parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/version.h>

#include <type_traits>
#include <utility>

namespace equiaffine::internal {

/// The tag of ours that stands for a parameter of CGAL with the same meaning.
template <class Cgal_tag>
struct Tag_for {
  static_assert(!std::is_same_v<Cgal_tag, Cgal_tag>,
                "equiaffine does not know one of the named parameters of CGAL that it is given");
};

#define EQUIAFFINE_TAG_FOR(CGAL_TAG, TAG)                                                                              \
  template <>                                                                                                          \
  struct Tag_for<CGAL::internal_np::CGAL_TAG> {                                                                        \
    using type = TAG;                                                                                                  \
  };
EQUIAFFINE_TAG_FOR(vertex_point_t, Vertex_point_tag)
EQUIAFFINE_TAG_FOR(vertex_normal_map_t, Vertex_normal_tag)
EQUIAFFINE_TAG_FOR(point_t, Point_tag)
EQUIAFFINE_TAG_FOR(normal_t, Normal_tag)
EQUIAFFINE_TAG_FOR(geom_traits_t, Geom_traits_tag)
EQUIAFFINE_TAG_FOR(verbose_t, Verbose_tag)
EQUIAFFINE_TAG_FOR(edge_is_constrained_t, Edge_is_constrained_tag)
EQUIAFFINE_TAG_FOR(number_of_iterations_t, Number_of_iterations_tag)
#if CGAL_VERSION_NR >= 1060000000
EQUIAFFINE_TAG_FOR(ball_radius_t, Ball_radius_tag)
EQUIAFFINE_TAG_FOR(vertex_mean_curvature_map_t, Vertex_mean_curvature_tag)
EQUIAFFINE_TAG_FOR(vertex_Gaussian_curvature_map_t, Vertex_Gaussian_curvature_tag)
EQUIAFFINE_TAG_FOR(vertex_principal_curvatures_and_directions_map_t, Vertex_principal_curvatures_tag)
#endif
#undef EQUIAFFINE_TAG_FOR

template <class Chain>
Chain appended(const Chain& chain, const No_parameters&) {
  return chain;
}

template <class Value, class Tag, class Base>
Named_parameters<Value, Tag, Base> appended(const No_parameters&, const Named_parameters<Value, Tag, Base>& given) {
  return given;
}

/// The chain followed by parameters of ours, in their order.
template <class Chain, class Value, class Tag, class Base>
auto appended(const Chain& chain, const Named_parameters<Value, Tag, Base>& given) {
  return add_parameter<Tag>(given.value, appended(chain, given.base));
}

/// The chain followed by parameters of CGAL, in their order.
template <class Chain>
Chain appended(const Chain& chain, const CGAL::internal_np::No_property&) {
  return chain;
}
template <class Chain, class Value, class Tag, class Base>
auto appended(const Chain& chain, const CGAL::Named_function_parameters<Value, Tag, Base>& given) {
  if constexpr (std::is_same_v<Tag, CGAL::internal_np::all_default_t>) return chain;
  else if constexpr (std::is_same_v<Base, CGAL::internal_np::No_property>)
    return add_parameter<typename Tag_for<Tag>::type>(given.v, chain);
  else return add_parameter<typename Tag_for<Tag>::type>(given.v, appended(chain, static_cast<const Base&>(given)));
}

template <class T>
inline constexpr bool is_parameter_chain = false;
template <>
inline constexpr bool is_parameter_chain<No_parameters> = true;
template <class Value, class Tag, class Base>
inline constexpr bool is_parameter_chain<Named_parameters<Value, Tag, Base>> = true;
template <class Value, class Tag, class Base>
inline constexpr bool is_parameter_chain<CGAL::Named_function_parameters<Value, Tag, Base>> = true;

/// Named parameters, of equiaffine or of CGAL.
template <class T>
concept Parameter_chain = is_parameter_chain<T>;

/// All named parameters of a call in one chain, those of CGAL under the tags of ours. Of two with the same name the last
/// one counts.
template <Parameter_chain Chain = No_parameters>
auto joined_parameters(const Chain& chain = {}) {
  return appended(No_parameters(), chain);
}
template <Parameter_chain First, Parameter_chain Second, Parameter_chain... Others>
auto joined_parameters(const First& first, const Second& second, const Others&... others) {
  return joined_parameters(appended(appended(No_parameters(), first), second), others...);
}

/// The type of that chain.
template <class... Given>
using Joined_parameters = decltype(joined_parameters(std::declval<const Given&>()...));

} // namespace equiaffine::internal

#endif
