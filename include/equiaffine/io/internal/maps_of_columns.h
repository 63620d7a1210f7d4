// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_MAPS_OF_COLUMNS_H
#define EQUIAFFINE_IO_INTERNAL_MAPS_OF_COLUMNS_H

#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/io/internal/Named_maps.h>
#include <equiaffine/io/internal/columns_of_tags.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

// The columns of a file become property maps.
namespace equiaffine::internal {

[[noreturn]] inline void fail_without_column(const std::string& name, const std::string& path) {
  fail_to_read(path, "it has no column '" + name + "' for a property map", "leave out the map, or name another file");
}

/// The numbers of columns of that many names, which a file has to have.
template <std::size_t Size>
class Required_columns {
public:
  Required_columns(const Vertex_attributes& attributes, const std::array<std::string, Size>& names,
                   const std::string& path) {
    for (std::size_t i = 0; i < Size; ++i) {
      columns_[i] = find_column(attributes, names[i]);
      if (columns_[i] == nullptr) fail_without_column(names[i], path);
    }
  }

  std::array<double, Size> operator()(std::size_t row) const {
    std::array<double, Size> numbers;
    for (std::size_t i = 0; i < Size; ++i) numbers[i] = columns_[i]->values[row];
    return numbers;
  }

private:
  std::array<const Vertex_attributes::Column*, Size> columns_;
};

/// Puts into a map what `value_in(row)` returns, for the elements in their order.
template <class Map, class Elements, class Value_in>
void fill_map(const Map& map, Elements&& elements, const Value_in& value_in) {
  check_map<Map>();
  std::size_t row = 0;
  for (auto&& element : elements) put_value(map, element, value_in(row++));
}

/// Fills the maps that are given. \throw Input_error if the file has no columns for one.
template <class Elements, class Parameters, class... Tags>
void fill_given_maps(Elements&& elements, const Parameters& parameters, const Vertex_attributes& attributes,
                     const std::string& path, Tag_list<Tags...>) {
  const auto fill = [&]<class Tag>(Tag tag) {
    if constexpr (has_parameter<Tag, Parameters>) {
      constexpr std::size_t size = number_of_columns(attribute_of(Tag()));
      const Required_columns<size> numbers(attributes, columns_of(tag), path);
      fill_map(given_parameter<Tag>(parameters), elements, [&](std::size_t row) {
        if constexpr (size == 1) return sign_in_files(tag) * numbers(row)[0];
        else return numbers(row);
      });
    }
  };
  (fill(Tags()), ...);
  if constexpr (has_parameter<Vertex_principal_curvatures_tag, Parameters>) {
    const Required_columns<2> k(attributes, {"k1", "k2"}, path);
    const Required_columns<3> first(attributes, columns_of_vector("direction1"), path),
        second(attributes, columns_of_vector("direction2"), path);
    fill_map(given_parameter<Vertex_principal_curvatures_tag>(parameters), elements, [&](std::size_t row) {
      return Principal_curvatures<double>{-k(row)[0], -k(row)[1], first(row), second(row)};
    });
  }
  if constexpr (has_parameter<Vertex_status_tag, Parameters>) {
    if (!attributes.status) fail_without_column("status", path);
    fill_map(given_parameter<Vertex_status_tag>(parameters), elements,
             [&](std::size_t row) { return (*attributes.status)[row]; });
  }
}

/// The name of the vector whose components are the columns from position c on, or an empty text.
inline std::string vector_at(const std::vector<Vertex_attributes::Column>& columns, std::size_t c) {
  if (c + 3 > columns.size()) return {};
  const std::string& first = columns[c].name;
  const std::string name = first == "nx" ? "normal" : first.ends_with("_x") ? first.substr(0, first.size() - 2) : "";
  const auto names = columns_of_vector(name);
  return columns[c + 1].name == names[1] && columns[c + 2].name == names[2] ? name : "";
}

/// Fills the map of a name, of whatever numbers it has, or adds one of doubles.
template <class Container, class Elements, class Value_in, class... T>
void fill_numbers(Container& container, const std::string& key, const Elements& elements, const Value_in& value_in,
                  std::tuple<T...>) {
  using Maps = Named_maps<Container>;
  const auto fill_existing = [&]<class Number>(Number) {
    const auto map = Maps::template find<Number>(container, key);
    if (map) fill_map(*map, elements, [&](std::size_t row) { return static_cast<Number>(value_in(row)); });
    return map.has_value();
  };
  if (!(fill_existing(T()) || ...)) fill_map(Maps::template add<double>(container, key), elements, value_in);
}

/// Adds a map for every column to a container that has maps under names, and one for every three that are a vector.
template <class Container, class Elements>
void add_named_maps(Container& container, Elements&& elements, const Vertex_attributes& attributes) {
  using Maps = Named_maps<Container>;
  const auto& columns = attributes.columns;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string vector = vector_at(columns, c);
    if (vector.empty()) {
      fill_numbers(
          container, Maps::key(columns[c].name), elements, [&](std::size_t row) { return columns[c].values[row]; },
          Numbers_of_maps());
      continue;
    }
    fill_map(Maps::template add<typename Maps::Vector_3>(container, Maps::key(vector)), elements, [&](std::size_t row) {
      return std::array{columns[c].values[row], columns[c + 1].values[row], columns[c + 2].values[row]};
    });
    c += 2;
  }
  if (attributes.status)
    fill_map(Maps::template add<Point_status>(container, Maps::key("status")), elements,
             [&](std::size_t row) { return (*attributes.status)[row]; });
}

/// Adds points to a container, or to a point set, which calls that `insert`.
template <class Points, class Added>
void append_points(Points& points, const std::vector<Added>& added) {
  if constexpr (!Point_set<Points>)
    static_assert(
        std::is_constructible_v<typename Points::value_type, double, double, double>,
        "points are read into a container of points, or into a CGAL::Point_set_3, which keeps what comes with "
        "them");
  for (const Added& p : added)
    if constexpr (Point_set<Points>) points.insert(typename Points::Point_3(p.x(), p.y(), p.z()));
    else points.push_back(typename Points::value_type(p.x(), p.y(), p.z()));
}

/// The statuses whose words are the column `status` of a table, if there is one and it has no other words.
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

/// Fills the maps that are given, or if there are none, adds maps under names to a container that can have them.
template <class Container, class Elements, class Parameters>
void fill_maps(Container& container, Elements&& elements, const Parameters& parameters,
               const Vertex_attributes& attributes, const std::string& path) {
  if constexpr (has_maps<Parameters>(Column_tags()) || has_maps<Parameters>(Tags_of_files()))
    fill_given_maps(elements, parameters, attributes, path, Column_tags());
  else if constexpr (Named_maps<Container>::exist) add_named_maps(container, elements, attributes);
}

} // namespace equiaffine::internal

#endif
