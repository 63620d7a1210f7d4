// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_SEGMENT_ORACLE_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_SEGMENT_ORACLE_3_H

#include <equiaffine/function/first_order_bounds.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/project_to_surface.h>
#include <equiaffine/surface/sign_change.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace equiaffine::internal {

/// Finds where segments, rays and lines, the duals of the facets of a Delaunay triangulation, meet a surface. They are
/// cut to the clip domain before the signs at their ends are compared, so that sheets of the surface outside of it do
/// not matter. Const members may be called from several threads at once if those of `Traits` may.
template <ImplicitFunctionTraits_3 Traits>
class Segment_oracle_3 {
public:
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// A segment longer than `certified_length` may have two roots and no sign change. If the bounds of the function
  /// cannot exclude that, its halves are searched, down to pieces of that length.
  Segment_oracle_3(Traits traits, const Clip_domain_3& domain, double certified_length = infinity)
      : traits_(std::move(traits)), domain_(domain), certified_length_(certified_length) {}

  /// A point of the surface on p + t d, first <= t <= last (which may be infinite), inside the domain.
  std::optional<Point_3> operator()(const Point_3& p, const Vector_3& d, double first, double last) const {
    const auto clipped = domain_.clip(p, d, first, last);
    if (!clipped) return std::nullopt;
    const auto at = [&](double t) { return t == 0 ? p : t == 1 && t == last ? p + d : p + FT(t) * d; }; // exact ends
    const Point_3 a = at(clipped->first), b = at(clipped->second);
    return on_segment(a, b, traits_.value(a), traits_.value(b));
  }

  bool is_inside(const Point_3& p) const { return domain_.contains(p) && traits_.value(p) < FT(0); }

  const Traits& traits() const { return traits_; }
  const Clip_domain_3& domain() const { return domain_; }

private:
  /// A root between a and b, where f has the values fa and fb.
  std::optional<Point_3> on_segment(const Point_3& a, const Point_3& b, const FT& fa, const FT& fb) const {
    if (is_sign_change(fa, fb)) {
      const auto root = intersect_segment(traits_, a, b, fa, fb);
      if (root.has_converged) return root.point;
      return std::nullopt;
    }
    if (fa == fa && fb != fb) return before_undefined(a, b, fa);
    if (fb == fb && fa != fa) return before_undefined(b, a, fb);
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>) {
      const Vector_3 d = b - a;
      if (d.squared_length() > FT(certified_length_ * certified_length_) && may_have_two_roots(a, b, d)) {
        const Point_3 middle = a + d / FT(2);
        const FT f = traits_.value(middle);
        if (const auto root = on_segment(a, middle, fa, f)) return root;
        return on_segment(middle, b, f, fb);
      }
    }
    return std::nullopt;
  }

  /// A root between a, where f has the value fa, and the place on the way to b from which on f is undefined.
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

  /// Returns false if f is proved to be monotone on the segment from a to b = a + d, or to have no zero in its box.
  bool may_have_two_roots(const Point_3& a, const Point_3& b, const Vector_3& d) const {
    const auto jet = first_order_bounds(traits_, a.bbox() + b.bbox());
    const auto& c = jet.coefficients();
    if (!c[0].contains(0)) return false;
    return (c[1] * Interval(CGAL::to_double(d.x())) + c[2] * Interval(CGAL::to_double(d.y())) +
            c[3] * Interval(CGAL::to_double(d.z())))
        .contains(0);
  }

  Traits traits_;
  Clip_domain_3 domain_;
  double certified_length_;
};

} // namespace equiaffine::internal

#endif
