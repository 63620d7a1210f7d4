// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/number/Jet_3.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace Jet_3_test {

using Exact = boost::multiprecision::cpp_bin_float_50;
template <class T>
using Full = equiaffine::Jet_3<T>;
using Jet = Full<double>;
using Point = std::array<double, 3>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Jet variable(int axis, double value) { return Jet::variable(axis, value); }

struct Function {
  std::string name;
  Jet (*jet)(const Jet&, const Jet&, const Jet&);
  Full<Exact> (*exact_jet)(const Full<Exact>&, const Full<Exact>&, const Full<Exact>&);
  Exact (*exact)(const Exact&, const Exact&, const Exact&);
  double bound = 5; // of the error, in epsilon: the largest of 35 errors over the largest of 35 coefficients
};

template <class F>
Function function(std::string name, F f, double bound = 5) {
  return {std::move(name), f, f, f, bound};
}

#define EQUIAFFINE_FUNCTION(...)                                                                                       \
  function(#__VA_ARGS__, [](const auto& x, [[maybe_unused]] const auto& y, [[maybe_unused]] const auto& z) {           \
    using std::max, std::min;                                                                                          \
    return std::decay_t<decltype(x)>(__VA_ARGS__);                                                                     \
  })

// Each operation once, of arguments that are not coordinates where it takes one: all parts of the composition count.
const std::vector<Function>& functions() {
  static const std::vector<Function> list = {
      EQUIAFFINE_FUNCTION(x + y * z),
      EQUIAFFINE_FUNCTION(3 - x * y),
      EQUIAFFINE_FUNCTION((x + y) * (x + y)),
      EQUIAFFINE_FUNCTION((x + y * z) * (y - x * z)),
      EQUIAFFINE_FUNCTION(2 * x / (y * z) - x / 3),
      EQUIAFFINE_FUNCTION(1 / (x * y + z)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, 0)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, 1)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, 2)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, 3)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, 7)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, 41)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, -1)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, -3)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, 2.5)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, -0.3)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, 3.0)),
      EQUIAFFINE_FUNCTION(pow(x * y + z, x - z)),
      EQUIAFFINE_FUNCTION(pow(2.5, x * y + z)),
      EQUIAFFINE_FUNCTION(sqrt(x * y + z)),
      EQUIAFFINE_FUNCTION(cbrt(x * y + z)),
      EQUIAFFINE_FUNCTION(exp(x * y + z)),
      EQUIAFFINE_FUNCTION(log(x * y + z)),
      EQUIAFFINE_FUNCTION(sin(x * y + z)),
      EQUIAFFINE_FUNCTION(cos(x * y + z)),
      EQUIAFFINE_FUNCTION(tan(x * y + z)),
      EQUIAFFINE_FUNCTION(asin((x * y + z) / 2)),
      EQUIAFFINE_FUNCTION(acos((x * y + z) / 2)),
      EQUIAFFINE_FUNCTION(atan(x * y + z)),
      EQUIAFFINE_FUNCTION(sinh(x * y + z)),
      EQUIAFFINE_FUNCTION(cosh(x * y + z)),
      EQUIAFFINE_FUNCTION(tanh(x * y + z)),
      EQUIAFFINE_FUNCTION(abs(x * y - 2)),
      EQUIAFFINE_FUNCTION(max(x * y, z * z)),
      EQUIAFFINE_FUNCTION(min(x * y, z * z)),
      EQUIAFFINE_FUNCTION(hypot(x * y, z)),
      EQUIAFFINE_FUNCTION(erf(x * y + z)),
      EQUIAFFINE_FUNCTION(floor(9 * x) + x * z),
      EQUIAFFINE_FUNCTION(sign(y - z) * x + y),
      EQUIAFFINE_FUNCTION(fmod(x * y + z, z)),
      EQUIAFFINE_FUNCTION(fmod(5., x * y + z)),
  };
  return list;
}

// Functions of the coordinates themselves: quadrants, axes, poles of spherical coordinates.
const std::vector<Function>& functions_of_a_direction() {
  static const std::vector<Function> list = {
      EQUIAFFINE_FUNCTION(atan2(y, x)),
      EQUIAFFINE_FUNCTION(hypot(x, y)),
      function("hypot(x, y, z)", [](const auto& x, const auto& y,
                                    const auto& z) { return std::decay_t<decltype(x)>(hypot(hypot(x, y), z)); }),
  };
  return list;
}

