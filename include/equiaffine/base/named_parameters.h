// SPDX-License-Identifier: GPL-3.0-or-later
// Named parameters in the style of CGAL, for property maps and data:
// `parameters::vertex_point_map(map).comments(lines)`. internal/named_parameter_list.h lists them. They have their own
// types because CGAL's list of names is closed and differs between its versions 5 and 6.
#ifndef EQUIAFFINE_BASE_NAMED_PARAMETERS_H
#define EQUIAFFINE_BASE_NAMED_PARAMETERS_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/named_parameter_list.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/version.h>

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

namespace equiaffine::internal {

/// Converts the value of a named parameter that is a count. \throw std::invalid_argument if it is negative
template <class Count, class Number>
Count count_of(const Number& number) {
  static_assert(std::is_integral_v<Number>, "this named parameter is a count: pass an integer");
  if constexpr (std::is_signed_v<Number>)
    check_argument(number >= 0, "a named parameter that is a count, such as number_of_maps, is negative: pass a number "
                                "that is at least 0");
  return static_cast<Count>(number);
}

/// Tags that identify the parameters.
struct Feature_curves_tag {};
struct Vertex_point_tag {};
struct Point_tag {};
struct Normal_tag {};
struct Edge_is_constrained_tag {};
struct Vertex_outcome_tag {};
struct Vertex_normal_tag {};
struct Geom_traits_tag {};
struct Verbose_tag {};
struct Comments_tag {};
struct Vertex_status_tag {};
struct Vertex_structure_tag {};
struct Vertex_unit_normal_tag {};
struct Vertex_mean_curvature_tag {};
struct Vertex_Gaussian_curvature_tag {};
struct Vertex_principal_curvatures_tag {};
struct Vertex_affine_mean_curvature_tag {};
struct Vertex_affine_Gaussian_curvature_tag {};
struct Vertex_affine_normal_tag {};
struct Vertex_conormal_tag {};
struct Vertex_pick_invariant_tag {};
struct Vertex_affine_metric_tag {};
struct Vertex_affine_area_density_tag {};
/// Tag of the map of estimated errors of the values with tag `Tag`.
template <class Tag>
struct Error_tag {};
using Vertex_affine_mean_curvature_error_tag = Error_tag<Vertex_affine_mean_curvature_tag>;
using Vertex_affine_Gaussian_curvature_error_tag = Error_tag<Vertex_affine_Gaussian_curvature_tag>;
using Vertex_affine_normal_error_tag = Error_tag<Vertex_affine_normal_tag>;
using Vertex_conormal_error_tag = Error_tag<Vertex_conormal_tag>;
using Vertex_pick_invariant_error_tag = Error_tag<Vertex_pick_invariant_tag>;
using Vertex_affine_area_density_error_tag = Error_tag<Vertex_affine_area_density_tag>;
using Vertex_mean_curvature_error_tag = Error_tag<Vertex_mean_curvature_tag>;
using Vertex_Gaussian_curvature_error_tag = Error_tag<Vertex_Gaussian_curvature_tag>;
using Vertex_unit_normal_error_tag = Error_tag<Vertex_unit_normal_tag>;

/// The empty chain of parameters.
struct No_parameters {};

template <class Value, class Tag, class Base>
struct Named_parameters;

template <class Tag, class Value, class Base>
Named_parameters<Value, Tag, Base> add_parameter(const Value& value, const Base& base) {
  return {value, base};
}

/// A parameter and those given before it.
template <class Value, class Tag, class Base>
struct Named_parameters {
  Value value;
  Base base;

