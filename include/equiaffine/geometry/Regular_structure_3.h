// SPDX-License-Identifier: GPL-3.0-or-later
// Local_structure_3, the Euclidean and the affine structure at a point with its status, and the same for packs of
// points.
#ifndef EQUIAFFINE_GEOMETRY_REGULAR_STRUCTURE_3_H
#define EQUIAFFINE_GEOMETRY_REGULAR_STRUCTURE_3_H

#include <equiaffine/geometry/Affine_structure_3.h>
#include <equiaffine/geometry/Euclidean_structure_3.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/number/select.h>

namespace equiaffine {

/// Everything that is known at a point of a level set. A number that does not exist is NaN: all of them when the status
/// is SINGULAR or OUTSIDE, the affine ones when it is PARABOLIC. A point is also SINGULAR if FT cannot hold a number in
/// the units at hand, although it could in others.
template <class FT>
struct Local_structure_3 {
  Point_status status;                 ///< says which numbers exist
  Euclidean_structure_3<FT> euclidean; ///< the Euclidean structure
  Affine_structure_3<FT> affine;       ///< the affine structure
};

/// The local structure at a regular point, or at the regular points of a pack.
template <class FT>
struct Regular_structure_3 {
  Local_structure_3<FT> structure; ///< means nothing at a point that is not regular
  Mask_of<FT> is_regular;          ///< every number exists
  Mask_of<FT> is_steep;            ///< the gradient does not count as zero
  Mask_of<FT> is_out_of_range;     ///< Monge_chart_3::d() is not zero, but its powers underflow
};

} // namespace equiaffine

#endif
