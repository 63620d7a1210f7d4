// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_OUTPUT_WRITE_VTP_H
#define EQUIAFFINE_SRC_OUTPUT_WRITE_VTP_H

#include "system/kernel.h"
#include <equiaffine/parabolic_curves.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <ostream>

namespace equiaffine {

/// Writes a VTK polydata file: points in double precision, triangles, a double point array per column and, if there
/// is a status, an unsigned char array `status`. Errors are in the state of the stream.
void write_VTP(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes);

/// The same for curves: a polyline for each, a closed one ends with the index of its first point.
void write_VTP(std::ostream& stream, const Parabolic_curves_3<Kernel>& curves);

} // namespace equiaffine

#endif
