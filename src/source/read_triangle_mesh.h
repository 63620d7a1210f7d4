// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SOURCE_READ_TRIANGLE_MESH_H
#define EQUIAFFINE_SRC_SOURCE_READ_TRIANGLE_MESH_H

#include "system/kernel.h"

#include <CGAL/Surface_mesh.h>

#include <string>

namespace equiaffine {

/// Reads `.off .ply .obj .stl`, or OFF from standard input for "-".
/// Equal points become one, faces get triangulated and a common orientation. Throws
/// `Input_error` if the file is not a mesh with finite coordinates.
CGAL::Surface_mesh<Kernel::Point_3> read_triangle_mesh(const std::string& path);

} // namespace equiaffine

#endif
