// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/geometry/Local_structure_3.h> // IWYU pragma: export
