// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/number/Interval.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <climits>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace Interval_test {

using equiaffine::Interval;
using equiaffine::Undecided_comparison;
using Exact = boost::multiprecision::cpp_bin_float_50;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;

struct Function {
  std::string name;
  Interval (*bounds)(const Interval&, const Interval&);
  Exact (*value)(const Exact&, const Exact&);
  double limit;                  // magnitude of the arguments
  double smooth_from, smooth_to; // where it is smooth in a, for b in [1, 2]
};

#define EQUIAFFINE_FUNCTION(expression, limit, from, to)                                                               \
  Function {                                                                                                           \
#expression,                                                                                                       \
        [](const Interval& a, [[maybe_unused]] const Interval& b) {                                                    \
          using std::max, std::min;                                                                                    \
          return Interval(expression);                                                                                 \
        },                                                                                                             \
        [](const Exact& a, [[maybe_unused]] const Exact& b) {                                                          \
          using std::max, std::min;                                                                                    \
          return Exact(expression);                                                                                    \
        },                                                                                                             \
        limit, from, to   \
  }

Exact square(const Exact& a) { return a * a; }

const std::vector<Function>& functions() {
  static const std::vector<Function> list = {
      EQUIAFFINE_FUNCTION(a + b, 1e300, -9, 9),
      EQUIAFFINE_FUNCTION(a - b, 1e300, -9, 9),
      EQUIAFFINE_FUNCTION(a * b, 1e150, -9, 9),
      EQUIAFFINE_FUNCTION(a / b, 1e150, -9, 9),
      EQUIAFFINE_FUNCTION(-a, 1e300, -9, 9),
      EQUIAFFINE_FUNCTION(square(a), 1e150, -9, 9),
      EQUIAFFINE_FUNCTION(a * a, 1e150, -9, 9),
      EQUIAFFINE_FUNCTION(abs(a), 1e300, -9, 9),
      EQUIAFFINE_FUNCTION(max(a, b), 1e300, -9, 9),
      EQUIAFFINE_FUNCTION(min(a, b), 1e300, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, 0), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, 1), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, 2), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, 3), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, 4), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, 6), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, 7), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, 10), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, -1), 10, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, -4), 10, -9, 9),
      EQUIAFFINE_FUNCTION(sqrt(a), 1e300, 0, 9),
      EQUIAFFINE_FUNCTION(cbrt(a), 1e300, -9, 9),
      EQUIAFFINE_FUNCTION(exp(a), 700, -9, 9),
      EQUIAFFINE_FUNCTION(log(a), 1e300, 2, 9),
      EQUIAFFINE_FUNCTION(sin(a), 1e4, -1e4, 1e4),
      EQUIAFFINE_FUNCTION(cos(a), 1e4, -1e4, 1e4),
      EQUIAFFINE_FUNCTION(tan(a), 1e4, -1.5, 1.5),
      EQUIAFFINE_FUNCTION(asin(a), 2, -0.99, 0.99),
      EQUIAFFINE_FUNCTION(acos(a), 2, -0.99, 0.99),
      EQUIAFFINE_FUNCTION(atan(a), 1e10, -9, 9),
      EQUIAFFINE_FUNCTION(atan2(a, b), 1e10, -9, 9),
      EQUIAFFINE_FUNCTION(atan2(b, a), 1e10, -9, 9),
      EQUIAFFINE_FUNCTION(sinh(a), 700, -9, 9),
      EQUIAFFINE_FUNCTION(cosh(a), 700, -9, 9),
      EQUIAFFINE_FUNCTION(tanh(a), 700, -9, 9),
      EQUIAFFINE_FUNCTION(hypot(a, b), 1e300, -9, 9),
      EQUIAFFINE_FUNCTION(pow(a, b), 20, 0.5, 2),
      EQUIAFFINE_FUNCTION(erf(a), 10, -3, 3),
      EQUIAFFINE_FUNCTION(floor(a), 1e300, 0.1, 0.9),
      EQUIAFFINE_FUNCTION(sign(a), 1e300, 1, 9),
      EQUIAFFINE_FUNCTION(fmod(a, abs(b) + 1), 1e10, 0.1, 0.9),
  };
  return list;
}
#undef EQUIAFFINE_FUNCTION

