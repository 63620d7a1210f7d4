// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/fit/Fitted_function_traits_3.h> // IWYU pragma: export
