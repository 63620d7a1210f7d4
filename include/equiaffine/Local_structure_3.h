// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/geometry/local_structure.h> // IWYU pragma: export
