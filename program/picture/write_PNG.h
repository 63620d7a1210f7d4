// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_PICTURE_WRITE_PNG_H
#define EQUIAFFINE_PROGRAM_PICTURE_WRITE_PNG_H

#include "picture/draw_surface.h"

#include <ostream>

namespace equiaffine {

/// Writes the picture, with a bar of its colors in the lower left corner if they are those of a number, as a PNG file.
void write_PNG(std::ostream& stream, Surface_picture picture);

} // namespace equiaffine

#endif
