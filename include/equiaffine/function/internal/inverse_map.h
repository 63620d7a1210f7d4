// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_INVERSE_MAP_H
#define EQUIAFFINE_FUNCTION_INTERNAL_INVERSE_MAP_H

#include <CGAL/Aff_transformation_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace equiaffine::internal {

/// `sum` and the products of the coordinates, as if added in twice the precision (Ogita, Rump, Oishi: Accurate sum and
/// dot product, 2005).
template <class FT>
FT sum_of_products(FT sum, const std::array<FT, 3>& x, const std::array<FT, 3>& y) {
  FT error(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const FT product = x[k] * y[k], next = sum + product, part = next - sum;
    error += (sum - (next - part)) + (product - part) + std::fma(x[k], y[k], -product);
    sum = next;
  }
  return sum + error;
}

/// The inverse of an affine map. That of CGAL has errors of the condition of the map or more, which its use multiplies by
/// the condition again. A step of Newton's method squares them, beside what they would be at best. Not finite where there
/// is no inverse.
template <class Kernel>
CGAL::Aff_transformation_3<Kernel> inverse_map(const CGAL::Aff_transformation_3<Kernel>& map) {
  using FT = typename Kernel::FT;
  const CGAL::Aff_transformation_3<Kernel> inverse = map.inverse();
  if constexpr (std::is_floating_point_v<FT>) {
    using Vector = std::array<FT, 3>;
    const auto row = [](const auto& m, int i) { return Vector{m.m(i, 0), m.m(i, 1), m.m(i, 2)}; };
    const auto negative = [](const Vector& v) { return Vector{-v[0], -v[1], -v[2]}; };
    const Vector translation = {map.m(0, 3), map.m(1, 3), map.m(2, 3)};
    std::array<Vector, 3> columns, x;
    for (std::size_t j = 0; j < 3; ++j) {
      const int n = int(j);
      const Vector column = {inverse.m(0, n), inverse.m(1, n), inverse.m(2, n)};
      Vector residual;
      for (std::size_t i = 0; i < 3; ++i) residual[i] = sum_of_products(FT(i == j), negative(row(map, int(i))), column);
      for (std::size_t i = 0; i < 3; ++i) columns[j][i] = sum_of_products(column[i], row(inverse, int(i)), residual);
    }
    Vector t;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = {columns[0][i], columns[1][i], columns[2][i]};
      t[i] = sum_of_products(FT(0), x[i], negative(translation));
      for (const FT number : {x[i][0], x[i][1], x[i][2], t[i]})
        if (!std::isfinite(number)) return inverse; // products left the range
    }
    return {x[0][0], x[0][1], x[0][2], t[0], x[1][0], x[1][1], x[1][2], t[1], x[2][0], x[2][1], x[2][2], t[2]};
  }
  return inverse;
}

} // namespace equiaffine::internal

#endif
