// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_SURFACE_OUTPUT_H
#define EQUIAFFINE_PROGRAM_OUTPUT_SURFACE_OUTPUT_H

#include "output/Outputs.h"
#include "picture/Surface_note.h"
#include "request/options.h"
#include "system/atomic_file.h"
#include "system/kernel.h"
#include <equiaffine/io/read_points.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

/// Throws `Input_error` unless `write_surface` knows the extension of the path, or it is "-".
void check_surface_output(const std::string& path);

/// Writes the mesh in the format of the path's extension, OFF for "-", without committing.
void write_surface(Output_file& file, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes);

/// Throws `Input_error` unless `write_vertices` knows the extension of the path, or it is "-".
void check_vertices_output(const std::string& path);

/// Writes a mesh or points as they came with more attributes in the format of the path's extension, CSV for "-", without
/// committing. Computed columns replace those of the same name.
void write_vertices(Output_file& file, const Point_table_3<Kernel>& table, const Vertex_attributes& attributes);

/// Throws `Input_error` unless `write_curves` knows the extension of the path, or it is "-".
void check_curves_output(const std::string& path);

/// Writes the curves in the format of the path's extension, OBJ for "-", without committing.
void write_curves(Output_file& file, const Parabolic_curves_3<Kernel>& curves);

/// Throws `Input_error` if the path has an extension that is not .json.
void check_statistics_output(const std::string& path);

/// Throws `Input_error` if the path has an extension that is not .json.
void check_maps_output(const std::string& path);

/// The table of a page about its surface, in rows of two cells.
using Description = std::vector<std::pair<std::string, std::string>>;

/// Returns the number with that many digits for a description.
std::string number_text(double number, int digits = 6);

/// Returns what a page of the surface in that file is called: the name of the file, or `otherwise` if that is "-".
std::string page_title(const std::string& path, const std::string& otherwise);

/// Throws `Input_error` if the page has an extension that is not that of a page, if the picture has another one than
/// .png, if the colors of `range_of` cannot be read, or if a picture is asked for and this program was built without
/// VTK. Each may be "-".
void check_display_outputs(const Display_options& options);

/// The texts by which a page and a picture describe a surface.
struct Surface_texts {
  std::string title;
  Description description;
  std::vector<Surface_note> notes = {}; ///< below the picture
  std::string label_suffix = {};        ///< what follows the labels of quantities
};

/// Writes the page and the picture that are among the outputs, without committing. The curves are on the picture only.
void write_displays(Outputs& outputs, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                    const Display_options& options, const Surface_texts& texts,
                    const std::vector<Polyline_3<Kernel>>& curves = {});

} // namespace equiaffine

#endif
