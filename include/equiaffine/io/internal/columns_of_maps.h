// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_COLUMNS_OF_MAPS_H
#define EQUIAFFINE_IO_INTERNAL_COLUMNS_OF_MAPS_H

#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/io/internal/Named_maps.h>
#include <equiaffine/io/internal/columns_of_tags.h>
#include <equiaffine/io/internal/mesh_text.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

// Property maps become the columns of a file.
namespace equiaffine::internal {

/// The numbers in a value of a map: one, those of a vector, or those of an array.
template <class Value>
auto numbers_in(const Value& value) {
  if constexpr (std::is_arithmetic_v<Value>) return std::array<double, 1>{double(value)};
  else if constexpr (requires { value.x(); }) return coordinates(value);
  else {
    std::array<double, std::tuple_size_v<Value>> numbers;
    std::copy(value.begin(), value.end(), numbers.begin());
    return numbers;
  }
}

/// Appends columns with the numbers of the values that `value_at` has for the elements, as many as there are names.
template <class Names, class Elements, class Value_at>
void append_columns(Vertex_attributes& attributes, const Names& names, Elements&& elements, const Value_at& value_at,
                    double sign = 1) {
  const std::size_t first = attributes.columns.size();
  for (const auto& name : names) attributes.columns.push_back({std::string(name), {}});
  for (auto&& element : elements) {
    const auto numbers = numbers_in(value_at(element));
    static_assert(std::tuple_size_v<std::decay_t<decltype(numbers)>> == std::tuple_size_v<Names>,
                  "this property map has vectors in the place of numbers, or the other way round");
    for (std::size_t i = 0; i < numbers.size(); ++i) attributes.columns[first + i].values.push_back(sign * numbers[i]);
  }
}

/// The columns of the maps that are given, in the order of the tags.
template <class Elements, class Parameters, class... Tags>
Vertex_attributes columns_of_given_maps(Elements&& elements, const Parameters& parameters, Tag_list<Tags...>) {
  Vertex_attributes result;
  const auto append = [&]<class Tag>(Tag tag) {
    if constexpr (has_parameter<Tag, Parameters>) {
      const auto& map = given_parameter<Tag>(parameters);
      check_map<std::decay_t<decltype(map)>>();
      append_columns(
          result, columns_of(tag), elements, [&](const auto& element) { return get(map, element); },
          sign_in_files(tag));
    }
  };
  (append(Tags()), ...);
  if constexpr (has_parameter<Vertex_principal_curvatures_tag, Parameters>) {
    const auto at = [&](const auto& element) {
      return get(given_parameter<Vertex_principal_curvatures_tag>(parameters), element);
    };
    append_columns(result, std::array{"k1"}, elements, [&](const auto& e) { return -at(e).min_curvature; });
    append_columns(result, std::array{"k2"}, elements, [&](const auto& e) { return -at(e).max_curvature; });
    append_columns(result, columns_of_vector("direction1"), elements,
                   [&](const auto& e) { return at(e).min_direction; });
    append_columns(result, columns_of_vector("direction2"), elements,
                   [&](const auto& e) { return at(e).max_direction; });
  }
  if constexpr (has_parameter<Vertex_status_tag, Parameters>) {
    result.status.emplace();
    for (auto&& element : elements)
      result.status->push_back(get(given_parameter<Vertex_status_tag>(parameters), element));
  }
  return result;
}

/// The name of a map without the kind of its elements, as "v:", and without what would end it in a file.
inline std::string column_name(const std::string& key) {
  std::string name = key.substr(key.starts_with("v:") ? 2 : 0);
  const auto ends_a_name = [](unsigned char c) {
    return std::isspace(c) || std::iscntrl(c) || c == ',' || c == ';' || c == '"';
  };
  std::replace_if(name.begin(), name.end(), ends_a_name, '_');
  return name;
}

/// The columns of all maps under names whose values are numbers or vectors, and the status.
template <class Container, class Elements>
Vertex_attributes columns_of_named_maps(const Container& container, Elements&& elements) {
  using Maps = Named_maps<Container>;
  Vertex_attributes result;
  const auto append = [&]<class T>(const std::string& key, std::type_identity<T>) {
    const auto map = Maps::template find<T>(container, key);
    if (!map) return;
    const auto at = [&](const auto& element) -> T { return get(*map, element); };
    if constexpr (std::is_arithmetic_v<T>) append_columns(result, std::array{column_name(key)}, elements, at);
    else append_columns(result, columns_of_vector(column_name(key)), elements, at);
  };
  const auto append_numbers = [&]<class... T>(const std::string& key, std::tuple<T...>) {
    (append(key, std::type_identity<T>()), ...);
  };
  for (const std::string& key : Maps::keys(container)) {
    if (key == "v:removed") continue; // is of the mesh itself
    append_numbers(key, Numbers_of_maps());
    append(key, std::type_identity<typename Maps::Vector_3>());
    if (column_name(key) != "status") continue;
    if (const auto map = Maps::template find<Point_status>(container, key)) {
      result.status.emplace();
      for (auto&& element : elements) result.status->push_back(get(*map, element));
    }
  }
  return result;
}

/// The columns of the maps that are given, or if there are none, of those that the container has under names.
template <class Container, class Elements, class Parameters>
Vertex_attributes columns_of_maps(Container& container, Elements&& elements, const Parameters& parameters) {
  constexpr bool has_given = has_maps<Parameters>(Column_tags()) || has_maps<Parameters>(Tags_of_files());
  Vertex_attributes result;
  if constexpr (has_given || !Named_maps<std::remove_const_t<Container>>::exist)
    result = columns_of_given_maps(elements, parameters, Column_tags());
  else result = columns_of_named_maps(container, elements);
  if constexpr (has_parameter<Comments_tag, Parameters>) {
    const auto& lines = given_parameter<Comments_tag>(parameters);
    result.comments.assign(std::begin(lines), std::end(lines));
  }
  return result;
}

} // namespace equiaffine::internal

#endif
