// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/sample_on_lattice.h>
#include <equiaffine/surface/internal/affine_gradients.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace affine_gradients_test {

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
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(after[n], before[n], 1e-11 * before[n]) << t << ' ' << n;
  }
}

TEST(Affine_gradients, have_the_unit_of_length_that_they_should_whatever_it_is) {
  const auto before = affine_gradient_norms(torus, on_meridian(0.9));
  for (const int exponent : {-200, -40, 40, 200}) {
    const double unit = std::ldexp(1, exponent);
    const analytic_functions::Torus scaled{R * unit, r * unit};
    const auto p = on_meridian(0.9);
    const auto after = affine_gradient_norms(make_analytic_traits<Kernel>(scaled, scaled.box()),
                                             Kernel::Point_3(p.x() * unit, p.y() * unit, p.z() * unit));
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_NEAR(after[n] / before[n] * std::exp2(exponent * (n == 0 ? 3.75 : 2.25)), 1, 1e-12)
          << exponent << ' ' << n;
  }
}

// The level sets of g and g^2 are the same; where g is small, the Hessian of g^2 is nearly of rank one, and rounding of
// its coefficients costs a factor of 1 / g.
TEST(Affine_gradients, lose_no_more_digits_than_coefficients_where_the_function_is_nearly_a_square) {
  const auto g = [](const auto& x, const auto& y, const auto& z) {
    return x * x * x * x + 0.5 * y * y + 2. * z * z + 0.3 * x * y - 1.;
  };
  const auto square = [g](const auto& x, const auto& y, const auto& z) {
    const auto value = g(x, y, z);
    return value * value;
  };
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  const auto traits = make_analytic_traits<Kernel>(g, box);
  const auto traits_of_square = make_analytic_traits<Kernel>(square, box);
  for (const double value : {1e-2, 1e-4, 1e-6})
    for (const auto& [x, y] : {std::array{.5, .6}, std::array{.3, -.8}, std::array{.7, .2}}) {
      const Kernel::Point_3 p(x, y, std::sqrt((value - g(x, y, 0.)) / 2));
      const auto expected = affine_gradient_norms(traits, p), norms = affine_gradient_norms(traits_of_square, p);
      for (std::size_t n = 0; n < 3; ++n)
        EXPECT_NEAR(norms[n] / expected[n], 1, 1e-14 / value) << value << ' ' << x << ' ' << n;
    }
}

