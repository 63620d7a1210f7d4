// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/contraction.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/number/Pack.h>

#include <CGAL/Simple_cartesian.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

namespace Pack_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
constexpr std::size_t size = Pack<double>::size;
const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);
const Kernel::Aff_transformation_3 shear(0.9, 0, 0.9, 0.1, 0, 2, 0, 0, 1.1, 0, 0.6, 0);

// Packs of the compiler's vectors, where it has them, and of arrays.
template <class Lanes>
class Pack_of : public testing::Test {};
using Arrays = internal::Array_lanes<double, size>;
using All_lanes = std::conditional_t<internal::has_simd, testing::Types<internal::Simd_lanes<double, size>, Arrays>,
                                     testing::Types<Arrays>>;
TYPED_TEST_SUITE(Pack_of, All_lanes);

std::uint64_t bits(double x) { return std::isnan(x) ? 0 : std::bit_cast<std::uint64_t>(x); }

// Random points, and between them points on the axes and the origin, where functions have kinks and gradients vanish.
std::vector<Kernel::Point_3> points(std::size_t number) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Kernel::Point_3> result;
  for (std::size_t n = 0; n < number; ++n) {
    double c[3] = {unit(random), unit(random), unit(random)};
    if (n % 7 == 0) c[n % 3] = 0;
    if (n % 11 == 0) c[n % 2] = c[2] = 0;
    result.emplace_back(c[0], c[1], c[2]);
  }
  return result;
}

template <class Tag = CGAL::Sequential_tag, class Traits>
void expect_batch_equals_single(const Traits& traits, std::size_t number = 203) {
  const auto selection = select_attributes("all");
  const auto p = points(number);
  const auto batch = compute_attributes<Tag>(traits, p, selection);
  ASSERT_EQ(batch.status->size(), number);
  for (std::size_t i = 0; i < number; ++i) {
    const auto single = local_structure_at(traits, p[i]);
    ASSERT_EQ((*batch.status)[i], single.status) << i;
    for (std::size_t n = 0; n < selection.columns.size(); ++n)
      ASSERT_EQ(bits(batch.columns[n].values[i]), bits(selection.columns[n].get(single)))
          << selection.columns[n].name << " at point " << i;
  }
}

template <class Function>
void expect_batch_equals_single_for(const Function& f) {
  expect_batch_equals_single(make_analytic_traits<Kernel>(f, box));
}

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

// The error of x in units of the last place of the exact value.
double units_in_the_last_place(double x, const Exact& exact) {
  return std::abs(double(Exact(x) - exact)) / std::ldexp(1., std::ilogb(double(exact)) - 52);
}

// Numbers of every size, on both sides of where the C library takes over, and beside multiples of pi / 2.
std::vector<double> arguments(double range) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> result = {0., -0., range, -range, std::nextafter(range, 2 * range)};
  for (int n = 0; n < 4000; ++n) result.push_back(range * unit(random) * std::exp2(-n % 40));
  for (int n = -400; n <= 400; ++n) result.push_back(n * std::acos(-1.) / 2); // up to 628
  while (result.size() % size != 0) result.push_back(1);
  return result;
}

TEST(Pack, elementary_functions_are_right_to_the_last_place_or_the_one_before) {
  for (const double x : arguments(internal::exponential_range))
    EXPECT_LT(units_in_the_last_place(internal::exp_value(x), exp(Exact(x))), 0.6) << x;
  for (const double x : arguments(internal::circular_range)) {
    const auto [sine, cosine] = internal::sine_and_cosine(x);
    if (x != 0) {
      EXPECT_LT(units_in_the_last_place(sine, sin(Exact(x))), 0.9) << x;
    }
    EXPECT_LT(units_in_the_last_place(cosine, cos(Exact(x))), 0.9) << x;
  }
  EXPECT_EQ(internal::sine_and_cosine(0.).first, 0);
}

