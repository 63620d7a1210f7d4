// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SOURCE_WARN_OF_OUTSIDE_H
#define EQUIAFFINE_SRC_SOURCE_WARN_OF_OUTSIDE_H

#include "source/source.h"
#include "system/progress.h"

#include <cstddef>
#include <string>

namespace equiaffine {

/// Warns of points outside the samples where the reason is one that the user would not expect: a narrow band, or fewer
/// nodes than a spline needs. `outside` of `all` points are; `points` is the word for them, such as "vertices".
void warn_of_outside(const Source_options& options, const Source& source, std::size_t outside, std::size_t all,
                     const std::string& points, Progress& progress);

} // namespace equiaffine

#endif
