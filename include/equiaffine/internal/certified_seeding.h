// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_CERTIFIED_SEEDING_H
#define EQUIAFFINE_INTERNAL_CERTIFIED_SEEDING_H

#include <equiaffine/Clip_domain_3.h>
#include <equiaffine/internal/Seed_grid_3.h>
#include <equiaffine/internal/acute_gradients.h>
#include <equiaffine/internal/curve_step.h>
#include <equiaffine/internal/first_order_bounds.h>
#include <equiaffine/project_to_surface.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Points to begin a mesh with.
template <class Point_3>
struct Seeding_3 {
  std::vector<Point_3> seeds;                ///< on the surface, on every component that was found
  std::vector<Point_3> scaffold;             ///< in the middle of large boxes without surface
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
  using Vector_3 = typename Traits::Vector_3;
  using FT = typename Traits::FT;
  using Grid = Seed_grid_3<Point_3, Vector_3>;
  using Seed = typename Grid::Seed;

  struct Cell {
    std::array<std::uint32_t, 3> position;
    /// Of a decided cell, or of one that contains it: the difference of values at two of its points per side.
    double slope = infinity;
    bool is_decided() const { return slope < infinity; }
  };

public:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int maximal_level = 24;
  /// Children of undecided cells of one level, much smaller than facets, that are worth a try: a singular point makes
  /// few at each level, a singular curve twice as many each time.
  static constexpr std::ptrdiff_t maximal_undecided_cells = 200'000;

  /// `size(p)` bounds the circumradius of facets near p, and is at most `largest_size`.
  Certified_seeding_3(const Traits& traits, const Clip_domain_3& domain, Sizing size, double largest_size)
      : traits_(traits), domain_(domain), box_(domain.bbox()), size_(std::move(size)), largest_size_(largest_size),
        side_(std::max({box_.x_span(), box_.y_span(), box_.z_span()})),
        has_gradient_bounds_(internal::has_gradient_bounds(traits)),
        has_tight_bounds_(internal::has_tight_bounds(traits)) {}

  /// Seeds keep the distance `spacing` from a vertex that the mesh has already.
  void keep_away(const Point_3& vertex, double spacing) {
    const auto jet = first_order(traits_, vertex);
    grid_.insert({vertex, unit(gradient_of<Vector_3>(jet)), spacing, true});
    vertices_ = grid_.seeds().size();
  }

  Seeding_3<Point_3> operator()() {
    spread();
    std::vector<Cell> cells = {{{0, 0, 0}}}, next;
    for (level_ = 0; !cells.empty(); ++level_) {
      const double h = cell_side();
      const auto undecided = std::count_if(cells.begin(), cells.end(), [](const Cell& c) { return !c.is_decided(); });
      const bool is_small = 2 * h < largest_size_;
      const bool is_solid =
          is_small && double(undecided) * h * h * h > solid * box_.x_span() * box_.y_span() * box_.z_span();
      const bool is_hopeless = is_solid || (8 * h < largest_size_ && undecided > maximal_undecided_cells);
      const bool is_last = level_ == maximal_level || (h < largest_size_ && !has_gradient_bounds_) || is_hopeless;
      next.clear();
      for (Cell& cell : cells) {
        const CGAL::Bbox_3 box = box_of(cell);
        if (domain_.excludes(box)) continue;
        if (is_empty(cell, box)) {
          if (h >= 4 * largest_size_) empty_cells_.push_back(box);
        } else if (!cell.is_decided() && is_last) {
          give_up(cell);
        } else if (!cell.is_decided() && is_small && is_unbounded(box)) {
          report(box);
        } else if (cell.is_decided() && h <= seeded_size * size_(center(box))) {
          make_seeds(box, packing * std::min(size_(center(box)), coarsening * h));
        } else {
          subdivide(cell, next);
        }
      }
      std::swap(cells, next);
    }
    if (!has_gradient_bounds_) result_.undecided_boxes = {box_};
    for (std::size_t n = vertices_; n < grid_.seeds().size(); ++n)
      if (!is_superfluous(grid_.seeds()[n])) result_.seeds.push_back(grid_.seeds()[n].point);
    make_scaffold();
    return std::move(result_);
  }

private:
  static constexpr double solid = 0.125;   // part of the box that undecided cells are not worth another try to fill
  static constexpr double seeded_size = 4; // side of the cells that are seeded / bound of circumradii
  static constexpr double packing = 1.1;   // distance of seeds / bound of circumradii

