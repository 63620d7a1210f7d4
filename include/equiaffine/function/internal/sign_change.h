// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_SIGN_CHANGE_H
#define EQUIAFFINE_FUNCTION_INTERNAL_SIGN_CHANGE_H

namespace equiaffine {

/// Whether the values of a function at the ends of a segment have different signs, where a value of zero counts as
/// positive; false if one of them is NaN.
template <class FT>
bool is_sign_change(const FT& first, const FT& second) {
  return (first < FT(0) && second >= FT(0)) || (first >= FT(0) && second < FT(0));
}

/// Returns the place where the linear interpolant of the values at the ends of a segment is zero, as a fraction of the
/// segment; it is halfway if the values are infinite. \pre `is_sign_change(first, second)`
template <class FT>
FT linear_zero(const FT& first, const FT& second) {
  const FT t = first / (first - second);
  return t >= FT(0) && t <= FT(1) ? t : FT(0.5);
}

} // namespace equiaffine

#endif
