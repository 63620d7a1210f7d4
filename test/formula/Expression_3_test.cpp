// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

namespace Expression_3_test {

using equiaffine::Expression_3;
using equiaffine::Input_error;
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
constexpr double px = 0.7, py = 0.4, pz = 0.9; // inside the domain of every function

double value(const std::string& text, double x = px, double y = py, double z = pz) {
  return Expression_3(text)(x, y, z);
}

/// An expression, and the same in the language; exact_cases has one for every operator and function.
struct Case {
  std::string text;
  std::function<double(double, double, double)> expected;
};

const std::vector<Case> exact_cases = {
    {"x", [](double x, double, double) { return x; }},
    {"z", [](double, double, double z) { return z; }},
    {"x+y", [](double x, double y, double) { return x + y; }},
    {"x-y", [](double x, double y, double) { return x - y; }},
    {"x*y", [](double x, double y, double) { return x * y; }},
    {"x/y", [](double x, double y, double) { return x / y; }},
    {"-x", [](double x, double, double) { return -x; }},
    {"+x", [](double x, double, double) { return x; }},
    {"--x", [](double x, double, double) { return x; }},
    {"x+3.5", [](double x, double, double) { return x + 3.5; }},
    {"3.5+x", [](double x, double, double) { return 3.5 + x; }},
    {"x-.3", [](double x, double, double) { return x - .3; }},
    {".3-x", [](double x, double, double) { return .3 - x; }},
    {"x*.3", [](double x, double, double) { return x * .3; }},
    {".3*x", [](double x, double, double) { return .3 * x; }},
    {"x/3", [](double x, double, double) { return x / 3; }},
    {"x/4", [](double x, double, double) { return x / 4; }},
    {"3/x", [](double x, double, double) { return 3 / x; }},
    {"x^0", [](double, double, double) { return 1.0; }},
    {"x^1", [](double x, double, double) { return x; }},
    {"x^2", [](double x, double, double) { return x * x; }},
    {"x^3", [](double x, double, double) { return x * x * x; }},
    {"x^4", [](double x, double, double) { return (x * x) * (x * x); }},
    {"x^5", [](double x, double, double) { return (x * x) * (x * x) * x; }},
    {"x^6", [](double x, double, double) { return (x * x * x) * (x * x * x); }},
    {"x^-1", [](double x, double, double) { return 1 / x; }},
    {"x^-3", [](double x, double, double) { return 1 / (x * x * x); }},
    {"x^.5", [](double x, double, double) { return std::sqrt(x); }},
    {"x^1.5", [](double x, double, double) { return std::pow(x, 1.5); }},
    {"x^-0.3", [](double x, double, double) { return std::pow(x, -0.3); }},
    {"x^y", [](double x, double y, double) { return std::pow(x, y); }},
    {"2^x", [](double x, double, double) { return std::pow(2, x); }},
    {"e^x", [](double x, double, double) { return std::exp(x); }},
    {"pow(x, 3)", [](double x, double, double) { return x * x * x; }},
    {"pow(x, y)", [](double x, double y, double) { return std::pow(x, y); }},
    {"sqrt(x)", [](double x, double, double) { return std::sqrt(x); }},
    {"cbrt(x)", [](double x, double, double) { return std::cbrt(x); }},
    {"exp(x)", [](double x, double, double) { return std::exp(x); }},
    {"log(x)", [](double x, double, double) { return std::log(x); }},
    {"sin(x)", [](double x, double, double) { return std::sin(x); }},
    {"cos(x)", [](double x, double, double) { return std::cos(x); }},
    {"tan(x)", [](double x, double, double) { return std::tan(x); }},
    {"asin(x)", [](double x, double, double) { return std::asin(x); }},
    {"acos(x)", [](double x, double, double) { return std::acos(x); }},
    {"atan(x)", [](double x, double, double) { return std::atan(x); }},
    {"atan2(x, y)", [](double x, double y, double) { return std::atan2(x, y); }},
    {"sinh(x)", [](double x, double, double) { return std::sinh(x); }},
    {"cosh(x)", [](double x, double, double) { return std::cosh(x); }},
    {"tanh(x)", [](double x, double, double) { return std::tanh(x); }},
    {"abs(-x)", [](double x, double, double) { return x; }},
    {"min(x, y)", [](double x, double y, double) { return std::min(x, y); }},
    {"max(x, y)", [](double x, double y, double) { return std::max(x, y); }},
    {"min(x, y, z, .1)", [](double, double, double) { return .1; }},
    {"max(x, y, z)", [](double x, double y, double z) { return std::max(x, std::max(y, z)); }},
    {"hypot(x, y)", [](double x, double y, double) { return std::hypot(x, y); }},
    {"erf(x)", [](double x, double, double) { return std::erf(x); }},
    {"floor(x + y)", [](double x, double y, double) { return std::floor(x + y); }},
    {"sign(y - x)", [](double x, double y, double) { return x < y ? 1. : -1.; }},
    {"pi", [](double, double, double) { return std::numbers::pi; }},
    {"e", [](double, double, double) { return std::numbers::e; }},
    {"x^2 = y", [](double x, double y, double) { return x * x - y; }},
};

/// The Input_error for a text, or nothing when it is accepted.
std::optional<Input_error> error_of(const std::string& text, const std::map<std::string, double>& constants = {}) {
  try {
    const Expression_3 accepted(text, constants);
  } catch (const Input_error& error) {
    return error;
  }
  return std::nullopt;
}

/// The column of the caret, counted from 1.
std::size_t caret_column(const std::string& excerpt) { return excerpt.size() - excerpt.rfind('\n') - 1; }

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

void expect_error(const std::string& text, std::size_t column, const std::string& problem, const std::string& advice) {
  const auto error = error_of(text);
  ASSERT_TRUE(error) << text << " was accepted";
  const std::string expected = problem + " at column " + std::to_string(column) + " of the expression: " + advice;
  EXPECT_EQ(error->what(), expected);
  EXPECT_EQ(caret_column(error->excerpt()), column) << error->excerpt();
}

std::size_t instructions(const std::string& text) { return Expression_3(text).number_of_instructions(); }

/// A few hundred points, whose number is no multiple of a block.
template <class T>
struct Points {
  std::vector<T> x, y, z;