bool encloses(const Interval& r, const Exact& x) {
  const bool above = r.lower() == -infinity || Exact(r.lower()) <= x;
  const bool below = r.upper() == infinity || x <= Exact(r.upper());
  return isnan(x) || (above && below);
}

bool encloses(const Interval& outer, const Interval& inner) {
  return outer.lower() <= inner.lower() && inner.upper() <= outer.upper();
}

/// Random numbers of all magnitudes up to a limit, and boxes: wide, narrow, points, ending in zero or in infinity.
class Random {
public:
  double number(double limit) {
    const double magnitude =
        bits_() % 3 == 0 ? limit * uniform_(bits_) : std::min(limit, std::exp(30 * uniform_(bits_) - 20));
    return bits_() % 2 == 0 ? magnitude : -magnitude;
  }

  Interval box(double limit) {
    const double p = number(limit);
    switch (bits_() % 8) {
    case 0: return Interval(p);
    case 1: return Interval(std::min(p, 0.0), std::max(p, 0.0));
    case 2: return p > 0 ? Interval(p, infinity) : Interval(-infinity, p);
    case 3:
    case 4: return Interval(p - std::abs(p) * 1e-3, p + std::abs(p) * 1e-3);
    default: {
      const double q = number(limit);
      return Interval(std::min(p, q), std::max(p, q));
    }
    }
  }

  /// A sub-box; a point of the box when `fraction` is zero.
  Interval part(const Interval& box, double limit, double fraction) {
    const double lower = std::max(box.lower(), -limit), upper = std::min(box.upper(), limit);
    const double p = lower + uniform_(bits_) * (upper - lower), q = p + fraction * uniform_(bits_) * (upper - p);
    const double first = std::clamp(p, box.lower(), box.upper());
    return Interval(first, std::clamp(q, first, box.upper()));
  }

  double point(const Interval& box, double limit) {
    switch (bits_() % 6) {
    case 0: return std::isinf(box.lower()) ? std::min(-limit, box.upper()) : box.lower();
    case 1: return std::isinf(box.upper()) ? std::max(limit, box.lower()) : box.upper();
    default: return part(box, limit, 0).lower();
    }
  }

private:
  std::mt19937_64 bits_{20240229};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

std::string text(const Interval& a) {
  std::ostringstream out;
  out.precision(17);
  out << '[' << a.lower() << ", " << a.upper() << ']';
  return out.str();
}

void expect_enclosures(const Function& f, int boxes) {
  Random random;
  for (int n = 0; n < boxes; ++n) {
    const Interval a = random.box(f.limit), b = random.box(f.limit), r = f.bounds(a, b);
    ASSERT_TRUE(r.lower() <= r.upper()) << f.name;
    for (int m = 0; m < 4; ++m) {
      const Exact x = random.point(a, f.limit), y = random.point(b, f.limit);
      ASSERT_TRUE(encloses(r, f.value(x, y))) << f.name << " of " << text(a) << ", " << text(b) << " is " << text(r)
                                              << " but at " << x << ", " << y << ": " << f.value(x, y);
    }
  }
}

struct Rounding_mode {
  explicit Rounding_mode(int mode) : old(std::fegetround()) { std::fesetround(mode); }
  ~Rounding_mode() { std::fesetround(old); }
  Rounding_mode(const Rounding_mode&) = delete;
  Rounding_mode& operator=(const Rounding_mode&) = delete;
  int old;
};

TEST(Interval, every_function_encloses_its_values_at_points_of_random_boxes) {
  for (const Function& f : functions()) expect_enclosures(f, 400);
}

TEST(Interval, enclosures_hold_in_every_rounding_mode_and_leave_it_alone) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const Rounding_mode scope(mode);
    for (const Function& f : functions()) expect_enclosures(f, 60);
    EXPECT_EQ(std::fegetround(), mode);
  }
}

