// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_WRITE_POLYGON_FILE_H
#define EQUIAFFINE_IO_INTERNAL_WRITE_POLYGON_FILE_H

#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <string>

// The library defines this function.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Writes polygons in the format that the extension of the path stands for, with those numbers that the format holds.
void write_polygon_file(const std::string& path, const Indexed_polygons& mesh, const Vertex_attributes& attributes);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
