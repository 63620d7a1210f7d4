// SPDX-License-Identifier: GPL-3.0-or-later
// How meshes slide over themselves: as the smooth surfaces do that their facets stand for, and solids do not.
#include "support/registration_cases.h"
#include <equiaffine/registration/slippage_of_mesh.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace slippage_of_mesh_test {

using namespace equiaffine;
using namespace registration_cases;
using std::cos, std::sin;

struct Soup {
  std::vector<Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

using Parametrization = std::function<Point_3(double, double)>;

/// Triangles of the unit square, n by n cells with inner vertices moved by up to a part of a cell, on a surface.
Soup patch(std::size_t n, double jitter, const Parametrization& surface) {
  std::mt19937 random(7);
  Soup soup;
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= n; ++j) {
      const auto moved = [&](std::size_t k) {
        const double change = jitter * (double(random()) / double(std::mt19937::max()) - 0.5) * 2;
        return (double(k) + (k > 0 && k < n ? change : 0)) / double(n);
      };
      const double u = moved(i), v = moved(j);
      soup.points.push_back(surface(u, v));
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t a = i * (n + 1) + j, b = a + n + 1;
      soup.triangles.push_back({a, b, b + 1});
      soup.triangles.push_back({a, b + 1, a + 1});
    }
  return soup;
}

struct Sliding_surface {
  std::string name;
  std::size_t rigid, affine; ///< the dimensions of the groups
  Parametrization surface;
};

const std::array<Sliding_surface, 6> surfaces = {{
    {"cylinder", 2, 5, [](double u, double v) { return Point_3(cos(4 * u), sin(4 * u), 2 * v); }},
    {"cone", 1, 4, [](double u, double v) { return Point_3((1 + v) * cos(4 * u), (1 + v) * sin(4 * u), 4 * v); }},
    {"extrusion", 1, 4, [](double u, double v) { return Point_3(2 * u, .3 * sin(5 * u) + .2 * u * u * u, 4 * v); }},
    {"helicoid", 1, 2,
     [](double u, double v) { return Point_3((.3 + v) * cos(3 * u), (.3 + v) * sin(3 * u), 1.5 * u); }},
    {"cap of a sphere", 3, 3,
     [](double u, double v) { return Point_3(sin(u + .4) * cos(2 * v), sin(u + .4) * sin(2 * v), cos(u + .4)); }},
    {"waves", 0, 0, [](double u, double v) { return Point_3(u, v, .3 * sin(3 * u + 1) * cos(2 * v)); }},
}};

TEST(Slippage_of_mesh, smooth_surfaces_slide_in_as_many_ways_as_their_groups_have_dimensions) {
  for (const auto& [name, rigid, affine, surface] : surfaces)
    for (const double jitter : {0., .3}) {
      const Soup soup = patch(50, jitter, surface);
      for (const Map_kind kind : {Map_kind::RIGID, Map_kind::AFFINE}) {
        const Affine_slippage_3 slippage = slippage_of_mesh(soup.points, soup.triangles, kind);
        EXPECT_EQ(slippage.dimension(), kind == Map_kind::RIGID ? rigid : affine) << name << " " << jitter;
        EXPECT_LT(slippage.rms, 1e-3) << name;
      }
    }
}

TEST(Slippage_of_mesh, the_generators_are_tangent_to_the_surface) {
  const Soup soup = patch(70, .3, surfaces[3].surface); // a helicoid about the z-axis, which rises by 1/2 per radian
  const Affine_slippage_3 slippage = slippage_of_mesh(soup.points, soup.triangles, Map_kind::RIGID);
  ASSERT_EQ(slippage.dimension(), 1u);
  const auto& [matrix, translation] = slippage.generators[0];
  const double turn = matrix(1, 0);
  EXPECT_NEAR(matrix(0, 1), -turn, 1e-12 * std::abs(turn));
  EXPECT_NEAR(matrix(2, 0), 0, 2e-3 * std::abs(turn));
  EXPECT_NEAR(matrix(2, 1), 0, 2e-3 * std::abs(turn));
  EXPECT_NEAR(translation[0], 0, 2e-3 * std::abs(turn));
  EXPECT_NEAR(translation[1], 0, 2e-3 * std::abs(turn));
  EXPECT_NEAR(translation[2], turn / 2, 2e-3 * std::abs(turn));
}

TEST(Slippage_of_mesh, facets_of_solids_are_faces) {
  for (const int sides : {8, 17, 40, 61, 120})
    for (const double radius : {1., .6}) {
      Soup soup;
      for (const double z : {0., 1.5})
        for (int i = 0; i < sides; ++i) {
          const double r = z > 0 ? radius : 1, angle = 2 * std::numbers::pi * i / sides;
          soup.points.emplace_back(r * cos(angle), r * sin(angle), z);
        }
      const auto n = std::size_t(sides);
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n;
        soup.triangles.push_back({i, next, n + next});
        soup.triangles.push_back({i, n + next, n + i});
        if (i > 1) soup.triangles.push_back({0, i, i - 1});
        if (i > 1) soup.triangles.push_back({n, n + i - 1, n + i});
      }
      for (const Map_kind kind : {Map_kind::RIGID, Map_kind::SIMILARITY, Map_kind::AFFINE})
        EXPECT_EQ(slippage_of_mesh(soup.points, soup.triangles, kind).dimension(), 0u) << sides << " " << radius;
    }
}

TEST(Slippage_of_mesh, there_is_none_without_an_area) {
  const std::vector<Point_3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<std::array<std::size_t, 3>> triangles = {{0, 1, 2}};
  EXPECT_EQ(slippage_of_mesh(points, triangles, Map_kind::RIGID).dimension(), 0u);
}

} // namespace slippage_of_mesh_test
