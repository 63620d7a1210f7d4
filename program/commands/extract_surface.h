// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes on a source: the surface, the reason if it is empty, and the removal of fragments.
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

/// Marching Cubes on the grid of a source, in parallel and with vector instructions.
Isosurface_3<Kernel> extract_surface(const Source_function& function, double isovalue, const Source_options& options,
                                     Vertex_position vertices);

/// A search that found no surface.
struct Failed_search {
  std::string place;         ///< "box" or "ball"
  std::string refinement;    ///< what may find a surface, such as "a smaller radius"; empty if nothing can
  bool met_poles;            ///< whether f changes its sign only at poles or jumps
  bool is_certified = false; ///< whether it is proved that there is no surface
};

/// Whether f - isovalue changes its sign between the nodes of a grid only at poles and jumps.
bool changes_sign_at_poles_only(const Source_function& function, double isovalue);

/// Throws an error with the reason why there is no surface, and the options to change.
[[noreturn]] void fail_without_surface(const Source_function& function, const Source_options& source, double isovalue,
                                       const Failed_search& search);

/// Removes small fragments from the zero set of a fit, sampled on the grid of the options.
void remove_small_fragments(Isosurface_3<Kernel>& surface, const Fit_traits& fit, const Source_options& options);

/// Keeps the `count` connected components of largest area, and the `values` (one per vertex, or none) of their
/// vertices. Returns the number of removed components.
std::size_t keep_largest(Isosurface_3<Kernel>& surface, std::size_t count, std::vector<double>& values);

} // namespace equiaffine

#endif
