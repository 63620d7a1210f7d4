// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_QUANTITIES_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_QUANTITIES_H

#include <equiaffine/attributes/internal/attribute_table.h>

#include <cmath>
#include <string_view>

namespace equiaffine {

/// Returns the words for the scalar attribute with that name, or null if it has no label or is none of our attributes.
constexpr const Quantity* find_quantity(std::string_view name) {
  for (const auto& row : attribute_table<double>)
    if (row.name == name && !row.quantity.label.empty()) return &row.quantity;
  return nullptr;
}

/// Returns the rank of the attribute with that name: pages and pictures offer attributes with smaller ranks first.
constexpr int rank_of_quantity(std::string_view name) {
  const Quantity* const quantity = find_quantity(name);
  return quantity ? quantity->rank : Quantity::unranked;
}

/// Returns whether numbers of that attribute do not exist where the Gaussian curvature is zero. On both sides of such a
/// curve they grow without bound, unless they are zero.
constexpr bool is_undefined_at_parabolic_points(std::string_view name) {
  const Quantity* const quantity = find_quantity(name);
  return quantity != nullptr && quantity->group == "Affine" && !quantity->exists_at_parabolic_points;
}

/// Returns the difference below which two numbers of a column are equal up to rounding, on a surface whose box has that
/// diagonal: 1e-9 in the surface's own unit of length, which is the accuracy promised for curvatures. Returns zero for
/// a column that is none of our attributes, since nothing is known about it.
inline double rounding_of_quantity(std::string_view name, double diagonal) {
  const Quantity* const quantity = find_quantity(name);
  if (quantity == nullptr || !(diagonal > 0)) return 0;
  return 1e-9 * std::pow(diagonal, quantity->weight / 2.);
}

} // namespace equiaffine

#endif
