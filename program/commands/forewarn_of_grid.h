// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_FOREWARN_OF_GRID_H
#define EQUIAFFINE_PROGRAM_COMMANDS_FOREWARN_OF_GRID_H

#include "request/options.h"
#include "source/source.h"
#include "system/forewarn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace equiaffine {

/// Says how long a stage will take that calls `run(options)` for the grid of the source, if that is minutes. It is called
/// for coarser grids here.
template <class Run>
void forewarn_of_grid(const std::string& stage, const Source_options& options, Progress& progress, const Run& run) {
  if (options.kind == Source_kind::VOLUME) return; // the volume has the grid
  const std::array<std::size_t, 3> size = options.resolution.value_or(default_resolution(options.kind));
  const double fineness = double(*std::max_element(size.begin(), size.end()));
  forewarn(stage, "a smaller --resolution", fineness, true, progress, [&](double coarse) {
    Source_options with_grid = options;
    with_grid.resolution = size;
    for (std::size_t& n : *with_grid.resolution)
      n = std::size_t(std::max(2., std::round(double(n) * coarse / fineness)));
    run(with_grid);
  });
}

} // namespace equiaffine

#endif
