// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_CERTIFIED_SEEDING_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_CERTIFIED_SEEDING_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/delaunay/internal/Seed_grid_3.h>
#include <equiaffine/delaunay/internal/Seeding_cell_3.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Packs a surface with seeds, which are points about `packing * size(p)` apart, or closer where a smaller spacing is
/// requested. From a box to be covered, seeds spread over the whole component of the surface.
template <ImplicitFunctionTraits_3 Traits, class Sizing>
class Seed_packing_3 {
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using FT = typename Traits::FT;
  using Grid = Seed_grid_3<Point_3, Vector_3>;

public:
  using Seed = typename Grid::Seed;
  static constexpr double packing = 1.1; ///< distance of seeds / maximum circumradius

  Seed_packing_3(const Traits& traits, const Clip_domain_3& domain, Sizing size)
      : traits_(traits), domain_(domain), size_(std::move(size)) {}

  const std::vector<Seed>& seeds() const { return grid_.seeds(); }

  /// Turns an existing vertex of the mesh into a fixed seed, to which others keep the distance `spacing`.
  void keep_away(const Point_3& vertex, double spacing) {
    const auto jet = first_order(traits_, vertex);
    grid_.insert({vertex, unit(gradient_of<Vector_3>(jet)), spacing, true});
  }

  /// If a box has no seed, finds one in it and spreads from there. The surface is searched up to the distance `reach`
  /// from points in the box.
  void cover(const CGAL::Bbox_3& box, double reach, double spacing) {
    constexpr int candidates = 3;
    if (grid_.has_seed_in(box)) return;
    bool is_found = false;
    for (int n = 0; n < candidates && !is_found; ++n)
      is_found = seed_surface_near(random_point(box), box, spacing, reach);
    if (!is_found) seed_edges(box, spacing);
    spread();
  }

  /// Surrounds every new seed with seeds at its spacing, until there are no new ones.
  void spread() {
    for (; spread_seeds_ < grid_.seeds().size(); ++spread_seeds_) {
      const Seed seed = grid_.seeds()[spread_seeds_]; // a copy, because insertion may reallocate the seeds
      surround(seed);
    }
  }

  /// A random point in a box. A regular arrangement of points would make the triangulation degenerate.
  Point_3 random_point(const CGAL::Bbox_3& b) {
    // Separate statements: the evaluation order of arguments is unspecified, and all compilers must give the same
    // mesh.
    const double z = random(), y = random(), x = random();
    return Point_3(FT(b.xmin() + x * b.x_span()), FT(b.ymin() + y * b.y_span()), FT(b.zmin() + z * b.z_span()));
  }

  /// A pseudorandom number in [0, 1), the same sequence on every machine (Vigna: splitmix64, 2015).
  double random() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27) * 0x94D049BB133111EBU;
    return std::ldexp(double((z ^ z >> 31) >> 11), -53);
  }

