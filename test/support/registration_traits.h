// SPDX-License-Identifier: GPL-3.0-or-later
// Functions derived from others, for tests and benchmarks of registration: a piece of one, several in disjoint boxes,
// and one with wrong derivatives.
#ifndef EQUIAFFINE_TEST_SUPPORT_REGISTRATION_TRAITS_H
#define EQUIAFFINE_TEST_SUPPORT_REGISTRATION_TRAITS_H

#include "support/registration_cases.h"
#include <equiaffine/function/capabilities.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace registration_cases {

/// A function restricted to the side n . p <= offset of a plane.
template <class Base>
struct Piece {
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;

  Base base;
  Eigen::Vector3d normal;
  double offset;

  bool contains(const Point_3& p) const { return normal.dot(Eigen::Vector3d(p.x(), p.y(), p.z())) <= offset; }
  double value(const Point_3& p) const { return contains(p) ? base.value(p) : nan(); }
  equiaffine::Jet_3<double, 1> first_order(const Point_3& p) const {
    return contains(p) ? equiaffine::first_order(base, p) : equiaffine::Jet_3<double, 1>(nan());
  }
  equiaffine::Jet_3<double> taylor(const Point_3& p) const {
    return contains(p) ? base.taylor(p) : equiaffine::Jet_3<double>(nan());
  }
  CGAL::Bbox_3 bbox() const { return base.bbox(); }

  std::vector<Point_3> points_of(std::vector<Point_3> points) const {
    std::erase_if(points, [&](const Point_3& p) { return !contains(p); });
    return points;
  }

private:
  static double nan() { return std::numeric_limits<double>::quiet_NaN(); }
};

/// Several functions, each in its own box. The boxes are disjoint.
template <class Base>
struct Scene {
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;

  std::vector<Base> objects = {};

  double value(const Point_3& p) const {
    const Base* object = object_at(p);
    return object ? object->value(p) : nan();
  }
  equiaffine::Jet_3<double, 1> first_order(const Point_3& p) const {
    const Base* object = object_at(p);
    return object ? equiaffine::first_order(*object, p) : equiaffine::Jet_3<double, 1>(nan());
  }
  equiaffine::Jet_3<double> taylor(const Point_3& p) const {
    const Base* object = object_at(p);
    return object ? object->taylor(p) : equiaffine::Jet_3<double>(nan());
  }
  CGAL::Bbox_3 bbox() const {
    CGAL::Bbox_3 box;
    for (const Base& object : objects) box += object.bbox();
    return box;
  }

private:
  const Base* object_at(const Point_3& p) const {
    for (const Base& object : objects)
      if (CGAL::do_overlap(object.bbox(), p.bbox())) return &object;
    return nullptr;
  }

  static double nan() { return std::numeric_limits<double>::quiet_NaN(); }
};

/// A function whose derivatives of orders 2 to 4 have random relative errors, which are constant within a cell.
template <class Base>
struct Disturbed {
  using FT = double;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;

  Base base;
  double part, cell;
  unsigned seed;

  double value(const Point_3& p) const { return base.value(p); }
  equiaffine::Jet_3<double, 1> first_order(const Point_3& p) const { return equiaffine::first_order(base, p); }
  equiaffine::Jet_3<double> taylor(const Point_3& p) const {
    auto jet = base.taylor(p);
    unsigned number = seed;
    for (int a = 0; a < 3; ++a) number = number * 2654435761u + unsigned(int(std::floor(p[a] / cell))) * 40503u + 977u;
    Random random(number % 2147483000u + 1);
    for (std::size_t n = 4; n < jet.size; ++n) jet.coefficients()[n] *= 1 + part * random.normal();
    return jet;
  }
  CGAL::Bbox_3 bbox() const { return base.bbox(); }
};

} // namespace registration_cases

#endif
