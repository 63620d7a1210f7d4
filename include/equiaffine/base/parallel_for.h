// SPDX-License-Identifier: GPL-3.0-or-later
// parallel_for<ConcurrencyTag>(begin, end, f): a loop on the threads of TBB or on one, for every room of the library.
#ifndef EQUIAFFINE_BASE_PARALLEL_FOR_H
#define EQUIAFFINE_BASE_PARALLEL_FOR_H

#include <equiaffine/base/internal/parallel_for.h> // IWYU pragma: export

#endif
