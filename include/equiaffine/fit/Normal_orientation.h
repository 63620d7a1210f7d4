// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_NORMAL_ORIENTATION_H
#define EQUIAFFINE_FIT_NORMAL_ORIENTATION_H

namespace equiaffine {

/// Says whether the normals that come with points agree about the side of the surface.
enum class Normal_orientation {
  ORIENTED,  ///< all point to the same side of the surface
  UNORIENTED ///< each is right up to its sign
};

} // namespace equiaffine

#endif
