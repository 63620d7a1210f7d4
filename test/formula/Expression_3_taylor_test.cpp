// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/number/Jet_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace Expression_3_taylor_test {

using equiaffine::Expression_3;
using Jet = equiaffine::Jet_3<double>;

TEST(Expression_3, taylor_polynomials_are_those_of_a_call_on_jets) {
  const std::vector<std::string> texts = {"x",
                                          "3",
                                          "x*y*z",
                                          "(x+2*y-z)^3/(3+x*z)",
                                          "sqrt(2+x)+cbrt(3+y)+exp(z)-log(2+x*y)",
                                          "sin(x)+cos(y)*tan(z)",
                                          "asin(x/2)+acos(y/2)+atan(z)+atan2(x,3+y)",
                                          "sinh(x)-cosh(y)+tanh(z)",
                                          "abs(x-2)*abs(y+3)",
                                          "min(x,y+3)+max(z,x-5)",
                                          "hypot(x,y+2)+pow(2+x,y)",
                                          "(2+x)^1.5+(3+y)^-2+(2+z)^9+2^x+max(x*y,0*z)",
                                          "erf(x*y+z)*z",
                                          "floor(3*x)*y+sign(z)*x+fmod(5*x,2+y)",
                                          "fmod(7,3+x*y)",
                                          "0*log(2+x)+(x-x)*y"};
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const std::string& text : texts) {
    const Expression_3 f(text);
    for (int n = 0; n < 20; ++n) {
      const double x = unit(random), y = unit(random), z = unit(random);
      const Jet actual = f.taylor(x, y, z);
      const Jet expected = f(Jet::variable(0, x), Jet::variable(1, y), Jet::variable(2, z));
      EXPECT_EQ(actual.value(), f(x, y, z)) << text;
      for (std::size_t c = 1; c < Jet::size; ++c) {
        const double limit = 1e-13 * (1 + std::abs(expected.coefficients()[c]));
        EXPECT_NEAR(actual.coefficients()[c], expected.coefficients()[c], limit) << text << ", coefficient " << c;
      }
    }
  }
}

TEST(Expression_3, taylor_polynomials_tell_of_kinks_and_of_values_that_do_not_exist) {
  const auto is_smooth = [](const std::string& text, double x) {
    const Jet jet = Expression_3(text).taylor(x, 0.0, 0.0);
    EXPECT_EQ(jet.value(), Expression_3(text)(x, 0.0, 0.0)) << text;
    return std::all_of(jet.coefficients().begin(), jet.coefficients().end(), [](double c) { return std::isfinite(c); });
  };
  for (const char* text :
       {"abs(x)", "y + abs(x)^3", "max(x, 0)", "min(x, y)", "sqrt(x^2)", "hypot(x, y)", "x^1.5", "cbrt(x)"}) {
    EXPECT_FALSE(is_smooth(text, 0)) << text;
    EXPECT_TRUE(is_smooth(text, 0.5)) << text;
  }
  for (const char* text : {"floor(x)", "floor(-x) + y", "sign(x)*z", "fmod(x + 3, 1)"}) {
    EXPECT_FALSE(is_smooth(text, 0)) << text;
    EXPECT_TRUE(is_smooth(text, 0.5)) << text;
  }
  EXPECT_TRUE(is_smooth("fmod(x, 1)", 0));
  for (const char* text : {"abs(x)^4", "abs(x)^2 + y", "abs(x - y)^6*z"}) EXPECT_TRUE(is_smooth(text, 0)) << text;
  EXPECT_TRUE(is_smooth("y + 0^x", 0.5));
  EXPECT_FALSE(is_smooth("y + 0^x", 0));
  EXPECT_TRUE(std::isnan(Expression_3("log(x)*y").taylor(-1.0, 2.0, 0.0).value()));
  EXPECT_TRUE(std::isnan(Expression_3("0*log(x)").taylor(-1.0, 2.0, 0.0).value()));
}

TEST(Expression_3, the_larger_of_two_equal_operands_has_no_kink) {
  const auto jet = Expression_3("max(x^2, x^2) + min(y, y)").taylor(0.5, 2., 0.);
  EXPECT_EQ(jet.value(), 2.25);
  EXPECT_EQ(jet.derivative(1, 0, 0), 1);
  EXPECT_EQ(jet.derivative(2, 0, 0), 2);
  EXPECT_EQ(jet.derivative(0, 1, 0), 1);
}

TEST(Expression_3, taylor_polynomials_of_many_points_are_those_of_each_bit_for_bit) {
  const Expression_3 f("exp(x*y)*sin(z)/(2+x) + max(x, y*z)^3"), copy = f;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const std::size_t size : {0, 1, 31, 32, 33, 100}) {
    std::vector<double> x(size), y(size), z(size);
    for (auto* axis : {&x, &y, &z})
      for (double& c : *axis) c = unit(random);
    std::vector<Jet> jets(size);
    f.taylor(std::span<const double>(x), std::span<const double>(y), std::span<const double>(z), std::span(jets));
    for (std::size_t i = 0; i < size; ++i)
      EXPECT_EQ(jets[i].coefficients(), copy.taylor(x[i], y[i], z[i]).coefficients());
  }
}

} // namespace Expression_3_taylor_test
