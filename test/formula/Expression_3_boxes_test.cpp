// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

namespace Expression_3_boxes_test {

using equiaffine::Expression_3;
using equiaffine::Interval;

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

} // namespace Expression_3_boxes_test
