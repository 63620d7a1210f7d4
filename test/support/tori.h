// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh for which the automatic scale is too large for some parts.
#ifndef EQUIAFFINE_TEST_SUPPORT_TORI_H
#define EQUIAFFINE_TEST_SUPPORT_TORI_H

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>

namespace equiaffine::test {

/// A wavy torus of 64 rows of 12 points, with a ring of radius 0.4 and a tube of radius 0.08.
inline std::array<double, 3> point_of_wavy_torus(int i, int j) {
  constexpr double ring = .4, tube = .08, wave = .25;
  const double u = 2 * std::numbers::pi * i / 64, v = 2 * std::numbers::pi * j / 12;
  const double radius = tube * (1 + wave * std::cos(2 * v + 7 * u) * std::cos(5 * u));
  const double from_axis = ring * (1 + wave * std::cos(3 * u)) + radius * std::cos(v);
  return {from_axis * std::cos(u), from_axis * std::sin(u), radius * std::sin(v) + wave * ring * std::sin(4 * u)};
}

/// A noisy torus of 60 rows of 30 points, with a ring of radius 1 and a tube of radius 0.5.
inline std::array<double, 3> point_of_noisy_torus(int i, int j, double noise) {
  const double u = 2 * std::numbers::pi * i / 60, v = 2 * std::numbers::pi * j / 30, radius = .5 + noise;
  return {(1 + radius * std::cos(v)) * std::cos(u), (1 + radius * std::cos(v)) * std::sin(u), radius * std::sin(v)};
}

/// An OFF file of a large noisy torus, which needs a large scale, and of four small wavy tori.
inline std::string tori() {
  std::ostringstream points, triangles;
  points.precision(17);
  int count = 0;
  const auto add = [&](int rows, int columns, const auto& point) {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const auto [x, y, z] = point(i, j);
        points << x << ' ' << y << ' ' << z << '\n';
        const auto corner = [&](int k, int l) { return count + (i + k) % rows * columns + (j + l) % columns; };
        triangles << "3 " << corner(0, 0) << ' ' << corner(1, 0) << ' ' << corner(1, 1) << '\n'
                  << "3 " << corner(0, 0) << ' ' << corner(1, 1) << ' ' << corner(0, 1) << '\n';
      }
    count += rows * columns;
  };
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, .03);
  add(60, 30, [&](int i, int j) { return point_of_noisy_torus(i, j, noise(random)); });
  for (const auto& center : {std::pair(2.5, 0.), {0., 2.5}, {-2.5, 0.}, {0., -2.5}})
    add(64, 12, [&](int i, int j) {
      const auto [a, b, c] = point_of_wavy_torus(i, j);
      return std::array{a + center.first, b + center.second, c};
    });
  return "OFF\n" + std::to_string(count) + ' ' + std::to_string(2 * count) + " 0\n" + points.str() + triangles.str();
}

} // namespace equiaffine::test

#endif
