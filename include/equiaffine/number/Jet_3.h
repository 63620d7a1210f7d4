// SPDX-License-Identifier: GPL-3.0-or-later
// Jet_3, Taylor polynomials of three variables, with its functions: division, powers, elementary functions, order.
#ifndef EQUIAFFINE_NUMBER_JET_3_H
#define EQUIAFFINE_NUMBER_JET_3_H

#include <equiaffine/number/internal/Jet_functions_3.h> // IWYU pragma: export
#include <equiaffine/number/internal/Jet_steps_3.h>     // IWYU pragma: export
#include <equiaffine/number/internal/jet.h>             // IWYU pragma: export

#endif
