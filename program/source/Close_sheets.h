// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_CLOSE_SHEETS_H
#define EQUIAFFINE_PROGRAM_SOURCE_CLOSE_SHEETS_H

#include "request/options.h"
#include "source/source_function.h"

#include <cstddef>

namespace equiaffine {

/// Sheets of the data of a fit that are nearer to each other than the steps of a grid, which does not tell them apart.
struct Close_sheets {
  std::size_t points = 0;     ///< the data that have another sheet so near
  double distance = 0;        ///< that a tenth of them are nearer than, in the unit of the data; NaN without points
  std::size_t resolution = 0; ///< of a grid that tells the others apart
};

/// For the grid on which Marching Cubes samples the fit.
Close_sheets close_sheets(const Fit_traits& fit, const Source_options& options);

} // namespace equiaffine

#endif
