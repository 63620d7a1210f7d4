// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/expand.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace Monge_chart_3_test {

using namespace equiaffine;
using Jet = Jet_3<double>;

template <class Function>
Jet expand(const Function& f, double x, double y, double z) {
  return equiaffine::expand<4, double>(f, x, y, z);
}

template <class Function>
Point_status status(const Function& f, double x, double y, double z) {
  return local_structure(expand(f, x, y, z), {x, y, z}).status;
}

const auto cone = [](const auto& x, const auto& y, const auto& z) { return x * x + y * y - z * z; };
const auto plane = [](const auto& x, const auto& y, const auto& z) { return 0.3 * x - 0.7 * y + 0.1 * z - 1; };

// Where w is of second order in u and v, the forms make up f to fifth order.
template <class Function>
void expect_forms_to_fifth_order(const Function& f, int pivot) {
  const std::array<std::array<double, 3>, 3> points = {{{.1, .2, .3}, {.5, -.4, .2}, {-.3, .2, -.4}}};
  for (const auto& p : points) {
    const Jet jet = expand(f, p[0], p[1], p[2]);
    const Monge_chart_3<double> chart(jet);
    ASSERT_TRUE(chart.is_steep && chart.is_curved);
    EXPECT_EQ(chart.pivot_is_x, pivot == 0);
    EXPECT_EQ(chart.pivot_is_y, pivot == 1);
    const double f_w = jet.coefficient(pivot == 0, pivot == 1, pivot == 2);
    const auto residual = [&](const Monge_chart_3<double>& forms, double h) {
      double worst = 0;
      for (int n = 0; n < 8; ++n) {
        const double u = h * std::cos(n * 0.785), v = h * std::sin(n * 0.785);
        const auto& [q0, q1, q2] = forms.quadratic;
        const auto& [c0, c1, c2, c3] = forms.cubic;
        const auto& [m0, m1, m2] = forms.mixed_quadratic;
        const auto& [r0, r1, r2, r3, r4] = forms.quartic;
        const double Q = q0 * u * u + 2 * q1 * u * v + q2 * v * v, L = forms.mixed[0] * u + forms.mixed[1] * v;
        const double C = c0 * u * u * u + 3 * c1 * u * u * v + 3 * c2 * u * v * v + c3 * v * v * v;
        const double D = m0 * u * u + 2 * m1 * u * v + m2 * v * v;
        const double R = r0 * u * u * u * u + 4 * r1 * u * u * u * v + 6 * r2 * u * u * v * v + 4 * r3 * u * v * v * v +
                         r4 * v * v * v * v;
        for (const double w : {-Q, Q / 3}) {
          const auto t = forms.vector(u, v, w);
          const double value = f(p[0] + t[0], p[1] + t[1], p[2] + t[2]) - f(p[0], p[1], p[2]);
          worst = std::max(worst, std::abs(value / f_w - (w + Q + w * L + forms.e * w * w + C + w * D + R)));
        }
      }
      return worst;
    };
    EXPECT_GT(std::log2(residual(chart, 0.02) / residual(chart, 0.01)), 4.7);
    const auto conjugate = chart.conjugate(true);
    EXPECT_EQ(conjugate.quadratic[1], 0);
    EXPECT_GT(std::log2(residual(conjugate, 0.02) / residual(conjugate, 0.01)), 4.7);
  }
}

TEST(Monge_chart_3, the_forms_are_those_of_f_to_fifth_order) {
  const auto f = [](const auto& x, const auto& y, const auto& z) {
    using std::exp;
    using std::sin;
    return exp(x) * sin(2.0 * y + 0.3) + x * z * z / (2.0 + x * y) + y * y * z + 5.0 * z;
  };
  const auto cyclic = [&](const auto& x, const auto& y, const auto& z) { return f(y, z, x); };
  const auto anticyclic = [&](const auto& x, const auto& y, const auto& z) { return f(z, x, y); };
  expect_forms_to_fifth_order(f, 2);
  expect_forms_to_fifth_order(cyclic, 0);
  expect_forms_to_fifth_order(anticyclic, 1);
}