  explicit Points(std::size_t n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0.05, 0.95);
    for (std::size_t i = 0; i < n; ++i)
      for (std::vector<T>* coordinate : {&x, &y, &z}) coordinate->push_back(T(number(random)));
  }
};

/// The text of an expression and its value at (px, py, pz), which is computed while the text is written.
struct Written {
  std::string text;
  double value;
};

Written random_expression(std::mt19937& random, int depth) {
  const unsigned choice = random() % 8;
  if (depth == 0 || choice == 0) {
    const std::vector<Written> leaves = {{"x", px}, {"y", py}, {"z", pz}};
    return leaves[random() % leaves.size()];
  }
  const Written a = random_expression(random, depth - 1);
  if (choice == 1) return {"sin(" + a.text + ")", equiaffine::internal::sine_and_cosine(a.value).first};
  if (choice == 2) return {"(" + a.text + ")^2", a.value * a.value};
  if (choice == 3) return {"(-" + a.text + ")", -a.value};
  const Written b = random_expression(random, depth - 1);
  if (choice == 4) return {"(" + a.text + "+" + b.text + ")", a.value + b.value};
  if (choice == 5) return {"(" + a.text + "-" + b.text + ")", a.value - b.value};
  if (choice == 6) return {"(" + a.text + ")*(" + b.text + ")", a.value * b.value};
  return {"(" + a.text + ")/(" + b.text + "+2)", a.value / (b.value + 2)};
}

const std::string torus = "(x^2+y^2+z^2+3.75)^2 = 16*(x^2+y^2)";
const std::string everything =
    "sqrt(x)+cbrt(y)+exp(z)+log(x)+sin(y)+cos(z)+tan(x)+asin(y)+acos(z)+atan(x)+atan2(y,z)+sinh(x)+cosh(y)+tanh(z)"
    "+abs(x-y)+min(x,y,z)+max(x,y,z)+hypot(x,y)+x^y+y^1.5+z^7+x^4+x^-3+2/x-x/3+(1-y)*0.25-(-z)^3+0.5";

