// SPDX-License-Identifier: GPL-3.0-or-later
// How samples become a spline.
#ifndef EQUIAFFINE_VOLUME_SPLINE_PARAMETERS_H
#define EQUIAFFINE_VOLUME_SPLINE_PARAMETERS_H

namespace equiaffine {

/// The ways to compute the coefficients of a spline of degree n from samples. The orders below are those of the error
/// of the value for spacing h -> 0. The error of a derivative of order k has order min(2, n + 1 - k) by the paper's
/// schemes and n + 1 - k by the others.
enum class Spline_scheme {
  CONVOLUTION,         ///< coefficients = samples: smooths; order 2
  QUASI_INTERPOLATION, ///< a local filter of 2 floor(n / 2) + 1 samples per axis: order n + 1, no spreading of kinks
  INTERPOLATION,       ///< a recursive filter, so that the spline has the samples as values at the nodes: order n + 1
  /// Expansions by convolution at the nodes, interpolated linearly between them, as Andrade, Lewiner 2012, section 4,
  /// do on the edges of the grid. These are not the expansions of one function, and are there only to compare with.
  PAPER
};

/// Parameters that say how samples become a spline. The defaults are good for samples without much noise. Name only the
/// members that differ from them: `{.degree = 5}`.
struct Spline_parameters {
  int degree = 7;                                            ///< 5, 7 or 9
  Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION; ///< how samples become coefficients
  double smoothing = 0; ///< the scale by which `smooth_volume` smooths the samples first, in steps; 0 for none
};

} // namespace equiaffine

#endif
