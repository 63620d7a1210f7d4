// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_EVALUATE_POINTS_H
#define EQUIAFFINE_PROGRAM_COMMANDS_EVALUATE_POINTS_H

#include "request/options.h"
#include "source/source.h"
#include "system/progress.h"

#include <span>

namespace equiaffine {

/// The attributes of a source at points, and the estimates that are asked for. Points at infinity are OUTSIDE.
Vertex_attributes evaluate_points(const Evaluate_options& options, const Source& source,
                                  std::span<const Kernel::Point_3> points, Progress& progress);

} // namespace equiaffine

#endif
