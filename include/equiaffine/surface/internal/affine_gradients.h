// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_AFFINE_GRADIENTS_H
#define EQUIAFFINE_SURFACE_INTERNAL_AFFINE_GRADIENTS_H

#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/affine_frame.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// The derivative of a function at 0 and an estimate of its error.
template <class FT>
struct Derivative {
  FT value = std::numeric_limits<FT>::quiet_NaN(), error = std::numeric_limits<FT>::infinity();
};

/// The derivatives at 0 of three functions `f(t)` by central differences with steps `step`, `step` / 2, ...,
/// extrapolated to step 0. For each function, returns the entry of the extrapolation table that differs least from
/// its neighbors (Ridders: Accurate computation of F'(x) and F'(x) F''(x), 1982). Steps at which a function is not
/// finite are skipped.
template <class FT, class F>
std::array<Derivative<FT>, 3> derivatives_at_zero(F f, FT step) {
  constexpr std::size_t levels = 10;
  std::array<std::array<FT, levels>, 3> last{}, row{};
  std::array<Derivative<FT>, 3> best;
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
        if (error < best[n].error) best[n] = {row[n][m], error};
      }
    }
    last = row;
    ++known;
  }
  return best;
}

/// The structure at a point, and the derivatives of K, H, and J along the principal directions. The derivatives are
/// NaN if the point is not regular.
template <class FT>
struct Differentiated_structure_3 {
  Local_structure_3<FT> structure;
  std::array<FT, 3> along1, along2;
};

/// The gradients of K, H, and J on the level set, as covectors on tangent vectors, from derivatives of order 5: the
/// chart of an expansion whose coefficients are expansions of order 1, in natural units. The inner expansions are
/// along the vectors e_u and e_v of the chart, or conjugate ones. Derivatives along the axes would lose digits: if f
/// is nearly a square, f_z varies strongly along the axes but little along the surface.
template <class FT>
std::array<std::array<FT, 3>, 3> gradients_of_invariants(const Jet_3<FT, 5>& given) {
  using Number = Jet_3<FT, 1>;
  const Natural_units_3<FT> units(given);
  const Jet_3<FT, 5> jet = units.apply(given);
  Jet_3<FT> fixed;
  std::copy_n(jet.coefficients().begin(), fixed.size, fixed.coefficients().begin());
  Monge_chart_3<FT> chart(fixed);
  chart = chart.conjugate(chart.is_nearly_square);
  const std::size_t w = chart.pivot_is_x ? 0 : chart.pivot_is_y ? 1 : 2, u = (w + 1) % 3, v = (w + 2) % 3;
  const FT &a = chart.a, &b = chart.b, &shear = chart.shear;
  Jet_3<Number> moving;
  for (std::size_t n = 0; n < moving.size; ++n) {
    const auto [i, j, k] = monomials[n];
    const std::array<FT, 3> along = {FT(i + 1) * jet.coefficient(i + 1, j, k), FT(j + 1) * jet.coefficient(i, j + 1, k),
                                     FT(k + 1) * jet.coefficient(i, j, k + 1)};
    const FT along_u = along[u] - a * along[w], along_v = along[v] - b * along[w] - shear * along_u;
    moving.coefficients()[n].coefficients() = {jet.coefficients()[n], along_u, along_v, FT(0)};
  }
  const auto& c = moving.coefficients();
  const auto invariants = affine_invariants(
      Monge_chart_3<Number>(moving, {chart.pivot_is_x, chart.pivot_is_y, {FT(1) / c[1], FT(1) / c[2], FT(1) / c[3]}}));
  std::array<std::array<FT, 3>, 3> gradients{};
  for (std::size_t n = 0; n < 3; ++n) {
    const Number& invariant = n == 0   ? invariants.gaussian_curvature
                              : n == 1 ? invariants.mean_curvature
                                       : invariants.pick_invariant;
    gradients[n][u] = invariant.coefficients()[1];
    gradients[n][v] = invariant.coefficients()[2] + shear * gradients[n][u];
    for (FT& x : gradients[n]) units.restore_all(n == 0 ? -16 : -10, x);
  }
  return gradients;
}

/// The derivatives of K, H, and J at a regular point along a unit vector, from differences of invariants of
/// neighboring level sets. They are NaN if the error exceeds a hundredth of the derivative and, for derivatives near
/// 0, a millionth of its natural size.
template <class Traits>
std::array<typename Traits::FT, 3> differences_along(const Traits& traits, const typename Traits::Point_3& p,
                                                     const Local_structure_3<typename Traits::FT>& structure,
                                                     const std::array<typename Traits::FT, 3>& direction) {
  using FT = typename Traits::FT;
  const typename Traits::Vector_3 along(direction[0], direction[1], direction[2]);
  const auto invariants = [&](FT t) {
    const auto s = local_structure(traits.taylor(p + t * along)).affine;
    return std::array{s.gaussian_curvature, s.mean_curvature, s.pick_invariant};
  };
  const auto& euclidean = structure.euclidean;
  const FT greatest = std::max(std::abs(euclidean.k1), std::abs(euclidean.k2));
  const FT size = std::pow(std::abs(euclidean.gaussian_curvature), FT(0.75));
  const std::array<FT, 3> natural = {size * size, size, size};
  const auto derivatives = derivatives_at_zero(invariants, FT(0.1) / greatest);
  std::array<FT, 3> result;
  for (std::size_t n = 0; n < 3; ++n) {
    const auto& [value, error] = derivatives[n];
    const bool is_known = error <= FT(0.01) * std::abs(value) || error <= FT(1e-6) * greatest * natural[n];
    result[n] = is_known ? value : std::numeric_limits<FT>::quiet_NaN();
  }
  return result;
}

