// SPDX-License-Identifier: GPL-3.0-or-later
// Pages and pictures of a surface, and what they say of a fit: its scale, its noise and what is known.
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

/// The table of a page about its surface, in rows of two cells.
using Description = std::vector<std::pair<std::string, std::string>>;

/// Returns the number with that many digits for a description.
std::string number_text(double number, int digits = 6);

/// Returns what a page of the surface in that file is called: the name of the file, or `otherwise` if that is "-".
std::string page_title(const std::string& path, const std::string& otherwise);

/// Throws `Input_error` if the page has an extension that is not that of a page, if the picture has another one than
/// .png, if the colors of `range_of` cannot be read, or if a picture is asked for and this program was built without
/// VTK. Each may be "-".
void check_display_outputs(const Display_request& options);

/// The texts by which a page and a picture describe a surface.
struct Surface_texts {
  std::string title;
  Description description;
  std::vector<Surface_note> notes = {}; ///< below the picture
  std::string label_suffix = {};        ///< what follows the labels of quantities
};

/// Writes the page and the picture that are among the outputs, without committing. The curves are on the picture only.
void write_displays(Outputs& outputs, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                    const Display_request& options, const Surface_texts& texts,
                    const std::vector<Polyline_3<Kernel>>& curves = {});

/// Scale, noise, and the parts of the vertices at which quantities are known, as rows of a description.
Description description_of(const Fit_statistics& fit);

/// The rows as comments of a mesh, by which `view` knows them again; none if nothing was fitted.
std::vector<std::string> comments_of(const Fit_statistics& fit);

/// The rows that comments_of() wrote, and one that says so if the mesh has lost its columns of errors. Empty for a mesh
/// that does not come from a fit.
Description description_of_fit(const Vertex_attributes& attributes);

/// " at scale 0.1" for what follows the names of quantities; nothing for the surface's own, or without a fit.
std::string label_suffix(const Description& fit);

/// The rows as lines below a picture, without the scale, which stands in its legend.
std::vector<Surface_note> notes_of(const Description& fit);

/// A mesh that is to be looked at, and the numbers at its vertices.
struct Displayed_mesh {
  Indexed_triangle_mesh_3<Kernel> mesh;
  Vertex_attributes attributes;
};

/// Makes a mesh of at most so many triangles, for display: of the vertices in a cell of a grid one is left, that
/// nearest to their mean, with its numbers (vertex clustering: Rossignac, Borrel 1993). Parts that are nearer to each
/// other than a cell may be merged, and triangles with a corner that is not finite are left out. There are at
/// most 2^21 cells along an axis: one vertex a thousand times as far away as the others makes the mesh coarse. Takes
/// about 70 bytes of memory per vertex.
Displayed_mesh decimate(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                        std::size_t most_triangles);

} // namespace equiaffine

#endif
