// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/oklab.h"
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/display/color_map.h>
#include <equiaffine/display/internal/Column_numbers.h>
#include <equiaffine/display/internal/trust.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace color_map_test {

using namespace equiaffine;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::tuple<int, int, int> rgb(const CGAL::IO::Color& color) { return {color.red(), color.green(), color.blue()}; }

std::vector<double> integers(int first, int last) {
  std::vector<double> values;
  for (int i = first; i <= last; ++i) values.push_back(i);
  std::shuffle(values.begin(), values.end(), std::mt19937(7));
  return values;
}

/// CIE 1976 lightness, a measure other than the one the maps are made of.
double lightness(const CGAL::IO::Color& color) {
  const auto linear = [](unsigned char byte) {
    const double x = byte / 255.;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(color.red()) + 0.7152 * linear(color.green()) + 0.0722 * linear(color.blue());
  return 116 * std::cbrt(y) - 16;
}

double position(const Color_range& range, Color_scale scale, double value) {
  return Color_mapping{range, scale}.position(value);
}

TEST(Color_map, a_column_with_few_numbers_that_are_not_zero_has_a_range) {
  std::vector<double> values(100, 0.);
  values.back() = 3;
  const Color_range range = color_range(values);
  EXPECT_EQ(range.lower, 0);
  EXPECT_EQ(range.upper, 3);
  EXPECT_EQ(Color_mapping{range}.position(0), 0);
  values.back() = -3;
  EXPECT_EQ(color_range(values).lower, -3);
}

TEST(Color_map, numbers_that_are_equal_within_their_errors_have_one_color) {
  const std::vector<double> values = {0.99, 1, 1.01}, magnitudes = values;
  const Color_mapping exact{color_range_of_sorted(values, magnitudes, 0, 0)};
  EXPECT_LT(exact.position(0.99), 0.1);
  EXPECT_GT(exact.position(1.01), 0.9);
  const Color_mapping rough{color_range_of_sorted(values, magnitudes, 0, 0, 0.05)};
  for (const double value : values) EXPECT_NEAR(rough.position(value), 0.5, 0.02);
  const std::vector<double> both = {-0.01, 0.001, 0.01};
  EXPECT_EQ(color_range_of_sorted(both, {0.001, 0.01, 0.01}, 0, 0, 0.05).upper, 0.4);
}

TEST(Color_map, errors_do_not_take_the_range_of_numbers_of_one_sign_across_zero) {
  const std::vector<double> values = {0.2, 0.3, 0.4}, opposite = {-0.4, -0.3, -0.2};
  const Color_range positive = color_range_of_sorted(values, values, 0, 0, 0.05);
  EXPECT_EQ(positive.lower, 0);
  EXPECT_EQ(positive.upper, 0.8);
  const Color_range negative = color_range_of_sorted(opposite, values, 0, 0, 0.05);
  EXPECT_EQ(negative.lower, -0.8);
  EXPECT_EQ(negative.upper, 0);
}

TEST(Color_map, quantiles_interpolate_between_order_statistics) {
  std::vector<double> values = {40, 10, 30, 20};
  EXPECT_EQ(quantile(values, 0), 10);
  EXPECT_EQ(quantile(values, 50), 25);
  EXPECT_EQ(quantile(values, 100), 40);
  EXPECT_DOUBLE_EQ(quantile(values, 10), 13);
  std::vector<double> one = {5};
  EXPECT_EQ(quantile(one, 37), 5);
}

TEST(Color_map, numbers_of_both_signs_get_a_range_centered_at_zero) {
  const Color_range range = color_range(integers(-20, 100), 0);
  EXPECT_EQ(range.lower, -100);
  EXPECT_EQ(range.upper, 100);
  EXPECT_TRUE(range.is_diverging);
}

TEST(Color_map, numbers_of_one_sign_get_the_range_between_their_quantiles) {
  const Color_range positive = color_range(integers(0, 100), 2);
  EXPECT_FALSE(positive.is_diverging);
  EXPECT_DOUBLE_EQ(positive.lower, 2);
  EXPECT_DOUBLE_EQ(positive.upper, 98);
  const Color_range negative = color_range(integers(-100, 0), 5);
  EXPECT_FALSE(negative.is_diverging);
  EXPECT_DOUBLE_EQ(negative.lower, -95);
  EXPECT_DOUBLE_EQ(negative.upper, -5);
}

TEST(Color_map, a_few_outliers_do_not_change_the_range_much) {
  std::vector<double> values = integers(-1000, 1000);
  const double before = color_range(values).upper;
  values.insert(values.end(), {1e12, -1e15, 1e300});
  EXPECT_NEAR(color_range(values).upper, before, 2);
}

TEST(Color_map, numbers_that_do_not_exist_do_not_count) {
  std::vector<double> values = integers(-50, 80);
  const Color_range range = color_range(values, 3);
  values.insert(values.end(), {nan, infinity, -infinity});
  EXPECT_EQ(color_range(values, 3), range);
}

TEST(Color_map, no_numbers_at_all_still_give_a_range) {
  for (const std::vector<double>& values : {std::vector<double>{}, {nan, infinity}, {0, 0, 0}}) {
    const Color_range range = color_range(values);
    EXPECT_LT(range.lower, range.upper);
    EXPECT_GT(range.knee, 0);
  }
}

TEST(Color_map, rounding_noise_around_zero_looks_like_zero) {
  const Color_range range = color_range({1e-15, -2e-15, 3e-16, 5e-15}, 0, 1e-9);
  EXPECT_TRUE(range.is_diverging);
  EXPECT_EQ(rgb(Color_mapping{range}.color(5e-15)), rgb(diverging_color(0)));
}

TEST(Color_map, rounding_noise_that_grows_beside_a_curve_looks_like_zero) {
  std::vector<double> values(1000, 1e-15);
  for (std::size_t i = 0; i < 15; ++i) values[i] = (i % 2 == 0 ? 1 : -1) * 2e-7;
  for (const double noise : {1e-12, 4e-8}) {
    for (std::size_t i = 15; i < 50; ++i) values[i] = noise;
    const Color_range range = color_range(values, default_clip_percent, 1e-9);
    for (const double value : values)
      EXPECT_EQ(rgb(Color_mapping{range}.color(value)), rgb(diverging_color(0))) << noise;
  }
}

TEST(Color_map, few_numbers_that_are_not_noise_have_their_color) {
  std::vector<double> values(1000, 1e-15);
  for (std::size_t i = 0; i < 10; ++i) values[i] = 0.5;
  EXPECT_EQ(rgb(Color_mapping{color_range(values, default_clip_percent, 1e-9)}.color(0.5)), rgb(diverging_color(0.5)));
}

TEST(Color_map, a_constant_up_to_rounding_has_one_color) {
  const std::vector<double> values = {-0.55, -0.55 + 1e-13, -0.55 - 1e-13};
  const Color_range range = color_range(values, 0, 1e-9);
  for (const double value : values) EXPECT_EQ(rgb(Color_mapping{range}.color(value)), rgb(sequential_color(0.5)));
}

TEST(Color_map, noise_of_the_other_sign_does_not_make_a_quantity_signed) {
  std::vector<double> values = integers(0, 100);
  values.push_back(-1e-9);
  EXPECT_FALSE(color_range(values).is_diverging);
  values.push_back(-1);
  EXPECT_TRUE(color_range(values).is_diverging);
}

TEST(Color_map, a_bound_that_is_nearly_zero_is_zero) {
  for (const double sign : {1., -1.}) {
    const Color_range range = color_range({sign * 2e-8, sign * 1, sign * 4}, 0);
    EXPECT_EQ(sign > 0 ? range.lower : range.upper, 0);
    EXPECT_EQ(sign > 0 ? range.upper : range.lower, sign * 4);
    EXPECT_FALSE(range.is_diverging);
  }
}

TEST(Color_map, mostly_zeros_keep_the_few_numbers_visible) {
  std::vector<double> values(1000, 0.);
  values[3] = 4;
  values[5] = -1;
  EXPECT_EQ(color_range(values).upper, 4);
}

TEST(Color_map, diverging_positions_are_odd_monotone_and_end_at_one) {
  const Color_range range{-4, 4, 0.1, true};
  for (const Color_scale scale : {Color_scale::LINEAR, Color_scale::ASINH}) {
    double previous = -1;
    for (double value = -4; value <= 4; value += 0.125) {
      const double t = position(range, scale, value);
      EXPECT_EQ(t, -position(range, scale, -value));
      if (value > -4) {
        EXPECT_GT(t, previous);
      }
      previous = t;
    }
    EXPECT_EQ(position(range, scale, 0), 0);
    EXPECT_EQ(position(range, scale, 4), 1);
    EXPECT_EQ(position(range, scale, infinity), 1);
    EXPECT_EQ(position(range, scale, -1e300), -1);
  }
}

TEST(Color_map, sequential_positions_run_from_zero_to_one) {
  const Color_range range{2, 10, 3, false};
  for (const Color_scale scale : {Color_scale::LINEAR, Color_scale::ASINH}) {
    EXPECT_EQ(position(range, scale, 1), 0);
    EXPECT_EQ(position(range, scale, 2), 0);
    EXPECT_EQ(position(range, scale, 10), 1);
    double previous = 0;
    for (double value = 2.25; value <= 10; value += 0.25) {
      EXPECT_GT(position(range, scale, value), previous);
      previous = position(range, scale, value);
    }
  }
}

TEST(Color_map, asinh_gives_equal_steps_to_equal_ratios_far_above_the_knee) {
  const Color_range range{-1e6, 1e6, 1, true};
  const auto t = [&](double value) { return position(range, Color_scale::ASINH, value); };
  // asinh(x) = log(2 x) + O(x^-2): from x = 1e3 on the steps of a decade differ by less than 1e-6.
  EXPECT_NEAR(t(1e4) - t(1e3), t(1e6) - t(1e5), 1e-6);
  // asinh(x) = x + O(x^3)
  EXPECT_NEAR(t(2e-3) / t(1e-3), 2, 1e-5);
}

TEST(Color_map, both_maps_stay_within_what_a_screen_can_show) {
  for (int i = -1000; i <= 1000; ++i) {
    const double t = i / 1000.;
    for (const auto& linear : {internal::diverging_linear_rgb(t), internal::sequential_linear_rgb(std::abs(t))})
      for (const double component : linear) {
        EXPECT_GE(component, 0) << "t = " << t;
        EXPECT_LE(component, 1) << "t = " << t;
      }
  }
}

TEST(Color_map, the_diverging_map_is_neutral_at_zero_and_as_dark_on_both_sides) {
  const auto center = diverging_color(0);
  const auto [least, greatest] = std::minmax({center.red(), center.green(), center.blue()});
  EXPECT_LE(greatest - least, 1);
  EXPECT_GT(diverging_color(1).red(), diverging_color(1).blue());
  EXPECT_LT(diverging_color(-1).red(), diverging_color(-1).blue());
  for (int i = 1; i <= 20; ++i) {
    const double t = i / 20.;
    EXPECT_LT(lightness(diverging_color(t)), lightness(diverging_color(t - 0.05)));
    EXPECT_LT(lightness(diverging_color(-t)), lightness(diverging_color(0.05 - t)));
    // Oklab's lightness and CIE's differ by a few units for saturated colors.
    EXPECT_NEAR(lightness(diverging_color(t)), lightness(diverging_color(-t)), 8);
  }
}

TEST(Color_map, the_sequential_map_darkens_steadily) {
  for (int i = 1; i <= 50; ++i)
    EXPECT_LT(lightness(sequential_color(i / 50.)), lightness(sequential_color((i - 1) / 50.)));
}

TEST(Color_map, known_colors_of_oklab) {
  // Ottosson's reference values: Oklab of sRGB white is (1, 0, 0), of red (0.627955, 0.224863, 0.125846).
  EXPECT_EQ(rgb(internal::color_from_linear_rgb(internal::linear_rgb_from_oklch(1, 0, 0))), std::tuple(255, 255, 255));
  const double hue = std::atan2(0.125846, 0.224863) * 180 / 3.141592653589793;
  const auto red = internal::linear_rgb_from_oklch(0.627955, std::hypot(0.224863, 0.125846), hue);
  EXPECT_NEAR(red[0], 1, 1e-5);
  EXPECT_NEAR(red[1], 0, 1e-5);
  EXPECT_NEAR(red[2], 0, 1e-5);
}

TEST(Color_map, a_missing_number_is_gray_in_both_maps) {
  EXPECT_EQ(rgb(Color_mapping{{-1, 1, 1, true}}.color(nan)), rgb(undefined_color()));
  EXPECT_EQ(rgb(Color_mapping{{0, 1, 1, false}, Color_scale::ASINH}.color(nan)), rgb(undefined_color()));
}

TEST(Color_map, every_status_has_its_own_color_away_from_both_maps) {
  std::set<std::tuple<int, int, int>> colors = {rgb(undefined_color())};
  for (std::size_t i = 0; i < number_of_point_statuses; ++i)
    colors.insert(rgb(status_color(static_cast<Point_status>(i))));
  EXPECT_EQ(colors.size(), number_of_point_statuses + 1);

  const auto difference = [](const CGAL::IO::Color& a, const CGAL::IO::Color& b) {
    return std::hypot(a.red() - b.red(), a.green() - b.green(), a.blue() - b.blue());
  };
  for (std::size_t i = 1; i < number_of_point_statuses; ++i)
    for (int k = -100; k <= 100; ++k) {
      const auto color = status_color(static_cast<Point_status>(i));
      EXPECT_GT(difference(color, diverging_color(k / 100.)), 40);
      EXPECT_GT(difference(color, sequential_color(std::abs(k) / 100.)), 40);
    }
}

Column_numbers numbers_of(const std::vector<double>& values, const std::vector<double>& errors = {}) {
  std::vector<bool> known;
  for (std::size_t i = 0; i < errors.size(); ++i) known.push_back(is_known(std::abs(values[i]), errors[i]));
  return {values, known, errors, std::vector<double>(values.size(), 1.), 0};
}

TEST(Color_map, the_automatic_scale_is_the_first_by_which_the_median_is_not_near_white) {
  std::vector<double> values(1000, 1.0);
  for (std::size_t i = 0; i < values.size(); i += 2) values[i] = -1;
  EXPECT_EQ(numbers_of(values).mapping().scale, Color_scale::LINEAR);
  for (std::size_t i = 0; i < 100; ++i) values[i] *= 100;
  EXPECT_EQ(numbers_of(values).mapping().scale, Color_scale::ASINH);
  for (std::size_t i = 0; i < 100; ++i) values[i] *= 1e4;
  const Color_mapping mapping = numbers_of(values).mapping();
  EXPECT_EQ(mapping.scale, Color_scale::EQUALIZED);
  EXPECT_GE(mapping.position(1), 0.125);
  EXPECT_LE(mapping.position(-1), -0.125);
}

TEST(Color_map, zero_is_the_middle_by_every_scale) {
  std::vector<double> values(1000, 0.);
  for (std::size_t i = 0; i < 300; ++i) values[i] = (i % 2 == 0 ? 1 : -1) * std::pow(1.1, double(i));
  const Color_mapping mapping = numbers_of(values).mapping();
  for (const Color_scale scale : {Color_scale::LINEAR, Color_scale::ASINH, Color_scale::EQUALIZED})
    EXPECT_EQ((Color_mapping{mapping.range, scale, mapping.equalization}.position(0)), 0);
}

TEST(Color_map, equalized_numbers_have_the_rank_of_their_sign_by_area) {
  std::vector<Weighted_number> numbers;
  for (int i = 1; i <= 640; ++i) numbers.push_back({std::pow(2., i), 1});
  for (int i = 1; i <= 64; ++i) numbers.push_back({-double(i), 10});
  const Equalization equalization(numbers);
  EXPECT_EQ(equalization(0), 0);
  EXPECT_DOUBLE_EQ(equalization(std::pow(2., 320)), 0.5);
  EXPECT_DOUBLE_EQ(equalization(-32), -0.5);
  EXPECT_EQ(equalization(infinity), 1);
  EXPECT_EQ(equalization(-1e300), -1);
  const Equalization of_areas({{1, 3}, {2, 1}, {3, 4}});
  EXPECT_LT(of_areas(1), of_areas(2));
  EXPECT_LT(of_areas(2), of_areas(3));
  EXPECT_NEAR(of_areas(2), 7. / 16, 1. / 64) << "the middle of the areas from 3/8 to 1/2";
}

TEST(Color_map, equalized_places_are_monotone_also_among_equal_numbers) {
  const Equalization equalization({{5, 1}, {5, 1}, {5, 1}, {7, 1}, {-2, 1}});
  double previous = -1;
  for (double x = -3; x <= 8; x += 0.01) {
    const double place = equalization(x);
    EXPECT_GE(place, previous) << x;
    previous = place;
  }
  EXPECT_GT(equalization(5), equalization(4.9));
}

TEST(Color_map, numbers_in_doubt_do_not_count_beside_known_ones) {
  std::vector<double> values = integers(1, 1000), errors(1000, 0.1);
  const Color_mapping known = numbers_of(values, errors).mapping();
  for (int i = 0; i < 500; ++i) {
    values.push_back(-1e9);
    errors.push_back(1e9);
  }
  const Column_numbers numbers = numbers_of(values, errors);
  EXPECT_EQ(numbers.mapping(), known);
  EXPECT_DOUBLE_EQ(numbers.part_unknown(), 1. / 3);
  const std::vector<double> unknown(1500, 1e10);
  EXPECT_EQ(numbers_of(values, unknown).mapping(), numbers_of(values).mapping()) << "if none is known, all count";
}

TEST(Color_map, an_area_density_is_zero_where_the_curvature_of_which_it_is_a_root_is_rounding) {
  using Kernel = CGAL::Simple_cartesian<double>;
  Indexed_triangle_mesh_3<Kernel> mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  Vertex_attributes attributes;
  attributes.columns = {{"affine_area_density", {1e-8, 6e-8, 0}}, {"gaussian_curvature", {1e-32, 1e-29, 0}}};
  const Numbers_of_mesh numbers(mesh, attributes);
  const auto width = [&](std::size_t i) { return numbers(attributes.columns[i]).mapping().range.upper; };
  EXPECT_GT(width(0), 0.5); // so that all have one color
  EXPECT_GT(width(1), 0.4);
  attributes.columns[0].values = {0.1, 0.2, 0.3};
  EXPECT_NEAR(width(0), 0.3, 0.01);
}

} // namespace color_map_test