static_assert(std::is_copy_constructible_v<Expression_3> && std::is_copy_assignable_v<Expression_3>);
static_assert(std::is_nothrow_move_constructible_v<Expression_3>);
static_assert(!std::is_convertible_v<std::string, Expression_3>, "parsing is never implicit");

TEST(Expression_3, every_operator_and_function_is_that_of_the_language) {
  for (const Case& c : exact_cases) EXPECT_EQ(value(c.text), c.expected(px, py, pz)) << c.text;
}

TEST(Expression_3, precedence_and_associativity_are_those_of_mathematics) {
  EXPECT_EQ(value("-x^2", 3), -9);
  EXPECT_EQ(value("(-x)^2", 3), 9);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("2^-2^2"), 1.0 / 16);
  EXPECT_EQ(value("x-2-1", 9), 6);
  EXPECT_EQ(value("x/2/3", 12), 2);
  EXPECT_EQ(value("x/2*3", 12), 18);
  EXPECT_EQ(value("1+2*x^2", 3), 19);
  EXPECT_EQ(value("(1+2)*x", 3), 9);
  EXPECT_EQ(value("2*-x", 3), -6);
  EXPECT_EQ(value("2--x", 3), 5);
  EXPECT_EQ(value("x+1 = 2*x-4", 3), 2);
}

TEST(Expression_3, white_space_is_free) { EXPECT_EQ(value(" \t x\n+\r\n min ( y ,z )  "), px + py); }

TEST(Expression_3, numbers_are_read_to_the_last_bit) {
  EXPECT_EQ(value("1e-3"), 1e-3);
  EXPECT_EQ(value(".5"), 0.5);
  EXPECT_EQ(value("2."), 2.0);
  EXPECT_EQ(value("1E+2"), 100.0);
  EXPECT_EQ(value("0.1000000000000000055511151231257827"), 0.1);
  EXPECT_EQ(value("1.7976931348623157e308"), std::numeric_limits<double>::max());
}

TEST(Expression_3, constants_of_the_caller_are_known) {
  const Expression_3 f("a*x + b_2 = Gamma", {{"a", 3.0}, {"b_2", 0.5}, {"Gamma", -1.0}});
  EXPECT_EQ(f(2.0, 0.0, 0.0), 7.5);
  EXPECT_EQ(f.text(), "a*x + b_2 = Gamma");
}

TEST(Expression_3, minimum_and_maximum_of_a_nan_are_nan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* text : {"min(x,y)", "max(x,y)"}) {
    EXPECT_TRUE(std::isnan(value(text, nan, 1))) << text;
    EXPECT_TRUE(std::isnan(value(text, 1, nan))) << text;
  }
}

TEST(Expression_3, outside_a_domain_a_double_is_nan) {
  EXPECT_TRUE(std::isnan(value("log(x)", -1)));
  EXPECT_TRUE(std::isnan(value("x^1.5", -1)));
  EXPECT_TRUE(std::isnan(value("x/y", 0, 0)));
}

TEST(Expression_3, equal_subexpressions_are_evaluated_once) {
  EXPECT_EQ(instructions("x"), 0u);
  EXPECT_EQ(instructions("x*x"), 1u);
  EXPECT_EQ(instructions("x^2 + x*x"), 2u);               // square, add
  EXPECT_EQ(instructions("x*y + y*x"), 2u);               // multiply, add
  EXPECT_EQ(instructions("sin(x+y)*sin(y+x)"), 3u);       // add, sin, square
  EXPECT_EQ(instructions("atan2(x,y) - atan2(y,x)"), 3u); // not the same
  EXPECT_EQ(instructions(torus), 9u);
}

