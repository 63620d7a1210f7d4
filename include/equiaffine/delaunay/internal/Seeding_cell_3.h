// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_SEEDING_CELL_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_SEEDING_CELL_3_H

#include <equiaffine/function/capabilities.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// Computes the boxes of the cells of an octree. The root, at level 0, is a cube that contains a box and shares its
/// lower corner. The cells of level n have sides 2^n times smaller and are clipped to the box.
class Octree_3 {
public:
  using Position = std::array<std::uint32_t, 3>; ///< index of the cell in its level along x, y, and z

  explicit Octree_3(const CGAL::Bbox_3& box) : box_(box), side_(std::max({box.x_span(), box.y_span(), box.z_span()})) {}

  const CGAL::Bbox_3& box() const { return box_; }
  double side(int level) const { return std::ldexp(side_, -level); }

  CGAL::Bbox_3 box_of(const Position& p, int level) const {
    const double h = side(level);
    const auto at = [&](int a, std::uint32_t n) { return std::min(box_.min(a) + n * h, box_.max(a)); };
    return CGAL::Bbox_3(at(0, p[0]), at(1, p[1]), at(2, p[2]), at(0, p[0] + 1), at(1, p[1] + 1), at(2, p[2] + 1));
  }

  /// Calls visit(position) for the children of a cell of the given level, except those outside the box.
  template <class Visit>
  void for_each_child(const Position& parent, int level, const Visit& visit) const {
    const double h = side(level) / 2;
    for (std::uint32_t c = 0; c < 8; ++c) {
      Position child;
      bool is_in_box = true;
      for (std::uint32_t a = 0; a < 3; ++a) {
        child[a] = 2 * parent[a] + (c >> a & 1);
        is_in_box = is_in_box && (box_.min(int(a)) + child[a] * h < box_.max(int(a)));
      }
      if (is_in_box) visit(child);
    }
  }

private:
  const CGAL::Bbox_3 box_;
  const double side_;
};

/// Whether any two gradients in the bounds of `jet` form an acute angle after projection to the plane or line of the
/// given axes.
inline bool has_acute_gradients(const Jet_3<Interval, 1>& jet, const std::array<bool, 3>& axes) {
  double largest = 0;
  for (std::size_t a = 0; a < 3; ++a) largest = std::max(largest, abs(jet.coefficients()[1 + a]).upper());
  if (!(largest > 0 && std::isfinite(largest))) return false;
  const Interval scale(std::ldexp(1.0, -std::ilogb(largest))); // so that no product overflows or underflows
  Interval product(0);
  for (std::size_t a = 0; a < 3; ++a) {
    const Interval g = jet.coefficients()[1 + a] * scale, independent = g; // bounds of two independent gradients
    if (axes[a]) product += g * independent;
  }
  return product.lower() > 0;
}

/// A face, an edge, or a corner of a cell, or the cell itself, given by its extent along each axis.
struct Cell_side_3 {
  enum Extent { WHOLE, LOWER, UPPER };
  std::array<Extent, 3> extents;

  /// Side n of the 27; number 0 is the cell itself.
  static Cell_side_3 number(int n) { return {{Extent(n % 3), Extent(n / 3 % 3), Extent(n / 9)}}; }

  std::array<bool, 3> axes() const {
    return {extents[0] == WHOLE, extents[1] == WHOLE, extents[2] == WHOLE}; // the axes along which this part extends
  }

  bool is_corner() const { return axes() == std::array<bool, 3>{false, false, false}; }

  CGAL::Bbox_3 box(const CGAL::Bbox_3& cell) const {
    std::array<double, 3> lower, upper;
    for (int a = 0; a < 3; ++a) {
      lower[std::size_t(a)] = extents[std::size_t(a)] == UPPER ? cell.max(a) : cell.min(a);
      upper[std::size_t(a)] = extents[std::size_t(a)] == LOWER ? cell.min(a) : cell.max(a);
    }
    return CGAL::Bbox_3(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]);
  }

  /// Whether this side of a cell lies in the same side of another box.
  bool touches(const CGAL::Bbox_3& cell, const CGAL::Bbox_3& outer) const {
    for (int a = 0; a < 3; ++a) {
      const Extent extent = extents[std::size_t(a)];
      if (extent == LOWER && cell.min(a) != outer.min(a)) return false;
      if (extent == UPPER && cell.max(a) != outer.max(a)) return false;
    }
    return true;
  }
};

/// Whether any two gradients in a cell form an acute angle, also after projection to every face and edge of the outer
/// box that the cell touches and the surface meets. `jet` bounds f on the cell.
template <ImplicitFunctionTraits_3 Traits>
bool has_acute_gradients(const Traits& traits, const Jet_3<Interval, 1>& jet, const CGAL::Bbox_3& cell,
                         const CGAL::Bbox_3& outer) {
  if (!has_acute_gradients(jet, {true, true, true})) return false;
  for (int n = 1; n < 27; ++n) {
    const auto side = Cell_side_3::number(n);
    if (side.is_corner() || !side.touches(cell, outer) || has_acute_gradients(jet, side.axes())) continue;
    const auto jet_there = tight_first_order_bounds(traits, side.box(cell));
    if (jet_there.value().contains(0) && !has_acute_gradients(jet_there, side.axes())) return false;
  }
  return true;
}

/// A cell of the octree with the known properties of f in it, which its children inherit.
struct Seeding_cell_3 {
  Octree_3::Position position;
  double slope = std::numeric_limits<double>::infinity(); ///< bound of the sum of the |partial derivatives|
  bool is_decided = false;                                ///< any two gradients form an acute angle
};

