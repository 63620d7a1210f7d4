// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SURFACE_ORACLE_3_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SURFACE_ORACLE_3_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/registration/certainty_of_fit.h>
#include <equiaffine/registration/internal/framed_point.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>
#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// The distance from a point to the surface to first order, and the direction in which it grows. The distance is NaN
/// where the function is not defined.
struct Signed_distance_3 {
  double distance;
  Eigen::Vector3d normal;
};

/// Registration asks a function, whatever its type, for frames on its zero set and distances from it, in doubles.
class Surface_oracle_3 {
public:
  virtual ~Surface_oracle_3() = default;
  virtual Framed_point_3 framed_point(const Eigen::Vector3d& p, Map_kind kind) const = 0;
  virtual Jet_3<double, 1> first_order(const Eigen::Vector3d& p) const = 0;

  /// How far the curvatures at a point can be trusted, from 0 to 1: less than 1 for fits, which estimate their errors.
  virtual double certainty(const Eigen::Vector3d& p) const = 0;

  Signed_distance_3 distance(const Eigen::Vector3d& p) const {
    const auto jet = first_order(p);
    const auto& c = jet.coefficients();
    const Eigen::Vector3d gradient(c[1], c[2], c[3]);
    const double length = gradient.stableNorm();
    return {c[0] / length, gradient / length};
  }

  /// Moves a point towards the surface by Newton's steps along the gradient.
  Eigen::Vector3d moved_to_surface(Eigen::Vector3d p, int steps) const {
    for (int step = 0; step < steps; ++step) {
      const auto [distance, normal] = this->distance(p);
      p -= distance * normal;
    }
    return p;
  }
};

/// The oracle of a model of ImplicitFunctionTraits_3. Its domain is the box of the function.
template <class Traits>
class Oracle_of_traits_3 final : public Surface_oracle_3 {
public:
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;

  explicit Oracle_of_traits_3(const Traits& traits) : traits_(traits), box_(traits.bbox()) {}

  Framed_point_3 framed_point(const Eigen::Vector3d& p, Map_kind kind) const override {
    return internal::framed_point([this](const Eigen::Vector3d& q) { return taylor(q); }, p, kind);
  }

  Jet_3<double, 1> first_order(const Eigen::Vector3d& p) const override {
    if (!contains(p)) return Jet_3<double, 1>(std::numeric_limits<double>::quiet_NaN());
    return in_doubles(equiaffine::first_order(traits_, point(p)));
  }

  double certainty(const Eigen::Vector3d& p) const override {
    if constexpr (requires { traits_.certainty(point(p)); }) return traits_.certainty(point(p));
    else if constexpr (requires { traits_.structure(point(p)).error; })
      return certainty_of_fit(traits_.structure(point(p)));
    else return 1;
  }

private:
  Jet_3<double> taylor(const Eigen::Vector3d& p) const {
    if (!contains(p)) return Jet_3<double>(std::numeric_limits<double>::quiet_NaN());
    return in_doubles(traits_.taylor(point(p)));
  }

  bool contains(const Eigen::Vector3d& p) const {
    for (int a = 0; a < 3; ++a)
      if (!(p[a] >= box_.min(a) && p[a] <= box_.max(a))) return false;
    return true;
  }

  static Point_3 point(const Eigen::Vector3d& p) { return Point_3(FT(p[0]), FT(p[1]), FT(p[2])); }

  template <int Order>
  static Jet_3<double, Order> in_doubles(const Jet_3<FT, Order>& jet) {
    Jet_3<double, Order> result;
    for (std::size_t n = 0; n < jet.size; ++n) result.coefficients()[n] = CGAL::to_double(jet.coefficients()[n]);
    return result;
  }

  Traits traits_;
  CGAL::Bbox_3 box_;
};

} // namespace equiaffine::internal

#endif
