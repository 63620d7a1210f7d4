// SPDX-License-Identifier: GPL-3.0-or-later
// The default grid on which the surface of a mesh or of points is sampled.
#ifndef EQUIAFFINE_SURFACE_INTERNAL_GRID_OF_DATA_H
#define EQUIAFFINE_SURFACE_INTERNAL_GRID_OF_DATA_H

#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/volume/Lattice_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine::internal {

/// The number of nodes along each axis.
inline constexpr std::array<std::size_t, 3> nodes_of_data = {129, 129, 129};

/// The bounding box of points, widened on all sides by a tenth of its longest side. If all points are equal, the
/// margin is larger than any coordinate.
template <class Points>
CGAL::Bbox_3 widened_box(const Points& points) {
  CGAL::Bbox_3 box;
  for (const auto& p : points) box += p.bbox();
  const double longest = std::max({box.x_span(), box.y_span(), box.z_span()});
  const double farthest = std::max({std::abs(box.xmax()), std::abs(box.ymax()), std::abs(box.zmax())});
  const double margin = longest > 0 ? longest / 10 : 1 + farthest;
  return {box.xmin() - margin, box.ymin() - margin, box.zmin() - margin,
          box.xmax() + margin, box.ymax() + margin, box.zmax() + margin};
}

/// The height above the data up to which samplers need values of a fit: Marching Cubes needs them at the corners of a
/// cell, the Delaunay mesher at a distance of the facet radius, which is the default one or `radius`.
inline double height_of_band(const std::array<std::size_t, 3>& nodes, const CGAL::Bbox_3& box, double radius = 0) {
  const auto [x, y, z] = Lattice_3<CGAL::Simple_cartesian<double>>(nodes, box).steps();
  return 2 * std::max({radius, std::sqrt((x + y + z).squared_length()), default_facet_radius(box)});
}

} // namespace equiaffine::internal

#endif
