// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/marching_cubes/marching_cubes_of_array.h> // IWYU pragma: export
