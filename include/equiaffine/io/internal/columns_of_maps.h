// SPDX-License-Identifier: GPL-3.0-or-later
// Property maps become the columns of a file, and the columns of a file become property maps.
#ifndef EQUIAFFINE_IO_INTERNAL_COLUMNS_OF_MAPS_H
#define EQUIAFFINE_IO_INTERNAL_COLUMNS_OF_MAPS_H

#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

// CGAL::Surface_mesh and CGAL::Point_set_3 keep property maps under names.

/// The types of numbers that maps under names are looked for with.
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

/// The named maps of a container that has none.
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

// The columns of a file whose numbers a property map with a tag has.

template <class... First, class... Second>
Tag_list<First..., Second...> concatenated(Tag_list<First...>, Tag_list<Second...>);

/// The maps that a file can hold, but those of the status and of the principal curvatures.
using Column_tags =
    decltype(concatenated(Tag_list<Vertex_unit_normal_tag, Vertex_mean_curvature_tag, Vertex_Gaussian_curvature_tag,
                                   Vertex_affine_mean_curvature_tag, Vertex_affine_Gaussian_curvature_tag,
                                   Vertex_affine_normal_tag, Vertex_conormal_tag, Vertex_pick_invariant_tag,
                                   Vertex_affine_metric_tag, Vertex_affine_area_density_tag>(),
                          Error_tags()));
using Tags_of_files = Tag_list<Vertex_status_tag, Vertex_principal_curvatures_tag>;

/// Refuses named parameters that are neither these maps nor among the other tags.
template <class Parameters, class... Others>
constexpr void check_map_file_parameters() {
  check_parameters_of_maps<Parameters, Vertex_status_tag, Vertex_principal_curvatures_tag, Geom_traits_tag, Verbose_tag,
                           Others...>(Column_tags());
}

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
constexpr std::string_view attribute_of(Vertex_affine_mean_curvature_error_tag) {
  return "affine_mean_curvature_error";
}
constexpr std::string_view attribute_of(Vertex_affine_Gaussian_curvature_error_tag) {
  return "affine_gaussian_curvature_error";
}
constexpr std::string_view attribute_of(Vertex_affine_normal_error_tag) { return "affine_normal_error"; }
constexpr std::string_view attribute_of(Vertex_conormal_error_tag) { return "conormal_error"; }
constexpr std::string_view attribute_of(Vertex_pick_invariant_error_tag) { return "pick_invariant_error"; }
constexpr std::string_view attribute_of(Vertex_affine_area_density_error_tag) { return "affine_area_density_error"; }
constexpr std::string_view attribute_of(Vertex_mean_curvature_error_tag) { return "mean_curvature_error"; }
constexpr std::string_view attribute_of(Vertex_Gaussian_curvature_error_tag) { return "gaussian_curvature_error"; }
constexpr std::string_view attribute_of(Vertex_unit_normal_error_tag) { return "normal_error"; }

/// Maps of CGAL have the opposite of the mean curvature of files.
template <class Tag>
constexpr double sign_in_files(Tag) {
  return std::is_same_v<Tag, Vertex_mean_curvature_tag> ? -1 : 1;
}

/// How many columns an attribute has: one if the table has no such attribute, as for an estimated error.
constexpr std::size_t number_of_columns(std::string_view attribute) {
  for (const auto& row : attribute_table<double>)
    if (row.name == attribute) return row.size();
  return 1;
}

/// The names of the columns that the map with a tag has.
template <class Tag>
auto columns_of(Tag tag) {
  std::array<std::string, number_of_columns(attribute_of(Tag()))> names{std::string(attribute_of(tag))};
  for (const auto& row : attribute_table<double>)
    if (row.name == attribute_of(tag))
      for (std::size_t i = 0; i < names.size(); ++i) names[i] = row.column(i);
  return names;
}

/// The names of the columns of a vector with a name.
inline std::array<std::string, 3> columns_of_vector(const std::string& name) {
  if (name == "normal") return {"nx", "ny", "nz"};
  return {name + "_x", name + "_y", name + "_z"};
}

// Property maps become the columns of a file.

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

// The columns of a file become property maps.

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
