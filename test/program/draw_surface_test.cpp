// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/draw_surface.h"
#include <equiaffine/display/internal/Parabolic_parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace draw_surface_test {

using namespace equiaffine;
using Vector = Kernel::Vector_3;
using Mesh = Indexed_triangle_mesh_3<Kernel>;

const Display_options small = {.size = {101, 101}};

/// A square that faces the eye of the first view.
Mesh facing_square() {
  const Vector back = Vector(0.5, -1, 0.62) / std::sqrt(0.25 + 1 + 0.62 * 0.62);
  const Vector across = cross_product(Vector(0, 0, 1), back), right = across / std::sqrt(across.squared_length());
  const Vector up = cross_product(back, right);
  Mesh mesh;
  for (const auto& [x, y] : {std::array{-1., -1.}, {1., -1.}, {1., 1.}, {-1., 1.}})
    mesh.points.push_back(CGAL::ORIGIN + x * right + y * up);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

std::array<int, 3> middle(const Picture& picture, std::size_t row) {
  const unsigned char* const first = &picture.rgb[3 * (row * picture.width + picture.width / 2)];
  return {first[0], first[1], first[2]};
}

/// What the shader of the page makes of a color that faces the eye.
std::array<int, 3> shaded(const CGAL::IO::Color& color) {
  const double cosine = 1 / std::sqrt(0.35 * 0.35 + 0.5 * 0.5 + 1), diffuse = 0.5 + 0.5 * cosine;
  const double shade = 0.36 + 0.67 * diffuse * diffuse, glint = 0.03 * std::pow((1 + cosine) / 2, 20);
  const auto channel = [&](unsigned char byte) {
    return int(std::lround(255 * std::pow(std::pow(byte / 255., 2.2) * shade + glint, 1 / 2.2)));
  };
  return {channel(color.red()), channel(color.green()), channel(color.blue())};
}

void expect_near(const std::array<int, 3>& actual, const std::array<int, 3>& expected) {
  for (std::size_t n = 0; n < 3; ++n) EXPECT_LE(std::abs(actual[n] - expected[n]), 2) << "channel " << n;
}

TEST(Program_draw_surface, a_plain_surface_has_the_color_and_light_of_the_page) {
  const auto drawn = draw_surface(facing_square(), {}, small);
  EXPECT_FALSE(drawn.legend);
  expect_near(middle(drawn.picture, 50), shaded(plain_color()));
  EXPECT_EQ(drawn.picture.rgb[0], 255) << "the background is white";
}

TEST(Program_draw_surface, numbers_have_the_colors_and_the_range_of_the_page) {
  Vertex_attributes attributes;
  attributes.columns = {{"mean_curvature", {-1, -1, 3, 3}}};
  const auto drawn = draw_surface(facing_square(), attributes, small);
  ASSERT_TRUE(drawn.legend);
  EXPECT_EQ(drawn.legend->label, "Mean curvature, length^-1");
  EXPECT_EQ(drawn.legend->mapping.range, color_range({-1, -1, 3, 3}));
  const std::size_t row = (101 - legend_height) / 2; // the middle of the square
  expect_near(middle(drawn.picture, row), shaded(drawn.legend->mapping.color(1)));
}

TEST(Program_draw_surface, a_range_can_be_given) {
  Vertex_attributes attributes;
  attributes.columns = {{"anything", {5, 5, 5, 5}}};
  Display_options options = small;
  options.range = {{-10, 10}};
  const auto drawn = draw_surface(facing_square(), attributes, options);
  ASSERT_TRUE(drawn.legend);
  EXPECT_TRUE(drawn.legend->mapping.range.is_diverging);
  expect_near(middle(drawn.picture, (101 - legend_height) / 2), shaded(diverging_color(0.5)));
  options.range = {{0, 10}};
  expect_near(middle(draw_surface(facing_square(), attributes, options).picture, (101 - legend_height) / 2),
              shaded(sequential_color(0.5)));
}

TEST(Program_draw_surface, what_has_no_number_has_the_color_of_its_status) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Vertex_attributes attributes;
  attributes.columns = {{"k1", {nan, nan, nan, nan}}};
  Display_options options = small;
  options.color = "k1";
  const std::size_t row = (101 - note_margin - note_height) / 2;
  expect_near(middle(draw_surface(facing_square(), attributes, options).picture, row), shaded(undefined_color()));
  attributes.status.emplace(4, Point_status::PARABOLIC);
  expect_near(middle(draw_surface(facing_square(), attributes, options).picture, row),
              shaded(parabolic_region_color()));
  attributes.columns[0].values = {1, 1, 1, 1};
  EXPECT_TRUE(draw_surface(facing_square(), attributes, options).notes.empty()) << "a number that exists is shown";
}