TEST(Monge_chart_3, the_pivot_has_a_gradient_where_second_derivatives_vanish_or_overflow) {
  const auto product = [](const auto& x, const auto& y, const auto& z) { return x * y * z; };
  EXPECT_TRUE(Monge_chart_3<double>(expand(product, 0, 1, 1)).pivot_is_x);
  EXPECT_TRUE(Monge_chart_3<double>(expand(product, 1, 0, 1)).pivot_is_y);
  const Monge_chart_3<double> last(expand(product, 1, 1, 0));
  EXPECT_FALSE(last.pivot_is_x || last.pivot_is_y);
  EXPECT_TRUE(Monge_chart_3<double>(expand(plane, 1, 2, 3)).pivot_is_y) << "the largest component of the gradient";
  Jet jet = expand(product, 1, 1, 0);
  for (std::size_t n = 4; n < 10; ++n) jet.coefficients()[n] = 1e300;
  jet.coefficients()[1] = 1e-9;
  jet.coefficients()[2] = 1;
  jet.coefficients()[3] = 1e-30;
  EXPECT_TRUE(Monge_chart_3<double>(jet).pivot_is_y);
}

TEST(Monge_chart_3, a_vanishing_gradient_is_singular) {
  EXPECT_EQ(status(cone, 0, 0, 0), Point_status::SINGULAR);
  EXPECT_EQ(status([](const auto& x, const auto& y, const auto& z) { return x * y * z + 4.0; }, 0, 0, 1),
            Point_status::SINGULAR);
  // A node at (1, 1, 1) that rounding hides: the gradient there is that of one rounding of the coordinates.
  const auto shifted = [](const auto& x, const auto& y, const auto& z) {
    const auto u = x - 1.0;
    const auto v = y - 1.0;
    const auto w = z - 1.0;
    return u * u + v * v - w * w;
  };
  EXPECT_EQ(status(shifted, 1 + 2e-16, 1, 1), Point_status::SINGULAR);
}

TEST(Monge_chart_3, a_gradient_is_not_taken_for_zero_because_of_the_units_of_the_axes) {
  const auto product = [](const auto& x, const auto& y, const auto& z) { return x * y * z; };
  const auto ellipsoid = [](const auto& x, const auto& y, const auto& z) {
    return x * x + 1e16 * (y * y) + 1e-16 * (z * z) + x * y * z;
  };
  const auto far = local_structure(expand(product, 1e-35, 1, 1e35), {1e-35, 1, 1e35});
  EXPECT_EQ(far.status, Point_status::REGULAR);
  EXPECT_NEAR(far.affine.gaussian_curvature, 1 / std::sqrt(27), 1e-15);
  EXPECT_EQ(status(product, 1e-60, 1, 1e60), Point_status::SINGULAR) << "not a wrong number: powers of d underflow";
  EXPECT_EQ(status(ellipsoid, 1, 1e-8, 1e8), Point_status::REGULAR);
  EXPECT_EQ(status(ellipsoid, 0, 0, 0), Point_status::SINGULAR);
  // Rounding hides the node at (1e8, 1, 1e-8), in whatever units.
  const auto node = [](const auto& x, const auto& y, const auto& z) {
    const auto u = 1e-8 * x - 1.0;
    const auto v = y - 1.0;
    const auto w = 1e8 * z - 1.0;
    return u * u + v * v - w * w;
  };
  EXPECT_EQ(status(node, 1e8 * (1 + 2e-16), 1, 1e-8), Point_status::SINGULAR);
  EXPECT_NE(status(node, 1e8 * (1 + 3e-15), 1, 1e-8), Point_status::SINGULAR);
}

TEST(Monge_chart_3, near_a_singular_point_the_cone_is_an_ordinary_parabolic_surface) {
  EXPECT_EQ(status(cone, 1e-9, 0, 1e-9), Point_status::PARABOLIC);
}

TEST(Monge_chart_3, planes_cylinders_cones_and_flat_points_are_parabolic) {
  const auto cylinder = [](const auto& x, const auto& y, const auto&) { return x * x + y * y - 1.0; };
  const auto rotated_cylinder = [](const auto& x, const auto& y, const auto& z) {
    const auto u = 0.6 * x + 0.8 * y;
    const auto v = 0.28 * z + 0.96 * (0.6 * y - 0.8 * x);
    return u * u + v * v - 1.0;
  };
  const auto exponential_of_a_plane = [](const auto& x, const auto& y, const auto& z) {
    using std::exp;
    return exp(0.3 * x - 0.7 * y + 0.1 * z) - 1.0;
  };
  const auto monkey_saddle = [](const auto& x, const auto& y, const auto& z) {
    return z - x * x * x + 3.0 * x * y * y;
  };
  EXPECT_EQ(status(plane, 1, 2, 3), Point_status::PARABOLIC);
  EXPECT_EQ(status(cylinder, 0.6, 0.8, 5), Point_status::PARABOLIC);
  EXPECT_EQ(status(rotated_cylinder, 0.9, 0.4, 0.3), Point_status::PARABOLIC);
  EXPECT_EQ(status(exponential_of_a_plane, 0.2, 0.1, 0.1), Point_status::PARABOLIC);
  EXPECT_EQ(status(cone, 3, 4, 5), Point_status::PARABOLIC);
  EXPECT_EQ(status(monkey_saddle, 0, 0, 0), Point_status::PARABOLIC);
}

