// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_EUCLIDEAN_STRUCTURE_H
#define EQUIAFFINE_EUCLIDEAN_STRUCTURE_H

#include <equiaffine/Monge_chart_3.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace equiaffine {

/// Euclidean structure of an oriented surface at a point. The shape operator is S with dn(X) = -S X for the unit normal
/// n along the gradient: a sphere of radius r with outward gradient has k1 = k2 = -1/r, Gaussian curvature 1/r^2 and
/// mean curvature -1/r. Units: curvatures 1/length, Gaussian curvature 1/length^2.
template <class FT>
struct Euclidean_structure_3 {
  std::array<FT, 3> normal;
  FT k1, k2;                                ///< principal curvatures, k1 >= k2
  std::array<FT, 3> direction1, direction2; ///< unit principal directions; direction1, direction2, normal right-handed
  FT gaussian_curvature, mean_curvature;    ///< k1 k2, (k1 + k2) / 2
};

/// Euclidean structure from the second derivatives of a chart.
/// \pre chart.status is REGULAR or PARABOLIC.
template <class FT>
Euclidean_structure_3<FT> euclidean_structure(const Monge_chart_3<FT>& chart) {
  using std::abs;
  using std::hypot;
  using std::sqrt;
  const FT &a = chart.a, &b = chart.b;
  const FT e = FT(1) + a * a, w2 = e + b * b, w = sqrt(w2), r = chart.sign / w;

  Euclidean_structure_3<FT> s;
  s.normal = chart.unpermuted(a * r, b * r, r);

  // The second fundamental form in the orthonormal tangent basis t1 = e_u / sqrt(e), t2 = (e_v - f e_u) sqrt(e) / w.
  const FT f = a * b / e, sqrt_e = sqrt(e);
  const auto& h = chart.h;
  const FT l = r * h[0] / e;
  const FT m = r * (h[1] - f * h[0]) / w;
  const FT n = r * (h[2] - f * (FT(2) * h[1] - f * h[0])) * e / w2;

  s.mean_curvature = (l + n) / FT(2);
  s.gaussian_curvature = chart.d / (w2 * w2);
  const FT half_difference = (l - n) / FT(2), radius = hypot(half_difference, m);
  // The curvature of larger magnitude has no cancellation, the other one follows from the product.
  const bool first_is_larger = s.mean_curvature >= FT(0);
  const FT larger = first_is_larger ? s.mean_curvature + radius : s.mean_curvature - radius;
  const FT smaller = larger == FT(0) ? FT(0) : s.gaussian_curvature / larger;
  s.k1 = first_is_larger ? larger : std::max(smaller, larger); // equal at an umbilic, whatever the rounding
  s.k2 = first_is_larger ? std::min(smaller, larger) : larger;

  // The eigenvector of k1 in (t1, t2); at an umbilic any direction will do.
  FT c = half_difference >= FT(0) ? radius + half_difference : abs(m);
  FT t = half_difference >= FT(0) ? m : (m < FT(0) ? half_difference - radius : radius - half_difference);
  const FT length = hypot(c, t);
  c = length > FT(0) ? c / length : FT(1);
  t = length > FT(0) ? t / length : FT(0);
  const FT u2 = -f * sqrt_e / w, v2 = sqrt_e / w; // t2 in (e_u, e_v)
  s.direction1 = chart.tangent(c / sqrt_e + t * u2, t * v2);
  s.direction2 = chart.tangent(chart.sign * (c * u2 - t / sqrt_e), chart.sign * c * v2);
  return s;
}

} // namespace equiaffine

#endif
