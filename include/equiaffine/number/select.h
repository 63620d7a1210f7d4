// SPDX-License-Identifier: GPL-3.0-or-later
// Choices without branches, so that one formula serves a number and a pack of numbers: select(condition, yes, no),
// Mask_of, is_finite_number, fraction, all in equiaffine::internal.
#ifndef EQUIAFFINE_NUMBER_SELECT_H
#define EQUIAFFINE_NUMBER_SELECT_H

#include <equiaffine/number/internal/select.h> // IWYU pragma: export

#endif