TEST(Program_draw_surface, a_number_that_is_infinite_on_a_curve_does_not_pass_through_zero) {
  Display_options options = small;
  options.range = {{-5, 5}};
  const auto row_of = [&](double left, double right) {
    Vertex_attributes attributes;
    attributes.columns = {{"affine_gaussian_curvature", {left, right, right, left}},
                          {"gaussian_curvature", {1, -1, -1, 1}}};
    const auto drawn = draw_surface(facing_square(), attributes, options);
    EXPECT_TRUE(drawn.legend && drawn.notes.size() == 1);
    const auto first = drawn.picture.rgb.begin() + std::ptrdiff_t(3 * 101 * ((101 - legend_height - note_height) / 2));
    return std::vector<unsigned char>(first, first + 3 * 101);
  };
  const auto blue = row_of(-5, -5), red = row_of(5, 5), both = row_of(-5, 5);
  for (std::size_t i = 0; i < both.size(); ++i) EXPECT_EQ(both[i], i < both.size() / 2 ? blue[i] : red[i]) << i;
  const CGAL::IO::Color line = status_color(Point_status::PARABOLIC);
  expect_near({both[150], both[151], both[152]}, {line.red(), line.green(), line.blue()});
  EXPECT_NE(blue[3 * 45], red[3 * 45]);
}

TEST(Program_draw_surface, a_parabolic_vertex_has_a_line_and_no_share_of_the_triangles) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using enum Point_status;
  Vertex_attributes attributes;
  attributes.columns = {{"affine_gaussian_curvature", {nan, 5, nan, 5}}, {"gaussian_curvature", {0, 1, 0, -1}}};
  attributes.status = {PARABOLIC, REGULAR, PARABOLIC, REGULAR};
  const auto drawn = draw_surface(facing_square(), attributes, small);
  const std::size_t row = (101 - legend_height - note_height) / 2;
  std::size_t lines = 0, numbers = 0;
  for (std::size_t column = 0; column < 101; ++column) {
    const unsigned char* const first = &drawn.picture.rgb[3 * (row * drawn.picture.width + column)];
    const std::array<int, 3> color = {first[0], first[1], first[2]}, number = shaded(sequential_color(0.5));
    const CGAL::IO::Color line = status_color(PARABOLIC);
    const auto is_near = [&](const std::array<int, 3>& other) {
      return std::abs(color[0] - other[0]) + std::abs(color[1] - other[1]) + std::abs(color[2] - other[2]) < 12;
    };
    lines += is_near({line.red(), line.green(), line.blue()});
    numbers += is_near(number);
  }
  EXPECT_LE(lines, 3u);
  EXPECT_GT(lines, 0u);
  EXPECT_GT(numbers, 15u);
}

/// A square of 6 x 6 vertices that faces the eye, with an affine curvature of 5 where it exists.
struct Grid {
  static constexpr std::size_t side = 6;
  Mesh mesh;
  Vertex_attributes attributes;

  Grid() {
    const Mesh square = facing_square();
    const Vector right = square.points[1] - square.points[0], up = square.points[3] - square.points[0];
    for (std::size_t i = 0; i < side * side; ++i)
      mesh.points.push_back(square.points[0] + double(i % side) / (side - 1) * right +
                            double(i / side) / (side - 1) * up);
    for (std::uint32_t j = 0; j + 1 < side; ++j)
      for (std::uint32_t i = 0; i + 1 < side; ++i) {
        const std::uint32_t a = std::uint32_t(side) * j + i, b = a + 1, c = a + std::uint32_t(side), d = c + 1;
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({a, d, c});
      }
    attributes.columns = {{"affine_gaussian_curvature", std::vector<double>(side * side, 5)},
                          {"gaussian_curvature", std::vector<double>(side * side, -1)}};
    attributes.status.emplace(side * side, Point_status::REGULAR);
  }

  void make_parabolic(std::size_t vertex) {
    attributes.columns[0].values[vertex] = std::numeric_limits<double>::quiet_NaN();
    attributes.columns[1].values[vertex] = 1e-9;
    (*attributes.status)[vertex] = Point_status::PARABOLIC;
  }
};

TEST(Program_draw_surface, a_parabolic_vertex_amid_regular_ones_is_no_spot) {
  Grid grid;
  const auto without = draw_surface(grid.mesh, grid.attributes, small);
  grid.make_parabolic(14);
  const auto drawn = draw_surface(grid.mesh, grid.attributes, small);
  EXPECT_TRUE(drawn.notes.empty());
  EXPECT_EQ(drawn.picture.rgb, without.picture.rgb);
}

