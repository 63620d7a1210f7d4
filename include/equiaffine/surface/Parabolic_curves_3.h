// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_PARABOLIC_CURVES_3_H
#define EQUIAFFINE_SURFACE_PARABOLIC_CURVES_3_H

#include <equiaffine/mesh/Polyline_3.h>

#include <cstddef>
#include <vector>

namespace equiaffine {

/// The curves on which the Gaussian curvature changes its sign, where the affine metric is degenerate and the affine
/// curvatures are infinite.
template <class Kernel>
struct Parabolic_curves_3 {
  std::vector<Polyline_3<Kernel>> polylines; ///< the curves
  std::size_t unconverged_points = 0; ///< points left where linear interpolation along an edge of the mesh puts them
};

} // namespace equiaffine

#endif
