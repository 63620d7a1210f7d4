// SPDX-License-Identifier: GPL-3.0-or-later
// Any text is an expression or refused, and the number types agree on what it computes. No tolerance is needed:
// intervals contain what is rounded, and where nothing is rounded, all ways to compute a number give the same.
#include "support/fuzz_target.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace Expression_3_fuzz_test {

using namespace equiaffine;
using test::expect;

constexpr std::array points = {std::array{0.3, -0.7, 1.1},     std::array{1.0, 2.0, -3.0}, std::array{0.0, 0.0, 0.0},
                               std::array{-0.0, 1e200, 1e-9},  std::array{2.5, 0.5, 0.25}, std::array{-1.0, 1.0, -1.0},
                               std::array{1e-310, -40.0, 7e7}, std::array{0.3, 0.3, 0.3},  std::array{4.0, 9.0, 16.0}};

bool contains_if_number(const Interval& interval, double x) { return std::isnan(x) || interval.contains(x); }

/// A whole power of a double is a product of many factors, whose rounding an interval does not follow.
bool has_powers(const Expression_3& f) {
  return f.text().find('^') != std::string::npos || f.text().find("pow") != std::string::npos;
}

bool have_same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool are_same(double a, double b) { return have_same_bits(a, b) || (std::isnan(a) && std::isnan(b)); }

template <class T>
Jet_3<T, 1> first_order(const Expression_3& f, const std::array<double, 3>& p) {
  using Jet = Jet_3<T, 1>;
  return f(Jet::variable(0, T(p[0])), Jet::variable(1, T(p[1])), Jet::variable(2, T(p[2])));
}

void check_point(const Expression_3& f, const std::array<double, 3>& p) {
  const auto& [x, y, z] = p;
  std::feclearexcept(FE_ALL_EXCEPT);
  const double value = f(x, y, z);
  const auto jet = first_order<double>(f, p);
  const auto taylor = f.taylor(x, y, z);
  const bool is_exact = !std::fetestexcept(FE_ALL_EXCEPT);

  const auto intervals = first_order<Interval>(f, p);
  if (!has_powers(f))
    expect(contains_if_number(f(Interval(x), Interval(y), Interval(z)), value), "intervals contain values");
  for (std::size_t n = 0; n < 4; ++n) {
    const double coefficient = jet.coefficients()[n];
    if (!has_powers(f))
      expect(contains_if_number(intervals.coefficients()[n], coefficient), "jets of intervals contain jets");
    if (is_exact)
      expect(std::isnan(coefficient) || coefficient == taylor.coefficients()[n], "exact jets of both tapes agree");
  }
  if (is_exact) expect(std::isnan(value) || value == jet.value(), "exact values and jets agree");
}

void check_blocks(const Expression_3& f) {
  constexpr std::size_t size = 3 * points.size();
  std::array<std::vector<double>, 3> columns;
  for (std::size_t n = 0; n < size; ++n)
    for (std::size_t axis = 0; axis < 3; ++axis) columns[axis].push_back(points[n % points.size()][axis]);
  const std::span<const double> x(columns[0]), y(columns[1]), z(columns[2]);
  std::vector<double> values(size);
  std::vector<Jet_3<double>> jets(size);
  f(x, y, z, std::span(values));
  f.taylor(x, y, z, std::span(jets));
  for (std::size_t n = 0; n < size; ++n) {
    expect(have_same_bits(values[n], f(x[n], y[n], z[n])), "a block of points has the values of the points");
    const auto jet = f.taylor(x[n], y[n], z[n]);
    for (std::size_t k = 0; k < Jet_3<double>::size; ++k)
      expect(have_same_bits(jets[n].coefficients()[k], jet.coefficients()[k]), "a block has the jets of the points");
  }
}

/// Puts the text, if it is no equation, among operands of min, max and abs, and compares the expression with its part
/// on boxes around the points.
void check_parts(std::string_view text) {
  if (text.find('=') != std::string_view::npos) return;
  const std::string sum = "(" + std::string(text) + ")";
  const Expression_3 f("max(min(" + sum + ",x+y+1,abs(" + sum + "-2)),z-x*y-1,min(abs(x-.3)*" + sum +
                           ",y^3-z^2,sqrt(x+1))-2)+abs(x*y-z/3+.1)+min(x-y/7,2*z+x*z,y*z+.3)",
                       {{"R", 2.0}, {"r", 0.5}});
  for (const auto& p : points)
    for (const double r : {0.0, 1e-9, 0.1, 2.0}) {
      const auto side = [&](std::size_t axis) { return Interval(p[axis] - r, p[axis] + r); };
      const auto part = f.restricted(side(0), side(1), side(2));
      if (!part) continue;
      for (int corner = 0; corner <= 8; ++corner) { // 8 is the point itself
        const auto q = [&](int axis) { return p[std::size_t(axis)] + (corner == 8 ? 0 : corner >> axis & 1 ? r : -r); };
        const std::array<double, 3> point = {q(0), q(1), q(2)};
        const auto jet = first_order<double>(f, point), of_part = first_order<double>(*part, point);
        const double value = f(point[0], point[1], point[2]), value_of_part = (*part)(point[0], point[1], point[2]);
        expect(are_same(value, value_of_part), "the part of an expression on a box has the values of the whole");
        for (std::size_t n = 0; n < 4; ++n)
          expect(are_same(jet.coefficients()[n], of_part.coefficients()[n]), "a part has the jets of the whole");
      }
    }
}

EQUIAFFINE_FUZZ_TARGET(expression) {
  equiaffine::test::accepts([&] {
    const Expression_3 f(input, {{"R", 2.0}, {"r", 0.5}});
    for (const auto& p : points) check_point(f, p);
    check_blocks(f);
    check_parts(input);
  });
}

} // namespace Expression_3_fuzz_test
