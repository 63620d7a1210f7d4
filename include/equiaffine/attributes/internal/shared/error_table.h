// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_SHARED_ERROR_TABLE_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_SHARED_ERROR_TABLE_H

#include <equiaffine/attributes/internal/shared/error_sizes.h>
#include <equiaffine/geometry/Local_structure_error_3.h>
#include <equiaffine/geometry/Regular_structure_3.h>
#include <equiaffine/geometry/affine_area_density.h>

#include <array>
#include <cmath>
#include <string_view>

namespace equiaffine {

/// An attribute whose error fits estimate. Files have the estimate in the column NAME_error.
template <class FT>
struct Error_row {
  std::string_view attribute;
  FT (*get)(const Local_structure_error_3<FT>&);
  /// The number of which an error is called a part: it is not zero where a curvature only changes its sign.
  FT (*size)(const Local_structure_3<FT>&);

  /// Whether a number is known to within a part of its size.
  bool is_known(const Local_structure_3<FT>& structure, const Local_structure_error_3<FT>& error, double part) const {
    return get(error) <= part * size(structure);
  }
};

/// All of them, the two that splines have, too, first.
template <class FT>
inline constexpr auto error_table = [] {
  using Row = Error_row<FT>;
  using Error = Local_structure_error_3<FT>;
  using Structure = Local_structure_3<FT>;
  return std::array{
      Row{"affine_gaussian_curvature", [](const Error& e) { return e.gaussian_curvature; }, internal::affine_size<FT>},
      Row{"affine_mean_curvature", [](const Error& e) { return e.mean_curvature; },
          [](const Structure& s) -> FT { return std::sqrt(internal::affine_size(s)); }},
      Row{"pick_invariant", [](const Error& e) { return e.pick_invariant; },
          [](const Structure& s) -> FT { return std::abs(s.affine.pick_invariant); }},
      Row{"affine_normal", [](const Error& e) { return e.affine_normal; }, internal::angle_size<FT>},
      Row{"affine_normal_angle", [](const Error& e) { return std::hypot(e.affine_normal, e.normal); },
          internal::angle_size<FT>},
      Row{"affine_area_density", [](const Error& e) { return e.affine_area_density; },
          [](const Structure& s) -> FT { return affine_area_density(s.euclidean.gaussian_curvature); }},
      Row{"conormal", [](const Error& e) { return e.normal; }, internal::angle_size<FT>},
      Row{"normal", [](const Error& e) { return e.normal; }, internal::angle_size<FT>},
      Row{"gaussian_curvature", [](const Error& e) { return e.euclidean_gaussian_curvature; },
          [](const Structure& s) -> FT { return internal::curved_size(s) * internal::curved_size(s); }},
      Row{"mean_curvature", [](const Error& e) { return e.euclidean_mean_curvature; }, internal::curved_size<FT>},
      Row{"k1", [](const Error& e) { return e.k1; }, internal::curved_size<FT>},
      Row{"k2", [](const Error& e) { return e.k2; }, internal::curved_size<FT>},
  };
}();

} // namespace equiaffine

#endif
