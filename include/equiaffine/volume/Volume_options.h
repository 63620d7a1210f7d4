// SPDX-License-Identifier: GPL-3.0-or-later
// How the samples of a volume become a function.
#ifndef EQUIAFFINE_VOLUME_VOLUME_OPTIONS_H
#define EQUIAFFINE_VOLUME_VOLUME_OPTIONS_H

#include <equiaffine/base/Input_error.h>

#include <cmath>
#include <optional>

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

/// Options of a function through the samples of a volume. The defaults are good for samples without much noise.
struct Volume_options {
  /// The scale by which `smooth_volume` smooths the samples first, in voxels: 0 for none; up to 1 it has no effect.
  /// Without a value decide_smoothing() finds it.
  std::optional<double> smoothing = 0;
  Spline_scheme spline_scheme = Spline_scheme::QUASI_INTERPOLATION; ///< how samples become coefficients
  int spline_degree = 7;                                            ///< 5, 7 or 9
  /// The value on the level set beside which noise is measured. Without a value it is measured everywhere.
  std::optional<double> level = {};

  /// \throw Input_error for a value that makes no sense, about the field
  void check() const {
    using internal::check_field;
    check_field(!smoothing || (std::isfinite(*smoothing) && *smoothing >= 0), "smoothing", smoothing.value_or(0),
                "is not a number of voxels", "use 0 for none, some 1.5 to 8 for noise, or no value");
    check_field(spline_degree == 5 || spline_degree == 7 || spline_degree == 9, "spline_degree", spline_degree,
                "is not 5, 7 or 9", "choose one of these");
    check_field(!level || std::isfinite(*level), "level", level.value_or(0), "is not finite", "give a number");
  }
};

} // namespace equiaffine

#endif
