// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_CLOSE_SHEETS_H
#define EQUIAFFINE_FIT_CLOSE_SHEETS_H

#include <cstddef>

namespace equiaffine {

/// Sheets of the data of a fit that are nearer to each other than the steps of a grid. Marching Cubes on that grid may
/// join them, or leave holes there.
struct Close_sheets {
  std::size_t points = 0;     ///< the number of data that have another sheet so near
  double distance = 0;        ///< that a tenth of them are nearer than, in the unit of the data; NaN without points
  std::size_t resolution = 0; ///< the number of nodes, along the longest side, of a grid that separates the others
};

} // namespace equiaffine

#endif