TEST(Interval, a_part_of_a_box_has_bounds_inside_those_of_the_box) {
  for (const Function& f : functions()) {
    Random random;
    for (int n = 0; n < 300; ++n) {
      const Interval a = random.box(f.limit), b = random.box(f.limit);
      const Interval p = random.part(a, f.limit, 1), q = random.part(b, f.limit, n % 2);
      if (!isfinite(f.value(p.upper(), q.upper())) || !isfinite(f.value(p.lower(), q.lower()))) continue; // no domain
      const Interval outer = f.bounds(a, b), inner = f.bounds(p, q);
      ASSERT_TRUE(encloses(outer, inner)) << f.name << " of " << text(a) << ", " << text(b) << " is " << text(outer)
                                          << " but of " << text(p) << ", " << text(q) << ": " << text(inner);
    }
  }
}

TEST(Interval, bounds_of_a_small_box_exceed_the_range_by_rounding_only) {
  for (const Function& f : functions()) {
    std::mt19937_64 bits(7);
    std::uniform_real_distribution<double> a_values(f.smooth_from, f.smooth_to), b_values(1, 2);
    for (int n = 0; n < 100; ++n) {
      // Monotone in each argument on almost all of such boxes: the range is that of the corners.
      const double step = std::ldexp(1.0, n % 2 == 0 ? -26 : -60), x = a_values(bits), y = b_values(bits);
      const double x2 = x + std::abs(x) * step, y2 = y + y * step;
      std::vector<double> corners;
      for (const double u : {x, x2})
        for (const double v : {y, y2}) corners.push_back(double(f.value(u, v)));
      const auto [least, greatest] = std::minmax_element(corners.begin(), corners.end());
      const Interval r = f.bounds(Interval(x, x2), Interval(y, y2));
      const double rounding = 40 * epsilon * std::max({std::abs(*least), std::abs(*greatest), epsilon});
      const double range = (*greatest - *least) * (1 + 1e-6);
      ASSERT_LE(r.upper() - r.lower(), range + rounding) << f.name << " at " << x << ", " << y;
    }
  }
}

TEST(Interval, even_powers_and_absolute_values_of_a_box_around_zero_start_at_zero) {
  const Interval a(-1, 2);
  for (const Interval& r : {square(a), a * a, pow(a, 2), pow(a, 4), pow(a, 6), pow(a, 8), pow(a, 10), abs(a),
                            pow(a, Interval(2)), hypot(a, Interval(0))})
    EXPECT_EQ(r.lower(), 0) << text(r);
  EXPECT_LE(pow(a, 4).upper(), 16 * (1 + 20 * epsilon));
}

TEST(Interval, odd_powers_of_a_box_around_zero_are_as_tight_as_the_cubes_of_its_ends) {
  const Interval r = pow(Interval(-1, 2), 3);
  EXPECT_GE(r.lower(), -1 - 20 * epsilon);
  EXPECT_LE(r.upper(), 8 * (1 + 20 * epsilon));
}

TEST(Interval, extreme_exponents_are_defined) {
  EXPECT_TRUE(pow(Interval(2), INT_MIN).contains(0));
  EXPECT_LE(pow(Interval(2), INT_MIN).upper(), 2 * std::numeric_limits<double>::min());
  EXPECT_EQ(pow(Interval(2), INT_MAX).upper(), infinity);
  EXPECT_TRUE(encloses(pow(Interval(-1), INT_MIN), Exact(1)));
  EXPECT_TRUE(encloses(pow(Interval(-1), INT_MAX), Exact(-1)));
  EXPECT_EQ(pow(Interval(-1, 1), INT_MIN), Interval::whole());
}

