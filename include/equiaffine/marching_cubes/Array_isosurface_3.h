// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_ARRAY_ISOSURFACE_3_H
#define EQUIAFFINE_MARCHING_CUBES_ARRAY_ISOSURFACE_3_H

#include <equiaffine/marching_cubes/internal/Output_allocator.h>
#include <equiaffine/mesh/Isosurface_repairs.h>

#include <array>
#include <cstdint>
#include <vector>

namespace equiaffine {

/// A triangle mesh as plain arrays. Triangles are counterclockwise seen from the side of the greater values.
template <class FT>
struct Array_isosurface_3 {
  std::vector<std::array<FT, 3>, internal::Output_allocator<std::array<FT, 3>>> points; ///< the points
  /// Three indices of points each.
  std::vector<std::array<std::uint32_t, 3>, internal::Output_allocator<std::array<std::uint32_t, 3>>> triangles;
  Isosurface_repairs repairs; ///< what was repaired
};

} // namespace equiaffine

#endif
