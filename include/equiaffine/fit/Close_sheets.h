// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_CLOSE_SHEETS_H
#define EQUIAFFINE_FIT_CLOSE_SHEETS_H

#include <cstddef>

namespace equiaffine {

/// Sheets of the data of a fit that are closer to each other than the steps of a grid. Marching Cubes on that grid
/// may join them or leave holes.
struct Close_sheets {
  std::size_t points = 0;     ///< number of data points with another sheet closer than a step
  double distance = 0;        ///< a tenth of them are closer than this, in the unit of the data; NaN without points
  std::size_t resolution = 0; ///< nodes along the longest side of a grid that separates the rest
};

} // namespace equiaffine

#endif
