// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IMPLICIT_MESH_DOMAIN_3_H
#define EQUIAFFINE_IMPLICIT_MESH_DOMAIN_3_H

#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/delaunay/Delaunay_criteria.h>
#include <equiaffine/delaunay/internal/Segment_oracle_3.h>
#include <equiaffine/delaunay/internal/shared/Cgal_optional.h>
#include <equiaffine/delaunay/internal/shared/certified_seeding.h>
#include <equiaffine/surface/internal/shared/convert_point.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/tags.h>

#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

namespace equiaffine {

/// A model of CGAL's MeshDomain_3: the part of a clip domain where f < 0, with the zero set of f as its surface. Use it
/// in CGAL::make_mesh_3 in place of CGAL::Labeled_mesh_domain_3. Vertices on the surface are exact up to rounding,
/// every component that is closed within the clip domain gets initial points, and parts of the surface outside of the
/// clip domain do no harm.
///
/// `Kernel` is the kernel of the mesher, to which the points of the function are converted. Copies share the function.
template <ImplicitFunctionTraits_3 Traits, class Kernel = CGAL::Exact_predicates_inexact_constructions_kernel>
class Implicit_mesh_domain_3 {
  using Oracle = internal::Segment_oracle_3<Traits>;

public:
  using R = Kernel;
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Vector_3 = typename Kernel::Vector_3;
  using Segment_3 = typename Kernel::Segment_3;
  using Ray_3 = typename Kernel::Ray_3;
  using Line_3 = typename Kernel::Line_3;

  using Has_features = CGAL::Tag_false;
  using Subdomain_index = int;
  using Surface_patch_index = int;
  using Index = int;
  using Subdomain = Cgal_optional<Subdomain_index>;
  using Surface_patch = Cgal_optional<Surface_patch_index>;
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
  explicit Implicit_mesh_domain_3(Traits traits) : Implicit_mesh_domain_3(traits, Clip_domain_3(traits.bbox())) {}

  struct Construct_initial_points {
    /// Writes pairs of Point_3 and Index, as many as certainty and the facet size need. The number of points that the
    /// mesher asks for is ignored.
    template <class OutputIterator>
    OutputIterator operator()(OutputIterator out, int = 0) const {
      const auto size = [this](const auto&) { return facet_size; };
      const auto seeding = certified_seeding(oracle->traits(), oracle->domain(), size, facet_size);
      for (const auto& p : seeding.seeds) *out++ = std::pair(to_kernel(p), surface_index);
      return out;
    }

    std::shared_ptr<const Oracle> oracle;
    double facet_size;
  };

  struct Is_in_domain {
    Subdomain operator()(const Point_3& p) const {
      return oracle->is_inside(to_traits(p)) ? Subdomain(subdomain_index_inside) : Subdomain();
    }

    std::shared_ptr<const Oracle> oracle;
  };

  struct Construct_intersection {
    Intersection operator()(const Segment_3& s) const { return find(s.source(), s.to_vector(), 0, 1); }
    Intersection operator()(const Ray_3& r) const { return find(r.source(), r.to_vector(), 0, infinity); }
    Intersection operator()(const Line_3& l) const { return find(l.point(), l.to_vector(), -infinity, infinity); }

    Intersection find(const Point_3& p, const Vector_3& d, double first, double last) const {
      const typename Traits::Vector_3 direction(d.x(), d.y(), d.z());
      if (const auto q = (*oracle)(to_traits(p), direction, first, last)) return {to_kernel(*q), surface_index, 2};
      return Intersection(Point_3(CGAL::ORIGIN), 0, 0);
    }

    std::shared_ptr<const Oracle> oracle;
  };

  struct Do_intersect_surface {
    template <class Query>
    Surface_patch operator()(const Query& query) const {
      return std::get<2>(Construct_intersection{oracle}(query)) == 0 ? Surface_patch() : Surface_patch(surface_index);
    }

    std::shared_ptr<const Oracle> oracle;
  };

  Construct_initial_points construct_initial_points_object() const { return {oracle_, facet_size_}; }
  Is_in_domain is_in_domain_object() const { return {oracle_}; }
  Construct_intersection construct_intersection_object() const { return {oracle_}; }
  Do_intersect_surface do_intersect_surface_object() const { return {oracle_}; }

  Index index_from_surface_patch_index(const Surface_patch_index& index) const { return index; }
  Index index_from_subdomain_index(const Subdomain_index& index) const { return index; }
  Surface_patch_index surface_patch_index(const Index& index) const { return index; }
  Subdomain_index subdomain_index(const Index& index) const { return index; }
  CGAL::Bbox_3 bbox() const { return oracle_->domain().bbox(); }

  const Traits& traits() const { return oracle_->traits(); }
  const Clip_domain_3& domain() const { return oracle_->domain(); }

private:
  static constexpr int surface_index = 1, subdomain_index_inside = 1;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  static Point_3 to_kernel(const typename Traits::Point_3& p) { return convert_point<Kernel>(p); }
  static typename Traits::Point_3 to_traits(const Point_3& p) { return convert_point<Kernel_of<Traits>>(p); }

  double facet_size_;
  std::shared_ptr<const Oracle> oracle_;
};

} // namespace equiaffine

#endif