TEST(Monge_chart_3, a_point_where_d_is_merely_small_is_regular) {
  const auto nearly_flat = [](const auto& x, const auto& y, const auto& z) { return z - 1e-9 * (x * x + y * y); };
  const auto nearly_parabolic = [](const auto& x, const auto& y, const auto& z) { return z - x * x - 1e-11 * y * y; };
  EXPECT_EQ(status(nearly_flat, 0.5, 0.2, 0), Point_status::REGULAR);
  EXPECT_EQ(status(nearly_parabolic, 0.5, 0.2, 0), Point_status::REGULAR);
}

// Near the zeros of g the second derivatives of a function of g are nearly products of first ones: terms that cancel in
// d. The values are from 70-digit arithmetic. Roundings of the derivatives change K_e by 8e-10 of itself, K more, the
// higher the powers of 1 / g in the derivatives.
TEST(Monge_chart_3, large_terms_that_cancel_in_d_do_not_make_it_zero) {
  const Jet g =
      expand([](const auto& x, const auto& y, const auto& z) { return x * x + y * y + z * z + x * y * z - 1.0; }, 0.6,
             0.5, 0.4922626289332564);
  for (const Jet& jet : {g, g * g, g * g * g, log(g), -1.0 / g}) {
    const auto s = local_structure(jet, {0.6, 0.5, 0.4922626289332564});
    EXPECT_EQ(s.status, Point_status::REGULAR);
    EXPECT_NEAR(s.euclidean.gaussian_curvature / 0.40002457469023035, 1, 1e-8);
  }
  for (const auto& [jet, tolerance] : {std::pair{g, 1e-12}, std::pair{g * g, 1e-8}, std::pair{g * g * g, 1e-2}}) {
    const auto s = local_structure(jet).affine;
    EXPECT_NEAR(s.gaussian_curvature / 2.1338319317334991, 1, tolerance);
    EXPECT_NEAR(s.mean_curvature / -1.4665838917193817, 1, tolerance);
  }
}

TEST(Monge_chart_3, cubes_of_functions_with_parabolic_level_sets_have_parabolic_ones) {
  const auto cylinder = [](const auto& x, const auto& y, const auto& z) {
    const auto u = 0.6 * x + 0.8 * y;
    const auto v = 0.28 * z + 0.96 * (0.6 * y - 0.8 * x);
    return u * u + v * v - 0.75;
  };
  const auto cones = [](const auto& x, const auto& y, const auto& z) { return z * z / (x * x + y * y); };
  for (int n = 0; n < 100; ++n) {
    const double x = std::sin(n), y = std::sin(2.3 * n), z = std::sin(3.1 * n);
    for (const Jet& jet : {expand(cylinder, x, y, z), expand(cones, x, y, z), expand(plane, x, y, z)})
      for (const Jet& image : {jet, jet * jet, jet * jet * jet, exp(jet), -1.0 / jet})
        EXPECT_NE(local_structure(image, {x, y, z}).status, Point_status::REGULAR) << n;
  }
}

TEST(Monge_chart_3, kinks_are_singular_and_undefined_values_outside) {
  const auto kink = [](const auto& x, const auto& y, const auto& z) {
    using std::abs;
    return abs(x) + y * y + z;
  };
  const auto root = [](const auto& x, const auto& y, const auto& z) {
    using std::sqrt;
    return sqrt(x) + y + z * z;
  };
  EXPECT_EQ(status(kink, 0, 1, 1), Point_status::SINGULAR);
  EXPECT_NE(status(kink, 0.1, 1, 1), Point_status::SINGULAR);
  EXPECT_EQ(status(root, 0, 1, 1), Point_status::SINGULAR);
  EXPECT_EQ(status(root, -1, 1, 1), Point_status::OUTSIDE);
  EXPECT_EQ(status([](const auto& x, const auto& y, const auto& z) { return 1.0 / (x - y) + z; }, 1, 1, 0),
            Point_status::OUTSIDE);
}

