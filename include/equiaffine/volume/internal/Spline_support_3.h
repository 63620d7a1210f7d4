// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_SUPPORT_3_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_SUPPORT_3_H

#include <equiaffine/volume/Lattice_3.h>
#include <equiaffine/volume/internal/bspline_bounds.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace equiaffine::internal {

/// Finds the cells of a lattice that contain a point or meet a box. All points of the lattice are in the support, those
/// at its border even if rounding moves them out.
template <class Kernel>
class Spline_support_3 {
public:
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Lattice = Lattice_3<Kernel>;
  using Matrix = std::array<std::array<FT, 3>, 3>;

  /// A point of the support: its cell, and its place in the cell, in [0, 1] up to rounding.
  struct Place {
    std::array<std::size_t, 3> cell;
    std::array<FT, 3> offset;
  };

  /// The part of a box that is in the support.
  struct Common_box {
    Bspline_box<FT> box;
    bool is_whole_box = true; ///< if false, a part of the box is outside of the support
  };

  explicit Spline_support_3(const Lattice& lattice) : lattice_(lattice), to_lattice_(inverse_matrix(lattice)) {
    for (std::size_t a = 0; a < 3; ++a) slack_[a] = rounding_of_coordinate(a);
  }

  const Lattice& lattice() const { return lattice_; }

  /// The linear part of the map from space to lattice coordinates.
  const Matrix& to_lattice() const { return to_lattice_; }

  /// The greatest change of the lattice coordinates of a point of the lattice by rounding.
  const std::array<FT, 3>& slack() const { return slack_; }

  /// The place of a point, if it is in the support.
  std::optional<Place> locate(const Point_3& p) const {
    Place place;
    const auto d = p - lattice_.origin();
    for (std::size_t a = 0; a < 3; ++a) {
      const FT u = to_lattice_[a][0] * d.x() + to_lattice_[a][1] * d.y() + to_lattice_[a][2] * d.z();
      if (!is_inside(u, a)) return std::nullopt;
      place.cell[a] = cell(u, a);
      place.offset[a] = u - FT(place.cell[a]);
    }
    return place;
  }

  /// The box of the lattice around what a box and the support have in common, if they meet. A side that only rounding
  /// separates from a node is taken to be there.
  std::optional<Common_box> locate(const CGAL::Bbox_3& box) const {
    Common_box common;
    for (std::size_t a = 0; a < 3; ++a) {
      std::array<FT, 2> sides = sides_in_lattice(box, a);
      const FT last = FT(lattice_.size()[a] - 1);
      if (sides[1] < -slack_[a] || sides[0] > last + slack_[a]) return std::nullopt;
      common.is_whole_box = common.is_whole_box && is_inside(sides[0], a) && is_inside(sides[1], a);
      for (FT& u : sides) {
        if (std::abs(u - std::round(u)) <= slack_[a]) u = std::round(u);
        u = std::clamp(u, FT(0), last);
      }
      const std::size_t first = cell(sides[0], a);
      const std::size_t end = std::max(first + 1, std::size_t(std::ceil(sides[1])));
      common.box.first[a] = first;
      common.box.cells[a] = end - first;
      common.box.begin[a] = sides[0] - FT(first);
      common.box.end[a] = sides[1] - FT(end - 1);
    }
    return common;
  }

private:
  /// Row a of the inverse is the cross product of the other two steps over the determinant.
  static Matrix inverse_matrix(const Lattice& lattice) {
    Matrix inverse;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto row = CGAL::cross_product(lattice.steps()[(a + 1) % 3], lattice.steps()[(a + 2) % 3]);
      for (int b = 0; b < 3; ++b) inverse[a][std::size_t(b)] = row[b] / lattice.determinant();
    }
    return inverse;
  }

  FT rounding_of_coordinate(std::size_t a) const {
    const CGAL::Bbox_3 box = lattice_.bbox();
    FT sum = 0;
    for (int b = 0; b < 3; ++b)
      sum += std::abs(to_lattice_[a][std::size_t(b)]) * FT(std::max(std::abs(box.min(b)), std::abs(box.max(b))));
    return 8 * std::numeric_limits<FT>::epsilon() * sum;
  }

  /// The least and the greatest lattice coordinate a of the points of a box.
  std::array<FT, 2> sides_in_lattice(const CGAL::Bbox_3& box, std::size_t a) const {
    constexpr FT infinity = std::numeric_limits<FT>::infinity();
    std::array<FT, 2> sides{};
    for (int b = 0; b < 3; ++b) {
      const FT p = to_lattice_[a][std::size_t(b)] * (FT(box.min(b)) - lattice_.origin()[b]);
      const FT q = to_lattice_[a][std::size_t(b)] * (FT(box.max(b)) - lattice_.origin()[b]);
      sides[0] += std::min(p, q);
      sides[1] += std::max(p, q);
    }
    if (!(sides[0] <= sides[1])) return {-infinity, infinity}; // 0 times infinity has made a NaN
    return sides;
  }

  /// Whether a lattice coordinate is in the support; NaN is not.
  bool is_inside(FT u, std::size_t a) const { return u >= -slack_[a] && u <= FT(lattice_.size()[a] - 1) + slack_[a]; }

  std::size_t cell(FT u, std::size_t a) const {
    return std::min(std::size_t(std::max(u, FT(0))), lattice_.size()[a] - 2);
  }

  Lattice lattice_;
  Matrix to_lattice_;
  std::array<FT, 3> slack_{};
};

} // namespace equiaffine::internal

#endif
