// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_SEEDING_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_SEEDING_3_H

#include <CGAL/Bbox_3.h>

#include <vector>

namespace equiaffine {

/// Points to begin a mesh with.
template <class Point_3>
struct Seeding_3 {
  std::vector<Point_3> seeds;                ///< on the surface, on every component that was found
  std::vector<Point_3> scaffold;             ///< in the middle of large boxes without surface, and far outside
  std::vector<CGAL::Bbox_3> undecided_boxes; ///< where a part of the surface may have been missed
};

/// A vertex that the mesh has before it gets seeds.
template <class Point_3>
struct Fixed_vertex_3 {
  Point_3 point;    ///< on the surface
  double clearance; ///< distance that seeds keep from the vertex
};

} // namespace equiaffine

#endif
