// SPDX-License-Identifier: GPL-3.0-or-later
// Selects attributes of points by name.
#ifndef EQUIAFFINE_ATTRIBUTES_ATTRIBUTE_SELECTION_H
#define EQUIAFFINE_ATTRIBUTES_ATTRIBUTE_SELECTION_H

#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Whether `name` selects this component of the row.
constexpr bool is_selected_by(const Attribute_row<double>& row, std::size_t component, std::string_view name) {
  using namespace attribute_lists;
  if (name == "basic") return (row.lists & basic) == basic;
  if (name == "all") return (row.lists & all) != 0;
  if (name == "signature") return (row.lists & signature) != 0;
  return name == row.name || name == row.column(component);
}

/// Calls select(row, component) for everything `name` stands for, in the order of the table. Returns false if the
/// name is unknown.
template <class Select>
bool select_by_name(std::string_view name, const Select& select) {
  bool is_known = name == "status";
  for (std::size_t n = 0; n < attribute_table<double>.size(); ++n)
    for (std::size_t i = 0; i < attribute_table<double>[n].size(); ++i)
      if (is_selected_by(attribute_table<double>[n], i, name)) {
        is_known = true;
        select(n, i);
      }
  return is_known;
}

/// Reads a comma-separated list of names, and calls select(row, component) for everything they stand for.
/// \throw Input_error for an unknown name.
template <class Select>
void read_attribute_names(std::string_view list, const Select& select) {
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string_view name = list.substr(begin, end - begin);
    if (!select_by_name(name, select))
      throw Input_error("unknown attribute '" + std::string(name) +
                        "': use basic, all, none, or a list of names such as normal,affine_mean_curvature,status");
    begin = end + 1;
  }
}

} // namespace equiaffine::internal

namespace equiaffine {

/// A column of a file: a scalar attribute, or one component of a vector or form.
struct Attribute {
  std::string_view name; ///< as in the header of a file
  std::size_t row,       ///< of attribute_table
      component;         ///< of the vector or form in that row; 0 for a scalar

  /// Returns the number from a sample, or a pack of numbers from a sample of packs. It is NaN for the norm of a
  /// gradient, which a sample does not contain.
  template <class FT>
  FT get(const Attribute_sample<FT>& sample) const {
    const auto getter = attribute_table<FT>[row].get;
    return getter ? getter(sample, component) : FT(std::numeric_limits<double>::quiet_NaN());
  }
  /// The same from a local structure, without a mesh.
  template <class FT>
  FT get(const Local_structure_3<FT>& structure) const {
    return get(Attribute_sample<FT>(structure));
  }
};

/// The attributes to compute, and whether to compute the status.
struct Attribute_selection {
  std::vector<Attribute> columns; ///< in the order of the request
  bool has_status = true;         ///< whether the status is selected, too
};

/// Reads `basic`, `all`, `none`, or a comma-separated list of names of attributes, of their components (`nx`), and
/// of `signature` and `status`. `signature` is K, H, J and the norms of their gradients. Columns have the order of
/// the list, and those of one name the order of the table; each column occurs once.
/// \throw Input_error for an unknown name.
inline Attribute_selection select_attributes(std::string_view list) {
  if (list == "none") return {{}, false};
  Attribute_selection selection;
  std::array<std::array<bool, 6>, attribute_table<double>.size()> is_selected{};
  internal::read_attribute_names(list, [&](std::size_t row, std::size_t i) {
    if (!std::exchange(is_selected[row][i], true))
      selection.columns.push_back({attribute_table<double>[row].column(i), row, i});
  });
  return selection;
}

/// Returns a selected attribute that exists only at vertices of a mesh with faces, such as `vertex_area`, or null.
inline const Attribute* attribute_of_mesh(const Attribute_selection& selection) {
  for (const Attribute& column : selection.columns)
    if (attribute_table<double>[column.row].lists & attribute_lists::of_mesh) return &column;
  return nullptr;
}

/// \throw Input_error if a selected attribute needs a mesh with faces.
inline void refuse_attributes_of_mesh(const Attribute_selection& selection) {
  if (const Attribute* const attribute = attribute_of_mesh(selection))
    throw Input_error("the attribute '" + std::string(attribute->name) +
                      "' needs a mesh with faces: leave it out, or give a mesh with faces");
}

/// Returns the areas around the vertices of a mesh if a selected attribute needs them, or else an empty vector.
/// \throw Input_error if an attribute needs them, and there are points but no polygons.
template <class Points, class Polygons>
std::vector<double> selected_vertex_areas(const Attribute_selection& selection, const Points& points,
                                          const Polygons& polygons) {
  if (!attribute_of_mesh(selection)) return {};
  if (!std::ranges::empty(points) && std::ranges::empty(polygons)) refuse_attributes_of_mesh(selection);
  return vertex_areas(points, polygons);
}

/// The names that select_attributes() reads, one for each vector or form, for help texts.
struct Attribute_names {
  std::vector<std::string_view> basic;        ///< in `basic`
  std::vector<std::string_view> added_by_all; ///< in `all` and not in `basic`
  std::vector<std::string_view> by_name;      ///< in no list
  std::vector<std::string_view> signature;    ///< in `signature`
};

/// Returns these names in the order of the table.
inline Attribute_names attribute_names() {
  using namespace attribute_lists;
  Attribute_names names;
  for (const auto& row : attribute_table<double>) {
    if (!(row.lists & (all | signature))) names.by_name.push_back(row.name);
    if (row.lists & signature) names.signature.push_back(row.name);
    if ((row.lists & basic) == basic) names.basic.push_back(row.name);
    else if (row.lists & all) names.added_by_all.push_back(row.name);
  }
  return names;
}

} // namespace equiaffine

#endif
