// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_ATTRIBUTE_NAMES_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_ATTRIBUTE_NAMES_H

#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace equiaffine::internal {

inline constexpr std::size_t number_of_attribute_rows = attribute_table<double>.size();

/// Whether `name` selects this component of the row.
constexpr bool is_selected_by(const Attribute_row<double>& row, std::size_t component, std::string_view name) {
  using namespace attribute_lists;
  if (name == "basic") return (row.lists & basic) == basic;
  if (name == "all") return (row.lists & all) != 0;
  if (name == "signature") return (row.lists & signature) != 0;
  return name == row.name || name == row.column(component);
}

/// Calls select(row, component) for all that `name` stands for, in the order of the table. Returns false if it is
/// unknown.
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

/// Reads a list of names with commas between them: calls select(row, component) for what they stand for.
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

#endif