  double cell_side() const { return std::ldexp(side_, -level_); }

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
      Cell child = {{}, cell.slope};
      bool is_in_box = true;
      for (std::uint32_t a = 0; a < 3; ++a) {
        child.position[a] = 2 * cell.position[a] + (c >> a & 1);
        is_in_box = is_in_box && (box_.min(int(a)) + child.position[a] * h < box_.max(int(a)));
      }
      if (is_in_box) next.push_back(child);
    }
  }

  /// Whether there is no surface in a cell, which is decided here if it can be.
  bool is_empty(Cell& cell, const CGAL::Bbox_3& box) {
    if (cell.is_decided()) {
      return std::abs(CGAL::to_double(traits_.value(center(box)))) > cell.slope * cell_side();
    }
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>)
      if (!traits_.bounds(box).contains(0)) return true;
    auto jet = first_order_bounds(traits_, box);
    jet.template at<0>() = Interval::intersection(jet.value(), mean_value_bound(traits_, jet, box));
    bool is_decided = has_acute_gradients(traits_, jet, box, box_);
    if (!is_decided && has_tight_bounds_ && jet.value().contains(0) && cell_side() <= seeded_size * largest_size_) {
      jet = tight_first_order_bounds(traits_, box);
      is_decided = has_acute_gradients(traits_, jet, box, box_);
    }
    if (is_decided) {
      double sum = 0;
      for (std::size_t a = 1; a < 4; ++a) sum += abs(jet.coefficients()[a]).upper();
      cell.slope = 0.501 * sum; // from the center half a side along each axis, and some rounding
    }
    return !jet.value().contains(0);
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
    make_seeds(box, packing * size_(center(box)));
  }

  /// Seeds get the denser the nearer they are to a singular point; where facets end, they may end.
  bool is_superfluous(const Seed& seed) const {
    if (given_up_.empty() || seed.spacing >= packing * largest_size_ / 16) return false;
    std::array<std::int64_t, 3> cell;
    for (int a = 0; a < 3; ++a)
      cell[std::size_t(a)] = std::int64_t(std::floor((CGAL::to_double(seed.point[a]) - box_.min(a)) / given_up_side_));
    for (std::int64_t n = 0; n < 125; ++n)
      if (given_up_.contains({std::uint32_t(cell[0] + n % 5 - 2), std::uint32_t(cell[1] + n / 5 % 5 - 2),
                              std::uint32_t(cell[2] + n / 25 - 2)}))
        return true;
    return false;
  }

  /// A seed in a cell, and from there as far as the surface goes without one.
  void make_seeds(const CGAL::Bbox_3& box, double spacing) {
    if (grid_.has_seed_in(box)) return;
    bool is_found = false;
    for (int n = 0; n < candidates && !is_found; ++n)
      is_found = project(random_point(box), box, spacing, 2 * cell_side());
    if (!is_found) search_edges(box, spacing);
    spread();
  }

  /// Whether a point of the surface that is near p, and by Newton's method in the box, got a seed or had one nearby.
  bool project(const Point_3& p, const CGAL::Bbox_3& box, double spacing, double reach) {
    const auto jet = first_order(traits_, p);
    const auto gradient = gradient_of<Vector_3>(jet);
    const FT squared_norm = gradient.squared_length();
    if (!(squared_norm > FT(0)) || !(jet.value() - jet.value() == FT(0))) return false;
    const Point_3 newton = p - jet.value() / squared_norm * gradient;
    if (!CGAL::do_overlap(newton.bbox(), box)) return false;
    const Vector_3 normal = unit(gradient);
    if (grid_.is_crowded({newton, normal, 0.99 * spacing})) return true; // before more is spent on it
    const auto found = project_to_surface(traits_, p, FT(reach), jet);
    if (!found.has_converged) return false;
    insert({found.point, normal, spacing});
    return true;
  }

  /// From each new seed, seeds around it at the distance that they keep.
  void spread() {
    for (; spread_seeds_ < grid_.seeds().size(); ++spread_seeds_) {
      const Seed seed = grid_.seeds()[spread_seeds_]; // a copy: insertion may move it
      const Vector_3& n = seed.normal;
      const auto is_smaller = [](const FT& a, const FT& b) { return CGAL::abs(a) < CGAL::abs(b); };
      const auto axis = std::min_element(n.cartesian_begin(), n.cartesian_end(), is_smaller) - n.cartesian_begin();
      const Vector_3 u = unit(CGAL::cross_product(n, Vector_3(FT(axis == 0), FT(axis == 1), FT(axis == 2))));
      const Vector_3 v = CGAL::cross_product(n, u);
      const double turn = random();
      for (int k = 0; k < directions; ++k) {
        const double angle = 2 * std::numbers::pi * (k + turn) / directions;
        const double distance = seed.spacing * (1 + jitter * random());
        const Point_3 p = seed.point + FT(distance * std::cos(angle)) * u + FT(distance * std::sin(angle)) * v;
        if (!domain_.contains(p)) continue;
        const double spacing = std::min(packing * size_(p), growth * seed.spacing);
        if (grid_.is_crowded({p, n, 0.98 * spacing})) continue;
        const double r = spacing / 2;
        project(p, CGAL::Bbox_3(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r), spacing, spacing);
      }
    }
  }

  void search_edges(const CGAL::Bbox_3& box, double spacing) {
    std::array<Point_3, 8> corners;
    std::array<FT, 8> values;
    for (unsigned c = 0; c < 8; ++c) {
      corners[c] = Point_3(FT(c & 1 ? box.xmax() : box.xmin()), FT(c & 2 ? box.ymax() : box.ymin()),
                           FT(c & 4 ? box.zmax() : box.zmin()));
      values[c] = traits_.value(corners[c]);
    }
    for (unsigned c = 0; c < 8; ++c)
      for (unsigned axis = 1; axis < 8; axis *= 2) {
        const unsigned d = c | axis;
        if (c == d || !((values[c] < FT(0) && values[d] >= FT(0)) || (values[c] >= FT(0) && values[d] < FT(0))))
          continue;
        const auto found = intersect_segment(traits_, corners[c], corners[d], values[c], values[d]);
        if (!found.has_converged) continue;
        insert({found.point, unit(gradient_of<Vector_3>(first_order(traits_, found.point))), spacing});
      }
  }

  void insert(const Seed& seed) {
    if (domain_.contains(seed.point) && !grid_.is_crowded(seed)) grid_.insert(seed);
  }

  /// Zero stays zero: a singular point has no normal.
  static Vector_3 unit(const Vector_3& v) {
    const double norm = std::sqrt(CGAL::to_double(v.squared_length()));
    return norm > 0 ? v / FT(norm) : v;
  }

  /// A regular arrangement would be a degenerate one.
  Point_3 random_point(const CGAL::Bbox_3& b) {
    return Point_3(FT(b.xmin() + random() * b.x_span()), FT(b.ymin() + random() * b.y_span()),
                   FT(b.zmin() + random() * b.z_span()));
  }

  /// In [0, 1), the same on every machine (Vigna: splitmix64, 2015).
  double random() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27) * 0x94D049BB133111EBU;
    return std::ldexp(double((z ^ z >> 31) >> 11), -53);
  }

  void make_scaffold() {
    constexpr std::size_t enough = 1000;
    const double fraction = double(enough) / double(std::max(empty_cells_.size(), enough));
    for (const CGAL::Bbox_3& b : empty_cells_) {
      if (random() > fraction) continue;
      const Point_3 p = random_point(b), c = center(b);
      result_.scaffold.push_back(c + FT(0.1) * (p - c));
    }
  }

  static constexpr double coarsening = 1.4; // a cell that had to be small has seeds at this distance in sides
  static constexpr int candidates = 3;      // of a cell, before its edges are searched
  static constexpr int directions = 16;     // from a seed to others
  static constexpr double jitter = 0.3;     // of their distance, as a fraction
  static constexpr double growth = 1.2;     // of the spacing from a seed to those around it

  const Traits& traits_;
  const Clip_domain_3& domain_;
  const CGAL::Bbox_3 box_;
  Sizing size_;
  const double largest_size_, side_;
  int level_ = 0;
  Grid grid_;
  const bool has_gradient_bounds_, has_tight_bounds_;
  std::vector<CGAL::Bbox_3> empty_cells_;
  std::set<std::array<std::uint32_t, 3>> given_up_;
  double given_up_side_ = 0;
  Seeding_3<Point_3> result_;
  std::size_t vertices_ = 0, spread_seeds_ = 0; // of the seeds in the grid, the first ones
  std::uint64_t state_ = 1;
};

} // namespace equiaffine::internal

#endif
