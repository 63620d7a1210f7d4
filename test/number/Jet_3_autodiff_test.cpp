// SPDX-License-Identifier: GPL-3.0-or-later
// Jets against Boost.Math autodiff, which propagates nested univariate expansions: another algorithm altogether.
#include <equiaffine/number/Jet_3.h>

#include <boost/math/differentiation/autodiff.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace Jet_3_autodiff_test {

using Jet = equiaffine::Jet_3<double, 5>;
using Derivatives = std::vector<double>;

// The functions that autodiff has, of two arguments that are not the coordinates themselves, so that all parts of the
// composition count. The results are numbered.
constexpr auto functions = [](const auto& x, const auto& y, const auto& z, auto visit) {
  using Number = std::decay_t<decltype(x)>;
  const Number u = x * y + z, v = y - x * z;
  visit(Number(u + v));
  visit(Number(2 - u * v));
  visit(Number(u / v));
  visit(Number(3 / u));
  visit(Number(pow(u, 3)));
  visit(Number(pow(u, -2)));
  visit(Number(pow(u, 2.5)));
  visit(Number(pow(u, v)));
  visit(Number(sqrt(u)));
  visit(Number(exp(u)));
  visit(Number(log(u)));
  visit(Number(sin(u)));
  visit(Number(cos(u)));
  visit(Number(tan(u)));
  visit(Number(asin(u)));
  visit(Number(acos(u)));
  visit(Number(atan(u)));
  visit(Number(atan2(u, v)));
  visit(Number(sinh(u)));
  visit(Number(cosh(u)));
  visit(Number(tanh(u)));
  visit(Number(abs(u - v)));
};

template <class Derivative>
Derivatives derivatives(Derivative derivative) {
  Derivatives d;
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; i + j <= 5; ++j)
      for (int k = 0; i + j + k <= 5; ++k) d.push_back(derivative(i, j, k));
  return d;
}

std::vector<Derivatives> by_jets(const std::array<double, 3>& p) {
  std::vector<Derivatives> result;
  functions(Jet::variable(0, p[0]), Jet::variable(1, p[1]), Jet::variable(2, p[2]), [&](const Jet& f) {
    result.push_back(derivatives([&](int i, int j, int k) { return f.derivative(i, j, k); }));
  });
  return result;
}

std::vector<Derivatives> by_autodiff(const std::array<double, 3>& p) {
  const auto variables = boost::math::differentiation::make_ftuple<double, 5, 5, 5>(p[0], p[1], p[2]);
  using Number = decltype(std::get<0>(variables) + std::get<1>(variables) + std::get<2>(variables));
  std::vector<Derivatives> result;
  functions(Number(std::get<0>(variables)), Number(std::get<1>(variables)), Number(std::get<2>(variables)),
            [&](const Number& f) {
              result.push_back(derivatives([&](int i, int j, int k) { return f.derivative(i, j, k); }));
            });
  return result;
}

TEST(Jet_3_autodiff, all_derivatives_of_every_function_are_those_of_boost_autodiff) {
  // The norm is over all 56 derivatives; autodiff itself is good for a few units in the last place.
  constexpr double tolerance = 32 * std::numeric_limits<double>::epsilon();
  for (const std::array<double, 3>& p : {std::array{0.3, 0.7, 0.2}, std::array{-0.4, -0.9, 0.15}}) {
    const std::vector<Derivatives> jets = by_jets(p), oracle = by_autodiff(p);
    ASSERT_EQ(jets.size(), 22u);
    ASSERT_EQ(jets.size(), oracle.size());
    for (std::size_t f = 0; f < jets.size(); ++f) {
      double error = 0, norm = 0;
      for (std::size_t n = 0; n < jets[f].size(); ++n) {
        ASSERT_TRUE(std::isfinite(oracle[f][n]) && std::isfinite(jets[f][n])) << "function " << f << ", " << n;
        error = std::max(error, std::abs(jets[f][n] - oracle[f][n]));
        norm = std::max(norm, std::abs(oracle[f][n]));
      }
      EXPECT_LE(error, tolerance * norm) << "function " << f << " at (" << p[0] << ", " << p[1] << ", " << p[2] << ")";
    }
  }
}

} // namespace Jet_3_autodiff_test
