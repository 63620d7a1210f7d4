// SPDX-License-Identifier: GPL-3.0-or-later
// Writes columns of numbers to property maps: those that are given, or named maps.
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_MAPS_OF_COLUMNS_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_MAPS_OF_COLUMNS_H

#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

template <class Mesh>
inline constexpr bool is_surface_mesh = false;
template <class Point>
inline constexpr bool is_surface_mesh<CGAL::Surface_mesh<Point>> = true;

/// Fails to compile for a surface mesh that cannot have the maps `v:NAME`.
template <class Mesh>
constexpr void check_mesh_for_maps() {
  static_assert(
      std::is_same_v<typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel::FT, double>,
      "the maps v:NAME of a CGAL::Surface_mesh require coordinates of type double: give property maps, such as "
      "parameters::vertex_affine_mean_curvature_map(map)");
}

/// The attributes for which a surface mesh gets maps: all those of samples.
inline Attribute_selection selection_of_named_maps(bool has_faces) {
  Attribute_selection selection;
  for (const auto& row : attribute_table<double>)
    if (row.get != nullptr && (has_faces || !(row.lists & attribute_lists::of_mesh)))
      for (std::size_t i = 0; i < row.size(); ++i)
        selection.columns.push_back({row.column(i), std::size_t(&row - attribute_table<double>.data()), i});
  return selection;
}

/// The areas around the vertices of a surface mesh, given their points; empty if it has no faces.
template <class Mesh, class Points>
std::vector<double> areas_of_surface_mesh(const Mesh& mesh, const Points& points) {
  if (mesh.number_of_faces() == 0) return {};
  std::vector<double> areas(points.size(), 0.);
  std::vector<std::size_t> number_of(mesh.num_vertices()), corners; // including removed ones
  for (std::size_t n = 0; const auto v : mesh.vertices()) number_of[v] = n++;
  for (const auto f : mesh.faces()) {
    corners.clear();
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners.push_back(number_of[v]);
    add_vertex_areas(points, corners, areas);
  }
  return areas;
}

/// The attributes of the given maps.
template <class Parameters, class... Tags>
Attribute_selection selection_of_given_maps(Tag_list<Tags...>) {
  Attribute_selection selection;
  const auto select = [&]<class Tag>(Tag) {
    if constexpr (has_parameter<Tag, Parameters>)
      selection.columns.insert(selection.columns.end(), columns_of<Tag>.begin(), columns_of<Tag>.end());
  };
  (select(Tags()), ...);
  return selection;
}

// CGAL::Surface_mesh and CGAL::Point_set_3 have named property maps.

/// The number types that named maps are searched for.
using Numbers_of_maps = std::tuple<double, float, int, unsigned, long, unsigned long, long long, unsigned long long,
                                   short, unsigned short, char, signed char, unsigned char, bool>;

template <class Map>
std::optional<Map> optional_map(const std::pair<Map, bool>& map) { // of CGAL 5
  return map.second ? std::optional(map.first) : std::nullopt;
}
template <class Map>
std::optional<Map> optional_map(const std::optional<Map>& map) { // of CGAL 6
  return map;
}

/// The primary template is for containers without named maps.
template <class Container>
struct Named_maps {
  static constexpr bool exist = false;
};

template <class Point>
struct Named_maps<CGAL::Surface_mesh<Point>> {
  using Mesh = CGAL::Surface_mesh<Point>;
  using Vertex = typename Mesh::Vertex_index;
  using Vector_3 = typename CGAL::Kernel_traits<Point>::Kernel::Vector_3;

  static constexpr bool exist = true;
  static std::string key(const std::string& name) { return "v:" + name; }
  static std::vector<std::string> keys(const Mesh& mesh) { return mesh.template properties<Vertex>(); }
  template <class T>
  static auto find(const Mesh& mesh, const std::string& key) {
    return optional_map(mesh.template property_map<Vertex, T>(key));
  }
  template <class T>
  static auto add(Mesh& mesh, const std::string& key) {
    return mesh.template add_property_map<Vertex, T>(key, T()).first;
  }
};

template <class Container>
concept Point_set = requires(Container& points, const Container& constant) {
  { constant.properties() } -> std::same_as<std::vector<std::string>>;
  points.template add_property_map<double>(std::string(), 0.);
  typename Container::Vector_3;
};

template <Point_set Points>
struct Named_maps<Points> {
  using Vector_3 = typename Points::Vector_3;

