// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_FITTED_STRUCTURE_3_H
#define EQUIAFFINE_FIT_FITTED_STRUCTURE_3_H

#include <equiaffine/geometry/Local_structure_error_3.h>
#include <equiaffine/geometry/Regular_structure_3.h>

namespace equiaffine {

/// The structure that a fit around a data point gives it. A point that no fit belongs to has the status OUTSIDE.
///
/// The error is that of what the numbers stand for: those of the surface that was sampled, or at a scale those of the
/// polynomials of dense exact data, which noise and sampling alone make wrong. An infinite error means that nothing is
/// known.
template <class FT>
struct Fitted_structure_3 {
  Local_structure_3<FT> structure;   ///< the numbers
  Local_structure_error_3<FT> error; ///< their estimated errors
  Local_structure_error_3<FT> noise; ///< two standard deviations of what noise makes; at a scale, the error
  Local_structure_error_3<FT>
      detail; ///< at a scale: how much detail that the scale leaves out may make; else the error
  FT scale;   ///< the scale of the curvatures if they are those at a scale, else the radius of the ball that was fitted
  bool is_at_scale; ///< whether the curvatures are those at a scale, and not the surface's own
  FT deviation;     ///< the standard deviation of data around the point from a smooth surface, a length
};

} // namespace equiaffine

#endif
