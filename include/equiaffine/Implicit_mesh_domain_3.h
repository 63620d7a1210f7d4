// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h> // IWYU pragma: export
