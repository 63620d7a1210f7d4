// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_POINTS_ON_SURFACE_H
#define EQUIAFFINE_TEST_SUPPORT_POINTS_ON_SURFACE_H

#include "support/formulas.h"
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

/// All vertices, or a random subset, of the surface on a lattice of n nodes in the longest direction.
template <class Traits>
std::vector<typename Traits::Point_3> points_on_surface(const Traits& traits, std::size_t n, std::size_t most = 5000,
                                                        unsigned seed = 1) {
  auto points = [&] {
    if constexpr (std::is_constructible_v<equiaffine::vectorized::Formula, Traits>)
      return equiaffine::test::surface_of(traits, {.resolution = n}).points;
    else return equiaffine::marching_cubes(traits, {.resolution = n}).points;
  }();
  std::minstd_rand random(seed);
  for (std::size_t k = 0; k < std::min(most, points.size()); ++k)
    std::swap(points[k], points[k + random() % (points.size() - k)]);
  points.resize(std::min(most, points.size()));
  return points;
}

#endif