TEST(Interval, real_powers_with_a_whole_exponent_hold_for_negative_numbers) {
  EXPECT_TRUE(pow(Interval(-3, -2), Interval(3)).contains(-27));
  EXPECT_LT(pow(Interval(-3, -2), Interval(3)).upper(), -7.99);
  EXPECT_TRUE(pow(Interval(-3, -2), Interval(2, 3)).contains(-27));
  EXPECT_TRUE(pow(Interval(-3, -2), Interval(2, 3)).contains(9));
}

TEST(Interval, quotients_of_unbounded_boxes_enclose_all_quotients) {
  const Interval up(1, infinity), down(-infinity, -1);
  EXPECT_TRUE(encloses(up / down, Interval(-1e300, -1e-300)));
  EXPECT_TRUE(encloses(down / up, Interval(-1e300, -1e-300)));
  EXPECT_TRUE(encloses(down / down, Interval(1e-300, 1e300)));
  EXPECT_GE((up / up).lower(), -1e-300);
  EXPECT_LE((up / down).upper(), 1e-300);
}

TEST(Interval, division_by_a_box_that_touches_zero_is_the_whole_line) {
  for (const Interval& b : {Interval(0), Interval(0, 1), Interval(-1, 0), Interval(-0.0, 1), Interval(-1, 1)})
    EXPECT_EQ(Interval(1) / b, Interval::whole());
}

TEST(Interval, a_bound_that_overflows_keeps_the_other) {
  EXPECT_EQ(Interval(1e200, 1e300) * Interval(1e200), Interval(largest * (1 - epsilon), infinity));
  EXPECT_EQ(exp(Interval(0, 1000)).upper(), infinity);
  EXPECT_GE(exp(Interval(800, 1000)).lower(), 1e308);
  EXPECT_GE(cosh(Interval(800, 1000)).lower(), 1e308);
  EXPECT_LE(sinh(Interval(-1000, -800)).upper(), -1e308);
}

TEST(Interval, nan_is_the_whole_line) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Interval(nan), Interval::whole());
  EXPECT_EQ(Interval(std::numeric_limits<long double>::quiet_NaN()), Interval::whole());
  EXPECT_EQ(Interval(nan, 1), Interval::whole());
  EXPECT_EQ(Interval(0, nan), Interval::whole());
  EXPECT_EQ(Interval(2, 1), Interval::whole());
  EXPECT_EQ(Interval(infinity) - Interval(infinity), Interval::whole());
}

TEST(Interval, numbers_that_no_double_can_hold_are_enclosed) {
  EXPECT_EQ(Interval(7).upper(), 7);
  EXPECT_EQ(Interval(7ll), Interval(7, 7));
  EXPECT_TRUE(encloses(Interval((1ll << 53) + 1), Exact((1ll << 53) + 1)));
  EXPECT_TRUE(encloses(Interval(LLONG_MAX), Exact(LLONG_MAX)));
  EXPECT_TRUE(encloses(Interval(0.1L), Exact(0.1L)));
}

TEST(Interval, outside_its_domain_a_function_is_the_whole_line) {
  for (const Interval& r : {sqrt(Interval(-2, -1)), log(Interval(-2, -1)), log(Interval(0)), asin(Interval(2, 3)),
                            acos(Interval(-3, -2)), tan(Interval(1, 2))})
    EXPECT_EQ(r, Interval::whole());
  EXPECT_LE(sqrt(Interval(-1, 4)).upper(), 2.001);
  EXPECT_EQ(sqrt(Interval(-1, 4)).lower(), 0);
  EXPECT_EQ(log(Interval(-1, 1)).lower(), -infinity);
  EXPECT_LE(asin(Interval(-3, 3)).upper(), 1.571);
}

