// SPDX-License-Identifier: GPL-3.0-or-later
// Pages and pictures of a surface, and their descriptions of fits: scale, noise, and errors.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_DISPLAYS_H
#define EQUIAFFINE_PROGRAM_OUTPUT_DISPLAYS_H

#include "output/Outputs.h"
#include "picture/Surface_paint.h"
#include "request/Request.h"
#include "system/kernel.h"
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

/// The table of facts on a page: labels and values.
using Description = std::vector<std::pair<std::string, std::string>>;

/// Formats a number for a description.
std::string number_text(double number, int digits = 6);

/// The title of the page of a surface: the name of the file without extension, or `otherwise` if the path is "-".
std::string page_title(const std::string& path, const std::string& otherwise);

/// Throws `Input_error` if the page or the picture has a wrong extension, if the colors of `range_of` cannot be read,
/// or if a picture is requested and this program was built without VTK. Each path may be "-".
void check_display_outputs(const Display_request& options);

/// The texts of a page and a picture about their surface.
struct Surface_texts {
  std::string title;
  Description description;
  std::vector<Surface_note> notes = {}; ///< below the picture
  std::string label_suffix = {};        ///< appended to the labels of quantities
};

/// Writes the page and the picture of the outputs, without committing. Only the picture shows the curves.
void write_displays(Outputs& outputs, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                    const Display_request& options, const Surface_texts& texts,
                    const std::vector<Polyline_3<Kernel>>& curves = {});

/// Scale, noise, and the percentages of vertices with small errors, as rows of a description.
Description description_of(const Fit_statistics& fit);

/// The rows as comments of a mesh, from which `view` reads them; empty if nothing was fitted.
std::vector<std::string> comments_of(const Fit_statistics& fit);

/// Reads the rows of comments_of(), and adds a row if the mesh has lost its columns of errors. Empty for a mesh that
/// does not come from a fit.
Description description_of_fit(const Vertex_attributes& attributes);

/// The suffix " at scale 0.1" of labels of quantities; empty for curvatures of the surface itself, or without a fit.
std::string label_suffix(const Description& fit);

/// The rows as notes below a picture, without the scale, which is in the legend.
std::vector<Surface_note> notes_of(const Description& fit);

/// A mesh for display, and the attributes of its vertices.
struct Displayed_mesh {
  Indexed_triangle_mesh_3<Kernel> mesh;
  Vertex_attributes attributes;
};

/// Makes a mesh of at most `most_triangles` triangles for display: in each cell of a grid, it keeps the vertex nearest
/// to the mean of the cell's vertices, with its attributes (vertex clustering: Rossignac, Borrel 1993). Parts nearer to
/// each other than a cell may be merged; triangles with a corner that is not finite are left out. There are at most
/// 2^21 cells along an axis, so a vertex a thousand times as far away as the others makes the mesh coarse. Uses about
/// 70 bytes of memory per vertex.
Displayed_mesh decimate(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                        std::size_t most_triangles);

} // namespace equiaffine

#endif
