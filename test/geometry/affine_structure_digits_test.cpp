// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/random_surfaces.h"
#include "support/anisotropic_surface.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/expand.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <CGAL/Simple_cartesian.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace affine_structure_digits_test {

using namespace equiaffine;
using namespace random_surfaces;
using Kernel = CGAL::Simple_cartesian<double>;

// The invariants of the jet of doubles, computed with 100 digits.
Affine_invariants_3<double> exact_invariants(const Jet_3<double>& jet) {
  using Precise = boost::multiprecision::cpp_bin_float_100;
  Jet_3<Precise> exact;
  for (std::size_t n = 0; n < jet.size; ++n) exact.coefficients()[n] = jet.coefficients()[n];
  const auto s = local_structure(exact).affine;
  Affine_invariants_3<double> result;
  result.gaussian_curvature = s.gaussian_curvature.convert_to<double>();
  result.mean_curvature = s.mean_curvature.convert_to<double>();
  result.pick_invariant = s.pick_invariant.convert_to<double>();
  return result;
}

// There the terms of K are larger than K by a power of 1 / x, and it is well conditioned all the same.
TEST(Affine_structure, the_gaussian_curvature_keeps_its_digits_near_parabolic_curves) {
  const auto quartic = [](const auto& x, const auto& y, const auto& z) { return z - x * x * x * x - y * y * y * y; };
  for (const double x : {1e-9, 1e-6, 1e-3, 0.1}) {
    const double K = local_structure(expand(quartic, {x, 1, x * x * x * x + 1})).affine.gaussian_curvature;
    EXPECT_NEAR(K * 8 * x * x * x, 1, 1e-14) << x;
  }
  for (const char* formula : {"z-x^3-y^2-y^3", "z-x^3-y^2-x*y^3", "x^4+y^4+z^4-1", "z-exp(x^3)-y^2*cos(y)-x^2*y^2"})
    for (const double x : {1e-6, 1e-4, 1e-2}) {
      const auto jet = expand(Expression_3(formula), {x, 0.3, 0.8});
      const double K = local_structure(jet).affine.gaussian_curvature;
      EXPECT_NEAR(K / exact_invariants(jet).gaussian_curvature, 1, 1e-12) << formula << ' ' << x;
    }
}

TEST(Affine_structure, invariants_keep_their_digits_where_a_nearly_parabolic_direction_is_oblique) {
  const Expression_3 torus("(sqrt(x^2+y^2)-2)^2+z^2-1");
  for (const double gap : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9}) {
    const auto jet = expand(torus, {1.2, 1.6 + gap, -1});
    const Affine_invariants_3<double> s = local_structure(jet).affine, expected = exact_invariants(jet);
    const double tolerance = 1e-14 / gap; // roundings of the derivatives change K_e by 1 / gap
    EXPECT_NEAR(s.gaussian_curvature / expected.gaussian_curvature, 1, tolerance) << gap;
    EXPECT_NEAR(s.mean_curvature / expected.mean_curvature, 1, tolerance) << gap;
    EXPECT_NEAR(s.pick_invariant / expected.pick_invariant, 1, tolerance) << gap;
  }
}