  EQUIAFFINE_NAMED_PARAMETERS(const, *this)
};

template <class Tag, class Default>
Default get_parameter(const No_parameters&, const Default& otherwise) {
  return otherwise;
}

/// The parameter with the given tag, or `otherwise`. If there are several, the last one counts.
template <class Tag, class Default, class Value, class OtherTag, class Base>
Default get_parameter(const Named_parameters<Value, OtherTag, Base>& parameters, const Default& otherwise) {
  if constexpr (std::is_same_v<Tag, OtherTag>) return parameters.value;
  else return get_parameter<Tag>(parameters.base, otherwise);
}

/// The value of a parameter of any type. Precondition: it is given.
template <class Tag, class Value, class OtherTag, class Base>
const auto& given_parameter(const Named_parameters<Value, OtherTag, Base>& parameters) {
  if constexpr (std::is_same_v<Tag, OtherTag>) return parameters.value;
  else return given_parameter<Tag>(parameters.base);
}

/// Whether a parameter was given.
template <class Tag, class Parameters>
inline constexpr bool has_parameter = false;
template <class Tag, class Value, class OtherTag, class Base>
inline constexpr bool has_parameter<Tag, Named_parameters<Value, OtherTag, Base>> =
    std::is_same_v<Tag, OtherTag> || has_parameter<Tag, Base>;

/// The compiler's message shows the tag of the unsupported parameter as `Given`.
template <class Given, class... Known>
constexpr void check_parameter() {
  static_assert((std::is_same_v<Given, Known> || ...),
                "this function does not support one of the given named parameters: see its table of parameters");
}

template <class... Known>
constexpr void check_each_parameter(const No_parameters*) {}

template <class... Known, class Value, class Tag, class Base>
constexpr void check_each_parameter(const Named_parameters<Value, Tag, Base>*) {
  check_parameter<Tag, Known...>();
  check_each_parameter<Known...>(static_cast<const Base*>(nullptr));
}

/// Fails to compile if `Parameters` contains a tag that is not among `Known`. Called first by every function with named
/// parameters.
template <class Parameters, class... Known>
constexpr void check_parameters() {
  check_each_parameter<Known...>(static_cast<const Parameters*>(nullptr));
}

/// Our tag for the CGAL parameter with the same meaning.
template <class Cgal_tag>
struct Tag_for {
  static_assert(!std::is_same_v<Cgal_tag, Cgal_tag>,
                "equiaffine does not support one of the given named parameters of CGAL");
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
#if CGAL_VERSION_NR >= 1060000000
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

/// Appends our parameters to the chain, in their order.
template <class Chain, class Value, class Tag, class Base>
auto appended(const Chain& chain, const Named_parameters<Value, Tag, Base>& given) {
  return add_parameter<Tag>(given.value, appended(chain, given.base));
}

/// Appends CGAL's parameters to the chain, in their order.
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

/// Fails to compile unless all arguments are named parameters. Public functions have a catch-all overload that calls
/// this, so that the first compiler error names the mistake instead of listing candidates.
template <class... Arguments>
constexpr void explain_parameters() {
  static_assert((Parameter_chain<Arguments> && ...),
                "an argument is not a named parameter: write equiaffine::parameters::NAME(value) or "
                "CGAL::parameters::NAME(value)");
}

/// Fails to compile: an argument other than the options struct was passed in its place.
template <class Given>
constexpr void explain_options() {
  static_assert(!std::is_same_v<Given, Given>,
                "this function takes a struct of options before its named parameters: write {} for the defaults");
}

/// Joins all named parameters of a call into one chain, with CGAL's parameters under our tags. If a name occurs twice,
/// the last one counts.
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

namespace equiaffine::parameters {

/// No parameters: every one has its default.
inline internal::No_parameters default_values() { return {}; }

/// Joins several chains of named parameters, of equiaffine or of CGAL, into one, for functions that take one chain per
/// surface. If a name occurs twice, the last one counts.
template <internal::Parameter_chain... Chains>
internal::Joined_parameters<Chains...> joined(const Chains&... chains) {
  return internal::joined_parameters(chains...);
}

EQUIAFFINE_NAMED_PARAMETERS(, default_values())

} // namespace equiaffine::parameters

#undef EQUIAFFINE_NAMED_PARAMETERS
#undef EQUIAFFINE_VERTEX_MAP

#endif
