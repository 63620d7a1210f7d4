// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes on a source: the surface, the reason why there is none, and what is left out of it.
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_EXTRACT_SURFACE_H
#define EQUIAFFINE_PROGRAM_COMMANDS_EXTRACT_SURFACE_H

#include "request/source_options.h"
#include "source/source_function.h"
#include "system/kernel.h"
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <string>
#include <vector>

namespace equiaffine {

/// Marching Cubes on the grid of a source, with all threads and vector instructions.
Isosurface_3<Kernel> extract_surface(const Source_function& function, double isovalue, const Source_options& options,
                                     Vertex_position vertices);

/// What is known of a search for a surface that found none.
struct Vain_search {
  std::string place;         ///< where it was looked for, "box" or "ball"
  std::string refinement;    ///< what may find more of the surface, such as "a smaller radius"; empty if nothing can
  bool met_poles;            ///< whether f changes its sign at poles or jumps only
  bool is_certified = false; ///< whether it is proved that there is none
};

/// Whether f - isovalue changes its sign between the nodes of a grid at poles and jumps, and nowhere else.
bool changes_sign_at_poles_only(const Source_function& function, double isovalue);

/// Throws the error that says why there is no surface, and what to choose instead.
[[noreturn]] void fail_without_surface(const Source_function& function, const Source_options& source, double isovalue,
                                       const Vain_search& search);

/// Removes small fragments from the zero set of a fit, which was sampled on the grid of the options.
void remove_small_fragments(Isosurface_3<Kernel>& surface, const Fit_traits& fit, const Source_options& options);

/// Keeps the connected components with the greatest areas, and `values`, one per vertex or none, of their vertices.
/// Returns how many components are left out.
std::size_t keep_largest(Isosurface_3<Kernel>& surface, std::size_t count, std::vector<double>& values);

} // namespace equiaffine

#endif