template <class Traits>
Differentiated_structure_3<typename Traits::FT> differentiated_structure(const Traits& traits,
                                                                         const typename Traits::Point_3& p) {
  using FT = typename Traits::FT;
  Differentiated_structure_3<FT> result{local_structure(traits.taylor(p)), {}, {}};
  result.along1.fill(std::numeric_limits<FT>::quiet_NaN());
  result.along2 = result.along1;
  if (result.structure.status != Point_status::REGULAR) return result;
  const auto &direction1 = result.structure.euclidean.direction1, &direction2 = result.structure.euclidean.direction2;
  if (const auto jet = fifth_order(traits, p)) {
    const auto gradients = gradients_of_invariants(*jet);
    for (std::size_t n = 0; n < 3; ++n) {
      const auto& g = gradients[n];
      result.along1[n] = g[0] * direction1[0] + g[1] * direction1[1] + g[2] * direction1[2];
      result.along2[n] = g[0] * direction2[0] + g[1] * direction2[1] + g[2] * direction2[2];
    }
  } else {
    result.along1 = differences_along(traits, p, result.structure, direction1);
    result.along2 = differences_along(traits, p, result.structure, direction2);
  }
  return result;
}

/// Returns the norms of the gradients, which exist even where the frame does not, for example on a sphere.
template <class FT>
std::array<FT, 3> gradient_norms_of(const Differentiated_structure_3<FT>& s) {
  const auto& euclidean = s.structure.euclidean;
  const FT scale = std::sqrt(std::sqrt(std::abs(euclidean.gaussian_curvature)));
  std::array<FT, 3> norms;
  for (std::size_t n = 0; n < 3; ++n) {
    const FT size = std::abs(s.along1[n]) + std::abs(s.along2[n]); // its square may overflow
    const FT part1 = s.along1[n] / size, part2 = s.along2[n] / size;
    const FT square = std::abs(scale * (part1 * part1 / euclidean.k1 + part2 * part2 / euclidean.k2));
    norms[n] = size == FT(0) ? size : FT(size * std::sqrt(square));
  }
  return norms;
}

/// Returns the derivatives along e1 and e2 of the affine frame, which are combinations of the principal directions.
template <class FT>
std::array<std::array<FT, 2>, 3> gradients_in_frame(const Differentiated_structure_3<FT>& s) {
  const auto& euclidean = s.structure.euclidean;
  const Affine_frame_3<FT> frame = affine_frame(s.structure.affine);
  std::array<std::array<FT, 2>, 3> gradients;
  for (std::size_t n = 0; n < 3; ++n)
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& e = i == 0 ? frame.e1 : frame.e2;
      FT part1(0), part2(0);
      for (std::size_t k = 0; k < 3; ++k) {
        part1 += e[k] * euclidean.direction1[k];
        part2 += e[k] * euclidean.direction2[k];
      }
      gradients[n][i] = part1 * s.along1[n] + part2 * s.along2[n];
    }
  return gradients;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Computes the norms of the gradients of K, H, and J on the surface in the affine metric, in this order. Together
/// with K, H, and J they are the signature of the surface at p, which is invariant under affine maps of
/// determinant 1. A norm is the root of the absolute value of |K_e|^(1/4) (a^2 / k1 + b^2 / k2), where a and b are
/// the derivatives along the principal directions. On hyperbolic surfaces the metric is indefinite, and the norm is
/// also 0 for gradients along an asymptotic direction. Units: length^(-15/4), length^(-9/4), length^(-9/4).
///
/// They depend on derivatives of order 5: those of the function if it has \ref fifth_order(), otherwise differences
/// of invariants of neighboring level sets, which take 40 expansions and are NaN if their error may exceed a
/// hundredth. All are NaN if p is not regular.
template <ImplicitFunctionTraits_3 Traits>
std::array<typename Traits::FT, 3> affine_gradient_norms(const Traits& traits, const typename Traits::Point_3& p) {
  return internal::gradient_norms_of(internal::differentiated_structure(traits, p));
}

/// The gradients of K, H, and J on the surface at a point, each as the derivatives along the vectors e1 and e2 of its
/// affine_frame(). With a the determinant of a map they have the weights a^(-5/4), a^(-3/4), and a^(-3/4). The norms
/// of affine_gradient_norms() are the roots of a^2 + b^2 at an elliptic point and of |2 a b| at a hyperbolic one.
template <class FT>
struct Affine_gradients_3 {
  std::array<FT, 2> gaussian_curvature, mean_curvature, pick_invariant;
};

/// Computes the gradients like affine_gradient_norms(), for the side to which the gradient of f points. They are NaN
/// where the frame does not exist.
template <ImplicitFunctionTraits_3 Traits>
Affine_gradients_3<typename Traits::FT> affine_gradients(const Traits& traits, const typename Traits::Point_3& p) {
  const auto gradients = internal::gradients_in_frame(internal::differentiated_structure(traits, p));
  return {gradients[0], gradients[1], gradients[2]};
}

} // namespace equiaffine

#endif
