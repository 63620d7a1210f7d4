// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_RANDOM_GRID_H
#define EQUIAFFINE_TEST_SUPPORT_RANDOM_GRID_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

/// The values at the nodes of a grid, with i fastest.
struct Grid {
  std::array<std::size_t, 3> size;
  std::vector<double> values;

  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (k * size[1] + j) * size[0] + i; }
};

/// Difficult grids for Marching Cubes:
/// closed  3 to 7 nodes along each axis, inside random, negative on the boundary: a closed surface
/// open    the same, random everywhere: a surface with boundary
/// check   like closed, but with alternating signs inside: every inner cell has six ambiguous faces
/// cell    one random cell
/// case13  one cell with alternating signs
/// ties    like closed, but with few different values inside, zero among them
/// holes   few different values everywhere, zero among them, and one node in eight without a value
inline Grid random_grid(const std::string& kind, std::uint64_t seed) {
  std::seed_seq sequence{std::uint32_t(seed), std::uint32_t(seed >> 32), std::uint32_t(kind[0]),
                         std::uint32_t(kind[1])};
  std::mt19937_64 random(sequence);
  std::uniform_real_distribution<double> magnitude(1e-3, 1);
  const bool is_cell = kind == "cell" || kind == "case13";
  Grid grid{{2, 2, 2}, {}};
  if (!is_cell)
    for (std::size_t& n : grid.size) n = 3 + random() % 5;
  for (std::size_t k = 0; k < grid.size[2]; ++k)
    for (std::size_t j = 0; j < grid.size[1]; ++j)
      for (std::size_t i = 0; i < grid.size[0]; ++i) {
        const bool is_boundary =
            i == 0 || j == 0 || k == 0 || i + 1 == grid.size[0] || j + 1 == grid.size[1] || k + 1 == grid.size[2];
        const bool is_odd = (i + j + k) % 2 == 1, coin = random() % 2 == 1;
        const double x = magnitude(random);
        if (is_boundary && (kind == "closed" || kind == "check" || kind == "ties")) grid.values.push_back(-x);
        else if (kind == "holes" && random() % 8 == 0) grid.values.push_back(std::numeric_limits<double>::quiet_NaN());
        else if (kind == "ties" || kind == "holes") grid.values.push_back(0.5 * double(random() % 5) - 1);
        else if (kind == "check" || kind == "case13") grid.values.push_back(is_odd ? -x : x);
        else grid.values.push_back(coin ? -x : x);
      }
  return grid;
}

#endif