TEST(Expression_3, constant_subexpressions_are_folded_to_what_run_time_would_give) {
  EXPECT_EQ(instructions("x + 2*pi/3 - sqrt(2)"), 2u); // add 2 pi / 3, add - sqrt 2
  EXPECT_EQ(instructions("1+2*3"), 1u);
  EXPECT_EQ(instructions("x*1 - 0"), 0u);
  EXPECT_EQ(instructions("x^2 = 0"), 1u);
  const double a = 0.3, b = 0.7;
  const std::map<std::string, double> constants = {{"a", a}, {"b", b}};
  for (const std::string op : {"a+b", "a-b", "a*b", "a/b", "a^b", "a^3", "a^-5", "sin(a)", "min(a,b)", "hypot(a,b)"}) {
    std::string in_variables = op;
    std::replace(in_variables.begin(), in_variables.end(), 'b', 'y');
    if (in_variables.substr(0, 4) != "sin(") std::replace(in_variables.begin(), in_variables.end(), 'a', 'x');
    else in_variables = "sin(x)";
    EXPECT_EQ(Expression_3(op, constants)(0.0, 0.0, 0.0), value(in_variables, a, b)) << op;
  }
}

TEST(Expression_3, only_identities_that_hold_for_every_double_are_used) {
  EXPECT_FALSE(std::signbit(value("x+0", -0.0)));
  EXPECT_TRUE(std::signbit(value("x-0", -0.0)));
  EXPECT_TRUE(std::isnan(value("0*x", std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isnan(value("x-x", std::numeric_limits<double>::infinity())));
  EXPECT_EQ(value("x/3", 5.0), 5.0 / 3.0);
  EXPECT_EQ(value("x/2^1023", 8.0), 0x1p-1020);
  EXPECT_EQ(value("x/2^-1023", 0x1p-1020), 8.0);
  EXPECT_EQ(value("x/4.9406564584124654e-324", 0.0), 0.0); // the inverse is not finite
}

TEST(Expression_3, random_expressions_are_evaluated_as_written) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    const Written written = random_expression(random, 6);
    const double evaluated = value(written.text);
    EXPECT_TRUE(evaluated == written.value || (std::isnan(evaluated) && std::isnan(written.value))) << written.text;
  }
}

TEST(Expression_3, a_block_gives_the_bits_of_single_calls) {
  const Points<double> p(333);
  for (const std::string& text : {torus, everything, std::string("x"), std::string("2"), std::string("x^-9+y^6")}) {
    const Expression_3 f(text);
    for (const std::size_t n : {0u, 1u, 63u, 64u, 65u, 333u}) {
      std::vector<double> out(n);
      f(std::span(p.x).first(n), std::span(p.y).first(n), std::span(p.z).first(n), std::span(out));
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(out[i]), std::bit_cast<std::uint64_t>(f(p.x[i], p.y[i], p.z[i])))
            << text << " at " << i;
    }
  }
}

TEST(Expression_3, a_block_may_overwrite_an_argument) {
  const Points<double> p(200);
  const Expression_3 f("y + sin(x)*z");
  std::vector<double> in_place = p.y;
  f(std::span(p.x), std::span<const double>(in_place), std::span(p.z), std::span(in_place));
  for (std::size_t i = 0; i < in_place.size(); ++i) EXPECT_EQ(in_place[i], f(p.x[i], p.y[i], p.z[i]));
}

TEST(Expression_3, a_block_of_jets_or_floats_gives_single_results) {
  const Expression_3 f(everything);
  const Points<float> p(150);
  std::vector<float> out(150);
  f(std::span<const float>(p.x), std::span<const float>(p.y), std::span<const float>(p.z), std::span(out));
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_EQ(out[i], f(p.x[i], p.y[i], p.z[i]));
  const std::vector<Jet> x = {Jet::variable(0, 0.3), Jet::variable(0, px)}, y(2, Jet::variable(1, py)),
                         z(2, Jet::variable(2, pz));
  std::vector<Jet> jets(2);
  f(std::span(x), std::span(y), std::span(z), std::span(jets));
  EXPECT_EQ(jets[1].coefficients(), f(x[1], y[1], z[1]).coefficients());
}

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