TEST(Program_draw_surface, a_parabolic_region_is_tinted_without_a_line_around_it) {
  Grid grid;
  for (std::size_t i = 0; i < Grid::side * Grid::side; ++i)
    if (i % Grid::side < 3) grid.make_parabolic(i);
  const auto drawn = draw_surface(grid.mesh, grid.attributes, small);
  ASSERT_EQ(drawn.notes.size(), 1u);
  EXPECT_EQ(drawn.notes[0].text, parabolic_region_text);
  EXPECT_EQ(drawn.notes[0].color, parabolic_region_color());
  const std::size_t row = (101 - legend_height - note_height) / 2;
  const auto at = [&](std::size_t column) {
    const unsigned char* const first = &drawn.picture.rgb[3 * (row * 101 + column)];
    return std::array<int, 3>{first[0], first[1], first[2]};
  };
  expect_near(at(47), shaded(parabolic_region_color()));
  expect_near(at(55), shaded(sequential_color(0.5)));
}

TEST(Program_draw_surface, a_picture_can_have_the_colors_of_another) {
  Vertex_attributes attributes;
  attributes.columns = {{"k1", {5, 5, 5, 5}}};
  Display_options options = small;
  const Equalization equalization({{1, 1}, {2, 1}, {5, 1}, {9, 1}, {-1, 1}});
  options.mappings = {{"k1", {{-9, 9, 1, true}, Color_scale::EQUALIZED, equalization}}};
  const auto drawn = draw_surface(facing_square(), attributes, options);
  EXPECT_EQ(drawn.legend->mapping, options.mappings.at("k1"));
  expect_near(middle(drawn.picture, (101 - legend_height) / 2),
              shaded(diverging_color(equalization(5) / equalization(9))));
  options.colors = Color_scale::LINEAR;
  expect_near(middle(draw_surface(facing_square(), attributes, options).picture, (101 - legend_height) / 2),
              shaded(diverging_color(5. / 9)));
}

std::ptrdiff_t green_pixels(const Picture& picture) {
  std::ptrdiff_t result = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    result += picture.rgb[i + 1] > 120 && picture.rgb[i] < 100 && picture.rgb[i + 2] < 110;
  return result;
}

TEST(Program_draw_surface, there_is_no_parabolic_line_beside_a_vertex_whose_curvature_is_not_known) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using enum Point_status;
  Vertex_attributes attributes;
  attributes.columns = {{"affine_gaussian_curvature", {5, 5, nan, 5}}, {"gaussian_curvature", {-1, -1, nan, -1}}};
  attributes.status = {REGULAR, REGULAR, OUTSIDE, REGULAR};
  const auto has_note = [](const Surface_picture& drawn) {
    return std::any_of(drawn.notes.begin(), drawn.notes.end(),
                       [](const auto& note) { return note.color == status_color(PARABOLIC); });
  };
  const auto saddle = draw_surface(facing_square(), attributes, small);
  EXPECT_EQ(green_pixels(saddle.picture), 0);
  EXPECT_FALSE(has_note(saddle));
  attributes.columns[1].values[2] = 1;
  const auto crossed = draw_surface(facing_square(), attributes, small);
  EXPECT_GT(green_pixels(crossed.picture), 0);
  EXPECT_TRUE(has_note(crossed));
  EXPECT_EQ(crossed.notes[0].text, "parabolic curve: no number there") << "it may be zero on both sides";
}

TEST(Program_draw_surface, notes_that_are_wider_than_the_picture_have_several_lines) {
  const std::vector<Surface_note> notes = {{std::nullopt, "one two three four five six"},
                                           {std::nullopt, "a-word-that-is-longer-than-a-line"}};
  const auto drawn = draw_surface(facing_square(), {}, small, notes);
  std::vector<std::string> lines; // from the bottom
  for (const auto& note : drawn.notes) lines.push_back(note.text);
  const std::vector<std::string> expected = {"r-than-a-line", "a-word-that-is-longe", "five six", "one two three four"};
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(std::equal(lines.begin(), lines.end(), expected.begin())) << lines[0];
}

