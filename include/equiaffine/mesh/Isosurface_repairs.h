// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_ISOSURFACE_REPAIRS_H
#define EQUIAFFINE_MESH_ISOSURFACE_REPAIRS_H

#include <cstddef>

namespace equiaffine {

/// Counts of the repairs by which a surface remains a mesh of proper triangles.
struct Isosurface_repairs {
  std::size_t contracted_edges = 0;   ///< edges without length, contracted without change of topology
  std::size_t dropped_components = 0; ///< closed parts without area, where the function only touches zero
  std::size_t moved_vertices = 0;     ///< moved along their grid edge, by at most 1e-6 of it or a few roundings
  std::size_t zero_area_left = 0;     ///< triangles for which none of this helped
  std::size_t flips_undone = 0; ///< vertices put back to their linear position since projection turned a triangle over
  std::size_t vertices_at_poles = 0; ///< removed with their triangles, at poles, jumps and ends of the function
};

} // namespace equiaffine

#endif
