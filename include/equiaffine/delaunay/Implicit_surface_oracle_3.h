// SPDX-License-Identifier: GPL-3.0-or-later
// This header is for programs that use CGAL's package 3D Surface Mesh Generation, which is deprecated since CGAL 6. For
// a new program, use delaunay_surface.h, or Implicit_mesh_domain_3.h and CGAL::make_mesh_3. No other header includes
// this one, and it includes no header of that package.
#ifndef EQUIAFFINE_DELAUNAY_IMPLICIT_SURFACE_ORACLE_3_H
#define EQUIAFFINE_DELAUNAY_IMPLICIT_SURFACE_ORACLE_3_H

#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>

#include <CGAL/Object.h>

#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

namespace equiaffine {

/// A model of CGAL's SurfaceMeshTraits_3 for CGAL::make_surface_mesh, whose surface is the zero set of an
/// `Implicit_mesh_domain_3`. Use it in place of CGAL::Implicit_surface_3 and its traits:
///
///     const Domain surface(traits, clip_domain, facet_size);
///     CGAL::make_surface_mesh(complex, surface, Implicit_surface_oracle_3<Domain>(), criteria, CGAL::Manifold_tag());
///
/// Vertices are exact up to rounding, there are initial points on every component that is closed within the clip
/// domain, and parts of the surface outside of the clip domain do no harm. The oracle has no state.
template <class Domain>
class Implicit_surface_oracle_3 {
public:
  using Surface_3 = Domain;                     ///< the surface, an Implicit_mesh_domain_3
  using Point_3 = typename Domain::Point_3;     ///< points of the mesher
  using Segment_3 = typename Domain::Segment_3; ///< segments of the mesher
  using Ray_3 = typename Domain::Ray_3;         ///< rays of the mesher
  using Line_3 = typename Domain::Line_3;       ///< lines of the mesher
  using Intersection_point = Point_3;           ///< the type of an intersection

  /// The functor that intersects a segment, a ray or a line with the surface.
  struct Intersect_3 {
    /// `query` is a Segment_3, Ray_3 or Line_3; gives an Intersection_point or nothing.
    template <class Query>
    CGAL::Object operator()(const Surface_3& surface, const Query& query) const {
      const auto intersection = surface.construct_intersection_with_zero_set_object()(query);
      if (std::get<2>(intersection) == 0) return CGAL::Object();
      return CGAL::make_object(Intersection_point(std::get<0>(intersection)));
    }
  };

  /// The functor that finds the points with which the mesher begins.
  struct Construct_initial_points {
    /// Writes points, as many as certainty and the facet size need. The number that the mesher asks for is ignored.
    template <class OutputIterator>
    OutputIterator operator()(const Surface_3& surface, OutputIterator out, int = 0) const {
      std::vector<std::pair<Point_3, typename Surface_3::Index>> points;
      surface.construct_initial_points_of_zero_set_object()(std::back_inserter(points));
      for (const auto& [p, index] : points) *out++ = p;
      return out;
    }
  };

  Intersect_3 intersect_3_object() const { return {}; }                           ///< the functor
  Construct_initial_points construct_initial_points_object() const { return {}; } ///< the functor
};

} // namespace equiaffine

#endif