TEST(Expression_3, more_intermediate_results_than_fit_on_the_stack_are_possible) {
  std::string text = "x";
  double expected = px;
  for (int i = 40; i > 0; --i) { // right-nested: every quotient waits for the sum behind it
    text = "x/" + std::to_string(2 * i + 1) + "*(y/" + std::to_string(2 * i + 1) + "+" + text + ")";
    expected = px / (2 * i + 1) * (py / (2 * i + 1) + expected);
  }
  EXPECT_EQ(value(text), expected);
  EXPECT_EQ(Expression_3(text)(Jet(px), Jet(py), Jet(pz)).value(), expected);
  std::vector<double> out(70);
  const std::vector<double> x(70, px), y(70, py), z(70, pz);
  const Expression_3 f(text);
  f(std::span(x), std::span(y), std::span(z), std::span(out));
  EXPECT_EQ(out, std::vector<double>(70, expected));
}

TEST(Expression_3, long_texts_are_no_problem) {
  std::string text = "x";
  for (int i = 1; i <= 20000; ++i) text += " + y/" + std::to_string(i);
  double expected = px;
  for (int i = 1; i <= 20000; ++i) expected += py / i;
  EXPECT_EQ(value(text), expected);
}

TEST(Expression_3, a_copy_outlives_its_original) {
  std::optional<Expression_3> original(std::in_place, std::string("x + a"), std::map<std::string, double>{{"a", 2.0}});
  Expression_3 copy = *original;
  const Expression_3 moved = std::move(*original);
  original.reset();
  EXPECT_EQ(copy(1.0, 0.0, 0.0), 3);
  EXPECT_EQ(copy.text(), "x + a");
  EXPECT_EQ(moved(1.0, 0.0, 0.0), 3);
  copy = Expression_3("x*y");
  EXPECT_EQ(copy(2.0, 3.0, 0.0), 6);
  EXPECT_EQ(moved(1.0, 0.0, 0.0), 3);
}

TEST(Expression_3, threads_may_share_one) {
  const Expression_3 f(everything);
  const Points<double> p(2000);
  std::vector<double> expected(p.x.size());
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = f(p.x[i], p.y[i], p.z[i]);
  std::vector<std::vector<double>> results(4, std::vector<double>(expected.size()));
  std::vector<std::thread> threads;
  for (std::vector<double>& result : results)
    threads.emplace_back([&] { f(std::span(p.x), std::span(p.y), std::span(p.z), std::span(result)); });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& result : results) EXPECT_EQ(result, expected);
}

TEST(Expression_3, a_missing_operator_is_named) {
  expect_error("2x", 2, "missing operator between '2' and 'x'", "for a product write 2*x");
  expect_error("2(x+1)", 2, "missing operator between '2' and '('", "for a product write 2*(...)");
  expect_error("(x)(y)", 4, "missing operator between ')' and '('", "for a product write (...)*(...)");
  expect_error("x + y z", 7, "missing operator between 'y' and 'z'", "for a product write y*z");
  expect_error("sin(x)y", 7, "missing operator between ')' and 'y'", "for a product write (...)*y");
  expect_error("(2x)", 3, "missing operator between '2' and 'x'", "for a product write 2*x");
  expect_error("x**2", 2, "unknown operator '**'", "use ^ for powers");
}

TEST(Expression_3, an_unknown_name_is_told_with_a_remedy) {
  const std::string define = "give it a value as a constant, or use x, y, z";
  expect_error("x + 2*foo", 7, "unknown name 'foo'", define);
  const std::string all = "use one of sqrt cbrt exp log sin cos tan asin acos atan atan2 sinh cosh tanh abs min max "
                          "hypot erf floor sign fmod "
                          "pow";
  expect_error("sqr(x)", 1, "unknown function 'sqr'", "did you mean 'sqrt'? Otherwise " + all);
  expect_error("1+ln(x)", 3, "unknown function 'ln'", "did you mean 'log'? Otherwise " + all);
  expect_error("sgn(x)", 1, "unknown function 'sgn'", "did you mean 'sign'? Otherwise " + all);
  expect_error("mod(x, 2)", 1, "unknown function 'mod'", "did you mean 'fmod'? Otherwise " + all);
  expect_error("log10(x)", 1, "unknown function 'log10'", "did you mean 'log(...)/log(10)'? Otherwise " + all);
  expect_error("frobnicate(x)", 1, "unknown function 'frobnicate'", all);
  expect_error("X", 1, "unknown name 'X'", "did you mean 'x'? Otherwise give it a value as a constant, or use x, y, z");
  const auto error = error_of("x + radios", {{"radius", 1.0}});
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("did you mean 'radius'?"), std::string::npos) << error->what();
}

