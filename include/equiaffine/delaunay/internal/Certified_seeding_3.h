// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_CERTIFIED_SEEDING_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_CERTIFIED_SEEDING_3_H

#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/delaunay/internal/Octree_3.h>
#include <equiaffine/delaunay/internal/Seed_packing_3.h>
#include <equiaffine/delaunay/internal/Seeding_3.h>
#include <equiaffine/delaunay/internal/Seeding_cell_3.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The algorithm of `certified_seeding`.
template <ImplicitFunctionTraits_3 Traits, class Sizing>
class Certified_seeding_3 {
  using Point_3 = typename Traits::Point_3;
  using FT = typename Traits::FT;
  using Packing = Seed_packing_3<Traits, Sizing>;
  using Seed = typename Packing::Seed;
  using Cell = Seeding_cell_3;
  using Cells = std::vector<Cell>;

public:
  Certified_seeding_3(const Traits& traits, const Clip_domain_3& domain, const Sizing& size, double largest_size)
      : domain_(domain), size_(size), largest_size_(largest_size), octree_(domain.bbox()),
        prover_(traits, domain.bbox(), seeded_size * largest_size), packing_(traits, domain, size) {}

  Seeding_3<Point_3> operator()(const std::vector<Fixed_vertex_3<Point_3>>& vertices) {
    for (const auto& vertex : vertices) packing_.keep_away(vertex.point, vertex.clearance);
    packing_.spread();
    Cells cells = {Cell{{0, 0, 0}}};
    for (level_ = 0; !cells.empty(); ++level_) cells = process_level(cells);
    if (!prover_.knows_gradients()) result_.undecided_boxes = {octree_.box()};
    for (const Seed& seed : packing_.seeds())
      if (!seed.is_fixed && !is_superfluous(seed)) result_.seeds.push_back(seed.point);
    make_scaffold();
    return std::move(result_);
  }

private:
  static constexpr int maximal_level = 24;
  static constexpr double seeded_size = 4;  // largest side of cells that are seeded / bound of circumradii
  static constexpr double coarsening = 1.4; // distance of the seeds of a cell that had to be small / its side

  /// Seeds the cells of a level that are small enough, drops those without surface, and returns the children of the
  /// others.
  Cells process_level(Cells& cells) {
    const double h = octree_.side(level_);
    const auto undecided =
        double(std::count_if(cells.begin(), cells.end(), [](const Cell& c) { return !c.is_decided; }));
    const bool is_last = level_ == maximal_level || (h < largest_size_ && !prover_.knows_gradients()) ||
                         is_hopeless(undecided, h);                      // for undecided cells
    const bool is_urgent = is_last || is_hopeless(8 * undecided, h / 2); // the next level may be the last
    prover_.begin_level();
    Cells next;
    for (Cell& cell : cells) {
      Progress_observer::step();
      const CGAL::Bbox_3 box = octree_.box_of(cell.position, level_);
      if (domain_.excludes(box)) continue;
      if (prover_.is_empty(cell, box, h, is_urgent)) {
        if (h >= 4 * largest_size_) empty_boxes_.push_back(box);
      } else if (!cell.is_decided && is_undefined(box, h)) {
        report(box, h);
        undefined_volume_ += volume(box);
      } else if (!cell.is_decided && (is_last || (8 * h < largest_size_ && prover_.count_undefined(box) > 0))) {
        give_up(cell.position);
      } else if (!cell.is_decided && 2 * h < largest_size_ && prover_.is_unbounded(box)) {
        report(box, h);
      } else if (cell.is_decided && h <= seeded_size * size_(center(box))) {
        packing_.cover(box, 2 * h, Packing::packing * std::min(size_(center(box)), coarsening * h));
      } else {
        octree_.for_each_child(cell.position, level_, [&](const Octree_3::Position& child) {
          next.push_back({child, cell.slope, cell.is_decided});
        });
      }
    }
    return next;
  }

  /// Whether f seems to be undefined in all of a cell of side h, which is not much larger than facets: it has no value at any
  /// of some points, and not two bounds.
  bool is_undefined(const CGAL::Bbox_3& box, double h) const {
    return h < 4 * largest_size_ && prover_.knows_gradients() && !prover_.has_value(center(box)) &&
           prover_.lacks_a_bound(box) && prover_.count_undefined(box) == prover_.points_of_box;
  }