// In these coordinates two of the three charts have basis vectors that are nearly parallel for their lengths. The
// values are from 70-digit arithmetic; roundings of the derivatives change K and H of the first point by 5e-8, of the
// last by 2e-4 of themselves.
TEST(Affine_structure, invariants_keep_their_digits_where_a_thin_direction_is_oblique) {
  const char* formula = "(101*x-100*y)^3+(100*y-100*x)^2*z-sin((101*x-100*y)*z)";
  const auto s = local_structure(expand(Expression_3(formula), {.3, .296, .6})).affine;
  EXPECT_NEAR(s.gaussian_curvature / -65.701475492180557, 1, 1e-7);
  EXPECT_NEAR(s.mean_curvature / -1.9942270083903796, 1, 1e-7);
  EXPECT_NEAR(s.pick_invariant / -10.194114153924238, 1, 1e-9);
  const auto f = make_analytic_traits<Kernel>(Expression_3("x^3+y^2*z-sin(x*z)"), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto image = [&](double width, double y) {
    const Kernel::Aff_transformation_3 map(1, 1, 0, 1, 1 + width, 0, 0, 0, 1);
    return local_structure(Transformed_function_traits_3(f, map).taylor(Kernel::Point_3(0.29999999999999993, y, 0.6)))
        .affine;
  };
  EXPECT_NEAR(image(.01, .29599999999999993).mean_curvature / -1.9942270083907584, 1, 1e-7);
  const auto thinnest = image(.001, .2996);
  EXPECT_NEAR(thinnest.gaussian_curvature / -657.01475492179881, 1, 2e-4);
  EXPECT_NEAR(thinnest.mean_curvature / -6.3062995179388644, 1, 5e-4);
}

TEST(Affine_structure, the_pivot_is_right_where_the_hessian_is_nearly_of_rank_one) {
  const Expression_3 square("(x^2+y^2+z^2-1)^2");
  for (const Vector p : {Vector{.6, .8, 1e-3}, {.8, .6, 5e-4}, {1e-3, .6, .8}, {.8, 5e-4, .6}, {.36, .48, .8000001}}) {
    const double value = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1;
    const auto s = affine_structure(Monge_chart_3<double>(expand(square, p)));
    EXPECT_NEAR(s.gaussian_curvature, 1, 4 * value + 1e-14 / value) << p[0] << ' ' << p[1] << ' ' << p[2];
  }
}

TEST(Affine_structure, double_keeps_its_digits_where_components_of_the_gradient_vanish) {
  using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
  std::mt19937 random(13);
  std::uniform_real_distribution<double> unit(-1, 1);
  int regular = 0;
  for (int n = 0; n < 600; ++n) {
    Jet jet;
    for (double& c : jet.coefficients()) c = unit(random);
    const std::size_t kept = std::size_t(n % 3); // of the gradient; sometimes another component is tiny, not zero
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (axis != kept && (n % 2 == 0 || axis != (kept + 1) % 3))
        jet.coefficients()[1 + axis] = n % 5 == 0 ? 1e-200 : 0;
    const auto s = local_structure(jet);
    ASSERT_TRUE(s.status == Point_status::REGULAR || !std::isnan(s.euclidean.gaussian_curvature));
    if (std::abs(s.euclidean.gaussian_curvature) < 0.1) continue;
    ++regular;
    Jet_3<Number> exact;
    for (std::size_t c = 0; c < Jet::size; ++c) exact.coefficients()[c] = jet.coefficients()[c];
    const auto t = local_structure(exact);
    const double K = double(t.affine.gaussian_curvature), H = double(t.affine.mean_curvature), S = scale(s);
    EXPECT_NEAR(s.affine.gaussian_curvature, K, 1e-12 * S);
    EXPECT_NEAR(s.affine.mean_curvature, H, 1e-12 * std::sqrt(S));
  }
  EXPECT_GT(regular, 300);
}

TEST(Affine_structure, the_smaller_principal_curvature_keeps_its_digits) {
  const auto s = local_structure(expand(Expression_3("x^4+y^4+z-1"), {1, .01, 0})).affine;
  EXPECT_NEAR(s.k2 / .034641016137521, 1, 1e-13);
  const auto opposite = local_structure(expand(Expression_3("1-x^4-y^4-z"), {1, .01, 0})).affine;
  EXPECT_NEAR(opposite.k1 / -.034641016137521, 1, 1e-13);
  EXPECT_EQ(opposite.k2, -s.k1);
}

TEST(Affine_structure, double_agrees_with_50_digits_on_an_anisotropic_surface) {
  using Number = boost::multiprecision::cpp_bin_float_50;
  const Anisotropic_surface f;
  for (const auto& p : f.points(3000)) {
    const double x = p.x(), y = p.y(), z = p.z();
    ASSERT_NEAR(f(x, y, z), 0, 1e-14);
    const auto s = local_structure(equiaffine::expand<4, double>(f, x, y, z));
    const auto t = local_structure(equiaffine::expand<4, Number>(f, Number(x), Number(y), Number(z)));
    const double K = double(t.affine.gaussian_curvature), H = double(t.affine.mean_curvature);
    const double S = std::abs(K) + H * H + std::pow(std::abs(double(t.euclidean.gaussian_curvature)), 1.5);
    EXPECT_NEAR(s.affine.gaussian_curvature, K, 1e-12 * S);
    EXPECT_NEAR(s.affine.mean_curvature, H, 1e-12 * std::sqrt(S));
  }
}

/// The jet in coordinates that are multiplied by these powers of 2.
Jet in_units(Jet jet, const std::array<int, 3>& powers) {
  for (std::size_t n = 0; n < Jet::size; ++n) {
    const auto m = internal::monomials[n];
    jet.coefficients()[n] = std::ldexp(jet.coefficients()[n], -(m.i * powers[0] + m.j * powers[1] + m.k * powers[2]));
  }
  return jet;
}

TEST(Affine_structure, other_units_of_the_axes_keep_every_bit) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 1000; ++n) {
    Jet jet;
    for (double& c : jet.coefficients()) c = unit(random);
    const auto s = local_structure(jet);
    for (const int power : {4, 8, 20, 40, -20})
      for (const auto& powers : {std::array{power, 0, -power}, std::array{-power, 2 * power, -power}}) {
        const auto t = local_structure(in_units(jet, powers));
        ASSERT_EQ(t.status, s.status);
        if (s.status != Point_status::REGULAR) continue;
        EXPECT_EQ(t.affine.gaussian_curvature, s.affine.gaussian_curvature) << power;
        EXPECT_EQ(t.affine.mean_curvature, s.affine.mean_curvature) << power;
        EXPECT_EQ(t.affine.pick_invariant, s.affine.pick_invariant) << power;
        for (std::size_t i = 0; i < 3; ++i)
          EXPECT_EQ(std::ldexp(t.affine.normal[i], -powers[i]), s.affine.normal[i]) << power;
      }
  }
}

