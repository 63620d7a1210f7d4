// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_VERTEX_POSITION_H
#define EQUIAFFINE_MARCHING_CUBES_VERTEX_POSITION_H

namespace equiaffine {

/// The places at which Marching Cubes can put its vertices.
enum class Vertex_position {
  PROJECTED, ///< on the surface, to the last digits
  LINEAR     ///< where linear interpolation of the values at the ends of the grid edge vanishes, as the paper does
};

} // namespace equiaffine

#endif
