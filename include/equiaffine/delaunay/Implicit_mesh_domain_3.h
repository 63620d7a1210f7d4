// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a clip domain where a function is negative, for CGAL's 3D Mesh Generation.
#ifndef EQUIAFFINE_DELAUNAY_IMPLICIT_MESH_DOMAIN_3_H
#define EQUIAFFINE_DELAUNAY_IMPLICIT_MESH_DOMAIN_3_H

#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/delaunay/Delaunay_options.h>
#include <equiaffine/delaunay/internal/certified_seeding.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/number_utils.h>
#include <CGAL/tags.h>
#include <CGAL/version.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#if CGAL_VERSION_NR < 1060000000
#include <boost/optional.hpp>
#endif

namespace equiaffine::internal {

/// The optional type of CGAL's mesher: the standard library's since CGAL 6, Boost's before.
#if CGAL_VERSION_NR >= 1060000000
template <class T>
using Cgal_optional = std::optional<T>;
#else
template <class T>
using Cgal_optional = boost::optional<T>;
#endif

/// Calls visit(x, y, z) for points spread evenly over a sphere by a spiral around its axis.
template <class Visit>
void for_each_point_of_sphere(const std::array<double, 3>& center, double radius, double spacing, const Visit& visit) {
  using std::numbers::pi;
  const double count = std::ceil(4 * pi * (radius / spacing) * (radius / spacing)) + 4;
  for (double n = 0; n < count; ++n) {
    const double z = (2 * n + 1) / count - 1, r = std::sqrt(1 - z * z), angle = 2 * pi * n / std::numbers::phi;
    visit(center[0] + radius * r * std::cos(angle), center[1] + radius * r * std::sin(angle), center[2] + radius * z);
  }
}

/// Calls visit(x, y, z) for points on the faces of a box, the centers of a grid of rectangles.
template <class Visit>
void for_each_point_of_box(const CGAL::Bbox_3& box, double spacing, const Visit& visit) {
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const double width = box.max(b) - box.min(b), height = box.max(c) - box.min(c);
    const double columns = std::ceil(width / spacing), rows = std::ceil(height / spacing);
    for (double i = 0; i < columns; ++i)
      for (double j = 0; j < rows; ++j)
        for (const double at : {box.min(a), box.max(a)}) {
          std::array<double, 3> p;
          p[std::size_t(a)] = at;
          p[std::size_t(b)] = box.min(b) + width * (i + 0.5) / columns;
          p[std::size_t(c)] = box.min(c) + height * (j + 0.5) / rows;
          visit(p[0], p[1], p[2]);
        }
  }
}

/// Calls visit(x, y, z) for points on the border of a clip domain, about `spacing` apart.
template <class Visit>
void for_each_border_point(const Clip_domain_3& domain, double spacing, const Visit& visit) {
  if (domain.is_ball()) for_each_point_of_sphere(domain.center(), domain.radius(), spacing, visit);
  else for_each_point_of_box(domain.bbox(), spacing, visit);
}

/// Intersects segments, rays, and lines, the duals of the facets of a Delaunay triangulation, with a surface. They
/// are clipped to the domain before the signs at their ends are compared, so that sheets of the surface outside the
/// domain have no effect. Const members are thread-safe if those of `Traits` are.
template <ImplicitFunctionTraits_3 Traits>
class Segment_oracle_3 {
public:
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// A segment longer than `certified_length` may have two roots and no sign change. If the bounds of the function
  /// cannot exclude that, its halves are searched, down to pieces of that length, or of a sixteenth of it where there
  /// may be a pole next to a root.
  Segment_oracle_3(Traits traits, const Clip_domain_3& domain, double certified_length = infinity)
      : traits_(std::move(traits)), domain_(domain), certified_length_(certified_length),
        may_have_poles_(known_bounds(traits_).have_gradients &&
                        !is_bounded(first_order_bounds(traits_, domain.bbox()).value())) {}

