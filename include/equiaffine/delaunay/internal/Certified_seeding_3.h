// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_CERTIFIED_SEEDING_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_CERTIFIED_SEEDING_3_H

#include <equiaffine/delaunay/internal/Seed_packing_3.h>
#include <equiaffine/delaunay/internal/acute_gradients.h>
#include <equiaffine/function/first_order_bounds.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Points to begin a mesh with.
template <class Point_3>
struct Seeding_3 {
  std::vector<Point_3> seeds;                ///< on the surface, on every component that was found
  std::vector<Point_3> scaffold;             ///< in the middle of large boxes without surface, and far outside
  std::vector<CGAL::Bbox_3> undecided_boxes; ///< where a part of the surface may have been missed
};

/// Subdivides the box into an octree until every cell has no surface, or has gradients that pairwise form acute angles.
/// By a theorem of Plantinga and Vegter (Isotopic approximation of implicit curves and surfaces, 2004) a component of
/// the surface cannot hide in such a cell from the signs at the corners of the octree. Cells at the border of the box
/// must satisfy the same within its faces and edges.
///
/// The cells are then subdivided to the local facet size and packed with points.
template <ImplicitFunctionTraits_3 Traits, class Sizing>
class Certified_seeding_3 {
  using Point_3 = typename Traits::Point_3;
  using FT = typename Traits::FT;
  using Packing = Seed_packing_3<Traits, Sizing>;
  using Seed = typename Packing::Seed;

  struct Cell {
    std::array<std::uint32_t, 3> position;
    double slope = infinity; ///< bound of the sum of the absolute values of the partial derivatives
    bool is_decided = false; ///< the gradients form acute angles
  };

public:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int maximal_level = 24;
  /// Children of undecided cells of one level, much smaller than facets, that are worth a try: a singular point makes
  /// few at each level, a singular curve twice as many each time.
  static constexpr double maximal_undecided_cells = 200'000;

  /// `size(p)` bounds the circumradius of facets near p, and is at most `largest_size`.
  Certified_seeding_3(const Traits& traits, const Clip_domain_3& domain, Sizing size, double largest_size)
      : traits_(traits), domain_(domain), box_(domain.bbox()), size_(size), largest_size_(largest_size),
        side_(std::max({box_.x_span(), box_.y_span(), box_.z_span()})), known_(internal::known_bounds(traits)),
        packing_(traits, domain, std::move(size)) {}

  /// Seeds keep the distance `spacing` from a vertex that the mesh has already.
  void keep_away(const Point_3& vertex, double spacing) { packing_.keep_away(vertex, spacing); }

  Seeding_3<Point_3> operator()() {
    packing_.spread();
    std::vector<Cell> cells = {Cell{{0, 0, 0}}}, next;
    for (level_ = 0; !cells.empty(); ++level_) {
      const double h = cell_side();
      const auto undecided =
          double(std::count_if(cells.begin(), cells.end(), [](const Cell& c) { return !c.is_decided; }));
      const bool is_last =
          level_ == maximal_level || (h < largest_size_ && !known_.have_gradients) || is_hopeless(undecided, h);
      const bool is_urgent = is_last || is_hopeless(8 * undecided, h / 2); // the next level may be the last
      tight_cells_ = settled_tight_cells_ = 0;
      next.clear();
      for (Cell& cell : cells) {
        const CGAL::Bbox_3 box = box_of(cell);
        if (domain_.excludes(box)) continue;
        if (is_empty(cell, box, is_urgent)) {
          if (h >= 4 * largest_size_) empty_cells_.push_back(box);
        } else if (!cell.is_decided && is_last) {
          give_up(cell);
        } else if (!cell.is_decided && 2 * h < largest_size_ && is_unbounded(box)) {
          report(box);
        } else if (cell.is_decided && h <= seeded_size * size_(center(box))) {
          make_seeds(box, Packing::packing * std::min(size_(center(box)), coarsening * h));
        } else {
          subdivide(cell, next);
        }
      }
      std::swap(cells, next);
    }
    if (!known_.have_gradients) result_.undecided_boxes = {box_};
    for (const Seed& seed : packing_.seeds())
      if (!seed.is_fixed && !is_superfluous(seed)) result_.seeds.push_back(seed.point);
    make_scaffold();
    return std::move(result_);
  }

private:
  static constexpr double solid = 0.125;    // part of the box that undecided cells are not worth another try to fill
  static constexpr double seeded_size = 4;  // side of the cells that are seeded / bound of circumradii
  static constexpr double coarsening = 1.4; // a cell that had to be small has seeds at this distance in sides

  /// Tight bounds cost about three times as much as others. After so many cells of a level they are worth it as long as
  /// they settle a third.
  static constexpr std::size_t least_tight_cells = 64;

  double cell_side() const { return std::ldexp(side_, -level_); }

  /// Whether so many undecided cells of side h, smaller than facets, are not worth another try.
  bool is_hopeless(double undecided, double h) const {
    const bool is_solid =
        2 * h < largest_size_ && undecided * h * h * h > solid * box_.x_span() * box_.y_span() * box_.z_span();
    return is_solid || (8 * h < largest_size_ && undecided > maximal_undecided_cells);
  }

  CGAL::Bbox_3 box_of(const Cell& cell) const {
    const double h = cell_side();
    const auto at = [&](int a, std::uint32_t n) { return std::min(box_.min(a) + n * h, box_.max(a)); };
    const auto& c = cell.position;
    return CGAL::Bbox_3(at(0, c[0]), at(1, c[1]), at(2, c[2]), at(0, c[0] + 1), at(1, c[1] + 1), at(2, c[2] + 1));
  }

