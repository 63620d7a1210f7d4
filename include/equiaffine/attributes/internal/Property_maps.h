// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_PROPERTY_MAPS_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_PROPERTY_MAPS_H

#include <equiaffine/attributes/internal/attribute_table.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh/Surface_mesh_fwd.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace equiaffine::internal {

template <class Mesh>
inline constexpr bool is_surface_mesh = false;
template <class Point>
inline constexpr bool is_surface_mesh<CGAL::Surface_mesh<Point>> = true;

/// Does not compile for a surface mesh that cannot have the maps `v:NAME`.
template <class Mesh>
constexpr void check_mesh_for_maps() {
  static_assert(
      std::is_same_v<typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel::FT, double>,
      "a CGAL::Surface_mesh gets maps v:NAME if its coordinates are doubles: give this one property maps, such "
      "as parameters::vertex_affine_mean_curvature_map(map)");
}

/// The property maps that `annotate` fills: one per scalar and per vector of attribute_table, one per component of a
/// form.
template <class Mesh>
class Property_maps {
  using Vertex_index = typename Mesh::Vertex_index;
  using Kernel = typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel;
  using FT = typename Kernel::FT;
  using Vector_3 = typename Kernel::Vector_3;
  using Row = Attribute_row<FT>;
  template <class T>
  using Map = typename Mesh::template Property_map<Vertex_index, T>;

  struct Scalar_map {
    const Row& row;
    std::size_t component;
    Map<FT> map;
  };
  struct Vector_map {
    const Row& row;
    Map<Vector_3> map;
  };

public:
  explicit Property_maps(Mesh& mesh) : status_(add<Point_status>(mesh, "status")) {
    for (const Row& row : attribute_table<FT>) {
      if (row.get == nullptr) continue;
      if (row.size() == 3) vectors_.push_back({row, add<Vector_3>(mesh, row.name)});
      else
        for (std::size_t i = 0; i < row.size(); ++i) scalars_.push_back({row, i, add<FT>(mesh, row.column(i))});
    }
  }

  Point_status status(Vertex_index v) const { return status_[v]; }

  void set(Vertex_index v, const Local_structure_3<FT>& s) {
    status_[v] = s.status;
    for (auto& [row, component, map] : scalars_) map[v] = row.get(s, component);
    for (auto& [row, map] : vectors_) map[v] = Vector_3(row.get(s, 0), row.get(s, 1), row.get(s, 2));
  }

  /// Returns the map of that name, and adds it if the mesh has none.
  template <class T>
  static Map<T> add(Mesh& mesh, std::string_view name) {
    return mesh.template add_property_map<Vertex_index, T>("v:" + std::string(name), T()).first;
  }

private:
  Map<Point_status> status_;
  std::vector<Scalar_map> scalars_;
  std::vector<Vector_map> vectors_;
};

} // namespace equiaffine::internal

#endif
