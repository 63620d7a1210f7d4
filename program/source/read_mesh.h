// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of meshes and points.
#ifndef EQUIAFFINE_PROGRAM_SOURCE_READ_MESH_H
#define EQUIAFFINE_PROGRAM_SOURCE_READ_MESH_H

#include "request/source_options.h"
#include "system/kernel.h"
#include <equiaffine/io/read_points.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace equiaffine {

/// Throws `Input_error`: "cannot read the mesh 'path': reason; advice".
[[noreturn]] void fail_to_read_mesh(const std::string& path, const std::string& reason, const std::string& advice);

/// Makes a mesh of the triangles in a file: they get a common orientation, and equal points become one unless the
/// surface is closed without. Throws `Input_error` if they are no surface, or a coordinate is not finite.
CGAL::Surface_mesh<Kernel::Point_3> to_surface(const Indexed_triangle_mesh_3<Kernel>& mesh, const std::string& path);

/// The triangles of a mesh, turned to a common orientation; as they are if there is none without new points.
std::vector<std::array<std::uint32_t, 3>> oriented_triangles(const Indexed_triangle_mesh_3<Kernel>& mesh);

/// Reads such a mesh from `.off .ply .obj .stl`, or OFF from standard input for "-".
CGAL::Surface_mesh<Kernel::Point_3> read_triangle_mesh(const std::string& path);

/// Reads a mesh from `.ply .off .obj .stl`, or points from `.csv .xyz` and files without faces, as they are: in their
/// order, with what else is known of them. Corners of STL that coincide become one vertex, and faces are cut into
/// triangles from their first corner. "-" reads PLY, OFF or CSV from standard input. Throws `Input_error` for what
/// cannot be read, for a file without points, and for coordinates that are not finite or in an extreme unit.
Point_table_3<Kernel> read_vertices(const std::string& path);

/// The mesh or points of a source, from memory or from its file. Throws `Input_error` for the same.
Point_table_3<Kernel> read_vertices(const Source_options& source);

/// Whether points have colors in columns without names, where one might expect normals.
bool have_colors(const Annotated_mesh_3<Kernel>& points);

/// Throws `Input_error` if there are no points, a coordinate is not finite, or the unit is extreme. `name` stands for
/// where they come from.
void check_vertices(const std::vector<Kernel::Point_3>& points, const std::string& name);

} // namespace equiaffine

#endif
