// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_FRAME_H
#define EQUIAFFINE_GEOMETRY_AFFINE_FRAME_H

#include <equiaffine/geometry/Affine_frame_3.h>
#include <equiaffine/geometry/Affine_structure_3.h>
#include <equiaffine/geometry/internal/affine_frame_steps.h>

namespace equiaffine {

/// Computes the affine frame at a regular point, or at the points of a pack. It depends on the surface alone, not on
/// the side that the gradient points to. Where the structure has a symmetry, as on quadrics, the frame is not
/// determined: its quality is 0, or of the size of rounding, and e1 and e2 mean nothing, or are NaN. Nothing branches
/// on values. Takes about 200 floating-point operations.
template <class FT>
Affine_frame_3<FT> affine_frame(const Affine_structure_3<FT>& structure) {
  return internal::affine_frame_of(structure);
}

} // namespace equiaffine

#endif
