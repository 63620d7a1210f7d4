// SPDX-License-Identifier: GPL-3.0-or-later
// Files, pages and pictures of a fit say its scale, its noise and what is known.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_FIT_DISPLAY_H
#define EQUIAFFINE_PROGRAM_OUTPUT_FIT_DISPLAY_H

#include "output/surface_output.h"
#include "picture/Surface_note.h"
#include "source/Fit_statistics.h"

#include <string>
#include <vector>

namespace equiaffine {

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

} // namespace equiaffine

#endif