  static constexpr bool exist = true;
  static std::string key(const std::string& name) { return name; }
  static std::vector<std::string> keys(const Points& points) { return points.properties(); }
  template <class T>
  static auto find(const Points& points, const std::string& key) {
    return optional_map(points.template property_map<T>(key));
  }
  template <class T>
  static auto add(Points& points, const std::string& key) {
    return points.template add_property_map<T>(key, T()).first;
  }
};

/// The names in files of the columns for the map with a tag.
template <class Tag>
auto names_of_columns(Tag) {
  std::array<std::string, columns_of<Tag>.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (is_error_tag<Tag>) names[i] = std::string(attribute_table<double>[columns_of<Tag>[i].row].name) + "_error";
    else names[i] = columns_of<Tag>[i].name;
  }
  return names;
}

/// The names of the columns of a vector.
inline std::array<std::string, 3> columns_of_vector(const std::string& name) {
  if (name == "normal") return {"nx", "ny", "nz"};
  return {name + "_x", name + "_y", name + "_z"};
}

/// Writes `value_in(row)` to a map for the elements in their order.
template <class Map, class Elements, class Value_in>
void fill_map(const Map& map, Elements&& elements, const Value_in& value_in) {
  check_map<Map>();
  std::size_t row = 0;
  for (auto&& element : elements) put_value(map, element, value_in(row++));
}

/// Fills the given maps. `column(name)` returns the column of a name.
template <class Elements, class Parameters, class Column_of, class... Tags>
void fill_given_maps(Elements&& elements, const Parameters& parameters, const Column_of& column, Tag_list<Tags...>) {
  const auto fill = [&]<class Tag>(Tag tag) {
    if constexpr (has_parameter<Tag, Parameters>) {
      std::array<const double*, columns_of<Tag>.size()> values;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = column(names_of_columns(tag)[i]).values.data();
      fill_map(given_parameter<Tag>(parameters), elements, [&](std::size_t row) {
        std::array<double, columns_of<Tag>.size()> numbers;
        for (std::size_t i = 0; i < values.size(); ++i) numbers[i] = values[i][row];
        return value_of(tag, numbers);
      });
    }
  };
  (fill(Tags()), ...);
}

/// Fills the map of statuses if it is given.
template <class Elements, class Parameters>
void fill_status_map(Elements&& elements, const Parameters& parameters, const std::vector<Point_status>& status) {
  if constexpr (has_parameter<Vertex_status_tag, Parameters>)
    fill_map(given_parameter<Vertex_status_tag>(parameters), elements, [&](std::size_t row) { return status[row]; });
}

/// The name of the vector whose components are the columns from position c on, or an empty string.
inline std::string vector_at(const std::vector<Vertex_attributes::Column>& columns, std::size_t c) {
  if (c + 3 > columns.size()) return {};
  const std::string& first = columns[c].name;
  const std::string name = first == "nx" ? "normal" : first.ends_with("_x") ? first.substr(0, first.size() - 2) : "";
  const auto names = columns_of_vector(name);
  return columns[c + 1].name == names[1] && columns[c + 2].name == names[2] ? name : "";
}

/// Fills the map of a name, whatever its number type, or adds one of doubles.
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

/// Adds a named map to a container for every column, and one for every three columns that are a vector. Frees the
/// memory of each column when its map is filled.
template <class Container, class Elements>
void add_named_maps(Container& container, Elements&& elements, Vertex_attributes&& attributes) {
  using Maps = Named_maps<Container>;
  auto& columns = attributes.columns;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string vector = vector_at(columns, c);
    if (vector.empty()) {
      fill_numbers(
          container, Maps::key(columns[c].name), elements, [&](std::size_t row) { return columns[c].values[row]; },
          Numbers_of_maps());
      columns[c].values = {};
      continue;
    }
    fill_map(Maps::template add<typename Maps::Vector_3>(container, Maps::key(vector)), elements, [&](std::size_t row) {
      return std::array{columns[c].values[row], columns[c + 1].values[row], columns[c + 2].values[row]};
    });
    for (std::size_t n = 0; n < 3; ++n) columns[c + n].values = {};
    c += 2;
  }
  if (attributes.status)
    fill_map(Maps::template add<Point_status>(container, Maps::key("status")), elements,
             [&](std::size_t row) { return (*attributes.status)[row]; });
}

} // namespace equiaffine::internal

#endif
