// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/marching_cubes/marching_cubes_of_array.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace isosurface_extraction_test {

using namespace equiaffine;
using Size = std::array<std::size_t, 3>;
using Triangle = std::array<std::array<double, 3>, 3>;

std::vector<double> random_values(const Size& size, bool has_undefined, std::mt19937& random) {
  std::vector<double> values(size[0] * size[1] * size[2]);
  for (double& x : values) x = double(random()) / 2147483648.0 - 1;
  if (has_undefined)
    for (std::size_t n = 0; n < values.size() / 8; ++n)
      values[random() % values.size()] = std::numeric_limits<double>::quiet_NaN();
  return values;
}

template <class Surface>
void append_triangles(const Surface& surface, std::vector<Triangle>& triangles) {
  for (const auto& [a, b, c] : surface.triangles)
    triangles.push_back({surface.points[a], surface.points[b], surface.points[c]});
}

/// The triangles of all cells, where each cell is a grid of its own.
std::vector<Triangle> triangles_of_cells(const std::vector<double>& values, const Size& size) {
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k + 1 < size[2]; ++k)
    for (std::size_t j = 0; j + 1 < size[1]; ++j)
      for (std::size_t i = 0; i + 1 < size[0]; ++i) {
        std::array<double, 8> cell;
        for (std::size_t c = 0; c < 8; ++c)
          cell[c] = values[i + (c & 1) + size[0] * (j + (c >> 1 & 1) + size[1] * (k + (c >> 2)))];
        append_triangles(
            marching_cubes_of_array(std::span<const double>(cell), {2, 2, 2}, 0.0, {double(i), double(j), double(k)}),
            triangles);
      }
  return triangles;
}

// Rows are shorter, as long and longer than the 64 nodes of a word of signs, and than the 4096 nodes for which a word
// says which words have signs.
TEST(Isosurface_extraction, a_grid_has_the_triangles_of_its_cells) {
  std::mt19937 random(1);
  for (const Size& size : {Size{2, 2, 2}, Size{63, 3, 4}, Size{64, 4, 3}, Size{65, 3, 3}, Size{66, 3, 3},
                           Size{129, 3, 3}, Size{3, 70, 66}, Size{4098, 2, 2}, Size{8200, 2, 3}})
    for (const bool has_undefined : {false, true}) {
      const auto values = random_values(size, has_undefined, random);
      const auto surface = marching_cubes_of_array(std::span<const double>(values), size, 0.0);
      std::vector<Triangle> triangles, expected = triangles_of_cells(values, size);
      append_triangles(surface, triangles);
      std::sort(triangles.begin(), triangles.end());
      std::sort(expected.begin(), expected.end());
      ASSERT_TRUE(triangles == expected) << size[0] << " " << size[1] << " " << size[2] << " " << has_undefined;
    }
}

TEST(Isosurface_extraction, threads_change_nothing) {
  std::mt19937 random(2);
  for (const bool has_undefined : {false, true}) {
    const Size size = {70, 40, 50};
    auto values = random_values(size, has_undefined, random);
    for (std::size_t n = 0; n < 1000; ++n) values[random() % values.size()] = 0; // makes triangles without area
    const auto one = marching_cubes_of_array<CGAL::Sequential_tag>(std::span<const double>(values), size, 0.0);
    const auto many =
        marching_cubes_of_array<CGAL::Parallel_if_available_tag>(std::span<const double>(values), size, 0.0);
    EXPECT_TRUE(one.points == many.points);
    EXPECT_TRUE(one.triangles == many.triangles);
    EXPECT_GT(one.repairs.contracted_edges, 100u);
  }
}

} // namespace isosurface_extraction_test
