// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/fit/fitted_structures.h> // IWYU pragma: export
