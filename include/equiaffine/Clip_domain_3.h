// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/surface/Clip_domain_3.h> // IWYU pragma: export