TEST(Program_draw_surface, colors_that_show_no_number_have_notes_and_no_bar) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using enum Point_status;
  Vertex_attributes attributes;
  attributes.columns = {{"affine_gaussian_curvature", {nan, nan, nan, nan}}};
  attributes.status = {PARABOLIC, PARABOLIC, PARABOLIC, OUTSIDE};
  for (const char* name : {"affine_gaussian_curvature", "status"}) {
    Display_options options = small;
    options.color = name;
    const auto drawn = draw_surface(facing_square(), attributes, options);
    EXPECT_FALSE(drawn.legend) << name;
    ASSERT_EQ(drawn.notes.size(), 2u) << name;
    EXPECT_EQ(drawn.notes[0].text, std::string(name) == "status" ? "parabolic" : parabolic_region_text);
    EXPECT_EQ(drawn.notes[1].text, "outside");
    EXPECT_EQ(drawn.notes[1].color, status_color(OUTSIDE));
  }
}

TEST(Program_draw_surface, notes_leave_room_for_the_surface) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using enum Point_status;
  Vertex_attributes attributes;
  attributes.columns = {{"k1", {1, nan, nan, nan}}};
  attributes.status = {REGULAR, SINGULAR, OUTSIDE, UNCONVERGED};
  Display_options options = small;
  EXPECT_EQ(draw_surface(facing_square(), attributes, options).notes.size(), 1u);
  options.size = {101, 201};
  EXPECT_EQ(draw_surface(facing_square(), attributes, options).notes.size(), 3u);
}

TEST(Program_draw_surface, notes_that_are_given_stand_below_the_others_with_the_colors_of_their_numbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Vertex_attributes attributes;
  attributes.columns = {{"surface", {0, 0, 1, nan}}};
  Display_options options = small;
  options.size = {101, 301};
  options.range = {{0, 1}};
  const std::vector<Surface_note> notes = {{{}, "a map"}, {1, "the source"}};
  const auto drawn = draw_surface(facing_square(), attributes, options, notes);
  ASSERT_EQ(drawn.notes.size(), 3u);
  EXPECT_EQ(drawn.notes[0].text, "the source");
  EXPECT_EQ(drawn.notes[0].color, sequential_color(1));
  EXPECT_EQ(drawn.notes[1].text, "a map");
  EXPECT_FALSE(drawn.notes[1].color);
  EXPECT_EQ(drawn.notes[2].text, "no number");
}

TEST(Program_draw_surface, a_number_in_doubt_is_gray_and_as_light_as_its_color) {
  const auto middle_for = [](double error) {
    Vertex_attributes attributes;
    attributes.columns = {{"pick_invariant", {1, 1, 1, 1}}, {"pick_invariant_error", std::vector<double>(4, error)}};
    Display_options options = small;
    options.color = "pick_invariant";
    options.range = {{-2, 2}};
    const auto drawn = draw_surface(facing_square(), attributes, options);
    EXPECT_TRUE(drawn.legend && drawn.notes.size() == 1);
    return middle(drawn.picture, (101 - legend_height - note_height) / 2);
  };
  const auto [red, green, blue] = middle_for(10);
  EXPECT_LE(std::max({red, green, blue}) - std::min({red, green, blue}), 1);
  const auto trusted = middle_for(0);
  expect_near(trusted, shaded(diverging_color(0.5)));
  const auto light = [](int byte) { return std::pow(byte / 255., 2.2); };
  EXPECT_NEAR(light(red), 0.2126 * light(trusted[0]) + 0.7152 * light(trusted[1]) + 0.0722 * light(trusted[2]), 0.02);
}

TEST(Program_draw_surface, curves_and_arrows_are_dark_lines_on_it) {
  const Mesh mesh = facing_square();
  const auto is_dark = [](const Surface_picture& drawn) { return middle(drawn.picture, 50)[0] < 30; };
  EXPECT_FALSE(is_dark(draw_surface(mesh, {}, small)));
  const std::vector<Polyline_3<Kernel>> diagonal = {{{mesh.points[0], mesh.points[2]}, false}};
  EXPECT_TRUE(is_dark(draw_surface(mesh, {}, small, {}, diagonal)));

  const Vector along = mesh.points[2] - mesh.points[0];
  Vertex_attributes attributes;
  for (int n = 0; n < 3; ++n) attributes.columns.push_back({std::string("v_") + "xyz" [n], { along[n], 0, 0, 0 }});
  Display_options options = small;
  options.color = "plain";
  const auto without = draw_surface(mesh, attributes, options).picture.rgb;
  options.arrows = "v";
  EXPECT_NE(draw_surface(mesh, attributes, options).picture.rgb, without);
}

TEST(Program_draw_surface, a_vector_is_three_columns) {
  Vertex_attributes attributes;
  for (const char* name : {"nx", "ny", "nz", "a_x", "a_z"}) attributes.columns.push_back({name, {0}});
  EXPECT_TRUE(vector_columns(attributes, "normal"));
  EXPECT_FALSE(vector_columns(attributes, "a"));
}

} // namespace draw_surface_test
