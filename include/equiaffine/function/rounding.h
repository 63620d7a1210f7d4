// SPDX-License-Identifier: GPL-3.0-or-later
// rounding(traits, p): the one place where a model is asked how large errors of its second derivatives can be.
#ifndef EQUIAFFINE_FUNCTION_ROUNDING_H
#define EQUIAFFINE_FUNCTION_ROUNDING_H

#include <equiaffine/function/internal/rounding.h> // IWYU pragma: export

#endif
