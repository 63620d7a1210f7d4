// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_PICTURE_SURFACE_NOTE_H
#define EQUIAFFINE_PROGRAM_PICTURE_SURFACE_NOTE_H

#include <optional>
#include <string>

namespace equiaffine {

/// A line of text below a picture, beside the color of a number if it has one.
struct Surface_note {
  std::optional<double> number;
  std::string text;
};

} // namespace equiaffine

#endif