  /// Whether there are too many undecided cells of side h to subdivide them once more. A singular point leaves few undecided
  /// cells at each level, a singular curve twice as many at each level as before. Cells smaller than facets may be less.
  bool is_hopeless(double undecided, double h) const {
    constexpr double largest_fraction = 0.125; // of the box that cells may fill which are undecided, or have no f
    constexpr double maximal_undecided_cells = 200'000;
    const bool fills_box =
        2 * h < largest_size_ && undecided * h * h * h + undefined_volume_ > largest_fraction * volume(octree_.box());
    return fills_box || undecided > 10 * maximal_undecided_cells ||
           (8 * h < largest_size_ && undecided > maximal_undecided_cells);
  }

  static double volume(const CGAL::Bbox_3& b) { return b.x_span() * b.y_span() * b.z_span(); }
  static Point_3 center(const CGAL::Bbox_3& b) { return Cell_prover_3<Traits>::center(b); }

  /// Reports and seeds an undecided cell. If it is smaller than a sixteenth of a facet, a cell of about that size takes
  /// its place, which contains it.
  void give_up(Octree_3::Position position) {
    int level = level_;
    for (; level > 0 && 16 * octree_.side(level) < largest_size_; --level)
      for (auto& x : position) x /= 2;
    given_up_side_ = octree_.side(level);
    if (given_up_.insert(position).second) report(octree_.box_of(position, level), given_up_side_);
  }

  void report(const CGAL::Bbox_3& box, double side) {
    result_.undecided_boxes.push_back(box);
    packing_.cover(box, 2 * side, Packing::packing * size_(center(box)));
  }

  /// Whether a seed is nearer to others than a sixteenth of a facet, and at most two cells away from a cell that was
  /// given up. Seeds get denser towards a singular point, but are not needed there, where the mesh may end.
  bool is_superfluous(const Seed& seed) const {
    if (given_up_.empty() || seed.spacing >= Packing::packing * largest_size_ / 16) return false;
    std::array<std::int64_t, 3> cell;
    for (int a = 0; a < 3; ++a) {
      const double offset = CGAL::to_double(seed.point[a]) - octree_.box().min(a);
      cell[std::size_t(a)] = std::int64_t(std::floor(offset / given_up_side_));
    }
    for (std::int64_t n = 0; n < 125; ++n)
      if (given_up_.contains({std::uint32_t(cell[0] + n % 5 - 2), std::uint32_t(cell[1] + n / 5 % 5 - 2),
                              std::uint32_t(cell[2] + n / 25 - 2)}))
        return true;
    return false;
  }

  /// Makes points on both sides of the surface. With them the surface is no part of the convex hull, even if it is a
  /// plane.
  void make_scaffold() {
    const CGAL::Bbox_3& box = octree_.box();
    for (const double x : {box.xmin(), box.xmax()})
      for (const double y : {box.ymin(), box.ymax()})
        for (const double z : {box.zmin(), box.zmax()})
          result_.scaffold.push_back(center(box) +
                                     FT(2 + packing_.random()) * (Point_3(FT(x), FT(y), FT(z)) - center(box)));
    constexpr std::size_t enough = 1000;
    const double fraction = double(enough) / double(std::max(empty_boxes_.size(), enough));
    for (const CGAL::Bbox_3& b : empty_boxes_) {
      if (packing_.random() > fraction) continue;
      const Point_3 p = packing_.random_point(b), c = center(b);
      result_.scaffold.push_back(c + FT(0.1) * (p - c));
    }
  }

  const Clip_domain_3& domain_;
  Sizing size_;
  const double largest_size_;
  const Octree_3 octree_;
  Cell_prover_3<Traits> prover_;
  Packing packing_;
  int level_ = 0;
  std::vector<CGAL::Bbox_3> empty_boxes_; // much larger than facets
  std::set<Octree_3::Position> given_up_; // all on the same level
  double given_up_side_ = 0;
  double undefined_volume_ = 0; // of the cells in which f is undefined
  Seeding_3<Point_3> result_;
};

} // namespace equiaffine::internal

#endif
