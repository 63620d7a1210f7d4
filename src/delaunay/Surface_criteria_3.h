// SPDX-License-Identifier: GPL-3.0-or-later
// The criteria by which CGAL's mesher refines facets, and the sizing field that bounds their radius.
#ifndef EQUIAFFINE_SRC_DELAUNAY_SURFACE_CRITERIA_3_H
#define EQUIAFFINE_SRC_DELAUNAY_SURFACE_CRITERIA_3_H

#include <equiaffine/delaunay/Delaunay_options.h>
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <CGAL/Weighted_point_3.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace equiaffine::internal {

/// The maximum radius of facets near a point, between radius/16 and radius.
class Facet_sizing_field {
public:
  Facet_sizing_field(const Any_function_3& function, const Clip_domain_3& domain, double radius, Facet_sizing sizing)
      : function_(function), radius_(radius), extent_(domain.diagonal() / 4), sizing_(sizing) {}

  template <class Point_3>
  double operator()(const Point_3& p) const {
    if (sizing_ == Facet_sizing::UNIFORM) return radius_;
    const auto structure = local_structure(function_.taylor(Any_function_3::Point_3(p.x(), p.y(), p.z())));
    const double size = sizing_ == Facet_sizing::EUCLIDEAN ? euclidean(structure) : affine(structure);
    if (size < radius_ / 16) return radius_ / 16;
    return size >= radius_ / 16 ? std::min(size, radius_) : radius_; // the radius also for NaN
  }

private:
  /// A quarter of the smaller radius of curvature.
  static double euclidean(const Local_structure_3<double>& s) {
    const auto& e = s.euclidean;
    return 0.25 / std::max(std::abs(e.k1), std::abs(e.k2));
  }

  /// The size for facets of equal affine area. It equals the radius where the Gaussian curvature is that of a sphere
  /// that fills the domain.
  double affine(const Local_structure_3<double>& s) const {
    return radius_ * std::pow(std::abs(s.euclidean.gaussian_curvature) * extent_ * extent_, -0.125);
  }

  Any_function_3 function_;
  double radius_, extent_;
  Facet_sizing sizing_;
};

/// A model of CGAL's MeshCriteria_3 for surfaces only. CGAL's own facet criteria measure the same; these avoid
/// virtual calls and can stop at a smallest facet.
template <class Triangulation>
class Surface_criteria_3 {
public:
  struct Facet_criteria {
    enum Criterion { ON_SURFACE, RADIUS, DISTANCE, ANGLE };
    using Facet_quality = std::pair<int, double>; ///< criterion, and bound / measured value: the worst come first
    using Is_facet_bad = Cgal_optional<Facet_quality>;

    Is_facet_bad operator()(const Triangulation& triangulation, const typename Triangulation::Facet& facet) const {
      const auto& [cell, opposite] = facet;
      const auto point = [&, c = cell, o = opposite ](int i) -> const auto& {
        return triangulation.point(c, (o + i) & 3);
      };
      const auto &p = point(1).point(), &q = point(2).point(), &r = point(3).point();
      const auto& center = cell->get_facet_surface_center(opposite);
      const double squared_radius = CGAL::squared_distance(center, p);
      if (squared_radius < smallest * smallest) return Is_facet_bad();
      double largest_weight = 0;
      bool touches_corner = false;
      for (int i = 1; i < 4; ++i) {
        const int dimension = cell->vertex((opposite + i) & 3)->in_dimension();
        if (dimension > 2) return bad(ON_SURFACE, 0);
        touches_corner = touches_corner || dimension == 0;
        largest_weight = std::max(largest_weight, double(point(i).weight()));
      }
      // No vertex may lie in or near a ball around a feature.
      if (squared_radius - point(1).weight() < clearance * largest_weight) return Is_facet_bad();
      const double bound = size(center);
      if (squared_radius > bound * bound) return bad(RADIUS, bound * bound / squared_radius);
      return touches_corner ? Is_facet_bad() : is_shape_bad(p, q, r, squared_radius);
    }

    /// The criteria for angle and distance, for a triangle with a surface Delaunay ball of the given radius.
    template <class Point_3>
    Is_facet_bad is_shape_bad(const Point_3& p, const Point_3& q, const Point_3& r, double squared_radius) const {
      const double a = CGAL::squared_distance(q, r), b = CGAL::squared_distance(r, p), c = CGAL::squared_distance(p, q);
      const double squared_area = CGAL::cross_product(q - p, r - p).squared_length(); // of the parallelogram
      const double sine_squared = squared_area * std::min({a, b, c}) / (a * b * c);   // of the smallest angle
      if (sine_squared < least_sine * least_sine) return bad(ANGLE, sine_squared);
      const double squared_circumradius = a * b * c / (4 * squared_area);
      const double squared_distance = squared_radius - squared_circumradius;
      if (squared_distance > distance * distance) return bad(DISTANCE, distance * distance / squared_distance);
      return Is_facet_bad();
    }

    static Is_facet_bad bad(Criterion criterion, double quality) {
      return Is_facet_bad(Facet_quality(criterion, quality));
    }

    static constexpr double clearance = 2; // minimum square of distance / radius of a ball around a feature

    double squared_min_radius_bound() const { return smallest * smallest; } // required by CGAL 6

    Facet_sizing_field size;
    double least_sine, distance, smallest;
  };

  struct Cell_criteria {
    using Cell_quality = double;
    using Is_cell_bad = Cgal_optional<Cell_quality>;
    Is_cell_bad operator()(const Triangulation&, const typename Triangulation::Cell_handle&) const { return {}; }
  };

  /// Facets with a surface Delaunay ball of a radius below `smallest` are not refined.
  Surface_criteria_3(const Delaunay_criteria& criteria, const Facet_sizing_field& size, double smallest)
      : facet_criteria_{size, std::sin(criteria.angle * std::numbers::pi / 180), criteria.distance, smallest} {}

  const Facet_criteria& facet_criteria_object() const { return facet_criteria_; }
  const Cell_criteria& cell_criteria_object() const { return cell_criteria_; }

private:
  Facet_criteria facet_criteria_;
  Cell_criteria cell_criteria_;
};

} // namespace equiaffine::internal

#endif