TEST(Expression_3, the_error_of_an_unknown_name_has_the_name) {
  try {
    Expression_3("x + 2*radius_1");
    FAIL();
  } catch (const equiaffine::Unknown_name_error& error) {
    EXPECT_EQ(error.name(), "radius_1");
    EXPECT_EQ(error.excerpt(), "x + 2*radius_1\n      ^");
  }
}

TEST(Expression_3, signs_of_other_alphabets_are_told_with_what_to_write) {
  expect_error("x\u00b2 + y", 2, "unexpected '\u00b2'", "write ^2");
  expect_error("2*\u03c0*x", 3, "unexpected '\u03c0'", "write pi");
  expect_error("x \u2212 1", 3, "unexpected '\u2212'", "write -");
}

TEST(Expression_3, has_no_angle_at_the_origin) {
  const Expression_3 f("y + x^2 + z^2 + atan2(0, x)");
  EXPECT_TRUE(std::isnan(f(0., 0., 0.)));
  EXPECT_TRUE(std::isnan(f.taylor(0., 0., 0.).value()));
  EXPECT_TRUE(std::isnan(f.taylor(0., 1., 0.).value()));
  EXPECT_EQ(f.taylor(1., 0., 0.).value(), 1.);
  expect_error("x + atan2(0, 0)", 5, "result of 'atan2' that is not a finite number",
               "check the constants it is applied to");
}

TEST(Expression_3, parentheses_must_match) {
  expect_error("2*(x+1", 3, "'(' that is never closed", "add ')'");
  expect_error("sin(x", 4, "'(' that is never closed", "add ')'");
  expect_error("((x)", 1, "'(' that is never closed", "add ')'");
  expect_error("x+1)", 4, "')' that closes nothing", "remove it or add '('");
  expect_error("x+()", 4, "unexpected ')'", "a number, a name or '(' is missing before it");
}

TEST(Expression_3, something_must_stand_on_both_sides_of_an_operator) {
  const std::string advice = "write a function of x, y, z such as x^2 + y^2 + z^2 - 1";
  expect_error("", 1, "nothing to evaluate", advice);
  expect_error("x +", 4, "unexpected end", "a number, a name or '(' is missing");
  expect_error("x = ", 5, "unexpected end", "a number, a name or '(' is missing");
  expect_error("*x", 1, "unexpected '*'", "a number, a name or '(' is missing before it");
  expect_error("= x", 1, "unexpected '='", "a number, a name or '(' is missing before it");
  expect_error("x+/y", 3, "unexpected '/'", "a number, a name or '(' is missing before it");
  const auto blank = error_of(" \t\n");
  ASSERT_TRUE(blank);
  EXPECT_EQ(std::string(blank->what()), "nothing to evaluate at column 1 of the expression: " + advice);
}

TEST(Expression_3, an_equation_has_one_sign) {
  expect_error("x = y = z", 7, "second '='", "an equation is lhs = rhs");
  expect_error("x == y", 4, "second '='", "an equation is lhs = rhs");
  expect_error("(x = y)", 4, "'=' inside parentheses", "an equation is lhs = rhs");
}

TEST(Expression_3, functions_take_their_number_of_arguments) {
  expect_error("1+atan2(x)", 3, "wrong number of arguments of 'atan2'", "it takes 2 arguments, not 1");
  expect_error("sin()", 1, "wrong number of arguments of 'sin'", "it takes 1 argument, not 0");
  expect_error("sin(x,y)", 1, "wrong number of arguments of 'sin'", "it takes 1 argument, not 2");
  expect_error("max(x)", 1, "wrong number of arguments of 'max'", "it takes 2 or more arguments, not 1");
  expect_error("pow(x,2,3)", 1, "wrong number of arguments of 'pow'", "it takes 2 arguments, not 3");
  expect_error("sin + x", 1, "function 'sin' without arguments", "write sin(...)");
  expect_error("min(x,)", 7, "unexpected ')'", "a number, a name or '(' is missing before it");
}

