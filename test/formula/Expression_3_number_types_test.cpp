// SPDX-License-Identifier: GPL-3.0-or-later
#include "formula/expression_cases.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace Expression_3_number_types_test {

using namespace expression_cases;
using equiaffine::Expression_3;
using equiaffine::Interval;
using Jet = equiaffine::Jet_3<double>;
using Big = boost::multiprecision::cpp_bin_float_50;

// This namespace stands for that of a user. Its number type, a value and a derivative, has only what Expression_3
// asks for. Its only pow takes an int, as a trap for pow(T, 1.5).
namespace dual_numbers {

struct Dual {
  explicit Dual(double v = 0, double d = 0) : value(v), derivative(d) {}
  double value, derivative;
};

Dual operator+(const Dual& a, const Dual& b) { return Dual(a.value + b.value, a.derivative + b.derivative); }
Dual operator-(const Dual& a, const Dual& b) { return Dual(a.value - b.value, a.derivative - b.derivative); }
Dual operator*(const Dual& a, const Dual& b) {
  return Dual(a.value * b.value, a.derivative * b.value + a.value * b.derivative);
}
Dual operator/(const Dual& a, const Dual& b) {
  return Dual(a.value / b.value, (a.derivative * b.value - a.value * b.derivative) / (b.value * b.value));
}
Dual operator-(const Dual& a) { return Dual(-a.value, -a.derivative); }
bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
bool operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }

Dual chain(const Dual& a, double value, double slope) { return Dual(value, slope * a.derivative); }
Dual pow(const Dual& a, int n) { return chain(a, std::pow(a.value, n), n * std::pow(a.value, n - 1)); }
Dual sqrt(const Dual& a) { return chain(a, std::sqrt(a.value), 0.5 / std::sqrt(a.value)); }
Dual cbrt(const Dual& a) { return chain(a, std::cbrt(a.value), std::cbrt(a.value) / (3 * a.value)); }
Dual exp(const Dual& a) { return chain(a, std::exp(a.value), std::exp(a.value)); }
Dual log(const Dual& a) { return chain(a, std::log(a.value), 1 / a.value); }
Dual sin(const Dual& a) { return chain(a, std::sin(a.value), std::cos(a.value)); }
Dual cos(const Dual& a) { return chain(a, std::cos(a.value), -std::sin(a.value)); }
Dual tan(const Dual& a) { return sin(a) / cos(a); }
Dual asin(const Dual& a) { return chain(a, std::asin(a.value), 1 / std::sqrt(1 - a.value * a.value)); }
Dual acos(const Dual& a) { return chain(a, std::acos(a.value), -1 / std::sqrt(1 - a.value * a.value)); }
Dual atan(const Dual& a) { return chain(a, std::atan(a.value), 1 / (1 + a.value * a.value)); }
Dual atan2(const Dual& a, const Dual& b) {
  const double norm = a.value * a.value + b.value * b.value;
  return Dual(std::atan2(a.value, b.value), (a.derivative * b.value - b.derivative * a.value) / norm);
}
Dual sinh(const Dual& a) { return chain(a, std::sinh(a.value), std::cosh(a.value)); }
Dual cosh(const Dual& a) { return chain(a, std::cosh(a.value), std::sinh(a.value)); }
Dual tanh(const Dual& a) { return sinh(a) / cosh(a); }
Dual abs(const Dual& a) { return a.value < 0 ? -a : a; }
Dual erf(const Dual& a) {
  return chain(a, std::erf(a.value), 2 * std::numbers::inv_sqrtpi * std::exp(-a.value * a.value));
}
Dual floor(const Dual& a) { return Dual(std::floor(a.value)); }

} // namespace dual_numbers

using dual_numbers::Dual;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(Expression_3, fifty_digits_agree_with_double) {
  for (const Case& c : exact_cases) {
    const double big = static_cast<double>(Expression_3(c.text)(Big(px), Big(py), Big(pz)));
    EXPECT_NEAR(big, c.expected(px, py, pz), 4 * epsilon * std::abs(big)) << c.text;
  }
  const Big third = Expression_3("x/3")(Big(1), Big(0), Big(0));
  EXPECT_EQ(third, Big(1) / 3);
  EXPECT_EQ(Expression_3("x^7")(third, Big(0), Big(0)), pow(third, 7));
  EXPECT_EQ(Expression_3("x^1.5")(third, Big(0), Big(0)), pow(third, Big(1.5)));
}

