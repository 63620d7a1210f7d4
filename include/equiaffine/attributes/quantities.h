// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_QUANTITIES_H
#define EQUIAFFINE_ATTRIBUTES_QUANTITIES_H

#include <equiaffine/attributes/attribute_table.h>

#include <cmath>
#include <string_view>

namespace equiaffine {

/// What people call the scalar attribute with that name, or null for one that has no label and for one of somebody
/// else.
constexpr const Quantity* find_quantity(std::string_view name) {
  for (const auto& row : attribute_table<double>)
    if (row.name == name && !row.quantity.label.empty()) return &row.quantity;
  return nullptr;
}

/// The place at which the attribute with that name is offered, among others of a page or picture: smaller ones first.
constexpr int rank_of_quantity(std::string_view name) {
  const Quantity* const quantity = find_quantity(name);
  return quantity ? quantity->rank : Quantity::unranked;
}

/// The difference below which two numbers of a column are equal but for rounding, on a surface whose box has that
/// diagonal: 1e-9 in the surface's own unit of length, the accuracy promised for curvatures. Zero, nothing known, for
/// an attribute of somebody else.
inline double rounding_of_quantity(std::string_view name, double diagonal) {
  const Quantity* const quantity = find_quantity(name);
  if (quantity == nullptr || !(diagonal > 0)) return 0;
  return 1e-9 * std::pow(diagonal, quantity->weight / 2.);
}

} // namespace equiaffine

#endif
