// SPDX-License-Identifier: GPL-3.0-or-later
// On any small array Marching Cubes gives a manifold with the topology of the trilinear interpolant.
#include "support/fuzz_target.h"
#include "support/random_grid.h"
#include "support/trilinear_topology.h"
#include <equiaffine/marching_cubes/marching_cubes_of_array.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace marching_cubes_fuzz_test {

using namespace equiaffine;
using test::expect;

/// A grid of 2 to 5 nodes along each axis, as the first three bytes say, and of whole numbers, one per byte. The byte
/// -128 is a node without a value; nodes for which there is no byte have the value -1.
Grid grid_of(std::string_view input) {
  const auto byte = [&](std::size_t n) { return n < input.size() ? int(static_cast<signed char>(input[n])) : -1; };
  Grid grid{{2, 2, 2}, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) grid.size[axis] += std::size_t(byte(axis) & 3);
  for (std::size_t n = 0; n < grid.size[0] * grid.size[1] * grid.size[2]; ++n) {
    const int value = byte(3 + n);
    grid.values.push_back(value == -128 ? std::numeric_limits<double>::quiet_NaN() : value);
  }
  return grid;
}

/// The grid with other values of the same signs, where no two are equal and no saddle is zero.
Grid with_unequal_values(Grid grid) {
  for (std::size_t n = 0; n < grid.values.size(); ++n)
    grid.values[n] += 0.1 + 0.8 * std::fmod(double(n) * std::numbers::phi, 1.0);
  return grid;
}

/// The grid with positive values for zeros, so small that no saddle gets another sign.
Grid without_zeros(Grid grid) {
  std::replace(grid.values.begin(), grid.values.end(), 0.0, 1e-7);
  return grid;
}

template <class FT>
Array_isosurface_3<FT> surface_of(const Grid& grid) {
  const std::vector<FT> values(grid.values.begin(), grid.values.end());
  return marching_cubes_of_array(std::span<const FT>(values), grid.size, FT(0));
}

template <class FT>
Mesh_topology topology_of(const Array_isosurface_3<FT>& surface) {
  return mesh_topology(surface.triangles, surface.points.size());
}

template <class FT>
void check_repairs(const Grid& grid, const Mesh_topology& expected) {
  const auto surface = surface_of<FT>(grid);
  const Mesh_topology topology = topology_of(surface);
  expect(topology.is_manifold, "the surface is a manifold");
  expect(surface.repairs.zero_area_left == 0, "no triangle without area is left");
  const std::size_t dropped = surface.repairs.dropped_components; // spheres without area
  expect(topology.components + dropped == expected.components, "repairs keep the components");
  expect(topology.euler_characteristic + 2 * long(dropped) == expected.euler_characteristic,
         "repairs keep the Euler characteristic");
}

void check_topology(const Grid& grid, std::size_t axis) {
  if (std::any_of(grid.values.begin(), grid.values.end(), [](double x) { return std::isnan(x); })) return;
  const auto expected = topology_of_trilinear_surface(grid, axis);
  if (!expected) return;
  const Mesh_topology topology = topology_of(surface_of<double>(grid));
  expect(long(topology.components) == expected->components, "the components are those of the interpolant");
  expect(topology.euler_characteristic == expected->euler_characteristic,
         "the Euler characteristic is that of the interpolant");
}

EQUIAFFINE_FUZZ_TARGET(marching_cubes) {
  const Grid grid = grid_of(input);
  const Mesh_topology topology = topology_of(surface_of<double>(without_zeros(grid)));
  check_repairs<double>(grid, topology);
  check_repairs<float>(grid, topology);
  check_topology(with_unequal_values(grid), std::size_t(input.size() % 3));
}

} // namespace marching_cubes_fuzz_test