/// Proves, with bounds of f and its gradient, that cells contain no surface or that any two of their gradients form
/// an acute angle. Cells must be processed level by level.
template <ImplicitFunctionTraits_3 Traits>
class Cell_prover_3 {
  using Point_3 = typename Traits::Point_3;
  using FT = typename Traits::FT;
  using Cell = Seeding_cell_3;

public:
  /// `outer` is the box of the octree. Tight bounds are tried in cells with sides of at most `largest_tight_side`.
  Cell_prover_3(const Traits& traits, const CGAL::Bbox_3& outer, double largest_tight_side)
      : traits_(traits), outer_(outer), largest_tight_side_(largest_tight_side), known_(known_bounds(traits)) {}

  bool has_gradient_bounds() const { return known_.have_gradients; }

  /// Starts a level. Each level decides again whether tight bounds pay off.
  void begin_level() { tight_cells_ = settled_tight_cells_ = 0; }

  /// Whether a cell is proved to contain no surface. Otherwise stores in the cell what was found. For an urgent cell,
  /// tight bounds are always tried.
  bool is_empty(Cell& cell, const CGAL::Bbox_3& box, double side, bool is_urgent) {
    const double value =
        known_.have_gradients ? std::abs(CGAL::to_double(typename Traits::FT(traits_.value(center(box))))) : 0;
    if (is_far(cell, box, value)) return true;
    if (cell.is_decided) return false;
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>)
      if (!traits_.bounds(box).contains(0)) return true;
    if (update(cell, box, value, first_order_bounds(traits_, box))) return true;
    if (cell.is_decided || !are_tight_bounds_worth_it(side, is_urgent)) return false;
    const bool is_empty = update(cell, box, value, tight_first_order_bounds(traits_, box));
    ++tight_cells_;
    settled_tight_cells_ += is_empty || cell.is_decided;
    return is_empty;
  }

  /// Whether f has a pole in a box or is undefined there, which subdivision cannot remove.
  bool is_unbounded(const CGAL::Bbox_3& box) const {
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>) return traits_.bounds(box) == Interval::whole();
    else return false;
  }

  static constexpr int points_of_box = 27; ///< the number of points at which a box is tested for values of f

  bool has_value(const Point_3& p) const { return !std::isnan(CGAL::to_double(FT(traits_.value(p)))); }

  /// Counts the test points of a box, including its corners and its center, at which f has no value.
  int count_undefined(const CGAL::Bbox_3& box) const {
    const auto at = [](double lower, double upper, int n) { return FT(lower + 0.5 * n * (upper - lower)); };
    int count = 0;
    for (int n = 0; n < points_of_box; ++n)
      count += !has_value(Point_3(at(box.xmin(), box.xmax(), n % 3), at(box.ymin(), box.ymax(), n / 3 % 3),
                                  at(box.zmin(), box.zmax(), n / 9)));
    return count;
  }

  /// Whether f may be unbounded in a box.
  bool lacks_a_bound(const CGAL::Bbox_3& box) const {
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>) {
      const Interval bounds = traits_.bounds(box);
      return !std::isfinite(bounds.lower()) || !std::isfinite(bounds.upper());
    } else {
      return false;
    }
  }

  static Point_3 center(const CGAL::Bbox_3& b) {
    const auto c = center_of(b);
    return Point_3(FT(c[0]), FT(c[1]), FT(c[2]));
  }

private:
  /// Tight bounds cost about three times as much as ordinary ones. After a number of cells of a level, they are only
  /// used while they settle at least a third of the cells.
  bool are_tight_bounds_worth_it(double side, bool is_urgent) const {
    constexpr std::size_t least_tight_cells = 64;
    if (!known_.are_tight_in_small_boxes || side > largest_tight_side_) return false;
    return is_urgent || tight_cells_ < least_tight_cells || 3 * settled_tight_cells_ >= tight_cells_;
  }

  /// Stores the consequences of bounds of f and its gradient in the cell, and returns whether they exclude a zero.
  /// `value` is |f| at the center.
  bool update(Cell& cell, const CGAL::Bbox_3& box, double value, const Jet_3<Interval, 1>& jet) const {
    cell.is_decided = has_acute_gradients(traits_, jet, box, outer_);
    Interval sum(0);
    for (std::size_t a = 1; a < 4; ++a) sum += abs(jet.coefficients()[a]);
    cell.slope = std::min(cell.slope, sum.upper());
    return !jet.value().contains(0) || is_far(cell, box, value);
  }

  /// Whether |f| at the center of a cell, `value`, is so large that the slope excludes a zero in the cell. If it
  /// seems so, this is proved with bounds of the rounding errors, which take longer.
  bool is_far(const Cell& cell, const CGAL::Bbox_3& box, double value) const {
    const auto offset = offset_from_center(box, center_of(box));
    double reach = 0;
    for (const Interval& x : offset) reach = std::max(reach, abs(x).upper());
    if (!(value > cell.slope * reach)) return false;
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>)
      return !(traits_.bounds(box_of_point(center_of(box))) + Interval(-1, 1) * Interval(cell.slope) * Interval(reach))
                  .contains(0);
    else return false;
  }

  const Traits& traits_;
  const CGAL::Bbox_3 outer_;
  const double largest_tight_side_;
  const Known_bounds known_;
  std::size_t tight_cells_ = 0;         // the cells of this level on which tight bounds were tried
  std::size_t settled_tight_cells_ = 0; // those of them that became decided or were proved to be empty
};

} // namespace equiaffine::internal

#endif
