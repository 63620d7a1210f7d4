// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SOURCE_READ_TRIANGLE_MESH_H
#define EQUIAFFINE_SRC_SOURCE_READ_TRIANGLE_MESH_H

#include "source/Polygon_soup.h"
#include "system/kernel.h"

#include <CGAL/Surface_mesh.h>

#include <string>

namespace equiaffine {

/// Makes a mesh of what a file holds: equal points become one, faces get triangulated and a common orientation. Throws
/// `Input_error` if it is not a mesh with finite coordinates.
CGAL::Surface_mesh<Kernel::Point_3> to_triangle_mesh(Polygon_soup soup, const std::string& path);

/// Reads such a mesh from `.off .ply .obj .stl`, or OFF from standard input for "-".
CGAL::Surface_mesh<Kernel::Point_3> read_triangle_mesh(const std::string& path);

} // namespace equiaffine

#endif
