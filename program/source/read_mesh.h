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

/// Makes a mesh of the triangles in a file: orients them consistently, and merges equal points unless the surface is
/// already closed. Throws `Input_error` if they do not form a surface, or a coordinate is not finite.
CGAL::Surface_mesh<Kernel::Point_3> to_surface(const Indexed_triangle_mesh_3<Kernel>& mesh, const std::string& path);

/// The triangles of a mesh, oriented consistently; unchanged if that would need new points.
std::vector<std::array<std::uint32_t, 3>> oriented_triangles(const Indexed_triangle_mesh_3<Kernel>& mesh);

/// Reads such a mesh from `.off .ply .obj .stl`, or OFF from standard input for "-".
CGAL::Surface_mesh<Kernel::Point_3> read_triangle_mesh(const std::string& path);

/// Reads a mesh from `.ply .off .obj .stl`, or points from `.csv .xyz` and files without faces, in their order and with
/// their other columns. Merges equal corners of STL, and triangulates each face from its first corner. "-" reads PLY,
/// OFF or CSV from standard input. Throws `Input_error` if the file cannot be read or has no points, or if coordinates
/// are not finite or in an extreme unit.
Point_table_3<Kernel> read_vertices(const std::string& path);

/// The mesh or points of a source, from memory or from its file. Throws the same errors.
Point_table_3<Kernel> read_vertices(const Source_options& source);

/// Whether unnamed columns of the points are colors, not normals.
bool have_colors(const Annotated_mesh_3<Kernel>& points);

/// Throws `Input_error` if there are no points, a coordinate is not finite, or the unit is extreme. `name` is the file
/// or the name of the data.
void check_vertices(const std::vector<Kernel::Point_3>& points, const std::string& name);

} // namespace equiaffine

#endif
