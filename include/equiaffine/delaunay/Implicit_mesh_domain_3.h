// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_IMPLICIT_MESH_DOMAIN_3_H
#define EQUIAFFINE_DELAUNAY_IMPLICIT_MESH_DOMAIN_3_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/delaunay/Delaunay_criteria.h>
#include <equiaffine/delaunay/internal/Cgal_optional.h>
#include <equiaffine/delaunay/internal/Segment_oracle_3.h>
#include <equiaffine/delaunay/internal/certified_seeding.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/tags.h>

#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

namespace equiaffine {

/// A model of CGAL's MeshDomain_3: the part of a clip domain where f < 0. Its surface is the zero set of f, patch 1, and
/// the part of the border of the clip domain where f < 0, patch 2. Use it in CGAL::make_mesh_3 in place of
/// CGAL::Labeled_mesh_domain_3. Vertices on the surface are exact up to rounding, every component of the zero set that
/// is closed within the clip domain gets initial points, and parts of the surface outside of the clip domain do no
/// harm. The edges of a box, and those where the zero set meets the border, are no features: facets cut them off by as
/// much as the criteria allow.
///
/// `Kernel` is the kernel of the mesher, to which the points of the function are converted. Copies share the function.
template <ImplicitFunctionTraits_3 Traits, class Kernel = CGAL::Exact_predicates_inexact_constructions_kernel>
class Implicit_mesh_domain_3 {
  using Oracle = internal::Segment_oracle_3<Traits>;

public:
  using R = Kernel;                             ///< the kernel
  using FT = typename Kernel::FT;               ///< its number type
  using Point_3 = typename Kernel::Point_3;     ///< its points
  using Vector_3 = typename Kernel::Vector_3;   ///< its vectors
  using Segment_3 = typename Kernel::Segment_3; ///< its segments
  using Ray_3 = typename Kernel::Ray_3;         ///< its rays
  using Line_3 = typename Kernel::Line_3;       ///< its lines

  using Has_features = CGAL::Tag_false;             ///< there are no features of dimension 0 and 1
  using Subdomain_index = int;                      ///< 1 for the part where f < 0
  using Surface_patch_index = int;                  ///< 1 for the zero set, 2 for the border of the clip domain
  using Index = int;                                ///< of a subdomain or a surface patch
  using Subdomain = Cgal_optional<Subdomain_index>; ///< the index of the subdomain that has a point, or nothing
  /// The index of the surface patch that a query meets, or nothing.
  using Surface_patch = Cgal_optional<Surface_patch_index>;
  /// A point, the index of the surface patch, and 2; or 0 in the last place for none.
  using Intersection = std::tuple<Point_3, Index, int>;

  /// `facet_size` is the bound of the radii of surface Delaunay balls that the mesher will be given, or 0 for the
  /// default of `Delaunay_criteria`. Initial points are as dense as that, and on dual edges longer than twice that,
  /// pairs of intersections are looked for. \throw std::invalid_argument if it is negative or not finite
  Implicit_mesh_domain_3(Traits traits, const Clip_domain_3& domain, double facet_size = 0)
      : facet_size_(facet_size > 0 ? facet_size : Delaunay_criteria::default_radius(domain)),
        oracle_(std::make_shared<const Oracle>(std::move(traits), domain, 2 * facet_size_)) {
    check_argument(facet_size >= 0 && std::isfinite(facet_size),
                   "the facet size of a mesh domain is not a positive length: choose one, or 0 for the default");
  }
  /// Takes the box of the function as the clip domain, and the default facet size.
  explicit Implicit_mesh_domain_3(Traits traits) : Implicit_mesh_domain_3(traits, Clip_domain_3(traits.bbox())) {}

  /// The functor that finds the points with which the mesher begins.
  struct Construct_initial_points {
    /// Writes pairs of Point_3 and Index, as many as certainty and the facet size need. The number of points that the
    /// mesher asks for is ignored.
    template <class OutputIterator>
    OutputIterator operator()(OutputIterator out, int = 0) const {
      const auto size = [this](const auto&) { return facet_size; };
      const auto seeding = certified_seeding(oracle->traits(), oracle->domain(), size, facet_size);
      for (const auto& p : seeding.seeds) *out++ = std::pair(to_kernel(p), zero_set_index);
      if (!has_border) return out;
      internal::for_each_border_point(oracle->domain(), facet_size, [&](double x, double y, double z) {
        const typename Traits::Point_3 p(x, y, z);
        if (oracle->traits().value(p) < typename Traits::FT(0)) *out++ = std::pair(to_kernel(p), border_index);
      });
      return out;
    }

