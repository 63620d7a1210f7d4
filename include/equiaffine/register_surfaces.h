// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/registration/register_surfaces.h> // IWYU pragma: export
