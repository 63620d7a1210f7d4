// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/volume/Volume_3.h> // IWYU pragma: export