    std::shared_ptr<const Oracle> oracle; ///< the function in its clip domain
    double facet_size;                    ///< bound of the radii of surface Delaunay balls
    bool has_border = true;               ///< whether the border of the clip domain belongs to the surface
  };

  /// The functor that says in which subdomain a point lies.
  struct Is_in_domain {
    /// 1 if f(p) < 0 in the clip domain, else nothing.
    Subdomain operator()(const Point_3& p) const {
      return oracle->is_inside(to_traits(p)) ? Subdomain(subdomain_index_inside) : Subdomain();
    }

    std::shared_ptr<const Oracle> oracle; ///< the function in its clip domain
  };

  /// The functor that intersects a segment, a ray or a line with the surface.
  struct Construct_intersection {
    /// A point of the surface on a segment.
    Intersection operator()(const Segment_3& s) const { return find(s.source(), s.to_vector(), 0, 1); }
    /// A point of the surface on a ray.
    Intersection operator()(const Ray_3& r) const { return find(r.source(), r.to_vector(), 0, infinity); }
    /// A point of the surface on a line.
    Intersection operator()(const Line_3& l) const { return find(l.point(), l.to_vector(), -infinity, infinity); }

    /// A point p + t d of the surface with `first` <= t <= `last`, in the clip domain.
    Intersection find(const Point_3& p, const Vector_3& d, double first, double last) const {
      const typename Traits::Vector_3 direction(d.x(), d.y(), d.z());
      if (const auto q = (*oracle)(to_traits(p), direction, first, last)) return {to_kernel(*q), zero_set_index, 2};
      if (has_border)
        if (const auto q = oracle->on_border(to_traits(p), direction, first, last))
          return {to_kernel(*q), border_index, 2};
      return Intersection(Point_3(CGAL::ORIGIN), 0, 0);
    }

    std::shared_ptr<const Oracle> oracle; ///< the function in its clip domain
    bool has_border = true;               ///< whether the border of the clip domain belongs to the surface
  };

  /// The functor that says whether a segment, a ray or a line meets the surface.
  struct Do_intersect_surface {
    /// The index of the patch that the query meets, or nothing.
    template <class Query>
    Surface_patch operator()(const Query& query) const {
      const Intersection found = intersect(query);
      return std::get<2>(found) == 0 ? Surface_patch() : Surface_patch(std::get<1>(found));
    }

    Construct_intersection intersect; ///< finds a point where they meet
  };

  Construct_initial_points construct_initial_points_object() const { return {oracle_, facet_size_}; } ///< the functor
  Is_in_domain is_in_domain_object() const { return {oracle_}; }                                      ///< the functor
  Construct_intersection construct_intersection_object() const { return {oracle_}; }                  ///< the functor
  Do_intersect_surface do_intersect_surface_object() const {
    return {construct_intersection_object()};
  } ///< the functor

  /// @{
  /// The functors for a mesh of the zero set alone, which ends at the border of the clip domain.
  Construct_initial_points construct_initial_points_of_zero_set_object() const { return {oracle_, facet_size_, false}; }
  Construct_intersection construct_intersection_with_zero_set_object() const { return {oracle_, false}; }
  /// @}

  Index index_from_surface_patch_index(const Surface_patch_index& index) const { return index; } ///< the same number
  Index index_from_subdomain_index(const Subdomain_index& index) const { return index; }         ///< the same number
  Surface_patch_index surface_patch_index(const Index& index) const { return index; }            ///< the same number
  Subdomain_index subdomain_index(const Index& index) const { return index; }                    ///< the same number
  CGAL::Bbox_3 bbox() const { return oracle_->domain().bbox(); } ///< the box of the clip domain

  const Traits& traits() const { return oracle_->traits(); }        ///< the function
  const Clip_domain_3& domain() const { return oracle_->domain(); } ///< the clip domain

private:
  static constexpr int zero_set_index = 1, border_index = 2, subdomain_index_inside = 1;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  static Point_3 to_kernel(const typename Traits::Point_3& p) { return convert_point<Kernel>(p); }
  static typename Traits::Point_3 to_traits(const Point_3& p) { return convert_point<Kernel_of<Traits>>(p); }

  double facet_size_;
  std::shared_ptr<const Oracle> oracle_;
};

} // namespace equiaffine

#endif