/// The largest error of K and H against 50 digits, in units of their size and of what a change of the jet by half a
/// rounding does.
double loss_of_digits(const Jet& jet, std::mt19937& random) {
  using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
  Jet_3<Number> exact;
  std::copy(jet.coefficients().begin(), jet.coefficients().end(), exact.coefficients().begin());
  const auto expected = affine_invariants(Monge_chart_3<Number>(exact));
  const double K = double(expected.gaussian_curvature), H = double(expected.mean_curvature);
  const double S = std::abs(K) + H * H + double(expected.pick_invariant * expected.pick_invariant);
  const auto error = [&](const auto& s) {
    return std::max(double(abs(Number(s.gaussian_curvature) - expected.gaussian_curvature)) / S,
                    double(abs(Number(s.mean_curvature) - expected.mean_curvature)) / std::sqrt(S));
  };
  const double epsilon = std::numeric_limits<double>::epsilon();
  double conditioning = epsilon;
  for (int n = 0; n < 4; ++n) {
    Jet_3<Number> changed = exact;
    for (Number& c : changed.coefficients()) c *= 1 + Number((int(random() % 3) - 1) * epsilon);
    conditioning = std::max(conditioning, error(affine_invariants(Monge_chart_3<Number>(changed))));
  }
  return error(affine_invariants(Monge_chart_3<double>(jet))) / conditioning;
}

TEST(Affine_structure, double_keeps_its_digits_in_all_units_of_the_axes_and_where_second_derivatives_vanish) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> unit(-1, 1);
  const std::array<std::size_t, 3> pure = {4, 7, 9}; // x^2, y^2, z^2
  for (int n = 0; n < 1500; ++n) {
    Jet jet;
    for (double& c : jet.coefficients()) c = unit(random);
    if (n % 3 > 0) { // affine to second order along an axis, and steep to others
      const std::size_t axis = random() % 3;
      jet.coefficients()[pure[axis]] = 0;
      if (n % 3 == 1) jet.coefficients()[1 + axis] *= std::pow(10, -8 * std::abs(unit(random)));
    }
    const auto power = [&] { return int(40 * unit(random)); };
    EXPECT_LE(loss_of_digits(in_units(jet, {power(), power(), power()}), random), 300) << n;
  }
}

TEST(Affine_structure, surfaces_of_any_anisotropy_keep_their_digits) {
  std::mt19937 random(29);
  for (const double s : {1., 10., 30., 100., 1e3, 1e4, 1e5, 1e6}) {
    const Stretched_surface f{s};
    for (const Vector& p : f.points(100)) {
      ASSERT_EQ(local_structure(expand(f, p), p).status, Point_status::REGULAR) << s;
      EXPECT_LE(loss_of_digits(expand(f, p), random), 30) << s;
    }
  }
}

} // namespace affine_structure_digits_test
