// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_ISOSURFACE_3_H
#define EQUIAFFINE_MESH_ISOSURFACE_3_H

#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/Isosurface_repairs.h>

#include <cstddef>
#include <vector>

namespace equiaffine {

/// The result of sampling the zero set of a function: a mesh and facts about it.
template <class Kernel>
struct Isosurface_3 : Indexed_triangle_mesh_3<Kernel> {
  /// One per point: REGULAR, or UNCONVERGED if the point could not be put on the surface and stays at its linear
  /// position.
  std::vector<Point_status> vertex_status;
  Isosurface_repairs repairs;           ///< what was repaired
  std::size_t function_evaluations = 0; ///< of f, with or without derivatives
  double sampling_seconds = 0,          ///< the time that it took to evaluate the function and to make the mesh
      projection_seconds = 0;           ///< the time that it took to put vertices on the surface
};

} // namespace equiaffine

#endif
