// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/surface/project_to_surface.h> // IWYU pragma: export
