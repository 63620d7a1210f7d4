// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_SOURCE_FUNCTION_H
#define EQUIAFFINE_PROGRAM_SOURCE_SOURCE_FUNCTION_H

#include "source/Fit_traits.h"
#include "system/kernel.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>

#include <type_traits>
#include <variant>

namespace equiaffine {

using Formula_traits = Analytic_function_traits_3<Kernel, Expression_3>;
using Spline_traits = Sampled_function_traits_3<Kernel>;

/// A source under the map of --transform, which is the identity if there is none.
using Formula_function = Transformed_function_traits_3<Formula_traits>;
using Spline_function = Transformed_function_traits_3<Spline_traits>;
using Fit_function = Transformed_function_traits_3<Fit_traits>;

/// SOURCE of the command line as a function.
using Source_function = std::variant<Formula_function, Spline_function, Fit_function>;

/// Whether a model of Source_function is a fit.
template <class Traits>
inline constexpr bool is_fit = std::is_same_v<Traits, Fit_function>;

} // namespace equiaffine

#endif