TYPED_TEST(Pack_of, elementary_functions_with_the_bits_of_single_numbers) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  using Number = Pack<double, TypeParam>;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> x = arguments(internal::exponential_range);
  x.insert(x.end(), {infinity, -infinity, std::nan(""), 1e300, -1e300, 710., -746., 1e-310});
  for (std::size_t first = 0; first + size <= x.size(); first += size) {
    const Number pack = Number::generate([&](std::size_t i) { return x[first + i]; });
    const Number e = exp(pack), s = sin(pack), c = cos(pack), p = natural_power(pack, 11), t = atan2(pack, Number(3));
    for (std::size_t i = 0; i < size; ++i) {
      const double u = x[first + i];
      EXPECT_EQ(bits(e[i]), bits(internal::exp_value(u))) << u;
      EXPECT_EQ(bits(s[i]), bits(internal::sine_and_cosine(u).first)) << u;
      EXPECT_EQ(bits(c[i]), bits(internal::sine_and_cosine(u).second)) << u;
      EXPECT_EQ(bits(p[i]), bits(internal::natural_power(u, 11))) << u;
      EXPECT_EQ(bits(t[i]), bits(std::atan2(u, 3))) << u;
    }
  }
}

TYPED_TEST(Pack_of, the_arithmetic_and_the_order_of_its_numbers) {
  using Number = Pack<double, TypeParam>;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> numbers = {0., -0., 1. / 3, -7.25, 1e300, -1e-310, nan, 1 / 0.};
  for (const double u : numbers)
    for (const double v : numbers) {
      // the first lane differs from the others, so that a lane in the wrong place is found
      const Number a = Number::generate([&](std::size_t i) { return i == 0 ? u : v; }), b = v;
      const auto expect = [&](const Number& computed, double first, double other) {
        EXPECT_EQ(bits(computed[0]), bits(first)) << u << ' ' << v;
        EXPECT_EQ(bits(computed[size - 1]), bits(other)) << u << ' ' << v;
      };
      expect(a + b, u + v, v + v);
      expect(a - b, u - v, v - v);
      expect(a * b, u * v, v * v);
      expect(a / b, u / v, v / v);
      expect(-a, -u, -v);
      expect(abs(a), std::abs(u), std::abs(v));
      expect(sqrt(a), std::sqrt(u), std::sqrt(v));
      const auto expect_truth = [&](const auto& computed, bool first, bool other) {
        EXPECT_EQ(computed[0], first) << u << ' ' << v;
        EXPECT_EQ(computed[size - 1], other) << u << ' ' << v;
      };
      expect_truth(a < b, u < v, false);
      expect_truth(a > b, u > v, false);
      expect_truth(a <= b, u <= v, v <= v);
      expect_truth(a >= b, u >= v, v >= v);
      expect_truth(a == b, u == v, v == v);
      expect_truth(a != b, u != v, v != v);
      expect_truth(!(a < b) && a == a, !(u < v) && u == u, v == v);
      expect_truth(a < b || b != b, u < v || v != v, v != v);
    }
}

// The Barth sextic, with an exponential, a sine, a quotient and a root, has every kind of operation on jets.
TYPED_TEST(Pack_of, the_jets_of_its_numbers_bit_for_bit) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  using Number = Pack<double, TypeParam>;
  const auto p = points(size);
  const auto coordinate = [&](int axis) { return Number::generate([&](std::size_t i) { return p[i][axis]; }); };
  const auto jet = [](const auto& x, const auto& y, const auto& z) {
    using T = std::remove_cvref_t<decltype(x)>;
    const auto f = [](const auto& u, const auto& v, const auto& w) {
      return analytic_functions::Barth_sextic()(u, v, w) + exp(u) * sin(v / (w + 3.0)) - sqrt(w * w + 1.0);
    };
    return f(Jet_3<T>::variable(0, x), Jet_3<T>::variable(1, y), Jet_3<T>::variable(2, z));
  };
  const auto pack = jet(coordinate(0), coordinate(1), coordinate(2));
  for (std::size_t i = 0; i < size; ++i) {
    const auto single = jet(p[i].x(), p[i].y(), p[i].z());
    for (std::size_t n = 0; n < single.size; ++n)
      EXPECT_EQ(bits(pack.coefficients()[n][i]), bits(single.coefficients()[n])) << n;
  }
}