TEST(Expression_3, jets_have_the_value_and_the_derivatives) {
  const double h = 1e-5;
  const Jet x = Jet::variable(0, px), y = Jet::variable(1, py), z = Jet::variable(2, pz);
  for (const Case& c : exact_cases) {
    const Jet jet = Expression_3(c.text)(x, y, z);
    EXPECT_NEAR(jet.value(), c.expected(px, py, pz), 4 * epsilon * std::abs(jet.value())) << c.text;
    const Big slope =
        (Expression_3(c.text)(Big(px + h), Big(py), Big(pz)) - Expression_3(c.text)(Big(px - h), Big(py), Big(pz))) /
        (Big(px + h) - Big(px - h));
    const double third_derivative_bound = 100;
    EXPECT_NEAR(jet.derivative(1, 0, 0), static_cast<double>(slope), third_derivative_bound * h * h) << c.text;
  }
  const Jet jet = Expression_3("x^2*y*z + x^4")(x, y, z);
  EXPECT_DOUBLE_EQ(jet.derivative(2, 1, 1), 2);
  EXPECT_DOUBLE_EQ(jet.derivative(4, 0, 0), 24);
}

TEST(Expression_3, an_interval_encloses_the_values) {
  const Points<double> p(100);
  const Interval x(0.3, 0.5), y(0.1, 0.35), z(0.6, 0.9);
  const auto inside = [](const Interval& i, double t) { return i.lower() + t * (i.upper() - i.lower()); };
  for (const Case& c : exact_cases) {
    const Interval bounds = Expression_3(c.text)(x, y, z);
    for (std::size_t i = 0; i < p.x.size(); ++i) {
      const double v = c.expected(inside(x, p.x[i]), inside(y, p.y[i]), inside(z, p.z[i]));
      EXPECT_TRUE(bounds.contains(v)) << c.text << ": " << v;
    }
    EXPECT_TRUE(std::isfinite(bounds.lower()) && std::isfinite(bounds.upper())) << c.text;
  }
}

TEST(Expression_3, a_square_of_an_interval_is_not_a_product) {
  for (const char* text : {"x^2", "x*x", "pow(x, 2)", "(x+y)*(y+x)"})
    EXPECT_GE(Expression_3(text)(Interval(-1, 2), Interval(0), Interval(0)).lower(), 0) << text;
}

TEST(Expression_3, any_number_type_works_through_argument_dependent_lookup) {
  for (const Case& c : exact_cases) {
    const Expression_3 f(c.text);
    const Dual dual = f(Dual(px, 1), Dual(py), Dual(pz));
    EXPECT_NEAR(dual.value, c.expected(px, py, pz), 8 * epsilon * std::abs(dual.value)) << c.text;
    const double slope = f(Jet::variable(0, px), Jet(py), Jet(pz)).derivative(1, 0, 0);
    EXPECT_NEAR(dual.derivative, slope, 32 * epsilon * std::max(1.0, std::abs(slope))) << c.text;
  }
}

TEST(Expression_3, a_number_type_without_a_function_is_told_so) {
  EXPECT_EQ(value("fmod(5*x, y)"), std::fmod(5 * px, py));
  const Expression_3 f("fmod(x, y)");
  EXPECT_THROW(f(Dual(px), Dual(py), Dual(pz)), std::domain_error);
}

TEST(Expression_3, a_float_is_evaluated_as_float) {
  EXPECT_EQ(Expression_3("x*0.1 + y")(0.3f, 0.2f, 0.f), 0.3f * 0.1f + 0.2f);
  EXPECT_EQ(Expression_3("sin(x)")(0.3f, 0.f, 0.f), std::sin(0.3f));
}

} // namespace Expression_3_number_types_test
