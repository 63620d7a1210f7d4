// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/Canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace Canvas_test {

using equiaffine::Canvas;
using equiaffine::Light;
using equiaffine::Picture;
using equiaffine::Screen_point;

constexpr Light black = {0, 0, 0}, red = {1, 0, 0}, green = {0, 1, 0};

auto paint(const Light& light) {
  return [light](const std::array<double, 3>&, bool) { return light; };
}

std::array<int, 3> pixel(const Picture& picture, std::size_t x, std::size_t y) {
  const unsigned char* const first = &picture.rgb[3 * (y * picture.width + x)];
  return {first[0], first[1], first[2]};
}

/// The area of what is black on white, in pixels; gray pixels count as fractions.
double dark_area(const Picture& picture) {
  double area = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) area += 1 - std::pow(picture.rgb[i] / 255., 2.2);
  return area;
}

TEST(Program_Canvas, is_white_at_first) {
  const Picture picture = Canvas(4, 3).picture();
  EXPECT_EQ(picture.width, 4U);
  EXPECT_EQ(picture.height, 3U);
  EXPECT_EQ(picture.rgb, std::vector<unsigned char>(36, 255));
}

TEST(Program_Canvas, a_triangle_covers_its_area) {
  Canvas canvas(100, 80);
  canvas.draw_triangle({Screen_point{10.3, 12, 1}, {90, 20.7, 1}, {25, 70.1, 1}}, paint(black));
  const double area = ((90 - 10.3) * (70.1 - 12) - (25 - 10.3) * (20.7 - 12)) / 2;
  EXPECT_NEAR(dark_area(canvas.picture()), area, 0.002 * area);
}

TEST(Program_Canvas, a_rectangle_covers_its_pixels_and_no_other) {
  Canvas canvas(60, 60);
  const Screen_point a{10, 20, 1}, b{40, 20, 1}, c{40, 50, 1}, d{10, 50, 1};
  canvas.draw_triangle({a, b, c}, paint(black));
  canvas.draw_triangle({a, c, d}, paint(black));
  const Picture picture = canvas.picture();
  for (std::size_t y = 0; y < 60; ++y)
    for (std::size_t x = 0; x < 60; ++x)
      EXPECT_EQ(pixel(picture, x, y)[0], x >= 10 && x < 40 && y >= 20 && y < 50 ? 0 : 255) << x << ' ' << y;
}

TEST(Program_Canvas, neighbors_leave_no_gap) {
  Canvas canvas(60, 60);
  const Screen_point a{-5, -7.1, 1}, b{71.3, -3.3, 0.7}, c{66.6, 80.8, 1.9}, d{-9.9, 69.7, 1.1};
  canvas.draw_triangle({a, b, c}, paint(black));
  canvas.draw_triangle({a, c, d}, paint(black));
  EXPECT_EQ(canvas.picture().rgb, std::vector<unsigned char>(3 * 60 * 60, 0));
}

TEST(Program_Canvas, what_is_nearer_hides_what_is_behind_in_any_order) {
  const std::array<Screen_point, 3> near = {Screen_point{0, 0, 2}, {20, 0, 2}, {0, 20, 2}};
  const std::array<Screen_point, 3> far = {Screen_point{0, 0, 1}, {20, 0, 1}, {0, 20, 1}};
  for (const bool near_first : {true, false}) {
    Canvas canvas(20, 20);
    if (near_first) canvas.draw_triangle(near, paint(red));
    canvas.draw_triangle(far, paint(green));
    if (!near_first) canvas.draw_triangle(near, paint(red));
    EXPECT_EQ(pixel(canvas.picture(), 4, 4), (std::array{255, 0, 0}));
  }
}