TEST(Interval, sine_and_cosine_of_a_box_with_an_extremum_reach_it_and_never_pass_it) {
  EXPECT_EQ(sin(Interval(1, 2)).upper(), 1);
  EXPECT_GT(sin(Interval(1, 2)).lower(), 0.84);
  EXPECT_EQ(cos(Interval(-0.1, 0.1)).upper(), 1);
  EXPECT_EQ(cos(Interval(3, 4)).lower(), -1);
  EXPECT_LT(cos(Interval(3, 4)).upper(), -0.65);
  for (const Interval& a : {Interval(0, 7), Interval(1e20), Interval(-infinity, infinity), Interval(-1e300, 1e300)}) {
    EXPECT_EQ(sin(a), Interval(-1, 1));
    EXPECT_EQ(cos(a), Interval(-1, 1));
  }
}

TEST(Interval, tangents_of_boxes_without_a_pole_are_bounded_and_with_one_are_not) {
  EXPECT_LT(tan(Interval(-1.5, 1.5)).upper(), 14.2);
  EXPECT_LT(tan(Interval(pi - 1.5, pi + 1.5)).upper(), 14.2);
  EXPECT_EQ(tan(Interval(1.5, 1.6)), Interval::whole());
  EXPECT_EQ(tan(Interval(4.7, 4.8)), Interval::whole());
  EXPECT_EQ(tan(Interval(1e20)), Interval::whole());
}

TEST(Interval, the_angle_of_a_box_across_the_cut_is_the_full_turn_and_elsewhere_that_of_its_corners) {
  for (const Interval& y : {Interval(-1, 1), Interval(0, 1), Interval(-1, 0), Interval(0), Interval(-0.0)}) {
    EXPECT_TRUE(encloses(atan2(y, Interval(-2, -1)), Interval(-pi, pi)));
    EXPECT_TRUE(encloses(atan2(y, Interval(0, 1)), Interval(-pi, pi)));
    EXPECT_LE(atan2(y, Interval(-2, -1)).upper(), 3.1416);
    EXPECT_LE(atan2(y, Interval(1, 2)).upper(), 0.786);
  }
  EXPECT_GT(atan2(Interval(1, 2), Interval(-1, 1)).lower(), 0.785);
  EXPECT_LT(atan2(Interval(1, infinity), Interval(-infinity, -1)).upper(), 3.1416);
  EXPECT_GT(atan2(Interval(1, infinity), Interval(-infinity, -1)).lower(), 1.5707);
}

TEST(Interval, subnormal_numbers_and_zero_are_enclosed) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(encloses(Interval(tiny) * Interval(0.5), Exact(tiny) / 2));
  EXPECT_TRUE(encloses(Interval(-tiny) * Interval(0.25), -Exact(tiny) / 4));
  EXPECT_TRUE(encloses(Interval(tiny) / Interval(3), Exact(tiny) / 3));
  EXPECT_TRUE(encloses(exp(Interval(-800)), exp(Exact(-800))));
  EXPECT_GE(exp(Interval(-800)).lower(), 0);
  EXPECT_TRUE(encloses(pow(Interval(1e-200), 2), pow(Exact(1e-200), 2)));
}

TEST(Interval, products_that_underflow_are_enclosed) {
  Random random;
  for (const double size : {1e-150, 1e-155, 1e-160, 1e-165, 1e-200})
    for (int n = 0; n < 2000; ++n) {
      const Interval a = Interval(size) * random.box(1e3), b = Interval(size) * random.box(1e3);
      for (const Interval& r : {a * b, square(a)}) ASSERT_LE(r.lower(), r.upper());
      for (const double x : {a.lower(), a.upper()}) {
        if (std::isinf(x)) continue;
        ASSERT_TRUE(encloses(square(a), Exact(x) * Exact(x))) << text(a);
        for (const double y : {b.lower(), b.upper()})
          if (!std::isinf(y)) {
            ASSERT_TRUE(encloses(a * b, Exact(x) * Exact(y))) << text(a) << " * " << text(b);
          }
      }
    }
}

