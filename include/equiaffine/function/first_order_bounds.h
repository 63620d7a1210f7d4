// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds of value and gradient on a box for any model of ImplicitFunctionTraits_3, as tight as the model knows them:
// first_order_bounds(traits, box), tight_first_order_bounds(traits, box), known_bounds(traits).
#ifndef EQUIAFFINE_FUNCTION_FIRST_ORDER_BOUNDS_H
#define EQUIAFFINE_FUNCTION_FIRST_ORDER_BOUNDS_H

#include <equiaffine/function/internal/first_order_bounds.h> // IWYU pragma: export

#endif
