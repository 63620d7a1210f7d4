// SPDX-License-Identifier: GPL-3.0-or-later
// What pages and pictures of a fit say about it.
#ifndef EQUIAFFINE_SRC_OUTPUT_FIT_DISPLAY_H
#define EQUIAFFINE_SRC_OUTPUT_FIT_DISPLAY_H

#include "output/surface_output.h"
#include "picture/Surface_note.h"
#include "source/Fit_statistics.h"

#include <string>
#include <vector>

namespace equiaffine {

/// " at scale 0.1" for what follows the names of quantities; nothing for the surface's own.
std::string label_suffix(const Fit_statistics& fit);

/// Scale, noise, and the parts of the vertices at which quantities are known, as rows of a description.
Description description_of(const Fit_statistics& fit);

/// The same as lines below a picture.
std::vector<Surface_note> notes_of(const Fit_statistics& fit);

} // namespace equiaffine

#endif