TEST(Local_structure_3, no_number_is_missing_without_a_status_and_none_is_there_with_one) {
  const auto s = local_structure(expand(cone, 0, 0, 0));
  EXPECT_TRUE(std::isnan(s.euclidean.normal[0]) && std::isnan(s.euclidean.k1) &&
              std::isnan(s.affine.gaussian_curvature));
  const auto p = local_structure(expand(cone, 3, 4, 5));
  EXPECT_EQ(p.status, Point_status::PARABOLIC);
  EXPECT_NEAR(p.euclidean.gaussian_curvature, 0, 1e-15);
  EXPECT_LT(p.euclidean.k2, -0.05);
  EXPECT_TRUE(std::isnan(p.affine.gaussian_curvature) && std::isnan(p.affine.normal[2]) &&
              std::isnan(p.affine.metric[0]));
}

TEST(Local_structure_3, powers_of_d_that_overflow_are_parabolic) {
  const double tiny = 1e-180;
  const auto f = [&](const auto& x, const auto& y, const auto& z) { return z - tiny * (x * x + y * y) - x * x * x; };
  EXPECT_EQ(status(f, 0, 0, 0), Point_status::PARABOLIC);
}

TEST(Euclidean_structure, principal_curvatures_and_directions_of_a_torus) {
  const double R = 2, r = 0.5;
  const auto torus = [&](const auto& x, const auto& y, const auto& z) {
    using std::sqrt;
    const auto q = sqrt(x * x + y * y) - R;
    return q * q + z * z - r * r;
  };
  for (double phi : {0.3, 1.9, 4.0})
    for (double theta : {0.0, 0.7, 2.0, 3.1415, 5.5}) {
      const double rho = R + r * std::cos(theta);
      const auto s = local_structure(expand(torus, rho * std::cos(phi), rho * std::sin(phi), r * std::sin(theta)));
      const double around = -std::cos(theta) / rho, across = -1 / r; // the outward normal: convex is negative
      EXPECT_NEAR(s.euclidean.k1, around, 1e-13);
      EXPECT_NEAR(s.euclidean.k2, across, 1e-13);
      EXPECT_NEAR(s.euclidean.gaussian_curvature, around * across, 1e-13);
      EXPECT_NEAR(s.euclidean.mean_curvature, (around + across) / 2, 1e-13);
      const auto &n = s.euclidean.normal, &d1 = s.euclidean.direction1, &d2 = s.euclidean.direction2;
      EXPECT_NEAR(n[0], std::cos(theta) * std::cos(phi), 1e-13);
      EXPECT_NEAR(n[2], std::sin(theta), 1e-13);
      EXPECT_NEAR(std::abs(-std::sin(phi) * d1[0] + std::cos(phi) * d1[1]), 1, 1e-13)
          << "direction 1 runs around the axis";
      EXPECT_NEAR(d1[1] * d2[2] - d1[2] * d2[1], n[0], 1e-13) << "direction1, direction2, normal are right-handed";
      EXPECT_NEAR(d1[0] * d2[1] - d1[1] * d2[0], n[2], 1e-13);
      EXPECT_NEAR(d2[0] * d2[0] + d2[1] * d2[1] + d2[2] * d2[2], 1, 1e-13);
    }
}

TEST(Local_structure_3, lengths_that_overflow_are_singular_and_not_infinite) {
  const auto sphere = [](const auto& x, const auto& y, const auto& z) { return x * x + y * y + z * z; };
  for (double r : {1e-200, 1e-160}) {
    const auto s = local_structure(expand(sphere, r, 0, 0));
    EXPECT_EQ(s.status, Point_status::SINGULAR) << r;
    EXPECT_TRUE(std::isnan(s.euclidean.k1) && std::isnan(s.euclidean.gaussian_curvature)) << r;
  }
  EXPECT_EQ(local_structure(expand(sphere, 1e-60, 0, 0)).status, Point_status::REGULAR);
}