// x y + z is exact: errors are those of the function alone, not of its argument times its condition.
const std::vector<Point> points = {{19 / 64., 45 / 64., 13 / 64.},
                                   {58 / 64., 51 / 64., 29 / 64.},
                                   {33 / 64., 109 / 64., 21 / 64.},
                                   {7 / 64., 20 / 64., 65 / 64.}};
const std::vector<Point> directions = {{1, 2, 3}, {-1, 2, 3}, {-1, -2, 3}, {1, -2, -3},
                                       {3, 0, 1}, {0, 3, 1},  {0, -3, 1}};

Full<Exact> exact_jet(const Function& f, const Point& p) {
  return f.exact_jet(Full<Exact>::variable(0, p[0]), Full<Exact>::variable(1, p[1]), Full<Exact>::variable(2, p[2]));
}

/// The largest difference of coefficients of the given degrees over the largest coefficient of these degrees.
template <class T>
double error(const Full<T>& f, const Full<Exact>& g, int from = 0, int to = 4) {
  Exact difference = 0, norm = 0;
  for (std::size_t n = 0; n < f.size; ++n) {
    const int degree = equiaffine::internal::monomials[n].degree();
    if (degree < from || degree > to) continue;
    if (!(boost::multiprecision::isfinite)(Exact(f.coefficients()[n]))) return std::numeric_limits<double>::infinity();
    difference = std::max(difference, Exact(abs(Exact(f.coefficients()[n]) - g.coefficients()[n])));
    norm = std::max(norm, Exact(abs(g.coefficients()[n])));
  }
  return norm == 0 ? double(difference) : double(difference / norm);
}

/// Central differences with 50 digits: sum over a of (-1)^a (n choose a) f(p + (n / 2 - a) h) in each direction. They
/// need only values of f.
Full<Exact> by_differences(const Function& f, const Point& p, const Exact& h) {
  constexpr std::array<std::array<int, 5>, 5> binomial = {
      {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}}};
  constexpr std::array<int, 5> factorial = {1, 1, 2, 6, 24};
  Full<Exact> result;
  for (std::size_t n = 0; n < result.size; ++n) {
    const auto m = equiaffine::internal::monomials[n];
    const auto at = [](int i) { return std::size_t(i); };
    Exact sum = 0;
    for (int a = 0; a <= m.i; ++a)
      for (int b = 0; b <= m.j; ++b)
        for (int c = 0; c <= m.k; ++c) {
          const int weight = binomial[at(m.i)][at(a)] * binomial[at(m.j)][at(b)] * binomial[at(m.k)][at(c)];
          const Exact value =
              f.exact(p[0] + (m.i - 2 * a) * h / 2, p[1] + (m.j - 2 * b) * h / 2, p[2] + (m.k - 2 * c) * h / 2);
          sum += ((a + b + c) % 2 == 0 ? weight : -weight) * value;
        }
    const int factorials = factorial[at(m.i)] * factorial[at(m.j)] * factorial[at(m.k)];
    result.coefficients()[n] = sum / (pow(h, m.degree()) * factorials);
  }
  return result;
}

/// Extrapolates from two steps: the truncation error is of the order h^4 = 1e-28 times a ratio of derivatives.
Full<Exact> by_differences(const Function& f, const Point& p) {
  const Exact h("1e-7");
  return (4 * by_differences(f, p, h) - by_differences(f, p, 2 * h)) / 3;
}

void expect_agreement(const std::vector<Function>& list, const std::vector<Point>& where) {
  for (const Function& f : list)
    for (const Point& p : where) {
      const std::string place = f.name + " at " + testing::PrintToString(p);
      const Full<Exact> oracle = exact_jet(f, p);
      EXPECT_LE(error(oracle, by_differences(f, p)), 1e-3 * epsilon) << place; // so that the oracle is one
      const Jet jet = f.jet(variable(0, p[0]), variable(1, p[1]), variable(2, p[2]));
      EXPECT_LE(error(jet, oracle), f.bound * epsilon) << place;
      EXPECT_LE(error(jet, oracle, 4, 4), f.bound * epsilon) << place << ", order 4 alone";
    }
}

