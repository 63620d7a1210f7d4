// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/delaunay/Implicit_surface_oracle_3.h> // IWYU pragma: export
