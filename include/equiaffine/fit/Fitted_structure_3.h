// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_FITTED_STRUCTURE_3_H
#define EQUIAFFINE_FIT_FITTED_STRUCTURE_3_H

#include <equiaffine/geometry/Affine_curvature_error.h>
#include <equiaffine/geometry/Local_structure_3.h>

namespace equiaffine {

/// The structure that a fit around a data point gives it. A point that no fit belongs to has the status OUTSIDE.
template <class FT>
struct Fitted_structure_3 {
  Local_structure_3<FT> structure;
  Affine_curvature_error<FT> error; ///< the whole estimate: of what the fits disagree on, and of what noise makes
  Affine_curvature_error<FT> noise; ///< two standard deviations of what noise makes at the scale of the fit
  FT scale;                         ///< the radius of the ball whose points were fitted
  FT deviation;                     ///< the standard deviation of data around the point from a smooth surface, a length
};

} // namespace equiaffine

#endif
