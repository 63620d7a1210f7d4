// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_ATTRIBUTE_NAMES_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_ATTRIBUTE_NAMES_H

#include <equiaffine/Input_error.h>
#include <equiaffine/attributes/internal/shared/attribute_table.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace equiaffine::internal {

inline constexpr std::size_t number_of_attribute_rows = attribute_table<double>.size();

/// Whether each component of each row of attribute_table is selected.
using Selected_components = std::array<std::array<bool, 6>, number_of_attribute_rows>;

/// Whether `name` selects this component of the row.
constexpr bool is_selected_by(const Attribute_row<double>& row, std::size_t component, std::string_view name) {
  using namespace attribute_lists;
  if (name == "basic") return (row.lists & basic) == basic;
  if (name == "all") return (row.lists & all) != 0;
  if (name == "signature") return (row.lists & signature) != 0;
  return name == row.name || name == row.column(component);
}

/// Selects all components that `name` stands for. Returns false if it is unknown.
inline bool select_by_name(Selected_components& is_selected, std::string_view name) {
  bool is_known = name == "status";
  for (std::size_t n = 0; n < number_of_attribute_rows; ++n)
    for (std::size_t i = 0; i < attribute_table<double>[n].size(); ++i)
      if (is_selected_by(attribute_table<double>[n], i, name)) is_selected[n][i] = is_known = true;
  return is_known;
}

/// Reads a list of names with commas between them. \throw Input_error for an unknown name.
inline Selected_components read_attribute_names(std::string_view list) {
  Selected_components is_selected{};
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string_view name = list.substr(begin, end - begin);
    if (!select_by_name(is_selected, name))
      throw Input_error("unknown attribute '" + std::string(name) +
                        "': use basic, all, none, or a list of names such as normal,affine_mean_curvature,status");
    begin = end + 1;
  }
  return is_selected;
}

} // namespace equiaffine::internal

#endif
