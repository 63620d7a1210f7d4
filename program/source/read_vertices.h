// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_READ_VERTICES_H
#define EQUIAFFINE_PROGRAM_SOURCE_READ_VERTICES_H

#include "request/options.h"
#include "system/kernel.h"
#include <equiaffine/io/read_points.h>

#include <string>
#include <vector>

namespace equiaffine {

/// Reads a mesh from `.ply .off .obj .stl`, or points from `.csv .xyz` and files without faces, as they are: in their
/// order, with what else is known of them. Corners of STL that coincide become one vertex, and faces are cut into
/// triangles from their first corner. "-" reads PLY, OFF or CSV from standard input. Throws `Input_error` for what
/// cannot be read, for a file without points, and for coordinates that are not finite or in an extreme unit.
Point_table_3<Kernel> read_vertices(const std::string& path);

/// The mesh or points of a source, from memory or from its file. Throws `Input_error` for the same.
Point_table_3<Kernel> read_vertices(const Source_options& source);

/// Whether points have colors in columns without names, where one might expect normals.
bool have_colors(const Annotated_mesh_3<Kernel>& points);

/// Throws `Input_error` if there are no points, a coordinate is not finite, or the unit is extreme. `name` stands for where
/// they come from.
void check_vertices(const std::vector<Kernel::Point_3>& points, const std::string& name);

} // namespace equiaffine

#endif
