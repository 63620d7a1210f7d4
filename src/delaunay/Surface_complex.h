// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_SURFACE_COMPLEX_H
#define EQUIAFFINE_SRC_DELAUNAY_SURFACE_COMPLEX_H

#include "delaunay/Memoized_function_3.h"
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>

namespace equiaffine::internal {

/// The domain for CGAL's mesher. It has a surface and no interior, so that the mesher never asks on which side of the
/// surface a point is.
struct Surface_domain_3 : Implicit_mesh_domain_3<Memoized_function_3> {
  using Implicit_mesh_domain_3::Implicit_mesh_domain_3;

  struct Is_in_domain {
    Subdomain operator()(const Point_3&) const { return Subdomain(); }
  };
  Is_in_domain is_in_domain_object() const { return {}; }
  Construct_intersection construct_intersection_object() const { return construct_intersection_with_zero_set_object(); }
  Do_intersect_surface do_intersect_surface_object() const { return {construct_intersection_object()}; }
};

/// A triangulation, and which of its facets approximate the surface. The `in_dimension()` of a vertex is 0 for corners
/// of features and singular points, 1 on curves that are features, 2 on the rest of the surface, and 3 elsewhere.
using Surface_triangulation = CGAL::Mesh_triangulation_3<Surface_domain_3>::type;
using Surface_vertex = Surface_triangulation::Vertex_handle;
using Surface_complex = CGAL::Mesh_complex_3_in_triangulation_3<Surface_triangulation>;

} // namespace equiaffine::internal

#endif
