// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SOURCE_H
#define EQUIAFFINE_SRC_SOURCE_H

#include "kernel.h"
#include "options.h"
#include "progress.h"
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/Expression_3.h>
#include <equiaffine/Sampled_function_traits_3.h>
#include <equiaffine/Transformed_function_traits_3.h>

#include <cstddef>
#include <string>
#include <variant>

namespace equiaffine {

using Formula_traits = Analytic_function_traits_3<Kernel, Expression_3>;
using Spline_traits = Sampled_function_traits_3<Kernel>;

/// SOURCE as a function: four models of ImplicitFunctionTraits_3.
using Source_function = std::variant<Formula_traits, Spline_traits, Transformed_function_traits_3<Formula_traits>,
                                     Transformed_function_traits_3<Spline_traits>>;

struct Source {
  Source_function function;
  std::size_t function_evaluations = 0; ///< that it took so far
};

/// Makes the function, which may mean to read a volume, to measure distances, and to fit a spline. Throws
/// `Input_error`.
Source make_source(const Source_options& options, Progress& progress);

/// The samples of a source that is not a volume.
Volume_3<Kernel> sample_source(const Source_options& options, Progress& progress);

/// "the formula x^2 + y^2 = 1", "the volume 'skull.nrrd'", "the distance to 'bunny.off'"
std::string describe(const Source_options& options);

} // namespace equiaffine

#endif
