// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_VERTEX_MAPS_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_VERTEX_MAPS_H

#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <CGAL/property_map.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>

// The values that annotate() and annotate_by_fit() write to property maps.
namespace equiaffine::internal {

template <class FT>
const Local_structure_3<FT>& structure_in(const Local_structure_3<FT>& s) {
  return s;
}
template <class FT>
const Local_structure_3<FT>& structure_in(const Fitted_structure_3<FT>& s) {
  return s.structure;
}

/// The principal curvatures with CGAL's sign.
template <class FT>
struct Principal_curvatures {
  FT least, greatest;
  std::array<FT, 3> direction_of_least, direction_of_greatest;
};

// The attribute for the map with a tag.
constexpr std::string_view attribute_of(Vertex_unit_normal_tag) { return "normal"; }
constexpr std::string_view attribute_of(Vertex_mean_curvature_tag) { return "mean_curvature"; }
constexpr std::string_view attribute_of(Vertex_Gaussian_curvature_tag) { return "gaussian_curvature"; }
constexpr std::string_view attribute_of(Vertex_affine_mean_curvature_tag) { return "affine_mean_curvature"; }
constexpr std::string_view attribute_of(Vertex_affine_Gaussian_curvature_tag) { return "affine_gaussian_curvature"; }
constexpr std::string_view attribute_of(Vertex_affine_normal_tag) { return "affine_normal"; }
constexpr std::string_view attribute_of(Vertex_conormal_tag) { return "conormal"; }
constexpr std::string_view attribute_of(Vertex_pick_invariant_tag) { return "pick_invariant"; }
constexpr std::string_view attribute_of(Vertex_affine_metric_tag) { return "metric"; }
constexpr std::string_view attribute_of(Vertex_affine_area_density_tag) { return "affine_area_density"; }
template <class Tag>
constexpr std::string_view attribute_of(Error_tag<Tag>) {
  return attribute_of(Tag());
}
template <class Tag>
inline constexpr std::array attributes_of = {attribute_of(Tag())};
template <>
inline constexpr std::array<std::string_view, 4> attributes_of<Vertex_principal_curvatures_tag> = {
    "k1", "k2", "direction1", "direction2"};

template <class Tag>
inline constexpr bool is_error_tag = false;
template <class Tag>
inline constexpr bool is_error_tag<Error_tag<Tag>> = true;

/// The columns for the value in the map with a tag. For an error, a column of the attribute.
template <class Tag>
inline constexpr auto columns_of = [] {
  constexpr auto size_of = [](std::string_view name) { return is_error_tag<Tag> ? 1 : find_row(name)->size(); };
  constexpr std::size_t size = [&] {
    std::size_t sum = 0;
    for (const std::string_view name : attributes_of<Tag>) sum += size_of(name);
    return sum;
  }();
  std::array<Attribute, size> columns{};
  std::size_t n = 0;
  for (const std::string_view name : attributes_of<Tag>)
    for (std::size_t i = 0; i < size_of(name); ++i)
      columns[n++] = {find_row(name)->column(i), std::size_t(find_row(name) - attribute_table<double>.data()), i};
  return columns;
}();

/// Mean curvatures in CGAL's maps have the opposite sign.
template <class Tag>
inline constexpr int sign_in_maps = std::is_same_v<Tag, Vertex_mean_curvature_tag> ? -1 : 1;

/// The value in the map with a tag, from the numbers of its columns.
template <class Tag, class FT, std::size_t Size>
auto value_of(Tag, const std::array<FT, Size>& n) {
  if constexpr (std::is_same_v<Tag, Vertex_principal_curvatures_tag>)
    return Principal_curvatures<FT>{-n[0], -n[1], {n[2], n[3], n[4]}, {n[5], n[6], n[7]}};
  else if constexpr (Size == 1) return FT(sign_in_maps<Tag> * n[0]);
  else return n;
}

/// The value in the map with a tag, from a Local_structure_3 or a Fitted_structure_3.
template <class Tag, class S>
decltype(auto) value_for(Tag tag, const S& s) {
  const auto& structure = structure_in(s);
  if constexpr (std::is_same_v<Tag, Vertex_status_tag>) return structure.status;
  else if constexpr (std::is_same_v<Tag, Vertex_structure_tag>) return (s);
  else if constexpr (is_error_tag<Tag>) return attribute_table<double>[columns_of<Tag>[0].row].error.get(s.error);
  else {
    std::array<std::decay_t<decltype(structure.euclidean.k1)>, columns_of<Tag>.size()> numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = columns_of<Tag>[i].get(structure);
    return value_of(tag, numbers);
  }
}

template <class Map>
concept Property_map = requires {
  typename boost::property_traits<Map>::key_type;
};

template <class... Tags>
struct Tag_list {};
template <class... First, class... Second>
Tag_list<First..., Second...> concatenated(Tag_list<First...>, Tag_list<Second...>);

/// In this order: the maps of one attribute, all maps of numbers that annotate() fills, all its maps, and the
/// additional maps of fits.
using Attribute_tags =
    Tag_list<Vertex_unit_normal_tag, Vertex_mean_curvature_tag, Vertex_Gaussian_curvature_tag,
             Vertex_affine_mean_curvature_tag, Vertex_affine_Gaussian_curvature_tag, Vertex_affine_normal_tag,
             Vertex_conormal_tag, Vertex_pick_invariant_tag, Vertex_affine_metric_tag, Vertex_affine_area_density_tag>;
using Number_tags = decltype(concatenated(Attribute_tags(), Tag_list<Vertex_principal_curvatures_tag>()));
using Structure_tags = decltype(concatenated(Tag_list<Vertex_status_tag, Vertex_structure_tag>(), Number_tags()));
using Error_tags = Tag_list<Vertex_affine_mean_curvature_error_tag, Vertex_affine_Gaussian_curvature_error_tag,
                            Vertex_affine_normal_error_tag, Vertex_conormal_error_tag, Vertex_pick_invariant_error_tag,
                            Vertex_affine_area_density_error_tag, Vertex_mean_curvature_error_tag,
                            Vertex_Gaussian_curvature_error_tag, Vertex_unit_normal_error_tag>;

/// Rejects named parameters that are neither in the list nor among the other tags.
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

/// Converts to a vector of CGAL, or to an array.
template <class Vector, class FT>
Vector vector_of(const std::array<FT, 3>& v) {
  static_assert(!std::is_arithmetic_v<Vector>,
                "this property map has numbers, but the value is a vector: give a map of "
                "CGAL's Vector_3, or of std::array");
  if constexpr (requires { typename Vector::value_type; }) {
    using Number = typename Vector::value_type;
    return Vector{Number(v[0]), Number(v[1]), Number(v[2])};
  } else return Vector(v[0], v[1], v[2]);
}

template <class Map>
constexpr void check_map() {
  static_assert(Property_map<Map>, "this is not a property map: make one with boost::make_assoc_property_map() from a "
                                   "std::map, or use one of a CGAL::Surface_mesh");
}

// The key may be an element that contains the value.
template <class Map, class Key, class Value>
void put_value(const Map& map, Key& key, const Value& value) {
  using Kept = typename boost::property_traits<Map>::value_type;
  static_assert(std::is_constructible_v<Kept, const Value&>,
                "this property map has another value type, such as vectors instead of numbers: give a map of the "
                "right type");
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

/// Writes the structure of a vertex to those maps of the list that are given.
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

/// The status assigned by a sampler, if the map of statuses is readable.
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
