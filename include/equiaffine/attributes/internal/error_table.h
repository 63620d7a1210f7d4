// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_ERROR_TABLE_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_ERROR_TABLE_H

#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/geometry/euclidean_structure.h>

#include <array>
#include <cmath>
#include <string_view>

namespace equiaffine::internal {

// The numbers of which errors are called parts.

/// An angle is known to 100 % within this many degrees.
inline constexpr double whole_angle = 30;

template <class FT>
FT affine_size(const Local_structure_3<FT>& s) {
  return std::abs(s.affine.gaussian_curvature) + s.affine.mean_curvature * s.affine.mean_curvature;
}

/// An error of an affine curvature that does not matter: 1e-9 of the size that is natural beside K_e, a power of |K_e|.
/// A K that is zero is known to within this, but not to within any part of itself.
template <class FT>
FT negligible_error(const FT& euclidean_gaussian_curvature, const FT& power) {
  return FT(1e-9) * std::pow(std::abs(euclidean_gaussian_curvature), power);
}

template <class FT>
FT curved_size(const Local_structure_3<FT>& s) {
  return curvedness(s.euclidean.k1, s.euclidean.k2);
}

template <class FT>
FT angle_size(const Local_structure_3<FT>&) {
  return whole_angle;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// An attribute whose error fits estimate. Files have the estimate in the column NAME_error.
template <class FT>
struct Error_row {
  std::string_view attribute;
  FT (*get)(const Local_structure_error_3<FT>&);
  /// The number of which an error is called a part: it is not zero where a curvature only changes its sign.
  FT (*size)(const Local_structure_3<FT>&);
  std::string_view name_of_size; ///< as the program writes it
  FT power_of_negligible = 0;    ///< of |K_e|, in negligible_error(); 0 if no error is negligible

  /// Whether a number is known to within a part of its size, or its error does not matter.
  bool is_known(const Local_structure_3<FT>& structure, const Local_structure_error_3<FT>& error, double part) const {
    return get(error) <= part * size(structure) ||
           (power_of_negligible > 0 &&
            get(error) <= internal::negligible_error(structure.euclidean.gaussian_curvature, power_of_negligible));
  }
};

/// All of them, the two that splines have, too, first.
template <class FT>
inline constexpr auto error_table = [] {
  using Row = Error_row<FT>;
  using Error = Local_structure_error_3<FT>;
  using Structure = Local_structure_3<FT>;
  constexpr auto angle = internal::angle_size<FT>;
  constexpr std::string_view angle_name = "30 degrees", curvedness = "the curvedness";
  return std::array{
      Row{"affine_gaussian_curvature", [](const Error& e) { return e.affine_gaussian_curvature; },
          internal::affine_size<FT>, "|K| + H^2", 1.5},
      Row{"affine_mean_curvature", [](const Error& e) { return e.affine_mean_curvature; },
          [](const Structure& s) -> FT { return std::sqrt(internal::affine_size(s)); }, "(|K| + H^2)^(1/2)", .75},
      Row{"pick_invariant", [](const Error& e) { return e.pick_invariant; },
          [](const Structure& s) -> FT { return std::abs(s.affine.pick_invariant); }, "|J|", .75},
      Row{"affine_normal", [](const Error& e) { return e.affine_normal; }, angle, angle_name},
      Row{"affine_normal_angle", [](const Error& e) { return std::hypot(e.affine_normal, e.normal); }, angle,
          angle_name},
      Row{"affine_area_density", [](const Error& e) { return e.affine_area_density; },
          [](const Structure& s) -> FT { return affine_area_density(s.euclidean.gaussian_curvature); }, "itself"},
      Row{"conormal", [](const Error& e) { return e.normal; }, angle, angle_name},
      Row{"normal", [](const Error& e) { return e.normal; }, angle, angle_name},
      Row{"gaussian_curvature", [](const Error& e) { return e.euclidean_gaussian_curvature; },
          [](const Structure& s) -> FT { return internal::curved_size(s) * internal::curved_size(s); },
          "the square of the curvedness"},
      Row{"mean_curvature", [](const Error& e) { return e.euclidean_mean_curvature; }, internal::curved_size<FT>,
          curvedness},
      Row{"k1", [](const Error& e) { return e.k1; }, internal::curved_size<FT>, curvedness},
      Row{"k2", [](const Error& e) { return e.k2; }, internal::curved_size<FT>, curvedness},
  };
}();

} // namespace equiaffine

#endif
