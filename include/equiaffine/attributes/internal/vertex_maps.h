// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_VERTEX_MAPS_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_VERTEX_MAPS_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/affine_structure.h>

#include <CGAL/property_map.h>

#include <array>
#include <cstddef>
#include <type_traits>

// The values that annotate() and annotate_by_fit() put into the property maps that they are given.
namespace equiaffine::internal {

template <class FT>
const Local_structure_3<FT>& structure_in(const Local_structure_3<FT>& s) {
  return s;
}
template <class FT>
const Local_structure_3<FT>& structure_in(const Fitted_structure_3<FT>& s) {
  return s.structure;
}

/// The principal curvatures with the sign of CGAL.
template <class FT>
struct Principal_curvatures {
  FT least, greatest;
  std::array<FT, 3> direction_of_least, direction_of_greatest;
};

// The value for the map with a tag, from a Local_structure_3 or a Fitted_structure_3.
template <class S>
auto value_for(Vertex_status_tag, const S& s) {
  return structure_in(s).status;
}
template <class S>
const S& value_for(Vertex_structure_tag, const S& s) {
  return s;
}
template <class S>
auto value_for(Vertex_unit_normal_tag, const S& s) {
  return structure_in(s).euclidean.normal;
}
template <class S>
auto value_for(Vertex_mean_curvature_tag, const S& s) {
  return -structure_in(s).euclidean.mean_curvature;
}
template <class S>
auto value_for(Vertex_Gaussian_curvature_tag, const S& s) {
  return structure_in(s).euclidean.gaussian_curvature;
}
template <class S>
auto value_for(Vertex_principal_curvatures_tag, const S& s) {
  const auto& e = structure_in(s).euclidean;
  return Principal_curvatures{-e.k1, -e.k2, e.direction1, e.direction2};
}
template <class S>
auto value_for(Vertex_affine_mean_curvature_tag, const S& s) {
  return structure_in(s).affine.mean_curvature;
}
template <class S>
auto value_for(Vertex_affine_Gaussian_curvature_tag, const S& s) {
  return structure_in(s).affine.gaussian_curvature;
}
template <class S>
auto value_for(Vertex_affine_normal_tag, const S& s) {
  return structure_in(s).affine.normal;
}
template <class S>
auto value_for(Vertex_conormal_tag, const S& s) {
  return structure_in(s).affine.conormal;
}
template <class S>
auto value_for(Vertex_pick_invariant_tag, const S& s) {
  return structure_in(s).affine.pick_invariant;
}
template <class S>
auto value_for(Vertex_affine_metric_tag, const S& s) {
  return structure_in(s).affine.metric;
}
template <class S>
auto value_for(Vertex_affine_area_density_tag, const S& s) {
  return affine_area_density(structure_in(s).euclidean.gaussian_curvature);
}
inline double value_for(Vertex_affine_mean_curvature_error_tag, const Fitted_structure_3<double>& s) {
  return s.error.affine_mean_curvature;
}
inline double value_for(Vertex_affine_Gaussian_curvature_error_tag, const Fitted_structure_3<double>& s) {
  return s.error.affine_gaussian_curvature;
}
inline double value_for(Vertex_affine_normal_error_tag, const Fitted_structure_3<double>& s) {
  return s.error.affine_normal;
}
inline double value_for(Vertex_conormal_error_tag, const Fitted_structure_3<double>& s) { return s.error.normal; }
inline double value_for(Vertex_pick_invariant_error_tag, const Fitted_structure_3<double>& s) {
  return s.error.pick_invariant;
}
inline double value_for(Vertex_affine_area_density_error_tag, const Fitted_structure_3<double>& s) {
  return s.error.affine_area_density;
}
inline double value_for(Vertex_mean_curvature_error_tag, const Fitted_structure_3<double>& s) {
  return s.error.euclidean_mean_curvature;
}
inline double value_for(Vertex_Gaussian_curvature_error_tag, const Fitted_structure_3<double>& s) {
  return s.error.euclidean_gaussian_curvature;
}
inline double value_for(Vertex_unit_normal_error_tag, const Fitted_structure_3<double>& s) { return s.error.normal; }

template <class Map>
concept Property_map = requires {
  typename boost::property_traits<Map>::key_type;
};

template <class... Tags>
struct Tag_list {};

/// The maps that annotate() fills, and those that fits have beside them.
using Structure_tags =
    Tag_list<Vertex_status_tag, Vertex_structure_tag, Vertex_unit_normal_tag, Vertex_mean_curvature_tag,
             Vertex_Gaussian_curvature_tag, Vertex_principal_curvatures_tag, Vertex_affine_mean_curvature_tag,
             Vertex_affine_Gaussian_curvature_tag, Vertex_affine_normal_tag, Vertex_conormal_tag,
             Vertex_pick_invariant_tag, Vertex_affine_metric_tag, Vertex_affine_area_density_tag>;
using Error_tags = Tag_list<Vertex_affine_mean_curvature_error_tag, Vertex_affine_Gaussian_curvature_error_tag,
                            Vertex_affine_normal_error_tag, Vertex_conormal_error_tag, Vertex_pick_invariant_error_tag,
                            Vertex_affine_area_density_error_tag, Vertex_mean_curvature_error_tag,
                            Vertex_Gaussian_curvature_error_tag, Vertex_unit_normal_error_tag>;

/// Refuses named parameters that are neither in the list nor among the other tags.
template <class Parameters, class... OtherTags, class... Tags>
constexpr void check_parameters_of_maps(Tag_list<Tags...>) {
  check_parameters<Parameters, OtherTags..., Tags...>();
}
template <class Parameters, class... OtherTags>
constexpr void check_annotate_parameters() {
  check_parameters_of_maps<Parameters, Geom_traits_tag, Verbose_tag, OtherTags...>(Structure_tags());
}

template <class Parameters, class... Tags>
constexpr bool has_maps(Tag_list<Tags...>) {
  return (has_parameter<Tags, Parameters> || ...);
}

/// A vector of CGAL, or an array.
template <class Vector, class FT>
Vector vector_of(const std::array<FT, 3>& v) {
  static_assert(!std::is_arithmetic_v<Vector>,
                "this property map has numbers, and the value is a vector: give a map of "
                "CGAL's Vector_3, or of std::array");
  if constexpr (requires { typename Vector::value_type; }) {
    using Number = typename Vector::value_type;
    return Vector{Number(v[0]), Number(v[1]), Number(v[2])};
  } else return Vector(v[0], v[1], v[2]);
}

template <class Map>
constexpr void check_map() {
  static_assert(Property_map<Map>, "this is no property map: boost::make_assoc_property_map() makes one of a std::map, "
                                   "and a CGAL::Surface_mesh gives its own");
}

// The key may be an element that has the value in it.
template <class Map, class Key, class Value>
void put_value(const Map& map, Key& key, const Value& value) {
  using Kept = typename boost::property_traits<Map>::value_type;
  static_assert(std::is_constructible_v<Kept, const Value&>,
                "this property map has values of another kind, such as vectors in the place of numbers");
  put(map, key, Kept(value));
}
template <class Map, class Key, class FT>
void put_value(const Map& map, Key& key, const std::array<FT, 3>& value) {
  put(map, key, vector_of<typename boost::property_traits<Map>::value_type>(value));
}
template <class Map, class Key, class FT>
void put_value(const Map& map, Key& key, const std::array<FT, 6>& value) {
  typename boost::property_traits<Map>::value_type form{};
  for (std::size_t i = 0; i < 6; ++i) form[i] = static_cast<std::decay_t<decltype(form[i])>>(value[i]);
  put(map, key, form);
}
template <class Map, class Key, class FT>
void put_value(const Map& map, Key& key, const Principal_curvatures<FT>& value) {
  typename boost::property_traits<Map>::value_type result;
  result.min_curvature = value.least;
  result.max_curvature = value.greatest;
  result.min_direction = vector_of<std::decay_t<decltype(result.min_direction)>>(value.direction_of_least);
  result.max_direction = vector_of<std::decay_t<decltype(result.max_direction)>>(value.direction_of_greatest);
  put(map, key, result);
}

/// Puts what is known of a vertex into those of the maps in the list that are given.
template <class Parameters, class Key, class S, class... Tags>
void put_structure(const Parameters& parameters, Key& key, const S& s, Tag_list<Tags...>) {
  const auto put_one = [&]<class Tag>(Tag tag) {
    if constexpr (has_parameter<Tag, Parameters>) {
      const auto& map = given_parameter<Tag>(parameters);
      check_map<std::decay_t<decltype(map)>>();
      put_value(map, key, value_for(tag, s));
    }
  };
  (put_one(Tags()), ...);
}

/// The status that a sampler gave, if the map of statuses can be read.
template <class Parameters, class Key>
Point_status status_before([[maybe_unused]] const Parameters& parameters, [[maybe_unused]] const Key& key) {
  if constexpr (has_parameter<Vertex_status_tag, Parameters>) {
    const auto& map = given_parameter<Vertex_status_tag>(parameters);
    if constexpr (requires { Point_status(get(map, key)); }) return get(map, key);
    else return Point_status::REGULAR;
  } else return Point_status::REGULAR;
}

} // namespace equiaffine::internal

#endif
