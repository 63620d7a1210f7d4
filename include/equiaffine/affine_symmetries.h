// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/registration/affine_symmetries.h> // IWYU pragma: export
