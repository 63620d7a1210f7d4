// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/delaunay/delaunay_surface.h> // IWYU pragma: export
