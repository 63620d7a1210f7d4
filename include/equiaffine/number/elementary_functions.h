// SPDX-License-Identifier: GPL-3.0-or-later
// exp, sin and cos that have the same bits for a number and for a lane of a pack: exp_value, sine_and_cosine, both in
// equiaffine::internal.
#ifndef EQUIAFFINE_NUMBER_ELEMENTARY_FUNCTIONS_H
#define EQUIAFFINE_NUMBER_ELEMENTARY_FUNCTIONS_H

#include <equiaffine/number/internal/elementary_functions.h> // IWYU pragma: export

#endif
