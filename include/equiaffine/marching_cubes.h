// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/marching_cubes/marching_cubes.h> // IWYU pragma: export
