// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/Level_set_traits_3.h> // IWYU pragma: export
