// SPDX-License-Identifier: GPL-3.0-or-later
// How the samples of a volume become a function.
#ifndef EQUIAFFINE_VOLUME_VOLUME_OPTIONS_H
#define EQUIAFFINE_VOLUME_VOLUME_OPTIONS_H

#include <equiaffine/base/Input_error.h>

#include <cmath>
#include <optional>

namespace equiaffine {

/// The ways to compute the coefficients of a spline of degree n from samples. The orders below are those of the error
/// of the value for spacing h -> 0. The error of a derivative of order k has order min(2, n + 1 - k) for CONVOLUTION
/// and PAPER, and n + 1 - k for the other schemes.
enum class Spline_scheme {
  CONVOLUTION,         ///< coefficients = samples: smooths; order 2
  QUASI_INTERPOLATION, ///< a local filter of 2 floor(n / 2) + 1 samples per axis: order n + 1, no spreading of kinks
  INTERPOLATION,       ///< a recursive filter: the spline has the samples as values at the nodes; order n + 1
  /// Expansions by convolution at the nodes, interpolated linearly between them, as Andrade, Lewiner 2012, section 4,
  /// do on the edges of the grid. These are not the expansions of one function; use them only for comparison.
  PAPER
};

/// Options of a function through the samples of a volume. The defaults suit samples without much noise.
struct Volume_options {
  /// The scale in voxels by which smooth_volume() first smooths the samples: 0 for none; up to 1 it has no effect.
  /// Without a value, decide_smoothing() chooses it.
  std::optional<double> smoothing = 0;
  Spline_scheme spline_scheme = Spline_scheme::QUASI_INTERPOLATION; ///< how samples become coefficients
  int spline_degree = 7;                                            ///< 5, 7 or 9
  /// The isovalue of the level set near which noise is measured. Without a value, noise is measured everywhere.
  std::optional<double> level = {};

  /// \throw Input_error about the field for an invalid value
  void check() const {
    using internal::check_field;
    check_field(!smoothing || (std::isfinite(*smoothing) && *smoothing >= 0), "smoothing", smoothing.value_or(0),
                "is negative or not finite", "use 0 for no smoothing, about 1.5 to 8 voxels for noise, or no value");
    check_field(spline_degree == 5 || spline_degree == 7 || spline_degree == 9, "spline_degree", spline_degree,
                "is not 5, 7 or 9", "choose one of these");
    check_field(!level || std::isfinite(*level), "level", level.value_or(0), "is not finite", "give a number");
  }
};

} // namespace equiaffine

#endif
