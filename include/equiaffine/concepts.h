// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/concepts.h> // IWYU pragma: export