TEST(Interval, a_comparison_has_the_answer_that_all_pairs_of_numbers_have) {
  const Interval a(1, 2), b(2, 3), c(2.5, 4);
  EXPECT_TRUE(a < c && c > a && a <= b && b >= a && a <= 2 && 0.5 < a);
  EXPECT_FALSE(c < a || a > c || b < a || a > b || c <= a || a >= c || a > 2 || 1 > a);
  EXPECT_THROW(static_cast<void>(a < b), Undecided_comparison) << "2 is not below 2, and 1 is";
  EXPECT_THROW(static_cast<void>(a >= b), Undecided_comparison);
  EXPECT_THROW(static_cast<void>(b > c), Undecided_comparison);
  EXPECT_THROW(static_cast<void>(Interval::whole() <= a), Undecided_comparison);
  EXPECT_THROW(static_cast<void>(a < 1.5), Undecided_comparison);
  EXPECT_FALSE(Interval(2) < Interval(2));
  EXPECT_TRUE(Interval(2) <= Interval(2));
  EXPECT_EQ(select(a < c, a, 7.0), a);
  EXPECT_EQ(select(c < a, a, 7.0), Interval(7));
}

TEST(Interval, limits_enclose_those_of_doubles) {
  using Limits = std::numeric_limits<Interval>;
  EXPECT_TRUE(Interval(Limits::max()).contains(largest));
  EXPECT_EQ(Interval(Limits::infinity()).upper(), infinity);
  EXPECT_EQ(Interval(Limits::quiet_NaN()), Interval::whole());
  EXPECT_FALSE(Limits::is_iec559);
}

TEST(Interval, an_exponent_that_is_a_number_keeps_its_fraction) {
  EXPECT_TRUE(encloses(pow(Interval(2), 2.5), pow(Exact(2), Exact(2.5))));
  EXPECT_LT(pow(Interval(2), 2.5).upper() - pow(Interval(2), 2.5).lower(), 1e-12);
  EXPECT_EQ(pow(Interval(-1, 2), 2.0), pow(Interval(-1, 2), 2));
  EXPECT_TRUE(pow(Interval(4), 0.5F).contains(2));
}

TEST(Interval, the_length_of_a_vector_may_have_three_coordinates) {
  const Interval r = hypot(Interval(2), Interval(-3, 3), Interval(6));
  EXPECT_TRUE(encloses(r, Exact(7)) && encloses(r, sqrt(Exact(40))));
  EXPECT_LT(r.upper(), 7 * (1 + 40 * epsilon));
  EXPECT_GT(r.lower(), std::sqrt(40.0) * (1 - 40 * epsilon));
}

// A subnormal number takes a processor a hundred times as long, and so does all that is computed of it.
TEST(Interval, zeros_make_no_subnormal_numbers) {
  const auto is_subnormal = [](double x) { return std::fpclassify(x) == FP_SUBNORMAL; };
  const std::array<Interval, 9> boxes = {Interval(0),      Interval(0, 2),    Interval(-2, 0),
                                         Interval(-2, 2),  Interval(1),       Interval(2, 3),
                                         Interval(-3, -2), Interval::whole(), Interval(0, infinity)};
  for (const Interval& a : boxes)
    for (const Interval& b : boxes)
      for (const Interval& r : {a * b, a + b, a - b, square(a), a * b + a, a * b * a})
        EXPECT_FALSE(is_subnormal(r.lower()) || is_subnormal(r.upper()))
            << text(a) << ", " << text(b) << ": " << text(r);
  EXPECT_EQ(Interval(0) * Interval::whole(), Interval(0));
  EXPECT_EQ(Interval(0) + Interval(0), Interval(0));
  EXPECT_EQ(square(Interval(0)), Interval(0));
}

} // namespace Interval_test