TEST(Local_structure_3, the_unit_of_length_decides_nothing_but_what_a_double_can_hold) {
  const auto product = [](const auto& x, const auto& y, const auto& z) { return x * y * z; };
  const auto root = [](const auto& x, const auto& y, const auto& z) {
    using std::sqrt;
    return sqrt(x * x + 2.0 * y * y + z * z);
  };
  const auto expect_scaled = [](const auto& f, double t) {
    const auto one = local_structure(expand(f, 1, 1, 1)), s = local_structure(expand(f, t, t, t), {t, t, t});
    ASSERT_EQ(s.status, Point_status::REGULAR) << t;
    const auto expect = [&](double actual, double expected) { EXPECT_NEAR(actual / expected, 1, 1e-12) << t; };
    expect(s.affine.gaussian_curvature, one.affine.gaussian_curvature / (t * t * t));
    expect(s.affine.mean_curvature, one.affine.mean_curvature / t / std::sqrt(t));
    expect(s.affine.conormal[1], one.affine.conormal[1] * std::sqrt(t));
    expect(s.affine.normal[1], one.affine.normal[1] / std::sqrt(t));
    expect(s.affine.metric[0], one.affine.metric[0] / std::sqrt(t));
    expect(s.euclidean.k2, one.euclidean.k2 / t);
    expect(s.euclidean.gaussian_curvature, one.euclidean.gaussian_curvature / (t * t));
    expect(1 + s.affine.quadric_defect, 1 + one.affine.quadric_defect);
  };
  for (const double t : {1e-100, 1e-75, 1e-50, 1e50, 1e75}) {
    expect_scaled(product, t);
    expect_scaled(root, t);
  }
  EXPECT_EQ(status(product, 1e-104, 1e-104, 1e-104), Point_status::SINGULAR) << "K is 2e311";
  // So flat that K would be beyond any range, in whatever units.
  for (const double t : {1e-60, 1., 1e30}) {
    const auto flat = [&](const auto& x, const auto& y, const auto& z) {
      return z - 1e-120 / t * (x * x + y * y) - x * x * x / (t * t);
    };
    const auto s = local_structure(expand(flat, 0, 0, 0));
    EXPECT_EQ(s.status, Point_status::PARABOLIC) << t;
    EXPECT_NEAR(s.euclidean.k1 / (2e-120 / t), 1, 1e-12) << t;
  }
}

TEST(Euclidean_structure, k1_is_never_less_than_k2) {
  for (int n = 0; n < 1000; ++n) {
    const double u = 0.1 + n * 0.0061, v = 0.3 + n * 0.37;
    const double x = std::sin(u) * std::cos(v), y = std::sin(u) * std::sin(v), z = std::cos(u);
    for (double sign : {1.0, -1.0}) {
      const auto f = [&](const auto& a, const auto& b, const auto& c) { return sign * (a * a + b * b + c * c); };
      const auto s = local_structure(expand(f, x, y, z)).euclidean;
      EXPECT_GE(s.k1, s.k2);
      EXPECT_NEAR(s.k2, -sign, 1e-14);
    }
  }
}

TEST(Euclidean_structure, umbilics_have_some_orthonormal_directions) {
  const auto sphere = [](const auto& x, const auto& y, const auto& z) { return x * x + y * y + z * z; };
  for (double z : {1.0, -1.0}) {
    const auto s = local_structure(expand(sphere, 0, 0, z)).euclidean;
    EXPECT_EQ(s.k1, s.k2);
    EXPECT_NEAR(std::hypot(s.direction1[0], s.direction1[1], s.direction1[2]), 1, 1e-15);
    EXPECT_NEAR(s.direction1[0] * s.direction2[0] + s.direction1[1] * s.direction2[1], 0, 1e-15);
  }
}

TEST(Euclidean_structure, the_smaller_principal_curvature_keeps_its_digits) {
  // Gauss map of x^2 + 1e-10 y^2 = 2 z at a point off the origin: k1 is near 1, k2 near 1e-10.
  const auto f = [](const auto& x, const auto& y, const auto& z) { return (x * x + 1e-10 * (y * y)) / 2.0 - z; };
  const auto s = local_structure(expand(f, 0.5, 0.3, 0)).euclidean;
  const double w2 = 1 + 0.25 + 0.09e-20, K = 1e-10 / (w2 * w2);
  EXPECT_NEAR(s.gaussian_curvature / K, 1, 1e-14);
  EXPECT_NEAR(s.k1 * s.k2 / K, 1, 1e-14);
}

} // namespace Monge_chart_3_test
