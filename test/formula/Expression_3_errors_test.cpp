// SPDX-License-Identifier: GPL-3.0-or-later
#include "formula/expression_cases.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/formula/Expression_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace Expression_3_errors_test {

using namespace expression_cases;
using equiaffine::Expression_3;
using equiaffine::Input_error;

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

void expect_error(const std::string& text, std::size_t column, const std::string& problem, const std::string& advice) {
  const auto error = error_of(text);
  ASSERT_TRUE(error) << text << " was accepted";
  const std::string expected = problem + " at column " + std::to_string(column) + " of the expression: " + advice;
  EXPECT_EQ(error->what(), expected);
  EXPECT_EQ(caret_column(error->excerpt()), column) << error->excerpt();
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
  const std::string define = "define it as a constant, or use x, y, z";
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
  expect_error("X", 1, "unknown name 'X'", "did you mean 'x'? Otherwise define it as a constant, or use x, y, z");
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
  expect_error("x + atan2(0, 0)", 5, "non-finite result of 'atan2'", "check its constant operands");
}

TEST(Expression_3, parentheses_must_match) {
  expect_error("2*(x+1", 3, "unclosed '('", "add ')'");
  expect_error("sin(x", 4, "unclosed '('", "add ')'");
  expect_error("((x)", 1, "unclosed '('", "add ')'");
  expect_error("x+1)", 4, "unmatched ')'", "remove it or add '('");
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
  expect_error("x = y = z", 7, "second '='", "write one equation, lhs = rhs");
  expect_error("x == y", 4, "second '='", "write one equation, lhs = rhs");
  expect_error("(x = y)", 4, "'=' inside parentheses", "use '=' only between the sides of an equation");
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
  expect_error("x \xE2\x88\x91 1", 3, "unexpected non-ASCII character, byte 0xE2", advice);
  expect_error("x\x01", 2, "unexpected control character, byte 0x01", advice);
  expect_error(std::string("x\0y", 3), 2, "unexpected control character, byte 0x00", advice);
  expect_error("1,5*x", 2, "unexpected ','",
               "use ',' only between arguments of a function, and '.' in decimal numbers");
}

TEST(Expression_3, numbers_must_be_in_the_range_of_double) {
  const std::string advice = "use a magnitude from 1e-307 to 1e308";
  expect_error("x+1e999", 3, "number '1e999' out of range", advice);
  expect_error("1e-999*x", 1, "number '1e-999' out of range", advice);
  expect_error("x + .", 5, "decimal point without digits", "write a number such as 0.5");
}

TEST(Expression_3, constant_results_must_be_finite) {
  const std::string advice = "check its constant operands";
  expect_error("x+1/0", 4, "non-finite result of '/'", advice);
  expect_error("x*sqrt(-2)", 3, "non-finite result of 'sqrt'", advice);
  expect_error("10^400 + x", 3, "non-finite result of '^'", advice);
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
              "the name of constant '" + name + "' is reserved: choose another name");
  for (const std::string name : {"", "2a", "a b", "a+"})
    EXPECT_EQ(std::string(error_of("x", {{name, 1.0}})->what()),
              "'" + name +
                  "' is not a valid name of a constant: use letters, digits and _, and do not start with a digit");
  for (const double number : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(std::string(error_of("x", {{"a", number}})->what()),
              "constant 'a' is not finite: set it to a finite value");
}

} // namespace Expression_3_errors_test
