// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/fit/move_to_fit.h> // IWYU pragma: export