TEST(Expression_3, characters_outside_the_language_are_refused) {
  const std::string advice = "use names, numbers, ( ) , = and + - * / ^ only";
  expect_error("x % 2", 3, "unexpected '%'", advice);
  expect_error("[x]", 1, "unexpected '['", advice);
  expect_error("x \xE2\x88\x91 1", 3, "unexpected character that is not ASCII, byte 0xE2", advice);
  expect_error("x\x01", 2, "unexpected control character byte 0x01", advice);
  expect_error(std::string("x\0y", 3), 2, "unexpected control character byte 0x00", advice);
  expect_error("1,5*x", 2, "unexpected ','", "it separates the arguments of a function; decimals have a point");
}

TEST(Expression_3, numbers_must_be_in_the_range_of_double) {
  const std::string advice = "magnitudes from 1e-307 to 1e308 are possible";
  expect_error("x+1e999", 3, "number '1e999' out of range", advice);
  expect_error("1e-999*x", 1, "number '1e-999' out of range", advice);
  expect_error("x + .", 5, "a point without digits", "write a number such as 0.5");
}

TEST(Expression_3, constant_results_must_be_finite) {
  const std::string advice = "check the constants it is applied to";
  expect_error("x+1/0", 4, "result of '/' that is not a finite number", advice);
  expect_error("x*sqrt(-2)", 3, "result of 'sqrt' that is not a finite number", advice);
  expect_error("10^400 + x", 3, "result of '^' that is not a finite number", advice);
}

TEST(Expression_3, nesting_is_limited_long_before_the_stack_ends) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '(') + "x" + std::string(depth, ')'); };
  EXPECT_EQ(value(nested(999)), px);
  EXPECT_EQ(value("2 + " + std::string(100001, '-') + "x"), 2 - px); // signs do not nest
  for (const std::string& text : {nested(1000000), [] {
                                    std::string tower = "x";
                                    for (int i = 0; i < 100000; ++i) tower += "^x";
                                    return tower;
                                  }()}) {
    const auto error = error_of(text);
    ASSERT_TRUE(error);
    EXPECT_EQ(std::string(error->what()).substr(0, 26), "too deep nesting at column");
  }
}

TEST(Expression_3, an_excerpt_shows_the_place_with_a_caret) {
  EXPECT_EQ(error_of("x +\t2y")->excerpt(), "x + 2y\n     ^");
  EXPECT_EQ(error_of("x \xE2\x88\x92 1")->excerpt(), "x ??? 1\n  ^");
}

TEST(Expression_3, an_excerpt_of_a_long_text_is_a_window) {
  std::string text;
  for (int i = 0; i < 200; ++i) text += "x + ";
  for (const std::size_t position : {std::size_t(0), std::size_t(300), std::size_t(792)}) {
    std::string bad = text + "y";
    bad[position] = '$';
    const auto error = error_of(bad);
    ASSERT_TRUE(error);
    const std::string excerpt = error->excerpt();
    const std::size_t line = excerpt.find('\n');
    EXPECT_LE(line, 100u);
    EXPECT_EQ(excerpt[caret_column(excerpt) - 1], '$') << excerpt;
    EXPECT_EQ(excerpt.substr(0, 3) == "...", position > 100) << excerpt;
    EXPECT_EQ(excerpt.substr(line - 3, 3) == "...", position < 700) << excerpt;
  }
}

TEST(Expression_3, a_message_is_one_line_of_bounded_length) {
  for (const std::string& text : {std::string(100000, 'q'), std::string("x\n+\n$"), std::string(100000, '(')}) {
    const auto error = error_of(text);
    ASSERT_TRUE(error);
    EXPECT_EQ(std::string(error->what()).find('\n'), std::string::npos);
    EXPECT_LT(std::string(error->what()).size(), 400u);
    EXPECT_EQ(std::count(error->excerpt().begin(), error->excerpt().end(), '\n'), 1);
  }
}

