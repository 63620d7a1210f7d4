// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SPLINE_PARAMETERS_H
#define EQUIAFFINE_VOLUME_SPLINE_PARAMETERS_H

#include <equiaffine/volume/Spline_scheme.h>

namespace equiaffine {

/// Parameters that say how samples become a spline. The defaults are good for samples without much noise. Name only the
/// members that differ from them: `{.degree = 5}`.
struct Spline_parameters {
  int degree = 7;                                            ///< 5, 7 or 9
  Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION; ///< how samples become coefficients
  double smoothing = 0; ///< the scale by which `smooth_volume` smooths the samples first, in steps; 0 for none
};

} // namespace equiaffine

#endif
