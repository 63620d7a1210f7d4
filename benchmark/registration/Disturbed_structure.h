// SPDX-License-Identifier: GPL-3.0-or-later
// A surface with wrong affine structure, but correct points and normals.
#ifndef EQUIAFFINE_BENCHMARK_REGISTRATION_DISTURBED_STRUCTURE_H
#define EQUIAFFINE_BENCHMARK_REGISTRATION_DISTURBED_STRUCTURE_H

#include "registration/Framed_surface_3.h"
#include "support/registration_cases.h"
#include <equiaffine/number/Jet_3.h>

#include <Eigen/Core>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace registration_runs {

using equiaffine::internal::Framed_point_3;
using registration_cases::Random;

/// Changes the structure of a function at a point by normal deviates that depend on the point: curvatures by a fraction
/// of their size, their derivatives along the surface by three times this fraction, and the frame by this fraction of
/// itself in every direction.
class Disturbed_structure final : public equiaffine::internal::Framed_function_3 {
public:
  Disturbed_structure(equiaffine::Any_function_3 function, double part, unsigned seed)
      : Framed_function_3(std::move(function)), part_(part), seed_(seed) {}

  Framed_point_3 framed_point(const Eigen::Vector3d& p, equiaffine::Map_kind kind) const override {
    Framed_point_3 result = Framed_function_3::framed_point(p, kind);
    if (!result.has_frame()) return result;
    Random random(number_of(p));
    const double before = result.invariants[4];
    disturb_curvatures(result, random);
    const double root = std::exp(before - result.invariants[4]); // of the ratio of the scales
    const Eigen::Matrix3d deviates = Eigen::Matrix3d::NullaryExpr([&] { return random.normal(); });
    result.basis *= Eigen::Vector3d(root, root, root * root).asDiagonal();
    result.basis *= Eigen::Matrix3d::Identity() + part_ * deviates;
    return result;
  }

private:
  using Curvature = equiaffine::Jet_3<double, 1>; ///< with its derivatives along the two tangent vectors of the frame

  unsigned number_of(const Eigen::Vector3d& p) const {
    std::uint64_t number = seed_;
    for (const double x : p) number = (number ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
    return unsigned((number >> 32) % 2147483000u + 1);
  }

  void disturb(Curvature& x, double size, Random& random) const {
    auto& c = x.coefficients();
    c[0] += part_ * size * random.normal();
    for (std::size_t n = 1; n < 3; ++n) c[n] *= 1 + 3 * part_ * random.normal();
  }

  /// The signature consists of H, J, D = H^2 - K and Theta; see Affine_frame_3.
  void disturb_curvatures(Framed_point_3& p, Random& random) const {
    const auto invariant = [&](Eigen::Index i) {
      Curvature x(p.invariants[i]);
      for (std::size_t n = 0; n < 2; ++n) x.coefficients()[n + 1] = p.gradient(i, Eigen::Index(n));
      return x;
    };
    const Curvature r = exp(2 * invariant(4));
    Curvature H = invariant(0) * r, J = invariant(1) * r, D = square(invariant(2) * r),
              Theta = invariant(3) * D * square(r);
    const double sign = p.invariants[2] < 0 ? -1 : 1;
    disturb(H, H.value(), random);
    disturb(J, J.value(), random);
    disturb(Theta, Theta.value(), random);
    disturb(D, std::abs(sign * D.value() + H.value() * H.value()), random);
    const double disturbed_sign = D.value() < 0 ? -sign : sign;
    if (D.value() < 0) D = -D;
    const Curvature scale = sqrt(square(H) + square(J) + D);
    const std::array<Curvature, 5> disturbed = {H / scale, J / scale, disturbed_sign * sqrt(D) / scale,
                                                Theta / (D * square(scale)), log(scale) / 2};
    for (std::size_t i = 0; i < 5; ++i) {
      p.invariants[Eigen::Index(i)] = disturbed[i].value();
      for (std::size_t n = 0; n < 2; ++n)
        p.gradient(Eigen::Index(i), Eigen::Index(n)) = disturbed[i].coefficients()[n + 1];
    }
  }

  double part_;
  unsigned seed_;
};

} // namespace registration_runs

#endif
