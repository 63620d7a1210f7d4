// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SPLINE_SCHEME_H
#define EQUIAFFINE_VOLUME_SPLINE_SCHEME_H

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

} // namespace equiaffine

#endif
