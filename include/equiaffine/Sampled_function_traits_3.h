// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/Sampled_function_traits_3.h> // IWYU pragma: export
