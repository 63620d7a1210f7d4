// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the picture of a surface, the initial view of its page, and writes it as a PNG file.
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

/// A picture of a surface, and the meaning of its colors.
struct Surface_picture {
  Picture picture;
  std::optional<Color_legend> legend; ///< if colors show a number
  std::vector<Color_note> notes;      ///< from bottom to top, as many as leave a quarter of the height
};

/// The heights in pixels of the legend at the bottom of a picture, and of each note above it. Without a legend, notes
/// begin `note_margin` above the bottom.
inline constexpr std::size_t legend_height = 56, note_height = 18, note_margin = 8;

/// The columns NAME_x, NAME_y, NAME_z (nx, ny, nz for the name `normal`), or nothing if one of them is missing.
std::optional<std::array<const std::vector<double>*, 3>> vector_columns(const Vertex_attributes& attributes,
                                                                        const std::string& name);

/// Draws the initial view of the page of write_HTML: the same camera, colors and light. Curves are black lines. The
/// notes are below the surface, from top to bottom.
Surface_picture draw_surface(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                             const Display_options& options, std::span<const Surface_note> notes = {},
                             std::span<const Polyline_3<Kernel>> curves = {});

/// Guesses which axis of a scan points up: y, as in most scans, or z if the convex hull of the lowest points along z
/// covers at least 1/10 of the box seen along z, and at least twice the fraction for y.
std::array<double, 3> natural_up(const std::vector<Kernel::Point_3>& points);

/// Writes the picture as a PNG file, with a color bar in the lower left corner if colors show a number.
void write_PNG(std::ostream& stream, Surface_picture picture);

} // namespace equiaffine

#endif
