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

/// Where the dual edges of a Delaunay triangulation meet a surface. A segment, ray or line is cut to the clip domain
/// before the signs at its ends are compared: a sheet of the surface outside has no say. Const members may be called
/// from several threads at once; `Traits` decides whether values are remembered.
template <ImplicitFunctionTraits_3 Traits>
class Segment_oracle_3 {
public:
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// A pair of roots, which leaves no sign change, is looked for on pieces of a segment longer than `certified_length`,
  /// with the bounds of the function, as far as they cannot exclude it.
  Segment_oracle_3(Traits traits, const Clip_domain_3& domain, double certified_length = infinity)
      : traits_(std::move(traits)), domain_(domain), certified_length_(certified_length) {}

  /// A point of the surface on p + t d, first <= t <= last (which may be infinite), inside the domain.
  std::optional<Point_3> operator()(const Point_3& p, const Vector_3& d, double first, double last) const {
    const auto part = domain_.clip(p, d, first, last);
    if (!part) return std::nullopt;
    const auto at = [&](double t, double end) { return t == 0 ? p : t == 1 && end == 1 ? p + d : p + FT(t) * d; };
    const Point_3 a = at(part->first, last), b = at(part->second, last);
    return on_segment(a, b, traits_.value(a), traits_.value(b));
  }

  bool is_inside(const Point_3& p) const { return domain_.contains(p) && traits_.value(p) < FT(0); }

  const Traits& traits() const { return traits_; }
  const Clip_domain_3& domain() const { return domain_; }

private:
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

  /// A root between a and where f ceases to be defined on the way to b.
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

  /// False if f is monotone on the segment, or has no zero on its box.
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
