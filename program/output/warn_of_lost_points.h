// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_WARN_OF_LOST_POINTS_H
#define EQUIAFFINE_PROGRAM_OUTPUT_WARN_OF_LOST_POINTS_H

#include "system/kernel.h"
#include "system/progress.h"

#include <string>
#include <vector>

namespace equiaffine {

/// Warns if the format of a file that the points of a mesh were written to cannot tell a hundredth of them from others:
/// STL, which has single precision.
void warn_of_lost_points(const std::string& path, const std::vector<Kernel::Point_3>& points, Progress& progress);

} // namespace equiaffine

#endif
