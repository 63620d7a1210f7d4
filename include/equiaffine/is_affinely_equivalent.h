// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/registration/is_affinely_equivalent.h> // IWYU pragma: export