private:
  void surround(const Seed& seed) {
    constexpr int directions = 16;
    constexpr double jitter = 0.3;     // largest random addition to a distance, as a fraction
    constexpr double growth = 1.2;     // largest ratio of the spacings of neighbors
    constexpr double tolerance = 0.98; // because the candidate is not on the surface yet
    const Vector_3 &n = seed.normal, u = tangent_at(seed), v = CGAL::cross_product(n, u);
    const double turn = random();
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * std::numbers::pi * (k + turn) / directions;
      const double distance = seed.spacing * (1 + jitter * random());
      const Point_3 p = seed.point + FT(distance * std::cos(angle)) * u + FT(distance * std::sin(angle)) * v;
      if (!domain_.contains(p)) continue;
      const double spacing = std::min(packing * size_(p), growth * seed.spacing);
      if (grid_.is_crowded({p, n, tolerance * spacing})) continue;
      const double r = spacing / 2;
      const CGAL::Bbox_3 box(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
      seed_surface_near(p, box, spacing, spacing);
    }
  }

  /// A unit vector orthogonal to the normal of a seed, computed from an axis that is far from parallel to the normal.
  static Vector_3 tangent_at(const Seed& seed) {
    const Vector_3& n = seed.normal;
    const auto is_smaller = [](const FT& a, const FT& b) { return CGAL::abs(a) < CGAL::abs(b); };
    const auto axis = std::min_element(n.cartesian_begin(), n.cartesian_end(), is_smaller) - n.cartesian_begin();
    return unit(CGAL::cross_product(n, Vector_3(FT(axis == 0), FT(axis == 1), FT(axis == 2))));
  }

  /// Inserts the point of the surface near p as a seed if a Newton step leads into the box. Returns whether there is
  /// now a seed at or near that point.
  bool seed_surface_near(const Point_3& p, const CGAL::Bbox_3& box, double spacing, double reach) {
    constexpr double tolerance = 0.99; // because the point is not on the surface yet
    const auto jet = first_order(traits_, p);
    const auto gradient = gradient_of<Vector_3>(jet);
    const FT squared_norm = gradient.squared_length();
    if (!(squared_norm > FT(0)) || !(jet.value() - jet.value() == FT(0))) return false;
    const Point_3 newton = p - jet.value() / squared_norm * gradient;
    if (!CGAL::do_overlap(newton.bbox(), box)) return false;
    const Vector_3 normal = unit(gradient);
    if (grid_.is_crowded({newton, normal, tolerance * spacing})) return true; // saves the projection
    const auto found = project_to_surface(traits_, p, FT(reach), jet);
    if (!found.has_converged) return false;
    insert({found.point, normal, spacing});
    return true;
  }

  /// Inserts seeds where the surface crosses the edges of a box.
  void seed_edges(const CGAL::Bbox_3& box, double spacing) {
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
        if (c == d || !is_sign_change(values[c], values[d])) continue;
        const auto found = intersect_segment(traits_, corners[c], corners[d], values[c], values[d]);
        if (!found.has_converged) continue;
        insert({found.point, unit(gradient_of<Vector_3>(first_order(traits_, found.point))), spacing});
      }
  }

  void insert(const Seed& seed) {
    if (domain_.contains(seed.point) && !grid_.is_crowded(seed)) grid_.insert(seed);
  }

  /// v normalized, or the zero vector if v has no direction: at a singular point, or where f has no derivatives.
  static Vector_3 unit(const Vector_3& v) {
    const double norm = std::sqrt(CGAL::to_double(v.squared_length()));
    return norm > 0 && std::isfinite(norm) ? v / FT(norm) : Vector_3(FT(0), FT(0), FT(0));
  }

  const Traits& traits_;
  const Clip_domain_3& domain_;
  Sizing size_;
  Grid grid_;
  std::size_t spread_seeds_ = 0; // the number of seeds, from the first one, that are surrounded by others
  std::uint64_t state_ = 1;      // of the random number generator
};

} // namespace equiaffine::internal

namespace equiaffine {

/// The initial points of a mesh.
template <class Point_3>
struct Seeding_3 {
  std::vector<Point_3> seeds;                ///< on the surface, on every component that was found
  std::vector<Point_3> scaffold;             ///< in the middle of large boxes without surface, and far outside
  std::vector<CGAL::Bbox_3> undecided_boxes; ///< where a part of the surface may have been missed
};

/// A vertex that exists in the mesh before seeding.
template <class Point_3>
struct Fixed_vertex_3 {
  Point_3 point;    ///< on the surface
  double clearance; ///< minimum distance of seeds from the vertex
};

} // namespace equiaffine

namespace equiaffine::internal {

/// Implements `certified_seeding`.
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
    if (!prover_.has_gradient_bounds()) result_.undecided_boxes = {octree_.box()};
    for (const Seed& seed : packing_.seeds())
      if (!seed.is_fixed && !is_superfluous(seed)) result_.seeds.push_back(seed.point);
    make_scaffold();
    return std::move(result_);
  }