TEST(Pack, attributes_of_a_batch_are_those_of_its_points_bit_for_bit) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  using namespace analytic_functions;
  expect_batch_equals_single_for(Torus());
  expect_batch_equals_single_for(Metaballs());
  expect_batch_equals_single_for(Gyroid());
  expect_batch_equals_single_for(Cayley_cubic());
  expect_batch_equals_single_for(Barth_sextic());
  expect_batch_equals_single_for(Expression_3("abs(x)^1.5 + max(y, z) * pow(2, x) + atan2(y, 2 + z) - min(x, y*z, 1) + "
                                              "hypot(y, z)^9 + log(x) + cbrt(y) + x^12 + tanh(x*y) + acos(z/2)"));
  expect_batch_equals_single_for(Expression_3("x*y + z^3 + erf(x) + floor(3*y) + sign(z - x) + fmod(7*x, y)"));
}

TEST(Pack, numbers_of_other_sizes_have_lanes_in_arrays) {
  const Pack<long double> x(-2.25L);
  for (std::size_t i = 0; i < x.size; ++i) EXPECT_EQ(sqrt(abs(x) * x * x)[i], std::sqrt(2.25L * 2.25L * 2.25L));
  const auto narrow = Pack<float>::generate([](std::size_t i) { return float(i) - 1.5F; });
  const auto roots = sqrt(abs(narrow)) + Pack<float>(1);
  for (std::size_t i = 0; i < narrow.size; ++i) EXPECT_EQ(roots[i], std::sqrt(std::abs(float(i) - 1.5F)) + 1);
}

TEST(Pack, any_number_of_points_is_a_batch) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  const auto traits = make_analytic_traits<Kernel>(analytic_functions::Gyroid(), box);
  for (std::size_t number = 0; number <= 2 * size + 1; ++number) expect_batch_equals_single(traits, number);
}

TEST(Pack, threads_and_adaptors_change_no_bit) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  const auto base = make_analytic_traits<Kernel>(analytic_functions::Torus(), box);
  const Level_set_traits_3 level_set(base, 0.25, Orientation_of_level_set::AGAINST_GRADIENT);
  expect_batch_equals_single(level_set);
  expect_batch_equals_single<CGAL::Parallel_if_available_tag>(level_set, 5003);
  expect_batch_equals_single(Transformed_function_traits_3(base, shear));
}

// A function that is continuous nowhere on the plane x = 0.
struct Branching {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    using std::exp;
    if (x < 0.0) return x * x + y * y * y + z;
    return y * z + exp(x);
  }
};

TEST(Pack, a_function_that_branches_is_evaluated_point_by_point_where_lanes_disagree) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  expect_batch_equals_single_for(Branching());
}

TYPED_TEST(Pack_of, masks_that_choose_lane_by_lane_and_decide_only_when_unanimous) {
  using Number = Pack<double, TypeParam>;
  const Number ascending = Number::generate([](std::size_t i) { return double(i); });
  const auto first = ascending < Number(1);
  const Number chosen = select(first, Number(5), -ascending);
  for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(chosen[i], i == 0 ? 5 : -double(i));
  EXPECT_TRUE(bool(ascending >= Number(0)));
  EXPECT_FALSE(bool(ascending < Number(0)));
  EXPECT_THROW(static_cast<void>(bool(first)), Lanes_disagree);
  const Number nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(max(ascending, nan)[0]) && std::isnan(min(nan, ascending)[0]));
}

} // namespace Pack_test
