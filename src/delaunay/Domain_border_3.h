// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_DOMAIN_BORDER_3_H
#define EQUIAFFINE_SRC_DELAUNAY_DOMAIN_BORDER_3_H

#include <equiaffine/number/Jet_3.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace equiaffine::internal {

/// The border of a clip domain: the faces of a box, or a sphere, onto which the faces of a cube are projected from the
/// center of the sphere.
template <class Kernel>
class Domain_border_3 {
  using Point_3 = typename Kernel::Point_3;

public:
  struct Face {
    int axis; ///< normal to the face
    bool is_upper;
  };

  explicit Domain_border_3(const Clip_domain_3& domain) : domain_(domain), box_(domain.bbox()) {}

  bool is_sphere() const { return domain_.is_ball(); }
  const CGAL::Bbox_3& box() const { return box_; }

  /// The point of a face with parameters u and v, which go from 0 to 1 from side to side.
  Point_3 point(const Face& face, double u, double v) const {
    return is_sphere() ? point_of_sphere(face, u, v) : point_of_box(face, u, v);
  }

  /// The jet of a function that vanishes on the sphere, or on the plane of the nearer face normal to `axis`.
  Jet_3<double, 1> function(const Point_3& p, int axis) const {
    Jet_3<double, 1> g(0.0);
    if (is_sphere()) {
      double squared = 0;
      for (int a = 0; a < 3; ++a) {
        const double d = p[a] - domain_.center()[std::size_t(a)];
        squared += d * d;
        g.coefficients()[std::size_t(1 + a)] = d;
      }
      g.template at<0>() = (squared - domain_.radius() * domain_.radius()) / 2;
    } else {
      g.coefficients()[std::size_t(1 + axis)] = 1;
      g.template at<0>() = p[axis] - nearer_plane(p, axis);
    }
    return g;
  }

  /// p, moved into the plane of the nearer face normal to `axis`; on a sphere p itself.
  Point_3 snap(const Point_3& p, int axis) const {
    if (is_sphere()) return p;
    std::array<double, 3> x = {p.x(), p.y(), p.z()};
    at(x, axis) = nearer_plane(p, axis);
    return Point_3(x[0], x[1], x[2]);
  }

  /// Returns the axes other than `axis` along which p is outside of the box. There are none for a sphere.
  std::vector<int> axes_beyond(const Point_3& p, int axis) const {
    std::vector<int> axes;
    for (int b = 0; b < 3 && !is_sphere(); ++b)
      if (b != axis && !(p[b] >= box_.min(b) && p[b] <= box_.max(b))) axes.push_back(b);
    return axes;
  }

  static double& at(std::array<double, 3>& p, int a) { return p[std::size_t(a)]; }

private:
  double nearer_plane(const Point_3& p, int axis) const {
    const bool is_upper = 2 * p[axis] > box_.min(axis) + box_.max(axis);
    return is_upper ? box_.max(axis) : box_.min(axis);
  }

  Point_3 point_of_box(const Face& face, double u, double v) const {
    const int b = (face.axis + 1) % 3, c = (face.axis + 2) % 3;
    std::array<double, 3> p;
    at(p, face.axis) = face.is_upper ? box_.max(face.axis) : box_.min(face.axis);
    at(p, b) = std::lerp(box_.min(b), box_.max(b), u);
    at(p, c) = std::lerp(box_.min(c), box_.max(c), v);
    return Point_3(p[0], p[1], p[2]);
  }

  Point_3 point_of_sphere(const Face& face, double u, double v) const {
    const int b = (face.axis + 1) % 3, c = (face.axis + 2) % 3;
    std::array<double, 3> p;
    const auto slope = [](double t) { return std::tan(std::numbers::pi / 2 * (t - 0.5)); };
    const double x = slope(u), y = slope(v), scale = domain_.radius() / std::sqrt(1 + x * x + y * y);
    at(p, face.axis) = domain_.center()[std::size_t(face.axis)] + (face.is_upper ? scale : -scale);
    at(p, b) = domain_.center()[std::size_t(b)] + x * scale;
    at(p, c) = domain_.center()[std::size_t(c)] + y * scale;
    return Point_3(p[0], p[1], p[2]);
  }

  const Clip_domain_3& domain_;
  const CGAL::Bbox_3 box_;
};

} // namespace equiaffine::internal

#endif