bool derivatives_are_not_finite(const Jet& f, std::initializer_list<std::array<int, 3>> derivatives) {
  return std::all_of(derivatives.begin(), derivatives.end(),
                     [&](const auto& d) { return !std::isfinite(f.coefficient(d[0], d[1], d[2])); });
}

TEST(Jet_3, every_function_is_within_5_epsilon_of_50_digits_which_agree_with_central_differences) {
  expect_agreement(functions(), points);
}

TEST(Jet_3, angles_and_lengths_are_as_good_in_all_quadrants_and_on_the_axes) {
  expect_agreement(functions_of_a_direction(), directions);
}

TEST(Jet_3, on_its_cut_the_angle_is_pi_and_its_derivatives_are_those_of_the_opposite_direction) {
  const Jet f = atan2(variable(1, 0), variable(0, -3)), opposite = atan2(-variable(1, 0), -variable(0, -3));
  EXPECT_EQ(f.value(), std::atan2(0.0, -3.0));
  EXPECT_EQ(f.coefficient(0, 1, 0), -1.0 / 3);
  for (std::size_t n = 1; n < f.size; ++n) EXPECT_EQ(f.coefficients()[n], opposite.coefficients()[n]);
}

TEST(Jet_3, the_length_of_a_vector_is_smooth_away_from_the_origin_also_where_two_coordinates_vanish) {
  // At (0, 0, r): r + (x^2 + y^2) / (2 r) + ..., exactly along z.
  const Jet f = hypot(variable(0, 0), variable(1, 0), variable(2, 2));
  EXPECT_EQ(f.value(), 2);
  EXPECT_EQ(f.coefficient(0, 0, 1), 1);
  EXPECT_EQ(f.coefficient(0, 0, 2), 0);
  EXPECT_EQ(f.coefficient(2, 0, 0), 0.25);
  EXPECT_EQ(f.coefficient(0, 2, 1), -0.125);
  EXPECT_EQ(f.coefficient(4, 0, 0), -1.0 / 64);
  EXPECT_EQ(f.coefficient(2, 2, 0), -2.0 / 64);
}

TEST(Jet_3, integer_powers_are_defined_at_zero_for_every_exponent_that_is_not_negative) {
  const Jet x = variable(0, 0), u = x + variable(1, 0);
  EXPECT_EQ(pow(x, 0).coefficients(), Jet(1).coefficients());
  EXPECT_EQ(pow(x, 1).coefficients(), x.coefficients());
  EXPECT_EQ(pow(u, 2).coefficients(), (u * u).coefficients());
  EXPECT_EQ(pow(u, 3).coefficients(), (u * u * u).coefficients());
  EXPECT_EQ(pow(u, 4).coefficients(), (u * u * u * u).coefficients());
  EXPECT_EQ(pow(u, 5).coefficients(), Jet(0).coefficients());
  EXPECT_EQ(pow(u, 2147483647).coefficients(), Jet(0).coefficients());
  EXPECT_EQ(pow(u, 2.0).coefficients(), (u * u).coefficients());
  EXPECT_FALSE(std::isfinite(pow(x, -1).value()));
}

TEST(Jet_3, integer_powers_with_extreme_exponents_have_the_right_binomials) {
  const double n = 2147483647;
  const Jet up = pow(variable(0, 1), 2147483647), down = pow(variable(0, 1), -2147483647 - 1);
  EXPECT_DOUBLE_EQ(up.derivative(1, 0, 0), n);
  EXPECT_DOUBLE_EQ(up.derivative(4, 0, 0), n * (n - 1) * (n - 2) * (n - 3));
  EXPECT_DOUBLE_EQ(down.derivative(3, 0, 0), -(n + 1) * (n + 2) * (n + 3));
}

TEST(Jet_3, at_a_kink_the_value_is_right_and_the_derivatives_are_not_finite) {
  const Jet x = variable(0, 0), y = variable(1, 0);
  const auto first = {std::array{1, 0, 0}}, both = {std::array{1, 0, 0}, std::array{0, 1, 0}};
  for (const Jet& f : {abs(x), sqrt(x), cbrt(x), pow(x, 0.5)}) {
    EXPECT_EQ(f.value(), 0);
    EXPECT_TRUE(derivatives_are_not_finite(f, first));
  }
  for (const Jet& f : {max(x, y), min(x, y), hypot(x, y), hypot(x, y, x + y)}) {
    EXPECT_EQ(f.value(), 0);
    EXPECT_TRUE(derivatives_are_not_finite(f, both));
  }
  EXPECT_EQ(pow(x, 2.5).value(), 0);
  EXPECT_TRUE(derivatives_are_not_finite(pow(x, 2.5), {{3, 0, 0}, {4, 0, 0}}));
  EXPECT_TRUE(derivatives_are_not_finite(atan2(y, x), both));
}

