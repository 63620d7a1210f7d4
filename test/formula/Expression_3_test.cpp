// SPDX-License-Identifier: GPL-3.0-or-later
#include "formula/expression_cases.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/number/Jet_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace Expression_3_test {

using namespace expression_cases;
using equiaffine::Expression_3;
using Jet = equiaffine::Jet_3<double>;

std::size_t instructions(const std::string& text) { return Expression_3(text).number_of_instructions(); }

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

} // namespace Expression_3_test
