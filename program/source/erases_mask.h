// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_ERASES_MASK_H
#define EQUIAFFINE_PROGRAM_SOURCE_ERASES_MASK_H

#include "source/source_function.h"
#include "system/kernel.h"
#include <equiaffine/volume/Volume_view_3.h>

namespace equiaffine {

/// Whether a spline has on the same side of an isovalue less than nine tenths of the samples that are on the rarer side of
/// it; judged by some of them.
bool erases_mask(const Spline_traits& spline, const Volume_view_3<Kernel>& mask, double isovalue);

} // namespace equiaffine

#endif
