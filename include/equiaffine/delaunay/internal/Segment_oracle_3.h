// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_SEGMENT_ORACLE_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_SEGMENT_ORACLE_3_H

#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace equiaffine::internal {

/// Calls visit(x, y, z) for points of a sphere, which a spiral about its axis spreads evenly.
template <class Visit>
void for_each_point_of_sphere(const std::array<double, 3>& center, double radius, double spacing, const Visit& visit) {
  using std::numbers::pi;
  const double count = std::ceil(4 * pi * (radius / spacing) * (radius / spacing)) + 4;
  for (double n = 0; n < count; ++n) {
    const double z = (2 * n + 1) / count - 1, r = std::sqrt(1 - z * z), angle = 2 * pi * n / std::numbers::phi;
    visit(center[0] + radius * r * std::cos(angle), center[1] + radius * r * std::sin(angle), center[2] + radius * z);
  }
}

/// Calls visit(x, y, z) for points of the faces of a box, the centers of squares.
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

/// Calls visit(x, y, z) for points of the border of a clip domain, with about `spacing` between neighbors.
template <class Visit>
void for_each_border_point(const Clip_domain_3& domain, double spacing, const Visit& visit) {
  if (domain.is_ball()) for_each_point_of_sphere(domain.center(), domain.radius(), spacing, visit);
  else for_each_point_of_box(domain.bbox(), spacing, visit);
}

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
  /// cannot exclude that, its halves are searched, down to pieces of that length. Where there may be a pole beside a
  /// root, pieces are a sixteenth as long.
  Segment_oracle_3(Traits traits, const Clip_domain_3& domain, double certified_length = infinity)
      : traits_(std::move(traits)), domain_(domain), certified_length_(certified_length),
        may_have_poles_(known_bounds(traits_).have_gradients &&
                        !is_bounded(first_order_bounds(traits_, domain.bbox()).value())) {}

  /// A point of the surface on p + t d, first <= t <= last (which may be infinite), inside the domain.
  std::optional<Point_3> operator()(const Point_3& p, const Vector_3& d, double first, double last) const {
    const auto clipped = domain_.clip(p, d, first, last);
    if (!clipped) return std::nullopt;
    const auto at = [&](double t) { return t == 0 ? p : t == 1 && t == last ? p + d : p + FT(t) * d; }; // exact ends
    const Point_3 a = at(clipped->first), b = at(clipped->second);
    return on_segment(a, b, traits_.value(a), traits_.value(b));
  }

  /// A point where p + t d, first <= t <= last, enters or leaves the domain and f is negative.
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
    if (!is_to_be_halved(a, b, d, may_have_pole && fa == fa)) return std::nullopt;
    const Point_3 middle = a + d / FT(2);
    const FT f = traits_.value(middle);
    if (const auto root = on_segment(a, middle, fa, f)) return root;
    return on_segment(middle, b, f, fb);
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

  /// Whether there may be roots between a and b = a + d that the signs there do not show, and the segment is longer than
  /// pieces need to be.
  bool is_to_be_halved(const Point_3& a, const Point_3& b, const Vector_3& d, bool may_have_pole) const {
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

  /// Whether bounds of f exclude that it has a pole.
  static bool is_bounded(const Interval& bounds) {
    return std::isfinite(bounds.lower()) && std::isfinite(bounds.upper());
  }

  Traits traits_;
  Clip_domain_3 domain_;
  double certified_length_;
  bool may_have_poles_; // in the domain, by the bounds of f
};

} // namespace equiaffine::internal

#endif
