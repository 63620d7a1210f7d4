// SPDX-License-Identifier: GPL-3.0-or-later
// These functions make the texts by which pages and pictures say what maps were found.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_MAPS_DISPLAY_H
#define EQUIAFFINE_PROGRAM_OUTPUT_MAPS_DISPLAY_H

#include "output/maps.h"
#include "output/surface_output.h"

#include <vector>

namespace equiaffine {

/// The options with which the two surfaces are shown: by the color of each unless another one or a range is given.
Display_options display_of(const Registration_report& report, Display_options options);

/// The texts for the page and the picture that are shown with the `options`.
Description description_of(const Registration_report& report, const Display_options& options);
std::vector<Surface_note> notes_of(const Registration_report& report, const Display_options& options);

/// The same for symmetries, whose planes and axes stand beside the surface.
Display_options display_of(const Symmetries_report& report, Display_options options);
Description description_of(const Symmetries_report& report, const Display_options& options);
std::vector<Surface_note> notes_of(const Symmetries_report& report, const Display_options& options);

} // namespace equiaffine

#endif