TEST(Expression_3, a_constant_must_have_a_free_name_and_a_finite_value) {
  for (const std::string name : {"x", "y", "z", "pi", "e", "sin", "pow"})
    EXPECT_EQ(std::string(error_of("x", {{name, 1.0}})->what()),
              "constant '" + name + "' hides a name that expressions know: choose another name");
  for (const std::string name : {"", "2a", "a b", "a+"})
    EXPECT_EQ(std::string(error_of("x", {{name, 1.0}})->what()),
              "'" + name + "' cannot name a constant: use letters, digits and _, and no digit first");
  for (const double number : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(std::string(error_of("x", {{"a", number}})->what()),
              "constant 'a' is not a finite number: give it a finite value");
}

/// A union of spheres with a cut, whose choices differ from place to place.
std::string text_with_choices() {
  std::string spheres;
  for (int n = 0; n < 12; ++n) {
    const std::string c = std::to_string(0.15 * (n - 6));
    spheres += (n > 0 ? "," : "") + std::string("sqrt((x-") + c + ")^2+(y+" + c + ")^4+abs(z-" + c + ")^3)-0.2";
  }
  return "max(min(" + spheres + "), x-0.9, abs(y)-0.8)";
}

TEST(Expression_3, on_a_box_it_is_shorter_and_has_the_same_bits) {
  const Expression_3 f(text_with_choices());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> center(-1, 1);
  std::size_t shorter = 0;
  for (int box = 0; box < 300; ++box) {
    const std::array<double, 3> c = {center(random), center(random), center(random)};
    const double r = std::pow(2.0, -(box % 6));
    const auto part = f.restricted({c[0] - r, c[0] + r}, {c[1] - r, c[1] + r}, {c[2] - r, c[2] + r});
    if (!part) continue;
    shorter += part->number_of_instructions() < f.number_of_instructions() / 2;
    std::uniform_real_distribution<double> offset(-r, r);
    for (int n = 0; n < 20; ++n) {
      const double x = c[0] + offset(random), y = c[1] + offset(random), z = c[2] + offset(random);
      ASSERT_EQ(std::bit_cast<std::uint64_t>((*part)(x, y, z)), std::bit_cast<std::uint64_t>(f(x, y, z)));
      using First_order = equiaffine::Jet_3<double, 1>;
      const std::array<First_order, 3> p = {First_order::variable(0, x), First_order::variable(1, y),
                                            First_order::variable(2, z)};
      const auto of_part = (*part)(p[0], p[1], p[2]), of_whole = f(p[0], p[1], p[2]);
      for (std::size_t m = 0; m < of_whole.size; ++m)
        ASSERT_EQ(std::bit_cast<std::uint64_t>(of_part.coefficients()[m]),
                  std::bit_cast<std::uint64_t>(of_whole.coefficients()[m]));
    }
  }
  EXPECT_GT(shorter, 100u);
}

TEST(Expression_3, on_a_box_an_operand_without_a_value_somewhere_stays) {
  const std::string sum = "+x+y+z+x*y+y*z+z*x+x*y*z+x^2*y+y^2*z+z^2*x+x/7+y/7+z/7";
  const Interval side(-0.01, 0.01);
  EXPECT_TRUE(Expression_3("min(x, 10+sqrt(1+y))" + sum).restricted(side, side, side));
  for (const std::string other :
       {"sqrt(y)", "log(y)", "1/y", "y^1.5", "asin(1+y)", "atan2(y,z)", "y/(x-z)", "(1/y)*0", "tan(pi/2+y)"})
    EXPECT_FALSE(Expression_3("min(x, 10+" + other + ")" + sum).restricted(side, side, side)) << other;
  EXPECT_FALSE(Expression_3("min(x, y)" + sum).restricted(side, side, side));
  EXPECT_FALSE(Expression_3("abs(x)" + sum).restricted(Interval(0, 1), side, side)); // abs(-0) is 0
  EXPECT_FALSE(Expression_3("max(x, y, z)").restricted(Interval(1, 2), side, side)) << "too short to gain";
}

} // namespace Expression_3_test
