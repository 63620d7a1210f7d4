// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_OF_ARRAY_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_OF_ARRAY_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/marching_cubes/Array_isosurface_3.h>
#include <equiaffine/marching_cubes/internal/array_isosurface.h>

#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <span>

namespace equiaffine {

/// Runs Marching Cubes on a plain array: meshes the surface where `values`, float or double with i fastest, pass
/// `isovalue`. Node (i, j, k) lies at origin + (i, j, k) * spacing. The topology, and the meaning of NaN and of values
/// equal to the isovalue, are those of `marching_cubes`. Vertices lie where linear interpolation along edges puts them.
/// \throw std::invalid_argument unless there are as many values as nodes, at least two nodes along each axis, and the
/// spacing is positive and finite
template <class ConcurrencyTag = CGAL::Sequential_tag, class FT>
Array_isosurface_3<FT> marching_cubes_of_array(std::span<const FT> values, const std::array<std::size_t, 3>& size,
                                               FT isovalue, const std::array<FT, 3>& origin = {0, 0, 0},
                                               const std::array<FT, 3>& spacing = {1, 1, 1}) {
  const auto [nx, ny, nz] = size;
  check_argument(nx >= 2 && ny >= 2 && nz >= 2, "an array has less than two nodes along an axis: choose a larger size");
  check_argument(values.size() / nx / ny == nz && values.size() == nx * ny * nz,
                 "an array has not as many values as its size has nodes: choose the size that it has");
  for (const FT& step : spacing)
    check_argument(step > 0 && step - step == 0,
                   "the spacing of an array is not a positive length: choose one along each axis");
  const internal::Array_grid<FT> grid(values, size, isovalue, origin, spacing);
  return internal::isosurface_of_array<ConcurrencyTag>(grid, internal::Case_table::instance());
}

} // namespace equiaffine

#endif
