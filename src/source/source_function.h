// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SOURCE_SOURCE_FUNCTION_H
#define EQUIAFFINE_SRC_SOURCE_SOURCE_FUNCTION_H

#include "system/kernel.h"
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/Expression_3.h>
#include <equiaffine/Fitted_function_traits_3.h>
#include <equiaffine/Sampled_function_traits_3.h>
#include <equiaffine/Transformed_function_traits_3.h>

#include <type_traits>
#include <variant>

namespace equiaffine {

using Formula_traits = Analytic_function_traits_3<Kernel, Expression_3>;
using Spline_traits = Sampled_function_traits_3<Kernel>;

using Fit_traits = Fitted_function_traits_3<Kernel>;

/// SOURCE of the command line as a function: six models of ImplicitFunctionTraits_3.
using Source_function =
    std::variant<Formula_traits, Spline_traits, Fit_traits, Transformed_function_traits_3<Formula_traits>,
                 Transformed_function_traits_3<Spline_traits>, Transformed_function_traits_3<Fit_traits>>;

/// Whether a model of Source_function is a fit.
template <class Traits>
inline constexpr bool is_fit =
    std::is_same_v<Traits, Fit_traits> || std::is_same_v<Traits, Transformed_function_traits_3<Fit_traits>>;

/// The fit that such a model is made of.
inline const Fit_traits& fit_of(const Fit_traits& fit) { return fit; }
inline const Fit_traits& fit_of(const Transformed_function_traits_3<Fit_traits>& image) { return image.base(); }

} // namespace equiaffine

#endif
