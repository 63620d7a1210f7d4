// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_MEASURED_SAMPLES_H
#define EQUIAFFINE_BINDINGS_VTK_MEASURED_SAMPLES_H

#include "Image_pieces.h"
#include "Ranks.h"
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace equiaffine {

using Views = std::vector<Volume_view_3<Kernel>>; ///< views of the samples of the pieces of a process

/// The noise of the samples. All processes must call this and the functions below, and exchange their measurements.
Sample_noise measured_noise(const Views& views, const Image_pieces& pieces, double level, const Ranks& ranks);

/// The scale of smoothing with the smallest estimated error.
double chosen_smoothing(const Views& views, const Image_pieces& pieces, const Sample_noise& noise,
                        const Volume_options& options, const Ranks& ranks);

/// The number of distinct values of the samples if it is small.
std::optional<std::size_t> counted_values(const Views& views, const Image_pieces& pieces, const Ranks& ranks);

/// Whether the views of all processes cover the whole image.
bool are_whole(const Views& views, const Ranks& ranks);

} // namespace equiaffine

#endif
