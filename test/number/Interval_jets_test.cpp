// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

namespace Interval_jets_test {

using equiaffine::Interval;
using Interval_jet = equiaffine::Jet_3<Interval>;
using Long_jet = equiaffine::Jet_3<long double>; // so exact that its error does not count

constexpr double infinity = std::numeric_limits<double>::infinity();

bool encloses(const Interval& outer, const Interval& inner) {
  return outer.lower() <= inner.lower() && inner.upper() <= outer.upper();
}

constexpr auto jet_functions = [](const auto& x, const auto& y, const auto& z, auto visit) {
  const auto u = x * y + z; // positive
  visit(u * u - x / (y + 3) + 2 / u);
  visit(pow(u, 3) + pow(x, 2) + pow(u, -2));
  visit(pow(u, 2.5));
  visit(pow(x, 3.0));
  visit(pow(u, x) + pow(1.5, y));
  visit(sqrt(u));
  visit(cbrt(u));
  visit(exp(x));
  visit(log(u));
  visit(sin(u) * cos(x));
  visit(tan(x));
  visit(asin(x * y / 9));
  visit(acos(x * y / 9));
  visit(atan(u));
  visit(atan2(u, x));
  visit(atan2(x, -u));
  visit(sinh(x) + cosh(y));
  visit(tanh(x));
  visit(hypot(x, u));
  visit(hypot(x, y, z));
  visit(abs(x));
  visit(max(x, y * y));
  visit(min(x, y + z - 2));
  visit(erf(u));
  visit(floor(5 * x) + y);
  visit(sign(x) * y);
  visit(fmod(5 * x, z));
};

TEST(Interval, jets_over_a_box_enclose_the_jets_at_its_points_also_across_kinks) {
  std::mt19937_64 bits(11);
  std::uniform_real_distribution<double> center(-1, 1), width(0, 0.4), fraction(0, 1);
  for (int n = 0; n < 60; ++n) {
    std::array<Interval, 3> box;
    std::array<double, 3> p;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double lower = center(bits) + (axis == 2 ? 3 : 0), upper = lower + width(bits) * (n % 3);
      box[axis] = Interval(lower, upper);
      p[axis] = std::clamp(lower + fraction(bits) * (upper - lower), lower, upper);
    }
    std::vector<Interval_jet> bounds;
    jet_functions(Interval_jet::variable(0, box[0]), Interval_jet::variable(1, box[1]),
                  Interval_jet::variable(2, box[2]), [&](const Interval_jet& f) { bounds.push_back(f); });
    std::size_t index = 0;
    jet_functions(Long_jet::variable(0, p[0]), Long_jet::variable(1, p[1]), Long_jet::variable(2, p[2]),
                  [&](const Long_jet& f) {
                    for (std::size_t k = 0; k < f.size; ++k) {
                      const Interval& r = bounds[index].coefficients()[k];
                      const long double c = f.coefficients()[k];
                      ASSERT_TRUE(r.lower() <= c && c <= r.upper()) << "function " << index << ", coefficient " << k;
                      const double limit = n % 3 == 0 ? 1e-11 : infinity; // a point, or a box
                      ASSERT_LE(r.upper() - r.lower(), limit) << "function " << index << ", coefficient " << k;
                    }
                    ++index;
                  });
  }
}

TEST(Interval, across_a_kink_the_gradient_is_bounded_and_higher_derivatives_are_not) {
  const Interval_jet x = Interval_jet::variable(0, Interval(-1, 2)), y = Interval_jet::variable(1, Interval(0, 1));
  const Interval_jet touching = Interval_jet::variable(0, Interval(0, 2));
  for (const Interval& slope : {abs(x).coefficient(1, 0, 0), abs(touching).coefficient(1, 0, 0)}) {
    EXPECT_TRUE(encloses(slope, Interval(-1, 1)));
    EXPECT_LE(slope.upper() - slope.lower(), 2.001);
  }
  EXPECT_EQ(abs(x).value(), Interval(0, 2));
  EXPECT_EQ(abs(x).coefficient(2, 0, 0), Interval::whole());
  EXPECT_TRUE(encloses(max(x, y).coefficient(1, 0, 0), Interval(0, 1)));
  EXPECT_TRUE(encloses(max(x, y).coefficient(0, 1, 0), Interval(0, 1)));
  EXPECT_EQ(max(x, y).coefficient(1, 1, 0), Interval::whole());
  EXPECT_LE(max(x, y + 5).coefficient(1, 0, 0).upper(), 0.001);
}

TEST(Interval, across_the_cut_of_the_angle_the_gradient_is_not_bounded) {
  const auto gradient = [](const Interval& x, const Interval& y) {
    const auto angle = atan2(Interval_jet::variable(1, y), Interval_jet::variable(0, x));
    return std::array<Interval, 2>{angle.coefficient(1, 0, 0), angle.coefficient(0, 1, 0)};
  };
  for (const Interval& y : {Interval(-0.1, 0.1), Interval(0, 0.1), Interval(-0.1, 0)}) {
    EXPECT_EQ(gradient(Interval(-2, -1), y)[0], Interval::whole());
    EXPECT_EQ(gradient(Interval(-2, -1), y)[1], Interval::whole());
    EXPECT_LT(abs(gradient(Interval(1, 2), y)[1]).upper(), infinity);
  }
  EXPECT_LT(abs(gradient(Interval(-2, -1), Interval(0.5, 1))[0]).upper(), infinity);
}

TEST(Interval, across_a_step_no_derivative_is_bounded) {
  const auto slope = [](const auto& f, double lower, double upper) {
    return f(Interval_jet::variable(0, Interval(lower, upper))).coefficient(1, 0, 0);
  };
  const auto whole_part = [](const Interval_jet& x) { return floor(x); };
  const auto signum = [](const Interval_jet& x) { return sign(x); };
  const auto remainder = [](const Interval_jet& x) { return fmod(x, 1.); };
  EXPECT_EQ(slope(whole_part, 0.1, 0.9), Interval(0));
  EXPECT_EQ(slope(whole_part, 0.1, 1), Interval::whole());
  EXPECT_EQ(slope(signum, -2, -0.1), Interval(0));
  EXPECT_EQ(slope(signum, -2, 0), Interval::whole());
  EXPECT_TRUE(slope(remainder, -0.9, 0.9).contains(1) && slope(remainder, -0.9, 0.9).upper() < 1.001);
  EXPECT_EQ(slope(remainder, 0.9, 1), Interval::whole());
}

TEST(Interval, a_jet_of_intervals_times_itself_has_a_square_as_its_value) {
  const Interval_jet x = Interval_jet::variable(0, Interval(-1, 2));
  EXPECT_EQ((x * x).value().lower(), 0);
  EXPECT_EQ(pow(x, 2).value().lower(), 0);
  EXPECT_GE(pow(x, 4).value().lower(), -1e-300);
}

} // namespace Interval_jets_test
