// SPDX-License-Identifier: GPL-3.0-or-later
// Disjoint_sets: the union-find structure, for every room of the library.
#ifndef EQUIAFFINE_BASE_DISJOINT_SETS_H
#define EQUIAFFINE_BASE_DISJOINT_SETS_H

#include <equiaffine/base/internal/disjoint_sets.h> // IWYU pragma: export

#endif
