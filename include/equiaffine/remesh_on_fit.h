// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/fit/remesh_on_fit.h> // IWYU pragma: export
