// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_QUANTITIES_H
#define EQUIAFFINE_ATTRIBUTES_QUANTITIES_H

#include <array>
#include <cmath>
#include <string_view>

namespace equiaffine::internal {

/// How a scalar attribute is called where people read it.
struct Quantity {
  std::string_view name; ///< of the attribute
  std::string_view label;
  std::string_view symbol; ///< UTF-8
  std::string_view group;
  int weight; ///< under p -> s p the number is multiplied by s^(weight / 2)
};

/// The quantities this library computes, in the order in which they are offered.
inline constexpr std::array<Quantity, 10> quantities = {{
    {"affine_gaussian_curvature", "Affine Gaussian curvature", "K", "Affine", -6},
    {"affine_mean_curvature", "Affine mean curvature", "H", "Affine", -3},
    {"pick_invariant", "Pick invariant", "J", "Affine", -3},
    {"affine_k1", "Affine principal curvature 1", "κ₁", "Affine", -3},
    {"affine_k2", "Affine principal curvature 2", "κ₂", "Affine", -3},
    {"quadric_defect", "Quadric defect", "|T| / |II|²", "Affine", 0},
    {"gaussian_curvature", "Gaussian curvature", "Kₑ", "Euclidean", -4},
    {"mean_curvature", "Mean curvature", "Hₑ", "Euclidean", -2},
    {"k1", "Principal curvature 1", "k₁", "Euclidean", -2},
    {"k2", "Principal curvature 2", "k₂", "Euclidean", -2},
}};

/// The entry with that name, or null for an attribute of somebody else.
constexpr const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : quantities)
    if (quantity.name == name) return &quantity;
  return nullptr;
}

/// Differences below this are rounding, on a surface whose box has that diagonal: 1e-9 in the surface's own unit of
/// length, the accuracy promised for curvatures. Zero, nothing known, for an attribute of somebody else.
inline double resolution(std::string_view name, double diagonal) {
  const Quantity* const quantity = find_quantity(name);
  if (quantity == nullptr || !(diagonal > 0)) return 0;
  return 1e-9 * std::pow(diagonal, quantity->weight / 2.);
}

} // namespace equiaffine::internal

#endif
