// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/analytic_functions.h> // IWYU pragma: export
