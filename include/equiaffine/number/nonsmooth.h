// SPDX-License-Identifier: GPL-3.0-or-later
// Defines derivatives where functions have kinks and jumps: branch_or_kink and factor_for_jump, both in
// equiaffine::internal.
#ifndef EQUIAFFINE_NUMBER_NONSMOOTH_H
#define EQUIAFFINE_NUMBER_NONSMOOTH_H

#include <equiaffine/number/internal/nonsmooth.h> // IWYU pragma: export

#endif