  /// A point of the surface on p + t d, first <= t <= last (which may be infinite), in the domain.
  std::optional<Point_3> operator()(const Point_3& p, const Vector_3& d, double first, double last) const {
    const auto clipped = domain_.clip(p, d, first, last);
    if (!clipped) return std::nullopt;
    const auto at = [&](double t) { return t == 0 ? p : t == 1 && t == last ? p + d : p + FT(t) * d; }; // exact ends
    const Point_3 a = at(clipped->first), b = at(clipped->second);
    return on_segment(a, b, traits_.value(a), traits_.value(b));
  }

  /// A point at which p + t d, first <= t <= last, enters or leaves the domain and f is negative.
  std::optional<Point_3> on_border(const Point_3& p, const Vector_3& d, double first, double last) const {
    const auto clipped = domain_.clip(p, d, first, last);
    if (!clipped) return std::nullopt;
    for (const auto& [t, end] : {std::pair(clipped->first, first), std::pair(clipped->second, last)})
      if (const Point_3 q = p + FT(t) * d; t != end && traits_.value(q) < FT(0)) return q;
    return std::nullopt;
  }

  bool is_inside(const Point_3& p) const { return domain_.contains(p) && traits_.value(p) < FT(0); }

  const Traits& traits() const { return traits_; }
  const Clip_domain_3& domain() const { return domain_; }

private:
  /// A root between a and b, where f has the values fa and fb.
  std::optional<Point_3> on_segment(const Point_3& a, const Point_3& b, const FT& fa, const FT& fb) const {
    bool may_have_pole = may_have_poles_;
    if (is_sign_change(fa, fb)) {
      const auto root = intersect_segment(traits_, a, b, fa, fb);
      if (root.has_converged) return root.point;
      may_have_pole = may_have_pole || root.is_at_pole;
    }
    if (fa == fa && fb != fb) return before_undefined(a, b, fa);
    if (fb == fb && fa != fa) return before_undefined(b, a, fb);
    const Vector_3 d = b - a;
    if (!needs_halving(a, b, d, may_have_pole && fa == fa)) return std::nullopt;
    const Point_3 middle = a + d / FT(2);
    const FT f = traits_.value(middle);
    if (const auto root = on_segment(a, middle, fa, f)) return root;
    return on_segment(middle, b, f, fb);
  }

  /// A root between a, where f has the value fa, and the point on the way to b beyond which f is undefined.
  std::optional<Point_3> before_undefined(Point_3 a, Point_3 b, const FT& fa) const {
    constexpr int halvings = 12;
    for (int n = 0; n < halvings; ++n) {
      const Point_3 middle = a + (b - a) / FT(2);
      const FT f = traits_.value(middle);
      if (!(f == f)) {
        b = middle;
      } else if ((f < FT(0)) == (fa < FT(0))) {
        a = middle;
      } else {
        return on_segment(a, middle, fa, f);
      }
    }
    return std::nullopt;
  }

  /// Whether there may be roots between a and b = a + d that the signs there do not show, and the segment is longer
  /// than the required pieces.
  bool needs_halving(const Point_3& a, const Point_3& b, const Vector_3& d, bool may_have_pole) const {
    constexpr double piece_beside_pole = 1.0 / 16; // its length / the certified length
    const double length = std::sqrt(CGAL::to_double(d.squared_length()));
    const bool is_long = length > certified_length_;
    if (!is_long && !(may_have_pole && length > piece_beside_pole * certified_length_)) return false;
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>) {
      const auto jet = first_order_bounds(traits_, a.bbox() + b.bbox());
      const auto& c = jet.coefficients();
      if (!c[0].contains(0)) return false;
      if (!is_bounded(c[0])) return true;
      return is_long && (c[1] * Interval(CGAL::to_double(d.x())) + c[2] * Interval(CGAL::to_double(d.y())) +
                         c[3] * Interval(CGAL::to_double(d.z())))
                            .contains(0);
    } else {
      return may_have_pole;
    }
  }

  /// Whether the bounds of f exclude a pole.
  static bool is_bounded(const Interval& bounds) {
    return std::isfinite(bounds.lower()) && std::isfinite(bounds.upper());
  }

  Traits traits_;
  Clip_domain_3 domain_;
  double certified_length_;
  bool may_have_poles_; // in the domain, by the bounds of f
};

} // namespace equiaffine::internal

