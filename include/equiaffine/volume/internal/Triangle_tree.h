// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_TRIANGLE_TREE_H
#define EQUIAFFINE_VOLUME_INTERNAL_TRIANGLE_TREE_H

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine {

/// The kernel in which distances are computed. Every floating-point kernel rounds them; this one is faster.
using Distance_kernel = CGAL::Simple_cartesian<double>;

/// The point of a triangle nearest to p. It lies in the triangle up to rounding. Source: C. Ericson, Real-Time
/// Collision Detection, 2005, section 5.1.5.
inline Distance_kernel::Point_3 nearest_point(const Distance_kernel::Triangle_3& triangle,
                                              const Distance_kernel::Point_3& p) {
  const auto &a = triangle[0], &b = triangle[1], &c = triangle[2];
  const auto ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double ab_ap = ab * ap, ac_ap = ac * ap;
  if (ab_ap <= 0 && ac_ap <= 0) return a;
  const double ab_bp = ab * bp, ac_bp = ac * bp;
  if (ab_bp >= 0 && ac_bp <= ab_bp) return b;
  const double weight_c = ab_ap * ac_bp - ab_bp * ac_ap;
  if (weight_c <= 0 && ab_ap >= 0 && ab_bp <= 0) return a + ab_ap / (ab_ap - ab_bp) * ab;
  const double ab_cp = ab * cp, ac_cp = ac * cp;
  if (ac_cp >= 0 && ab_cp <= ac_cp) return c;
  const double weight_b = ab_cp * ac_ap - ab_ap * ac_cp;
  if (weight_b <= 0 && ac_ap >= 0 && ac_cp <= 0) return a + ac_ap / (ac_ap - ac_cp) * ac;
  const double weight_a = ab_bp * ac_cp - ab_cp * ac_bp, bc_bp = ac_bp - ab_bp, cb_cp = ab_cp - ac_cp;
  if (weight_a <= 0 && bc_bp >= 0 && cb_cp >= 0) return b + bc_bp / (bc_bp + cb_cp) * (c - b);
  const double sum = weight_a + weight_b + weight_c;
  return a + (weight_b / sum * ab + weight_c / sum * ac);
}

/// A half-space relative to a point c: every point x has at least the distance `distance + direction * (x - c)` to
/// it.
struct Half_space {
  Distance_kernel::Vector_3 direction;
  double distance;
};

/// A binary tree of boxes of triangles, split at the median along the longest side. A part is a box or a triangle;
/// the root is part 0. Boxes are enlarged by `slack`, which bounds the displacement of points by rounding.
class Triangle_tree {
public:
  using Point_3 = Distance_kernel::Point_3;
  using Vector_3 = Distance_kernel::Vector_3;
  using Triangle_3 = Distance_kernel::Triangle_3;
  using Part = std::ptrdiff_t; ///< a box if not negative, or ~t for the triangle t

  Triangle_tree(std::vector<Triangle_3> triangles, double slack) : triangles_(std::move(triangles)), slack_(slack) {
    boxes_.reserve(triangles_.size());
    build(triangles_.begin(), triangles_.end());
  }

  double slack() const { return slack_; }
  static bool is_triangle(Part part) { return part < 0; }
  const Triangle_3& triangle(Part part) const { return triangles_[std::size_t(~part)]; }
  const std::array<Part, 2>& children(Part box) const { return boxes_[std::size_t(box)].children; }
  /// Half the diagonal of a box; 0 for a triangle.
  double radius(Part part) const { return is_triangle(part) ? 0 : boxes_[std::size_t(part)].radius; }

  Point_3 nearest_point(Part part, const Point_3& p) const {
    if (is_triangle(part)) return equiaffine::nearest_point(triangle(part), p);
    const auto& [lower, upper, radius, children] = boxes_[std::size_t(part)];
    return {std::clamp(p.x(), lower[0], upper[0]), std::clamp(p.y(), lower[1], upper[1]),
            std::clamp(p.z(), lower[2], upper[2])};
  }

  /// A half-space that contains the part and is about as far from p as the part. For a triangle it is computed from
  /// the vertices, so that it contains them however the nearest point is rounded.
  Half_space half_space(Part part, const Point_3& p) const {
    const Vector_3 v = p - nearest_point(part, p);
    const double length = std::sqrt(v.squared_length());
    const Vector_3 direction = length > 0 ? 1 / length * v : v;
    if (!is_triangle(part)) return {direction, length - slack_};
    const Triangle_3& t = triangle(part);
    return {direction, std::min({(p - t[0]) * direction, (p - t[1]) * direction, (p - t[2]) * direction}) - slack_};
  }

private:
  struct Box {
    std::array<double, 3> lower, upper;
    double radius;
    std::array<Part, 2> children;
  };
  using Iterator = std::vector<Triangle_3>::iterator;

  Part build(Iterator first, Iterator last) {
    if (last - first == 1) return ~(first - triangles_.begin());
    CGAL::Bbox_3 box;
    for (auto t = first; t != last; ++t) box += t->bbox();
    const std::array<double, 3> sides = {box.x_span(), box.y_span(), box.z_span()};
    const int axis = int(std::max_element(sides.begin(), sides.end()) - sides.begin());
    const auto middle = first + (last - first) / 2;
    const auto position = [axis](const Triangle_3& t) { return t[0][axis] + t[1][axis] + t[2][axis]; };
    std::nth_element(first, middle, last,
                     [&](const Triangle_3& t, const Triangle_3& u) { return position(t) < position(u); });
    const std::size_t n = boxes_.size();
    boxes_.push_back({{box.xmin() - slack_, box.ymin() - slack_, box.zmin() - slack_},
                      {box.xmax() + slack_, box.ymax() + slack_, box.zmax() + slack_},
                      std::hypot(sides[0], sides[1], sides[2]) / 2,
                      {}});
    const Part left = build(first, middle), right = build(middle, last);
    boxes_[n].children = {left, right};
    return Part(n);
  }

  std::vector<Triangle_3> triangles_;
  double slack_;
  std::vector<Box> boxes_;
};

} // namespace equiaffine

#endif
