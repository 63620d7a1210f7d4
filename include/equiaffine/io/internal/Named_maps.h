// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_NAMED_MAPS_H
#define EQUIAFFINE_IO_INTERNAL_NAMED_MAPS_H

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <concepts>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// CGAL::Surface_mesh and CGAL::Point_set_3 keep property maps under names.
namespace equiaffine::internal {

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

} // namespace equiaffine::internal

#endif