namespace equiaffine {

/// A model of CGAL's MeshDomain_3: the part of a clip domain where f < 0. Its surface is the zero set of f, patch 1,
/// and the part of the border of the clip domain where f < 0, patch 2. Use it in CGAL::make_mesh_3 in place of
/// CGAL::Labeled_mesh_domain_3. Vertices on the surface are exact up to rounding. Every component of the zero set
/// that is closed within the clip domain gets initial points, and parts of the surface outside the clip domain have
/// no effect. The edges of a box and the curves where the zero set meets the border are not features: facets cut them
/// off by as much as the criteria allow.
///
/// `Kernel` is the kernel of the mesher, to which the points of the function are converted. Copies share the
/// function.
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

  using Has_features = CGAL::Tag_false; ///< there are no features of dimension 0 and 1
  using Subdomain_index = int;          ///< 1 for the part where f < 0
  using Surface_patch_index = int;      ///< 1 for the zero set, 2 for the border of the clip domain
  using Index = int;                    ///< the index of a subdomain or a surface patch
  /// The index of the subdomain that contains a point, or nothing.
  using Subdomain = internal::Cgal_optional<Subdomain_index>;
  /// The index of the surface patch that a query intersects, or nothing.
  using Surface_patch = internal::Cgal_optional<Surface_patch_index>;
  /// A point, the index of its surface patch, and 2, or 0 if there is no intersection.
  using Intersection = std::tuple<Point_3, Index, int>;

  /// The radius of the options determines the density of the initial points. Dual edges longer than twice the radius
  /// are searched for pairs of intersections. \throw Input_error for bad options
  explicit Implicit_mesh_domain_3(const Traits& traits, const Mesh_domain_options& options = {})
      : facet_size_(radius_of(traits, options)),
        oracle_(std::make_shared<const Oracle>(traits, clip_domain(options.clip, traits.bbox()), 2 * facet_size_)) {}

  /// The functor that computes the initial points of the mesher.
  struct Construct_initial_points {
    /// Writes pairs of Point_3 and Index, as many as the certificate and the facet size require. Ignores the number
    /// of points that the mesher requests.
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
    double facet_size;                    ///< maximum radius of surface Delaunay balls
    bool has_border = true;               ///< whether the border of the clip domain belongs to the surface
  };

  /// The functor that returns the subdomain of a point.
  struct Is_in_domain {
    /// 1 if p lies in the clip domain and f(p) < 0, otherwise nothing.
    Subdomain operator()(const Point_3& p) const {
      return oracle->is_inside(to_traits(p)) ? Subdomain(subdomain_index_inside) : Subdomain();
    }

    std::shared_ptr<const Oracle> oracle; ///< the function in its clip domain
  };

  /// The functor that intersects a segment, a ray, or a line with the surface.
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

  /// The functor that decides whether a segment, a ray, or a line intersects the surface.
  struct Do_intersect_surface {
    /// The index of the patch that the query intersects, or nothing.
    template <class Query>
    Surface_patch operator()(const Query& query) const {
      const Intersection found = intersect(query);
      return std::get<2>(found) == 0 ? Surface_patch() : Surface_patch(std::get<1>(found));
    }

    Construct_intersection intersect; ///< computes the intersection
  };

  Construct_initial_points construct_initial_points_object() const { return {oracle_, facet_size_}; } ///< the functor
  Is_in_domain is_in_domain_object() const { return {oracle_}; }                                      ///< the functor
  Construct_intersection construct_intersection_object() const { return {oracle_}; }                  ///< the functor
  Do_intersect_surface do_intersect_surface_object() const {
    return {construct_intersection_object()};
  } ///< the functor

  /// @{
  /// The functors for a mesh of the zero set only, which ends at the border of the clip domain.
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

  static double radius_of(const Traits& traits, const Mesh_domain_options& options) {
    options.check();
    return options.radius ? *options.radius : default_radius(options.clip, traits.bbox());
  }

  static Point_3 to_kernel(const typename Traits::Point_3& p) { return convert_point<Kernel>(p); }
  static typename Traits::Point_3 to_traits(const Point_3& p) { return convert_point<Kernel_of<Traits>>(p); }

  double facet_size_;
  std::shared_ptr<const Oracle> oracle_;
};

} // namespace equiaffine

#endif
