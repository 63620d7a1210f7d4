// SPDX-License-Identifier: GPL-3.0-or-later
// Interval, closed intervals of reals with outward rounding, with its elementary functions.
#ifndef EQUIAFFINE_NUMBER_INTERVAL_H
#define EQUIAFFINE_NUMBER_INTERVAL_H

#include <equiaffine/number/internal/interval.h> // IWYU pragma: export

#endif
