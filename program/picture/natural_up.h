// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_PICTURE_NATURAL_UP_H
#define EQUIAFFINE_PROGRAM_PICTURE_NATURAL_UP_H

#include "system/kernel.h"

#include <array>
#include <vector>

namespace equiaffine {

/// Guesses which axis of a scan points up: y, as in most files of scans, unless the shape stands along z. It does if the
/// convex hull of its lowest points along z covers a tenth of its box or more, and twice the part that they cover along y.
std::array<double, 3> natural_up(const std::vector<Kernel::Point_3>& points);

} // namespace equiaffine

#endif
