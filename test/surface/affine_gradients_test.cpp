// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/Transformed_function_traits_3.h>
#include <equiaffine/analytic_functions.h>
#include <equiaffine/surface/internal/shared/affine_gradients.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;

constexpr double R = 0.5, r = 0.2;
const auto torus = make_analytic_traits<Kernel>(analytic_functions::Torus{R, r}, analytic_functions::Torus{R, r}.box());

Kernel::Point_3 on_meridian(double t) { return {R + r * std::cos(t), 0, r * std::sin(t)}; }

auto affine_at(double t) { return local_structure(torus.taylor(on_meridian(t))).affine; }

// K, H and J of a torus change along the meridians only; there the chain rule and the metric give their gradients.
TEST(Affine_gradients, are_derivatives_by_arc_length_of_the_affine_metric) {
  for (const double t : {0.3, 0.9, 1.2, 2.0, 2.6}) {
    const std::array<double, 3> tangent = {-r * std::sin(t), 0, r * std::cos(t)};
    const auto& m = affine_at(t).metric;
    const double squared_speed =
        std::abs(m[0] * tangent[0] * tangent[0] + 2 * m[2] * tangent[0] * tangent[2] + m[5] * tangent[2] * tangent[2]);
    const auto slope = [&](auto invariant) {
      constexpr double h = 1e-3; // differences of order 8
      constexpr std::array<double, 4> weights = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
      double sum = 0;
      for (int n = 1; n <= 4; ++n)
        sum += weights[std::size_t(n - 1)] * (invariant(affine_at(t + n * h)) - invariant(affine_at(t - n * h)));
      return std::abs(sum / h) / std::sqrt(squared_speed);
    };
    const auto norms = affine_gradient_norms(torus, on_meridian(t));
    const std::array<double, 3> expected = {slope([](const auto& s) { return s.gaussian_curvature; }),
                                            slope([](const auto& s) { return s.mean_curvature; }),
                                            slope([](const auto& s) { return s.pick_invariant; })};
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(norms[n], expected[n], 1e-7 * expected[n]) << t << ' ' << n;
  }
}

TEST(Affine_gradients, are_kept_by_maps_of_determinant_one) {
  const Kernel::Aff_transformation_3 map(1, 2, 0.5, 0, 1, 0, 0.3, 0.6, 1.15);
  const Transformed_function_traits_3 image(torus, map);
  for (const double t : {0.4, 1.1, 2.2}) {
    const auto before = affine_gradient_norms(torus, on_meridian(t));
    const auto after = affine_gradient_norms(image, map(on_meridian(t)));
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(after[n], before[n], 1e-6 * before[n]) << t << ' ' << n;
  }
}

TEST(Affine_gradients, vanish_on_affine_spheres) {
  const auto product = [](const auto& x, const auto& y, const auto& z) { return x * y * z; };
  const auto traits = make_analytic_traits<Kernel>(product, CGAL::Bbox_3(0, 0, 0, 4, 4, 4));
  for (const auto& p : {Kernel::Point_3(1, 2, 3), Kernel::Point_3(0.2, 1, 0.7)}) {
    const auto s = local_structure(traits.taylor(p)).affine;
    const auto norms = affine_gradient_norms(traits, p);
    EXPECT_LE(norms[0], 1e-9 * std::pow(std::abs(s.mean_curvature), 2.5));
    EXPECT_LE(norms[1], 1e-9 * std::pow(std::abs(s.mean_curvature), 1.5));
    EXPECT_LE(norms[2], 1e-9 * std::pow(std::abs(s.mean_curvature), 1.5));
  }
}

TEST(Affine_gradients, do_not_exist_at_parabolic_points) {
  for (const double norm : affine_gradient_norms(torus, Kernel::Point_3(R, 0, r))) EXPECT_TRUE(std::isnan(norm));
}

TEST(Affine_gradients, differences_are_extrapolated_and_skip_what_is_not_finite) {
  const auto f = [](double t) {
    const double x = std::exp(t), undefined = std::abs(t) > 0.05 ? NAN : x;
    return std::array{x, std::sin(3 * t), undefined};
  };
  const auto [a, b, c] = internal::derivatives_at_zero(f, 0.1);
  EXPECT_NEAR(a, 1, 1e-11);
  EXPECT_NEAR(b, 3, 1e-11);
  EXPECT_NEAR(c, 1, 1e-11);
}

} // namespace