TEST(Program_Canvas, weights_are_those_in_space) {
  Canvas canvas(100, 100);
  std::array<double, 3> middle{};
  // In space the point that is seen in the middle of the edge divides it as 3 to 1.
  canvas.draw_triangle({Screen_point{0, 50, 1}, {100, 50, 3}, {50, 100, 2}}, [&](const auto& weights, bool is_front) {
    if (std::abs(weights[2]) < 0.01 && std::abs(weights[0] - 0.25) < 0.01) middle = weights;
    EXPECT_FALSE(is_front) << "y points downwards";
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-12);
    return Light{float(weights[0]), 0, 0};
  });
  EXPECT_NEAR(middle[1], 0.75, 0.02);
  const double light = std::pow(pixel(canvas.picture(), 50, 50)[0] / 255., 2.2);
  EXPECT_NEAR(light, 0.25, 0.01);
}

TEST(Program_Canvas, a_stroke_has_round_ends_and_its_width) {
  Canvas canvas(100, 60);
  canvas.draw_stroke({20, 30, 1}, {80, 31, 1}, 4, 4, black, 0);
  const double area = 8 * std::hypot(60, 1) + std::numbers::pi * 16;
  EXPECT_NEAR(dark_area(canvas.picture()), area, 0.01 * area);
}

TEST(Program_Canvas, a_stroke_goes_from_one_width_to_another) {
  Canvas canvas(120, 60);
  canvas.draw_stroke({20, 30, 1}, {80, 30, 1}, 12, 0, black, 0);
  const double area = 12 * 60 + std::numbers::pi * 12 * 12 / 2; // a triangle and half a disk
  EXPECT_NEAR(dark_area(canvas.picture()), area, 0.01 * area);
}

TEST(Program_Canvas, a_stroke_on_a_surface_is_seen_only_if_it_is_lifted) {
  const std::array<Screen_point, 3> surface = {Screen_point{0, 0, 1}, {100, 0, 1}, {0, 100, 1}};
  for (const double lift : {0.01, -0.01}) {
    Canvas canvas(50, 50);
    canvas.draw_triangle(surface, paint(red));
    canvas.draw_stroke({5, 20, 1}, {40, 20, 1}, 2, 2, black, lift);
    EXPECT_EQ(pixel(canvas.picture(), 20, 20), (lift > 0 ? std::array{0, 0, 0} : std::array{255, 0, 0}));
  }
}

TEST(Program_Canvas, what_is_not_a_number_is_not_drawn) {
  Canvas canvas(10, 10);
  canvas.draw_triangle({Screen_point{0, 0, 1}, {10, NAN, 1}, {0, 10, 1}}, paint(black));
  canvas.draw_stroke({0, 0, 1}, {INFINITY, 5, 1}, 2, 2, black, 0);
  EXPECT_EQ(dark_area(canvas.picture()), 0);
}

TEST(Program_Canvas, bands_have_the_bytes_of_the_whole) {
  const auto drawn = [](Canvas canvas) {
    canvas.draw_triangle({Screen_point{3.3, 2, 1}, {38, 7.7, 2}, {11, 37.1, 3}}, paint(red));
    canvas.draw_triangle({Screen_point{20, 5, 2.5}, {35, 30, 1}, {2, 21.3, 1}}, paint(green));
    canvas.draw_stroke({5, 35, 3}, {36.5, 3, 3}, 2.5, 0.5, black, 0.1);
    return canvas.picture().rgb;
  };
  const auto whole = drawn(Canvas(40, 40));
  for (const std::size_t rows : {1u, 7u, 39u}) {
    std::vector<unsigned char> bytes;
    for (std::size_t first = 0; first < 40; first += rows) {
      const auto band = drawn(Canvas(40, std::min<std::size_t>(rows, 40 - first), first));
      bytes.insert(bytes.end(), band.begin(), band.end());
    }
    EXPECT_EQ(bytes, whole) << rows;
  }
}

TEST(Program_Canvas, bands_need_little_memory_however_large_the_picture_is) {
  for (const std::size_t width : {100u, 4000u, 10000u}) {
    const std::size_t samples = 9 * width * Canvas::rows_of_band(width);
    EXPECT_LE(samples * (sizeof(float) + sizeof(Light)), 64'000'000u);
    EXPECT_GE(Canvas::rows_of_band(width), 1u);
  }
}

} // namespace Canvas_test
