// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_BOX_INTERVALS_H
#define EQUIAFFINE_FUNCTION_INTERNAL_BOX_INTERVALS_H

#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/monomials_3.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>

namespace equiaffine::internal {

/// The intervals of x, y and z over a box.
inline std::array<Interval, 3> sides_of(const CGAL::Bbox_3& box) {
  return {Interval(box.xmin(), box.xmax()), Interval(box.ymin(), box.ymax()), Interval(box.zmin(), box.zmax())};
}

inline std::array<double, 3> center_of(const CGAL::Bbox_3& box) {
  return {(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2};
}

/// The box that contains the point only.
inline CGAL::Bbox_3 box_of_point(const std::array<double, 3>& p) {
  return CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
}

/// The intervals of the vectors from the center to the points of a box.
inline std::array<Interval, 3> offset_from_center(const CGAL::Bbox_3& box, const std::array<double, 3>& center) {
  std::array<Interval, 3> offset = sides_of(box);
  for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] = offset[axis] - Interval(center[axis]);
  return offset;
}

/// The index of the monomial that is the product of two coordinates.
inline std::size_t index_of_product(std::size_t axis, std::size_t other_axis) {
  std::array<int, 3> exponents = {};
  ++exponents[axis];
  ++exponents[other_axis];
  return std::size_t(monomial_index(exponents[0], exponents[1], exponents[2]));
}

/// Bounds of value and gradient on a box by the mean value theorem: f lies in f(c) + sum of f_a offset_a, and its
/// derivative f_a along axis a lies in f_a(c) + sum of f_ab offset_b. Here c is a point of the box, `at_point` has the
/// bounds at c, `on_box` has the bounds on the box, and `offset` the vectors from c to the points of the box. The
/// result is the intersection of these bounds with those in `on_box`.
inline Jet_3<Interval, 1> mean_value_bounds(const Jet_3<Interval, 2>& on_box, const Jet_3<Interval, 1>& at_point,
                                            const std::array<Interval, 3>& offset) {
  const auto& derivatives = on_box.coefficients();
  std::array<Interval, 4> sum = at_point.coefficients();
  for (std::size_t a = 0; a < 3; ++a) {
    sum[0] += derivatives[1 + a] * offset[a];
    for (std::size_t b = 0; b < 3; ++b) // the Taylor coefficient of x_a^2 is half of f_aa
      sum[1 + a] += derivatives[index_of_product(a, b)] * offset[b] * Interval(a == b ? 2 : 1);
  }
  Jet_3<Interval, 1> bounds;
  for (std::size_t n = 0; n < 4; ++n) bounds.coefficients()[n] = Interval::intersection(derivatives[n], sum[n]);
  return bounds;
}

} // namespace equiaffine::internal

#endif
