// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_H
#define EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_H

#include <equiaffine/geometry/Monge_chart_3.h>

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

namespace internal {

/// sqrt(x^2 + y^2) without overflow or underflow of the squares, in operations that packs have.
template <class FT>
FT length(const FT& x, const FT& y) {
  using std::abs;
  using std::sqrt;
  const FT u = abs(x), v = abs(y), large = select(u > v, u, v), small = select(u > v, v, u);
  const FT ratio = select(large == FT(0), FT(0), FT(small / large));
  return large * sqrt(FT(FT(1) + ratio * ratio));
}

} // namespace internal

/// Euclidean structure from the second derivatives of a chart.
template <class FT>
Euclidean_structure_3<FT> euclidean_structure(const Monge_chart_3<FT>& chart) {
  using internal::select;
  using std::abs;
  using std::sqrt;
  const FT &a = chart.a, &b = chart.b;
  const FT e = FT(1) + a * a, w2 = e + b * b, w = sqrt(w2), r = chart.sign / w;

  Euclidean_structure_3<FT> s;
  s.normal = chart.unpermuted(a * r, b * r, r);

  // The second fundamental form in the orthonormal tangent basis t1 = e_u / sqrt(e), t2 = (e_v - f e_u) sqrt(e) / w.
  const FT f = a * b / e, sqrt_e = sqrt(e), zero(0);
  const FT huu = chart.h_uu(), huv = chart.h_uv(), hvv = chart.h_vv();
  const FT l = r * huu / e;
  const FT m = r * (huv - f * huu) / w;
  const FT n = r * (hvv - f * (FT(2) * huv - f * huu)) * e / w2;

  s.mean_curvature = (l + n) / FT(2);
  s.gaussian_curvature = chart.d() / (w2 * w2);
  const FT half_difference = (l - n) / FT(2), radius = internal::length(half_difference, m);
  // The curvature of larger magnitude has no cancellation, the other one follows from the product.
  const auto first_is_larger = s.mean_curvature >= zero;
  const FT larger = s.mean_curvature + select(first_is_larger, radius, FT(-radius));
  const FT smaller = select(larger == zero, zero, FT(s.gaussian_curvature / larger));
  // Equal at an umbilic, whatever the rounding.
  s.k1 = select(first_is_larger || smaller < larger, larger, smaller);
  s.k2 = select(first_is_larger && smaller < larger, smaller, larger);

  // The eigenvector of k1 in (t1, t2); at an umbilic any direction will do.
  const auto along_first = half_difference >= zero;
  const FT sum = radius + abs(half_difference);
  FT c = select(along_first, sum, FT(abs(m))), t = select(along_first, m, select(m < zero, FT(-sum), sum));
  const FT length = internal::length(c, t);
  const auto is_umbilic = length == zero;
  c = select(is_umbilic, FT(1), FT(c / length));
  t = select(is_umbilic, zero, FT(t / length));
  const FT u2 = -f * sqrt_e / w, v2 = sqrt_e / w; // t2 in (e_u, e_v)
  s.direction1 = chart.tangent(c / sqrt_e + t * u2, t * v2);
  s.direction2 = chart.tangent(chart.sign * (c * u2 - t / sqrt_e), chart.sign * c * v2);
  return s;
}

} // namespace equiaffine

#endif