private:
  static constexpr int maximal_level = 24;
  static constexpr double seeded_size = 4;  // largest side of cells that are seeded / maximum circumradius
  static constexpr double coarsening = 1.4; // spacing of the seeds of a cell that had to be small / its side

  /// Seeds the cells of a level that are small enough, drops those without surface, and returns the children of the
  /// remaining ones.
  Cells process_level(Cells& cells) {
    const double h = octree_.side(level_);
    const auto undecided =
        double(std::count_if(cells.begin(), cells.end(), [](const Cell& c) { return !c.is_decided; }));
    const bool is_last = level_ == maximal_level || (h < largest_size_ && !prover_.has_gradient_bounds()) ||
                         is_hopeless(undecided, h);                      // for undecided cells
    const bool is_urgent = is_last || is_hopeless(8 * undecided, h / 2); // the next level may be the last one
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

  /// Whether f seems to be undefined in an entire cell of side h, which is not much larger than facets: f has no
  /// value at any test point, and lacks a bound.
  bool is_undefined(const CGAL::Bbox_3& box, double h) const {
    return h < 4 * largest_size_ && prover_.has_gradient_bounds() && !prover_.has_value(center(box)) &&
           prover_.lacks_a_bound(box) && prover_.count_undefined(box) == prover_.points_of_box;
  }

  /// Whether there are too many undecided cells of side h to subdivide them once more. A singular point leaves a few
  /// undecided cells at each level; a singular curve doubles their number with each level. The limit is lower for
  /// cells smaller than facets.
  bool is_hopeless(double undecided, double h) const {
    constexpr double largest_fraction = 0.125; // of the box that undecided cells and cells without f may fill
    constexpr double maximal_undecided_cells = 200'000;
    const bool fills_box =
        2 * h < largest_size_ && undecided * h * h * h + undefined_volume_ > largest_fraction * volume(octree_.box());
    return fills_box || undecided > 10 * maximal_undecided_cells ||
           (8 * h < largest_size_ && undecided > maximal_undecided_cells);
  }

  static double volume(const CGAL::Bbox_3& b) { return b.x_span() * b.y_span() * b.z_span(); }
  static Point_3 center(const CGAL::Bbox_3& b) { return Cell_prover_3<Traits>::center(b); }

  /// Reports and seeds an undecided cell. A cell smaller than a sixteenth of a facet is replaced by its ancestor of
  /// about that size.
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

  /// Whether a seed has a spacing of less than a sixteenth of a facet and is at most two cells away from a cell that
  /// was given up. Seeds get denser toward a singular point but are not needed there, because the mesh may end there.
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

  /// Adds points on both sides of the surface, so that the surface is not a part of the convex hull even if it is a
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
  std::vector<CGAL::Bbox_3> empty_boxes_; // those much larger than facets
  std::set<Octree_3::Position> given_up_; // all of the same level
  double given_up_side_ = 0;
  double undefined_volume_ = 0; // of the cells in which f is undefined
  Seeding_3<Point_3> result_;
};

} // namespace equiaffine::internal

namespace equiaffine {

/// Finds points on every component of the zero set of f in a domain, dense enough as initial points of a Delaunay
/// mesh. `size(p)` bounds the circumradius of facets near p, and is at most `largest_size`. \throw
/// std::invalid_argument unless `largest_size` is positive and finite
///
/// The box of the domain is subdivided into an octree until every cell either contains no surface or has gradients of
/// which any two form an acute angle. By a theorem of Plantinga and Vegter (Isotopic approximation of implicit curves
/// and surfaces, 2004), a component of the surface cannot lie in such cells without a change of sign between corners
/// of the octree. Cells at the border of the box must satisfy the same condition within its faces and edges. The
/// cells with surface are then subdivided to the local facet size and packed with points, which keep their clearance
/// from `vertices`. The points are the same on every run.
template <ImplicitFunctionTraits_3 Traits, class Sizing>
Seeding_3<typename Traits::Point_3>
certified_seeding(const Traits& traits, const Clip_domain_3& domain, const Sizing& size, double largest_size,
                  const std::vector<Fixed_vertex_3<typename Traits::Point_3>>& vertices = {}) {
  check_argument(largest_size > 0 && std::isfinite(largest_size),
                 "the largest size of facets is not positive and finite: choose a positive length");
  return internal::Certified_seeding_3<Traits, Sizing>(traits, domain, size, largest_size)(vertices);
}

} // namespace equiaffine

#endif
