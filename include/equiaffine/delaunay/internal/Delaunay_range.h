// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_DELAUNAY_RANGE_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_DELAUNAY_RANGE_H

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace equiaffine {

/// Which boxes and radii Delaunay meshes work with, whatever the unit of the coordinates is.
class Delaunay_range {
public:
  /// The mesher computes polynomials of degree 6 in lengths, which must neither overflow nor underflow.
  static constexpr double least = 1e-40, greatest = 1e40;

  explicit Delaunay_range(const CGAL::Bbox_3& box) : diagonal_(std::hypot(box.x_span(), box.y_span(), box.z_span())) {
    for (int a = 0; a < 3; ++a)
      greatest_coordinate_ = std::max({greatest_coordinate_, std::abs(box.min(a)), std::abs(box.max(a))});
  }

  double diagonal() const { return diagonal_; }
  double greatest_coordinate() const { return greatest_coordinate_; }

  bool has_box() const { return diagonal_ >= least && std::max(diagonal_, greatest_coordinate_) <= greatest; }

  /// The rounding of coordinates would spoil the shape of facets smaller than about a thousand units in the last place.
  double least_radius() const { return 1024 * std::numeric_limits<double>::epsilon() * greatest_coordinate_; }

private:
  double diagonal_, greatest_coordinate_ = 0;
};

} // namespace equiaffine

#endif
