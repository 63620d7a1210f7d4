// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/surface/mesh_topology.h> // IWYU pragma: export