// The right values are from 70-digit arithmetic; roundings of the derivatives change them by 1e-7 of themselves, those
// of the last point by 9e-3.
TEST(Affine_gradients, keep_their_digits_where_a_thin_direction_is_oblique) {
  const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
  const auto thin =
      make_analytic_traits<Kernel>(Expression_3("(101*x-100*y)^3+(100*y-100*x)^2*z-sin((101*x-100*y)*z)"), box);
  const auto norms = affine_gradient_norms(thin, Kernel::Point_3(.3, .296, .6));
  EXPECT_NEAR(norms[0] / 4580.3640716565028, 1, 5e-7);
  EXPECT_NEAR(norms[1] / 272.45813919415548, 1, 5e-7);
  EXPECT_NEAR(norms[2] / 238.19775575118052, 1, 5e-8);
  const auto f = make_analytic_traits<Kernel>(Expression_3("x^3+y^2*z-sin(x*z)"), box);
  const auto image = [&](double width, double y) {
    const Kernel::Aff_transformation_3 map(1, 1, 0, 1, 1 + width, 0, 0, 0, 1);
    return affine_gradient_norms(Transformed_function_traits_3(f, map), Kernel::Point_3(0.29999999999999993, y, 0.6));
  };
  EXPECT_NEAR(image(.01, .29599999999999993)[1] / 272.45813919414076, 1, 5e-7);
  EXPECT_NEAR(image(.001, .2996)[0] / 81451.671191091815, 1, 2e-2);
  EXPECT_NEAR(image(.001, .2996)[1] / 1532.1447105334246, 1, 2e-2);
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

/// A model of which no derivatives of order 5 are known.
template <class Traits>
struct Without_fifth_order {
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;
  double value(const Point_3& p) const { return base.value(p); }
  Jet_3<double> taylor(const Point_3& p) const { return base.taylor(p); }
  CGAL::Bbox_3 bbox() const { return base.bbox(); }
  Traits base;
};

// Known to 6 digits by 60-digit arithmetic.
TEST(Affine_gradients, are_right_where_they_change_fast) {
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  const auto quartic = make_analytic_traits<Kernel>(Expression_3("x^4+y^4+z^4-1"), box);
  const auto thin = make_analytic_traits<Kernel>(Expression_3("(x+10*y)^4+y^2+z^4"), box);
  const Kernel::Point_3 p(.01, .3, .9), q(.5, .3, .4);
  EXPECT_NEAR(affine_gradient_norms(quartic, p)[1], 9.7497e9, 5e4);
  const auto norms = affine_gradient_norms(thin, q);
  EXPECT_NEAR(norms[0], 131.8, .05);
  EXPECT_NEAR(norms[1], 1008.96, .005);
  EXPECT_NEAR(norms[2], 201.8, .05);
  EXPECT_NEAR(affine_gradient_norms(Any_function_3::make(thin), q)[1], norms[1], 1e-12 * norms[1]);
  EXPECT_NEAR(affine_gradient_norms(Level_set_traits_3(thin, 2.), q)[1], norms[1], 1e-12 * norms[1]);
}

TEST(Affine_gradients, from_differences_are_right_or_missing) {
  const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);
  const auto quartic = make_analytic_traits<Kernel>(Expression_3("x^4+y^4+z^4-1"), box);
  const Without_fifth_order<decltype(quartic)> other{quartic};
  std::size_t known = 0;
  for (int i = 0; i < 20; ++i) {
    const Kernel::Point_3 p(.01 + .04 * i, .3, .6);
    const auto norms = affine_gradient_norms(other, p), expected = affine_gradient_norms(quartic, p);
    for (std::size_t n = 0; n < 3; ++n) {
      known += !std::isnan(norms[n]);
      if (std::isnan(norms[n])) continue;
      EXPECT_NEAR(norms[n], expected[n], .03 * expected[n]) << p << ' ' << n;
    }
  }
  EXPECT_GT(known, 45U);
}

TEST(Affine_gradients, of_a_volume_are_those_of_its_spline) {
  const auto f = [](const auto& p) { return p.x() * p.x() * p.x() * p.x() + p.y() * p.y() + 2 * p.z() * p.z() - 1; };
  const Lattice_3<Kernel> lattice({40, 40, 40}, CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  const auto exact = make_analytic_traits<Kernel>(Expression_3("x^4+y^2+2*z^2-1"), lattice.bbox());
  const Sampled_function_traits_3 sampled(sample_on_lattice(f, lattice), {.spline_degree = 9});
  const Kernel::Point_3 p(.7, .5, .3);
  const auto norms = affine_gradient_norms(sampled, p), expected = affine_gradient_norms(exact, p);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(norms[n], expected[n], 1e-7 * expected[n]);
}

TEST(Affine_gradients, do_not_exist_at_parabolic_points) {
  for (const double norm : affine_gradient_norms(torus, Kernel::Point_3(R, 0, r))) EXPECT_TRUE(std::isnan(norm));
}

TEST(Affine_gradients, differences_are_extrapolated_and_skip_what_is_not_finite) {
  const auto f = [](double t) {
    const double x = std::exp(t), undefined = std::abs(t) > 0.05 ? NAN : x;
    return std::array{x, std::sin(3 * t), undefined};
  };
  const auto derivatives = internal::derivatives_at_zero(f, 0.1);
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_NEAR(derivatives[n].value, n == 1 ? 3 : 1, 1e-11);
    EXPECT_LT(derivatives[n].error, 1e-10);
  }
}

} // namespace affine_gradients_test
