// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_XYZ_COLORS_NOTE_H
#define EQUIAFFINE_IO_INTERNAL_XYZ_COLORS_NOTE_H

namespace equiaffine {

/// The comment that points of an XYZ file get whose columns 4 to 6 have no names and are no normals.
inline constexpr const char* xyz_colors_note = "columns 4 to 6 are colors, not normals, which would have the length 1";

} // namespace equiaffine

#endif
