// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_SURFACE_TO_REGISTER_H
#define EQUIAFFINE_PROGRAM_COMMANDS_SURFACE_TO_REGISTER_H

#include "request/options.h"
#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <optional>

namespace equiaffine {

/// A level set with points on it.
struct Surface_to_register {
  Any_function_3 function;                        ///< whose zero set is the level set
  std::optional<Any_function_3> unsmoothed = {};  ///< if the function is a spline through smoothed samples
  Indexed_triangle_mesh_3<Kernel> mesh = {};      ///< the data of a fit, else what Marching Cubes makes
  Indexed_triangle_mesh_3<Kernel> extracted = {}; ///< what Marching Cubes makes of a fit to points without faces
  std::optional<double> scale = {};               ///< of the curvatures of a fit, unless they are the surface's own

  const Any_function_3& refined() const { return unsmoothed ? *unsmoothed : function; }
  const Indexed_triangle_mesh_3<Kernel>& shown() const { return mesh.triangles.empty() ? extracted : mesh; }
};

/// Whether the triangles of a file are the surface, and no level set of a function.
bool is_mesh_itself(const Surface_options& options);

/// Makes the source and its surface. `is_shown` says whether faces are needed. Throws `Input_error`, also if there is no
/// surface.
Surface_to_register make_surface_to_register(const Surface_options& options, bool is_shown, Progress& progress);

} // namespace equiaffine

#endif
