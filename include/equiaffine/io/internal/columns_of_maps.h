// SPDX-License-Identifier: GPL-3.0-or-later
// Converts property maps to the columns of a file and back.
#ifndef EQUIAFFINE_IO_INTERNAL_COLUMNS_OF_MAPS_H
#define EQUIAFFINE_IO_INTERNAL_COLUMNS_OF_MAPS_H

#include <equiaffine/attributes/internal/maps_of_columns.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The maps that a file can hold besides that of the status; those of the principal curvatures are last.
using Column_tags =
    decltype(concatenated(concatenated(Attribute_tags(), Error_tags()), Tag_list<Vertex_principal_curvatures_tag>()));

template <class Parameters>
inline constexpr bool
    has_maps_of_files = has_maps<Parameters>(Column_tags()) || has_parameter<Vertex_status_tag, Parameters>;

/// Rejects named parameters that are neither these maps nor among the other tags.
template <class Parameters, class... Others>
constexpr void check_map_file_parameters() {
  check_parameters_of_maps<Parameters, Vertex_status_tag, Geom_traits_tag, Verbose_tag, Others...>(Column_tags());
}

// Property maps become the columns of a file.

/// The numbers in a value of a map: a number, the elements of a vector or an array, or principal curvatures.
template <class Value>
auto numbers_in(const Value& value) {
  if constexpr (std::is_arithmetic_v<Value>) return std::array<double, 1>{double(value)};
  else if constexpr (requires { value.min_curvature; }) {
    const auto first = numbers_in(value.min_direction), second = numbers_in(value.max_direction);
    return std::array<double, 8>{
        -value.min_curvature, -value.max_curvature, first[0], first[1], first[2], second[0], second[1], second[2]};
  } else if constexpr (requires { value.x(); }) return coordinates(value);
  else {
    std::array<double, std::tuple_size_v<Value>> numbers;
    std::copy(value.begin(), value.end(), numbers.begin());
    return numbers;
  }
}

/// Appends one column per name with the numbers of `value_at(element)` for all elements.
template <class Names, class Elements, class Value_at>
void append_columns(Vertex_attributes& attributes, const Names& names, Elements&& elements, const Value_at& value_at,
                    double sign = 1) {
  const std::size_t first = attributes.columns.size();
  for (const auto& name : names) attributes.columns.push_back({std::string(name), {}});
  for (auto&& element : elements) {
    const auto numbers = numbers_in(value_at(element));
    static_assert(std::tuple_size_v<std::decay_t<decltype(numbers)>> == std::tuple_size_v<Names>,
                  "the values of this property map are vectors instead of numbers, or numbers instead of vectors");
    for (std::size_t i = 0; i < numbers.size(); ++i) attributes.columns[first + i].values.push_back(sign * numbers[i]);
  }
}

/// The columns of the given maps, in the order of the tags.
template <class Elements, class Parameters, class... Tags>
Vertex_attributes columns_of_given_maps(Elements&& elements, const Parameters& parameters, Tag_list<Tags...>) {
  Vertex_attributes result;
  const auto append = [&]<class Tag>(Tag tag) {
    if constexpr (has_parameter<Tag, Parameters>) {
      const auto& map = given_parameter<Tag>(parameters);
      check_map<std::decay_t<decltype(map)>>();
      append_columns(
          result, names_of_columns(tag), elements, [&](const auto& element) { return get(map, element); },
          sign_in_maps<Tag>);
    }
  };
  (append(Tags()), ...);
  if constexpr (has_parameter<Vertex_status_tag, Parameters>) {
    result.status.emplace();
    for (auto&& element : elements)
      result.status->push_back(get(given_parameter<Vertex_status_tag>(parameters), element));
  }
  return result;
}

/// The name of a map without the prefix "v:", and with _ for characters that would end a name in a file.
inline std::string column_name(const std::string& key) {
  std::string name = key.substr(key.starts_with("v:") ? 2 : 0);
  const auto ends_a_name = [](unsigned char c) {
    return std::isspace(c) || std::iscntrl(c) || c == ',' || c == ';' || c == '"';
  };
  std::replace_if(name.begin(), name.end(), ends_a_name, '_');
  return name;
}

/// The columns of all named maps whose values are numbers or vectors, and the status.
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
    if (key == "v:removed") continue; // internal to the mesh
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

/// The columns of the given maps, or of the container's named maps if none are given.
template <class Container, class Elements, class Parameters>
Vertex_attributes columns_of_maps(Container& container, Elements&& elements, const Parameters& parameters) {
  Vertex_attributes result;
  if constexpr (has_maps_of_files<Parameters> || !Named_maps<std::remove_const_t<Container>>::exist)
    result = columns_of_given_maps(elements, parameters, Column_tags());
  else result = columns_of_named_maps(container, elements);
  if constexpr (has_parameter<Comments_tag, Parameters>) {
    const auto& lines = given_parameter<Comments_tag>(parameters);
    result.comments.assign(std::begin(lines), std::end(lines));
  }
  return result;
}

// The columns of a file become property maps.

[[noreturn]] inline void fail_without_column(const std::string& name, const std::string& path) {
  fail_to_read(path, "it has no column '" + name + "' for a property map", "omit the map, or give another file");
}

/// Adds points to a container, or to a point set, where the function is called `insert`.
template <class Points, class Added>
void append_points(Points& points, const std::vector<Added>& added) {
  if constexpr (!Point_set<Points>)
    static_assert(
        std::is_constructible_v<typename Points::value_type, double, double, double>,
        "points are read into a container of points, or into a CGAL::Point_set_3, which also keeps their attributes");
  for (const Added& p : added)
    if constexpr (Point_set<Points>) points.insert(typename Points::Point_3(p.x(), p.y(), p.z()));
    else points.push_back(typename Points::value_type(p.x(), p.y(), p.z()));
}

/// The statuses in the column `status` of a table; nothing if there is none, or if it contains other words.
inline std::optional<std::vector<Point_status>> status_in_cells(const std::vector<std::string>& header,
                                                                const std::vector<std::string>& cells) {
  const auto place = std::size_t(std::find(header.begin(), header.end(), "status") - header.begin());
  if (place == header.size()) return std::nullopt;
  std::vector<Point_status> result;
  for (std::size_t cell = place; cell < cells.size(); cell += header.size()) {
    std::size_t i = 0;
    while (i < number_of_point_statuses && cells[cell] != to_string(Point_status(i))) ++i;
    if (i == number_of_point_statuses) return std::nullopt;
    result.push_back(Point_status(i));
  }
  return result;
}

/// Fills the given maps, or adds named maps to a container that supports them if none are given.
/// \throw Input_error if the file has no column for a given map
template <class Container, class Elements, class Parameters>
void fill_maps(Container& container, Elements&& elements, const Parameters& parameters,
               Vertex_attributes&& attributes, const std::string& path) {
  if constexpr (has_maps_of_files<Parameters>) {
    const auto column = [&](const std::string& name) -> const auto& {
      const auto* const found = find_column(attributes, name);
      if (found == nullptr) fail_without_column(name, path);
      return *found;
    };
    fill_given_maps(elements, parameters, column, Column_tags());
    if (has_parameter<Vertex_status_tag, Parameters> && !attributes.status) fail_without_column("status", path);
    if (attributes.status) fill_status_map(elements, parameters, *attributes.status);
  } else if constexpr (Named_maps<Container>::exist) {
    add_named_maps(container, elements, std::move(attributes));
  }
}

} // namespace equiaffine::internal

#endif
