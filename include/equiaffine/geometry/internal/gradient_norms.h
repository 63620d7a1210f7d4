// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_GRADIENT_NORMS_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_GRADIENT_NORMS_H

#include <equiaffine/geometry/local_structure.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// The derivatives at 0 of three functions of a number, `f(t)`, by central differences with steps `step`, `step` / 2,
/// ..., extrapolated to step 0; for each function the entry of the table that differs least from its neighbors
/// (Ridders: Accurate computation of F'(x) and F'(x) F''(x), 1982). Steps at which a function is not finite do not
/// count.
template <class FT, class F>
std::array<FT, 3> derivatives_at_zero(F f, FT step) {
  constexpr std::size_t levels = 10;
  std::array<std::array<FT, levels>, 3> last{}, row{};
  std::array<FT, 3> best, least_error;
  best.fill(std::numeric_limits<FT>::quiet_NaN());
  least_error.fill(std::numeric_limits<FT>::infinity());
  for (std::size_t level = 0, known = 0; level < levels; ++level, step /= FT(2)) {
    const std::array<FT, 3> ahead = f(step), behind = f(-step);
    FT sum(0);
    for (std::size_t n = 0; n < 3; ++n) sum += row[n][0] = (ahead[n] - behind[n]) / (FT(2) * step);
    if (!std::isfinite(sum)) {
      known = 0;
      continue;
    }
    for (std::size_t n = 0; n < 3; ++n) {
      FT power(1);
      for (std::size_t m = 1; m <= known; ++m) {
        power *= FT(4);
        row[n][m] = row[n][m - 1] + (row[n][m - 1] - last[n][m - 1]) / (power - FT(1));
        const FT error = std::max(std::abs(row[n][m] - row[n][m - 1]), std::abs(row[n][m] - last[n][m - 1]));
        if (error < least_error[n]) {
          least_error[n] = error;
          best[n] = row[n][m];
        }
      }
    }
    last = row;
    ++known;
  }
  return best;
}

template <class Traits>
std::array<typename Traits::FT, 3> affine_gradient_norms_at(const Traits& traits, const typename Traits::Point_3& p) {
  using FT = typename Traits::FT;
  using Vector_3 = typename Traits::Vector_3;
  const auto structure = local_structure(traits.taylor(p));
  std::array<FT, 3> norms;
  norms.fill(std::numeric_limits<FT>::quiet_NaN());
  if (structure.status != Point_status::REGULAR) return norms;
  const auto& [normal, k1, k2, direction1, direction2, gaussian_curvature, mean_curvature] = structure.euclidean;
  const FT step = FT(0.1) / std::max(std::abs(k1), std::abs(k2));
  const auto derivatives_along = [&](const std::array<FT, 3>& direction) {
    const Vector_3 along(direction[0], direction[1], direction[2]);
    const auto invariants = [&](FT t) {
      const auto s = local_structure(traits.taylor(p + t * along)).affine;
      return std::array{s.gaussian_curvature, s.mean_curvature, s.pick_invariant};
    };
    return derivatives_at_zero(invariants, step);
  };
  const auto a = derivatives_along(direction1), b = derivatives_along(direction2);
  const FT scale = std::sqrt(std::sqrt(std::abs(gaussian_curvature)));
  for (std::size_t n = 0; n < 3; ++n) norms[n] = std::sqrt(std::abs(scale * (a[n] * a[n] / k1 + b[n] * b[n] / k2)));
  return norms;
}

} // namespace equiaffine::internal

#endif
