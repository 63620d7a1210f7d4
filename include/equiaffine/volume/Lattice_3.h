// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_LATTICE_3_H
#define EQUIAFFINE_VOLUME_LATTICE_3_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/convert_point.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/determinant.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// A grid of nx x ny x nz nodes in space: node (i, j, k) lies at origin + i e0 + j e1 + k e2. The steps e0, e1, e2
/// may have any lengths and directions, also left-handed ones, if their determinant is not zero. Nodes are stored
/// with i fastest. Lengths are in the user's coordinates.
template <class Kernel>
class Lattice_3 {
public:
  using FT = typename Kernel::FT;                                     ///< the number type of the kernel
  using Point_3 = typename Kernel::Point_3;                           ///< points of the kernel
  using Vector_3 = typename Kernel::Vector_3;                         ///< vectors of the kernel
  using Aff_transformation_3 = typename Kernel::Aff_transformation_3; ///< affine maps of the kernel
  using Size = std::array<std::size_t, 3>;                            ///< nx, ny, nz

  /// \throw std::invalid_argument unless there are at least two nodes along each axis, all coordinates are finite,
  /// and the steps are linearly independent
  /// \throw Input_error if the number of nodes overflows std::size_t
  Lattice_3(const Size& size, const Point_3& origin, const std::array<Vector_3, 3>& steps)
      : size_(size), origin_(origin), steps_(steps) {
    check_argument(size[0] >= 2 && size[1] >= 2 && size[2] >= 2,
                   "a lattice has fewer than two nodes along an axis: choose a larger size");
    if (size[0] > std::numeric_limits<std::size_t>::max() / size[1] / size[2])
      throw Input_error("the number of nodes of a lattice overflows: choose a smaller size");
    check_argument(is_finite(origin) && is_finite(steps[0]) && is_finite(steps[1]) && is_finite(steps[2]),
                   "the origin or a step of a lattice is not finite: choose a box with finite sides");
    check_argument(span_space(steps),
                   "the steps of a lattice are linearly dependent: choose a box with interior, or independent steps");
  }

  /// The axis-parallel lattice whose corner nodes are the corners of `box`. \throw std::invalid_argument also unless
  /// the lower bounds of the box are below its upper bounds
  Lattice_3(const Size& size, const CGAL::Bbox_3& box)
      : Lattice_3(size, Point_3(box.xmin(), box.ymin(), box.zmin()),
                  {Vector_3((box.xmax() - box.xmin()) / double(size[0] - 1), 0, 0),
                   Vector_3(0, (box.ymax() - box.ymin()) / double(size[1] - 1), 0),
                   Vector_3(0, 0, (box.zmax() - box.zmin()) / double(size[2] - 1))}) {
    check_argument(box.xmin() < box.xmax() && box.ymin() < box.ymax() && box.zmin() < box.zmax(),
                   "a lower bound of a box is not below its upper bound: give the lower bounds first, as in "
                   "CGAL::Bbox_3(xmin, ymin, zmin, xmax, ymax, zmax)");
  }

  /// The same lattice in another kernel with the same number type.
  template <class Other>
  explicit Lattice_3(const Lattice_3<Other>& other) requires std::is_same_v<typename Other::FT, FT>
      : Lattice_3(other.size(), convert_point<Kernel>(other.origin()),
                  {in_kernel(other.steps()[0]), in_kernel(other.steps()[1]), in_kernel(other.steps()[2])}) {}

  const Size& size() const { return size_; }                                     ///< nx, ny, nz
  std::size_t number_of_nodes() const { return size_[0] * size_[1] * size_[2]; } ///< nx ny nz
  /// The index of node (i, j, k), with i fastest.
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (k * size_[1] + j) * size_[0] + i; }

  const Point_3& origin() const { return origin_; }               ///< node (0, 0, 0)
  const std::array<Vector_3, 3>& steps() const { return steps_; } ///< e0, e1, e2

  /// The point with lattice coordinates (u, v, w), which are integers at the nodes.
  Point_3 point(const FT& u, const FT& v, const FT& w) const {
    return origin_ + (u * steps_[0] + v * steps_[1] + w * steps_[2]);
  }

  /// The signed volume of a cell, negative for a left-handed lattice.
  FT determinant() const {
    return CGAL::determinant(steps_[0].x(), steps_[0].y(), steps_[0].z(), steps_[1].x(), steps_[1].y(), steps_[1].z(),
                             steps_[2].x(), steps_[2].y(), steps_[2].z());
  }

  /// The map from lattice coordinates to space.
  Aff_transformation_3 transformation() const {
    const auto& e = steps_;
    return Aff_transformation_3(e[0].x(), e[1].x(), e[2].x(), origin_.x(), e[0].y(), e[1].y(), e[2].y(), origin_.y(),
                                e[0].z(), e[1].z(), e[2].z(), origin_.z());
  }

  /// The image of the lattice under an affine map.
  Lattice_3 transform(const Aff_transformation_3& map) const {
    return Lattice_3(size_, map(origin_), {map(steps_[0]), map(steps_[1]), map(steps_[2])});
  }

  /// The bounding box of the eight corner nodes.
  CGAL::Bbox_3 bbox() const {
    CGAL::Bbox_3 box = origin_.bbox();
    for (int corner = 1; corner < 8; ++corner)
      box += point(corner & 1 ? FT(size_[0] - 1) : FT(0), corner & 2 ? FT(size_[1] - 1) : FT(0),
                   corner & 4 ? FT(size_[2] - 1) : FT(0))
                 .bbox();
    return box;
  }

private:
  template <class Vector>
  static Vector_3 in_kernel(const Vector& v) {
    return Vector_3(FT(v.x()), FT(v.y()), FT(v.z()));
  }

  template <class Coordinates>
  static bool is_finite(const Coordinates& c) {
    return c.x() - c.x() == FT(0) && c.y() - c.y() == FT(0) && c.z() - c.z() == FT(0);
  }

  /// Whether three vectors are linearly independent. They are scaled first so that no product underflows.
  static bool span_space(std::array<Vector_3, 3> v) {
    for (Vector_3& u : v) u = u / std::max({CGAL::abs(u.x()), CGAL::abs(u.y()), CGAL::abs(u.z())});
    const FT volume = CGAL::cross_product(v[0], v[1]) * v[2];
    return volume < FT(0) || volume > FT(0); // false for NaN, from a zero vector
  }

  Size size_;
  Point_3 origin_;
  std::array<Vector_3, 3> steps_;
};

} // namespace equiaffine

#endif
