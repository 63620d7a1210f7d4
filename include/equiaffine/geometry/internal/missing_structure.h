// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of NaN for numbers that do not exist, and the test whether all numbers are finite.
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_MISSING_STRUCTURE_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_MISSING_STRUCTURE_H

#include <equiaffine/geometry/Affine_structure_3.h>
#include <equiaffine/geometry/Euclidean_structure_3.h>
#include <equiaffine/number/select.h>

#include <cstddef>
#include <limits>

namespace equiaffine::internal {

template <class FT>
Euclidean_structure_3<FT> no_euclidean_structure() {
  const FT nan = std::numeric_limits<FT>::quiet_NaN();
  return {{nan, nan, nan}, nan, nan, {nan, nan, nan}, {nan, nan, nan}, nan, nan};
}

template <class FT>
Affine_structure_3<FT> no_affine_structure() {
  const FT nan = std::numeric_limits<FT>::quiet_NaN();
  return {{{nan, nan, nan}, {nan, nan, nan}, nan, nan, nan, {nan, nan, nan, nan}, {nan, nan}, {nan, nan, nan, nan}},
          false,
          nan,
          nan,
          {nan, nan, nan, nan, nan, nan},
          nan,
          {nan, nan, nan},
          {nan, nan, nan},
          {nan, nan, nan},
          {nan, nan, nan, nan}};
}

/// Whether all numbers are finite. Only some are tested, but every coefficient of the jet, and every power of d, takes
/// part in one of these.
template <class FT>
Mask_of<FT> is_finite(const Affine_invariants_3<FT>& s) {
  FT sum = s.gaussian_curvature + s.mean_curvature + s.pick_invariant;
  for (std::size_t i = 0; i < 3; ++i) sum += s.conormal[i] + s.normal[i];
  return is_finite_number(sum);
}

template <class FT>
Mask_of<FT> is_finite(const Euclidean_structure_3<FT>& s) {
  return is_finite_number(FT(s.k1 + s.gaussian_curvature));
}

} // namespace equiaffine::internal

#endif
