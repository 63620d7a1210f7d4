// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_DELAUNAY_SURFACE_3_H
#define EQUIAFFINE_DELAUNAY_DELAUNAY_SURFACE_3_H

#include <equiaffine/mesh/Isosurface_3.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <CGAL/Bbox_3.h>

#include <vector>

namespace equiaffine {

/// A Delaunay mesh of the zero set of a function.
template <class Kernel>
struct Delaunay_surface_3 : Isosurface_3<Kernel> {
  bool is_certified = false; ///< no component of the surface was missed: there are no undecided boxes
  /// Boxes in which a part of the surface may have been missed, since neither its absence nor its regularity could be
  /// proved: around singular points, where the surface touches the border of the box, beside points where f is not
  /// defined, in noise that would need too many boxes, or everywhere if the function has no bounds of its gradient.
  /// There are also boxes where a part of the surface got no triangle, or a feature no edge, because it is too near to
  /// others, where points of features are nearer to each other than a thousandth of the radius, where the mesh is not a
  /// manifold, and where a triangle straddles a parabolic curve that is a feature. The whole box is one of them if
  /// CGAL's mesher gave up, because the surface has bends much smaller than facets: some triangles are then missing,
  /// and others do not satisfy the criteria.
  std::vector<CGAL::Bbox_3> undecided_boxes;
  Parabolic_curves_3<Kernel> parabolic_curves; ///< if the mesh was asked to follow them
};

} // namespace equiaffine

#endif
