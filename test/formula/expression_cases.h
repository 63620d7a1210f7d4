// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions, beside the same in the language.
#ifndef EQUIAFFINE_TEST_FORMULA_EXPRESSION_CASES_H
#define EQUIAFFINE_TEST_FORMULA_EXPRESSION_CASES_H

#include <equiaffine/formula/Expression_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace expression_cases {

using equiaffine::Expression_3;

inline constexpr double px = 0.7, py = 0.4, pz = 0.9; // inside the domain of every function

inline double value(const std::string& text, double x = px, double y = py, double z = pz) {
  return Expression_3(text)(x, y, z);
}

/// An expression, and the same in the language; exact_cases has one for every operator and function.
struct Case {
  std::string text;
  std::function<double(double, double, double)> expected;
};

inline const std::vector<Case> exact_cases = {
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

inline const std::string everything =
    "sqrt(x)+cbrt(y)+exp(z)+log(x)+sin(y)+cos(z)+tan(x)+asin(y)+acos(z)+atan(x)+atan2(y,z)+sinh(x)+cosh(y)+tanh(z)"
    "+abs(x-y)+min(x,y,z)+max(x,y,z)+hypot(x,y)+x^y+y^1.5+z^7+x^4+x^-3+2/x-x/3+(1-y)*0.25-(-z)^3+0.5";

} // namespace expression_cases

#endif