TEST(Jet_3, at_a_step_the_value_is_right_and_the_derivatives_are_not_finite) {
  const Jet one = variable(0, 1), zero = variable(0, 0);
  for (const Jet& f : {Jet(floor(one)), Jet(sign(zero)), Jet(fmod(one, 0.5)), Jet(fmod(-2 * one, variable(1, 2)))})
    EXPECT_TRUE(derivatives_are_not_finite(f, {{1, 0, 0}, {2, 0, 0}, {4, 0, 0}}));
  EXPECT_EQ(floor(one).value(), 1);
  EXPECT_EQ(floor(variable(0, -0.5)).value(), -1);
  EXPECT_EQ(sign(zero).value(), 0);
  EXPECT_EQ(sign(variable(0, -3)).value(), -1);
  EXPECT_EQ(fmod(one, 0.5).value(), 0);
  EXPECT_EQ(fmod(zero, 0.5).derivative(1, 0, 0), 1) << "no step: the remainder is x on both sides of 0";
  EXPECT_TRUE(std::isnan(sign(variable(0, std::nan(""))).value()));
  EXPECT_TRUE(std::isnan(equiaffine::sign(std::nan(""))));
}

TEST(Jet_3, outside_its_domain_no_coefficient_of_a_function_is_finite) {
  const Jet u = variable(0, -2);
  for (const Jet& f : {log(u), sqrt(u), pow(u, 2.5), pow(u, variable(1, 0.5)), asin(u), acos(u)}) {
    EXPECT_TRUE(std::isnan(f.value()));
    EXPECT_TRUE(derivatives_are_not_finite(f, {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  }
  const Jet zero = variable(0, 0);
  for (const Jet& f : {log(zero), 1 / zero, pow(zero, -2)})
    EXPECT_TRUE(derivatives_are_not_finite(f, {{0, 0, 0}, {1, 0, 0}, {4, 0, 0}}));
}

TEST(Jet_3, a_nan_is_not_hidden_by_comparisons) {
  const Jet nan = variable(0, std::numeric_limits<double>::quiet_NaN()), one = variable(1, 1);
  for (const Jet& f : {max(nan, one), max(one, nan), min(nan, one), min(one, nan), abs(nan)})
    EXPECT_TRUE(std::isnan(f.value()) && std::isnan(f.coefficient(1, 0, 0)));
}

TEST(Jet_3, homogeneous_functions_do_not_depend_on_the_scale) {
  const Jet x = variable(0, 0.6), y = variable(1, 1.1), z = variable(2, -0.4);
  const auto same = [](const Jet& f, const Jet& g, double scale) {
    for (std::size_t n = 0; n < f.size; ++n)
      if (!(std::abs(f.coefficients()[n] / scale - g.coefficients()[n]) <= 10 * epsilon)) return false;
    return true;
  };
  for (const double s : {1e-150, 1e-80, 1e80, 1e150}) {
    EXPECT_TRUE(same(hypot(s * x, s * y), hypot(x, y), s)) << s;
    EXPECT_TRUE(same(hypot(s * x, s * y, s * z), hypot(x, y, z), s)) << s;
    EXPECT_TRUE(same(atan2(s * y, s * x), atan2(y, x), 1)) << s;
    EXPECT_TRUE(same(sqrt(s * x), sqrt(x), std::sqrt(s))) << s;
    EXPECT_TRUE(same(cbrt(s * y), cbrt(y), std::cbrt(s))) << s;
    EXPECT_TRUE(same(pow(s * y, 0.7), pow(y, 0.7), std::pow(s, 0.7))) << s;
    EXPECT_TRUE(same((s * x) / (s * y), x / y, 1)) << s;
    EXPECT_TRUE(same(1 / (s * y), 1 / y, 1 / s)) << s;
    EXPECT_TRUE(same(pow(s * y, 2), pow(y, 2), s * s)) << s;
    EXPECT_TRUE(same(abs(-s * x), abs(x), s)) << s;
    EXPECT_TRUE(same(log(s * y) - std::log(s * 1.1), log(y) - std::log(1.1), 1)) << s;
  }
}

TEST(Jet_3, large_arguments_saturate_or_overflow_but_are_never_nan_where_the_limit_is_finite) {
  for (const double u : {50.0, 400.0, 1e5, 1e100, 1e200}) {
    const Jet t = tanh(variable(0, u)), a = atan(variable(0, u)), e = exp(-variable(0, u));
    EXPECT_EQ(t.value(), 1);
    EXPECT_DOUBLE_EQ(a.coefficient(1, 0, 0), 1 / (u * u + 1));
    for (int n = 1; n <= 4; ++n) {
      EXPECT_TRUE(std::isfinite(t.coefficient(n, 0, 0)) && std::isfinite(a.coefficient(n, 0, 0))) << u << ", " << n;
      EXPECT_TRUE(std::isfinite(e.coefficient(n, 0, 0)));
    }
  }
  // 1 - tanh(u)^2 = 4 exp(-2u) to all digits.
  EXPECT_NEAR(tanh(variable(0, 50)).coefficient(1, 0, 0) / (4 * std::exp(-100.0)), 1, 10 * epsilon);
}

// x y + z^2 sin x: no monomial with both y and z, at most one y, at most two z.
constexpr auto sparse = [](const auto& x, const auto& y, const auto& z) { return x * y + z * z * sin(x); };

template <int I, int J, int K>
constexpr equiaffine::Monomial_set monomial() {
  return equiaffine::Monomial_set(1) << Jet::index(I, J, K);
}
template <int Axis>
using Variable = equiaffine::Jet_3<double, 4, 1 | equiaffine::Monomial_set(1) << (1 + Axis)>;

template <int Axis>
Variable<Axis> sparse_variable(double value) {
  Variable<Axis> v(value);
  v.template at<1 + Axis>() = 1;
  return v;
}

TEST(Jet_3, sparse_jets_give_the_numbers_of_full_jets_on_a_smaller_support) {
  const auto f = sparse(sparse_variable<0>(0.3), sparse_variable<1>(0.7), sparse_variable<2>(0.2));
  const Jet g = sparse(variable(0, 0.3), variable(1, 0.7), variable(2, 0.2));
  EXPECT_EQ(Jet(f).coefficients(), g.coefficients());
  for (std::size_t n = 0; n < g.size; ++n)
    EXPECT_TRUE(equiaffine::internal::contains(f.support, int(n)) || g.coefficients()[n] == 0) << n;
}

TEST(Jet_3, the_support_of_a_result_is_that_of_its_structure) {
  const auto x = sparse_variable<0>(0.3);
  const auto y = sparse_variable<1>(0.7);
  constexpr auto powers_of_x =
      1 | monomial<1, 0, 0>() | monomial<2, 0, 0>() | monomial<3, 0, 0>() | monomial<4, 0, 0>();
  static_assert(decltype(x + y)::support == (1 | monomial<1, 0, 0>() | monomial<0, 1, 0>()));
  static_assert(decltype(x * y)::support == (1 | monomial<1, 0, 0>() | monomial<0, 1, 0>() | monomial<1, 1, 0>()));
  static_assert(decltype(square(x))::support == (1 | monomial<1, 0, 0>() | monomial<2, 0, 0>()));
  static_assert(decltype(sin(x))::support == powers_of_x);
  static_assert(decltype(pow(x, 2.5))::support == powers_of_x);
  static_assert(decltype(abs(x))::support == decltype(x)::support);
  static_assert(decltype(2 * x + 1)::support == decltype(x)::support);
  static_assert(decltype(max(x, 3))::support == decltype(x)::support);
  EXPECT_EQ(square(square(x)).size, 5u);
}

TEST(Jet_3, a_functor_with_one_fixed_number_type_gives_the_same_as_one_with_automatic_types) {
  const auto fixed = []<class T>(const T& x, const T& y, const T& z) -> T {
    const T a = x * y, b = z * z, c = sin(x);
    T sum = a;
    sum += b * c;
    return sum;
  };
  const Jet x = variable(0, 0.3), y = variable(1, 0.7), z = variable(2, 0.2);
  EXPECT_EQ(fixed(x, y, z).coefficients(), sparse(x, y, z).coefficients());
}

TEST(Jet_3, jets_of_lower_order_are_truncations) {
  const auto truncates = [](const auto& low, const Jet& high) {
    for (std::size_t n = 0; n < low.size; ++n)
      if (low.coefficients()[n] != high.coefficients()[n]) return false;
    return true;
  };
  const auto f = [](const auto& x, const auto& y, const auto& z) {
    return exp(x * y) / (1 + z * z) + sqrt(x + 2 * y) * atan2(y, z) + pow(hypot(x, y), 3);
  };
  const Jet full = f(variable(0, 0.3), variable(1, 0.7), variable(2, 0.2));
  using One = equiaffine::Jet_3<double, 1>;
  using Two = equiaffine::Jet_3<double, 2>;
  EXPECT_TRUE(truncates(f(One::variable(0, 0.3), One::variable(1, 0.7), One::variable(2, 0.2)), full));
  EXPECT_TRUE(truncates(f(Two::variable(0, 0.3), Two::variable(1, 0.7), Two::variable(2, 0.2)), full));
}

TEST(Jet_3, a_jet_times_itself_is_its_square) {
  const Jet u = exp(variable(0, 0.3) * variable(1, 0.7)) + variable(2, 0.1), copy = u;
  EXPECT_EQ((u * u).coefficients(), square(u).coefficients());
  for (std::size_t n = 0; n < u.size; ++n)
    EXPECT_NEAR((u * copy).coefficients()[n], square(u).coefficients()[n], 8 * epsilon * 4);
  Jet v = u;
  v *= v;
  EXPECT_EQ(v.coefficients(), square(u).coefficients());
}

TEST(Jet_3, coefficients_are_found_by_exponents_and_derivatives_carry_the_factorials) {
  const Jet x = variable(0, 2), y = variable(1, 3), z = variable(2, 5);
  const Jet f = x * x * y * z + pow(z, 4);
  EXPECT_EQ(f.value(), 60 + 625);
  EXPECT_EQ(f.coefficient(2, 1, 1), 1);
  EXPECT_EQ(f.derivative(2, 1, 1), 2);
  EXPECT_EQ(f.derivative(0, 0, 4), 24);
  EXPECT_EQ(f.derivative(0, 1, 0), 20);
  EXPECT_EQ(Jet::index(0, 0, 4), 34);
  EXPECT_EQ(Jet::index(0, 0, 1), 3);
  EXPECT_EQ(Jet::index(1, 0, 1), 6);
}

TEST(Jet_3, the_functions_of_the_standard_library_may_be_made_visible_beside_those_of_jets) {
  using std::abs, std::hypot, std::max, std::min, std::pow;
  const Jet x = variable(0, 2), y = variable(1, 3);
  EXPECT_EQ(max(x, y).value(), 3);
  EXPECT_EQ(min(x, y).value(), 2);
  EXPECT_EQ(max(x, 1).coefficient(1, 0, 0), 1);
  EXPECT_EQ(min(1.0, x).coefficient(1, 0, 0), 0);
  EXPECT_EQ(pow(x, 2).value(), 4);
  EXPECT_EQ(abs(-x).coefficient(1, 0, 0), 1);
  EXPECT_EQ(hypot(4, y).value(), 5);
}

TEST(Jet_3, jets_compare_by_their_values) {
  const Jet x = variable(0, 2), y = variable(1, 3);
  EXPECT_TRUE(x < y && y > x && x <= y && y >= x && x < 3 && 2.0 <= x && 4 > y);
  EXPECT_FALSE(y < x || x > y || y <= x || x >= y || x > 2 || 3.0 < y);
}

TEST(Jet_3, single_precision_has_the_accuracy_of_single_precision) {
  using Float_jet = Full<float>;
  const auto f = [](const auto& x, const auto& y) {
    return sqrt(x * y) + pow(x, 3) / 3 + atan2(y, x) + 0.5 * pow(y, 1.5);
  };
  const Float_jet single = f(Float_jet::variable(0, 1.25f), Float_jet::variable(1, 0.75f));
  const Jet reference = f(variable(0, 1.25), variable(1, 0.75));
  for (std::size_t n = 0; n < single.size; ++n)
    EXPECT_NEAR(double(single.coefficients()[n]), reference.coefficients()[n],
                8 * double(std::numeric_limits<float>::epsilon()));
}

} // namespace Jet_3_test
#undef EQUIAFFINE_FUNCTION