  static Point_3 center(const CGAL::Bbox_3& b) {
    const auto c = center_of(b);
    return Point_3(FT(c[0]), FT(c[1]), FT(c[2]));
  }

  void subdivide(const Cell& cell, std::vector<Cell>& next) const {
    const double h = cell_side() / 2;
    for (std::uint32_t c = 0; c < 8; ++c) {
      Cell child = {{}, cell.slope, cell.is_decided};
      bool is_in_box = true;
      for (std::uint32_t a = 0; a < 3; ++a) {
        child.position[a] = 2 * cell.position[a] + (c >> a & 1);
        is_in_box = is_in_box && (box_.min(int(a)) + child.position[a] * h < box_.max(int(a)));
      }
      if (is_in_box) next.push_back(child);
    }
  }

  /// Whether there is no surface in a cell, which is decided here if it can be; if urgent, at any cost.
  bool is_empty(Cell& cell, const CGAL::Bbox_3& box, bool is_urgent) {
    const double value = known_.have_gradients ? std::abs(CGAL::to_double(traits_.value(center(box)))) : 0;
    if (is_far(cell, box, value)) return true;
    if (cell.is_decided) return false;
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>)
      if (!traits_.bounds(box).contains(0)) return true;
    auto jet = first_order_bounds(traits_, box);
    learn(cell, box, jet);
    if (!jet.value().contains(0) || is_far(cell, box, value)) return true;
    if (cell.is_decided || !known_.are_tight_in_small_boxes || cell_side() > seeded_size * largest_size_) return false;
    if (!is_urgent && tight_cells_ >= least_tight_cells && 3 * settled_tight_cells_ < tight_cells_) return false;
    jet = tight_first_order_bounds(traits_, box);
    learn(cell, box, jet);
    const bool is_empty = !jet.value().contains(0) || is_far(cell, box, value);
    ++tight_cells_;
    settled_tight_cells_ += is_empty || cell.is_decided;
    return is_empty;
  }

  /// What bounds of f and its gradient in the cell tell.
  void learn(Cell& cell, const CGAL::Bbox_3& box, const Jet_3<Interval, 1>& jet) const {
    cell.is_decided = has_acute_gradients(traits_, jet, box, box_);
    Interval sum(0);
    for (std::size_t a = 1; a < 4; ++a) sum += abs(jet.coefficients()[a]);
    cell.slope = std::min(cell.slope, sum.upper());
  }

  /// Whether f has a value at the center of a cell, here without its sign, that is too large for a zero in it. What
  /// seems so is proved: bounds of rounding errors take longer.
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

  /// At a pole, or where f is not defined, which no subdivision removes.
  bool is_unbounded(const CGAL::Bbox_3& box) const {
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>) return traits_.bounds(box) == Interval::whole();
    else return false;
  }

  /// An undecided cell is reported and seeded as the one of a sixteenth of the facet size that contains it.
  void give_up(Cell cell) {
    const int level = level_;
    for (; level_ > 0 && 16 * cell_side() < largest_size_; --level_)
      for (auto& x : cell.position) x /= 2;
    given_up_side_ = cell_side();
    if (given_up_.insert(cell.position).second) report(box_of(cell));
    level_ = level;
  }

  void report(const CGAL::Bbox_3& box) {
    result_.undecided_boxes.push_back(box);
    make_seeds(box, Packing::packing * size_(center(box)));
  }

  void make_seeds(const CGAL::Bbox_3& box, double spacing) { packing_.cover(box, 2 * cell_side(), spacing); }

  /// Seeds get the denser the nearer they are to a singular point; where facets end, they may end.
  bool is_superfluous(const Seed& seed) const {
    if (given_up_.empty() || seed.spacing >= Packing::packing * largest_size_ / 16) return false;
    std::array<std::int64_t, 3> cell;
    for (int a = 0; a < 3; ++a)
      cell[std::size_t(a)] = std::int64_t(std::floor((CGAL::to_double(seed.point[a]) - box_.min(a)) / given_up_side_));
    for (std::int64_t n = 0; n < 125; ++n)
      if (given_up_.contains({std::uint32_t(cell[0] + n % 5 - 2), std::uint32_t(cell[1] + n / 5 % 5 - 2),
                              std::uint32_t(cell[2] + n / 25 - 2)}))
        return true;
    return false;
  }

  /// With points on both sides of it a surface is no part of the convex hull, even if it is a plane.
  void make_scaffold() {
    for (const double x : {box_.xmin(), box_.xmax()})
      for (const double y : {box_.ymin(), box_.ymax()})
        for (const double z : {box_.zmin(), box_.zmax()})
          result_.scaffold.push_back(center(box_) +
                                     FT(2 + packing_.random()) * (Point_3(FT(x), FT(y), FT(z)) - center(box_)));
    constexpr std::size_t enough = 1000;
    const double fraction = double(enough) / double(std::max(empty_cells_.size(), enough));
    for (const CGAL::Bbox_3& b : empty_cells_) {
      if (packing_.random() > fraction) continue;
      const Point_3 p = packing_.random_point(b), c = center(b);
      result_.scaffold.push_back(c + FT(0.1) * (p - c));
    }
  }

  const Traits& traits_;
  const Clip_domain_3& domain_;
  const CGAL::Bbox_3 box_;
  Sizing size_;
  const double largest_size_, side_;
  int level_ = 0;
  std::size_t tight_cells_ = 0, settled_tight_cells_ = 0; // of the level: that tight bounds were tried on, and settled
  const Known_bounds known_;
  Packing packing_;
  std::vector<CGAL::Bbox_3> empty_cells_;
  std::set<std::array<std::uint32_t, 3>> given_up_;
  double given_up_side_ = 0;
  Seeding_3<Point_3> result_;
};

} // namespace equiaffine::internal

#endif
