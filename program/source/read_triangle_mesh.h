// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_READ_TRIANGLE_MESH_H
#define EQUIAFFINE_PROGRAM_SOURCE_READ_TRIANGLE_MESH_H

#include "source/Polygon_soup.h"
#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace equiaffine {

/// Makes a mesh of what a file holds: faces get triangulated and a common orientation, and equal points become one unless
/// the surface is closed without. Throws `Input_error` if it is not a mesh with finite coordinates.
CGAL::Surface_mesh<Kernel::Point_3> to_triangle_mesh(Polygon_soup soup, const std::string& path);

/// The triangles of a mesh, turned to a common orientation; as they are if there is none without new points.
std::vector<std::array<std::uint32_t, 3>> oriented_triangles(const Indexed_triangle_mesh_3<Kernel>& mesh);

/// Reads such a mesh from `.off .ply .obj .stl`, or OFF from standard input for "-".
CGAL::Surface_mesh<Kernel::Point_3> read_triangle_mesh(const std::string& path);

} // namespace equiaffine

#endif
