// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/surface/parabolic_curves.h> // IWYU pragma: export
