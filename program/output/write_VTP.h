// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_WRITE_VTP_H
#define EQUIAFFINE_PROGRAM_OUTPUT_WRITE_VTP_H

#include "system/kernel.h"
#include <equiaffine/surface/parabolic_curves.h>

#include <ostream>

namespace equiaffine {

/// Writes a VTK polydata file of curves: points in double precision, and a polyline for each curve; a closed one ends
/// with the index of its first point. Errors are in the state of the stream.
void write_VTP(std::ostream& stream, const Parabolic_curves_3<Kernel>& curves);

} // namespace equiaffine

#endif
