// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the picture of a surface as its page first shows it, and writes it as a PNG file.
#ifndef EQUIAFFINE_PROGRAM_PICTURE_DRAW_SURFACE_H
#define EQUIAFFINE_PROGRAM_PICTURE_DRAW_SURFACE_H

#include "picture/Canvas.h"
#include "picture/Surface_paint.h"
#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// A picture of a surface and what its colors mean.
struct Surface_picture {
  Picture picture;
  std::optional<Color_legend> legend; ///< if there are colors of a number
  std::vector<Color_note> notes;      ///< from the bottom to the top, as many as leave a quarter of the height
};

/// The rows at the bottom of a picture that are left free for its legend, if it has one, and for each note above that.
/// Without a legend notes begin `note_margin` above the bottom.
inline constexpr std::size_t legend_height = 56, note_height = 18, note_margin = 8;

/// The columns NAME_x, NAME_y, NAME_z, or nx, ny, nz for the name `normal`; nothing if one of them is missing.
std::optional<std::array<const std::vector<double>*, 3>> vector_columns(const Vertex_attributes& attributes,
                                                                        const std::string& name);

/// Draws the surface as the page of write_HTML shows it first: the same view, colors and light. Curves are black
/// lines. The notes stand below the surface, from the top to the bottom.
Surface_picture draw_surface(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                             const Display_options& options, std::span<const Surface_note> notes = {},
                             std::span<const Polyline_3<Kernel>> curves = {});

/// Guesses which axis of a scan points up: y, as in most files of scans, unless the shape stands along z. It does if
/// the convex hull of its lowest points along z covers a tenth of its box or more, and twice the part that they cover
/// along y.
std::array<double, 3> natural_up(const std::vector<Kernel::Point_3>& points);

/// Writes the picture, with a bar of its colors in the lower left corner if they are those of a number, as a PNG file.
void write_PNG(std::ostream& stream, Surface_picture picture);

} // namespace equiaffine

#endif
