// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_SEED_GRID_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_SEED_GRID_3_H

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace equiaffine {

/// Points with a minimum distance to each other, in hashed grids, one for each power of two of the distance.
/// Insertion takes constant time; a query takes time proportional to the number of grids.
template <class Point_3, class Vector_3>
class Seed_grid_3 {
public:
  struct Seed {
    Point_3 point;
    Vector_3 normal; // zero at a singular point
    double spacing;
    bool is_fixed = false; // if true, seeds with a smaller spacing also keep its spacing
  };

  const std::vector<Seed>& seeds() const { return seeds_; }

  /// Whether a seed is closer to the candidate than the smaller one of their spacings and their normals do not form
  /// an obtuse angle: the two sides of a thin part of a surface have separate seeds.
  bool is_crowded(const Seed& candidate) {
    if (latest_ < seeds_.size() && is_near(seeds_[latest_], candidate)) return true;
    for (const int level : levels_) {
      const auto cell = cell_of(candidate.point, level, -0.5); // the spacing of seeds is less than half the cell size
      for (std::int64_t k = 0; k <= 1; ++k)
        for (std::int64_t j = 0; j <= 1; ++j)
          for (std::int64_t i = 0; i <= 1; ++i)
            for (auto s = heads_[bucket({cell[0] + i, cell[1] + j, cell[2] + k}, level)]; s != none; s = next_[s])
              if (is_near(seeds_[s], candidate)) {
                latest_ = s;
                return true;
              }
    }
    return false;
  }

  /// Whether there is a seed in a box. Seeds whose spacing is below about 1/8 of the box are ignored.
  bool has_seed_in(const CGAL::Bbox_3& box) const {
    constexpr double most_cells = 8; // the maximum number of cells to visit along an axis
    for (const int level : levels_) {
      if (std::ldexp(most_cells, level - 1) < std::max({box.x_span(), box.y_span(), box.z_span()})) continue;
      const auto first = cell_of({box.xmin(), box.ymin(), box.zmin()}, level);
      const auto last = cell_of({box.xmax(), box.ymax(), box.zmax()}, level);
      for (std::int64_t k = first[2]; k <= last[2]; ++k)
        for (std::int64_t j = first[1]; j <= last[1]; ++j)
          for (std::int64_t i = first[0]; i <= last[0]; ++i)
            for (auto s = heads_[bucket({i, j, k}, level)]; s != none; s = next_[s])
              if (CGAL::do_overlap(seeds_[s].point.bbox(), box)) return true;
    }
    return false;
  }

  void insert(const Seed& seed) {
    if (2 * seeds_.size() >= heads_.size()) grow();
    seeds_.push_back(seed);
    next_.push_back(none);
    link(std::uint32_t(seeds_.size() - 1));
    const int level = level_of(seed);
    if (std::find(levels_.begin(), levels_.end(), level) == levels_.end()) levels_.push_back(level);
  }

private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  static bool is_near(const Seed& seed, const Seed& candidate) {
    const double spacing = seed.is_fixed ? seed.spacing : std::min(seed.spacing, candidate.spacing);
    return (seed.point - candidate.point).squared_length() < spacing * spacing && seed.normal * candidate.normal >= 0;
  }

  /// The level of a seed: the lowest one whose cells, of side 2^level, are larger than twice its spacing, so that a
  /// ball of that radius meets at most two cells along each axis.
  static int level_of(const Seed& seed) { return std::ilogb(seed.spacing) + 2; }

  /// The cell of a level that contains p, shifted along all axes by `shift` sides of a cell.
  static Cell cell_of(const Point_3& p, int level, double shift = 0) {
    const auto index = [=](double x) { return std::int64_t(std::floor(std::ldexp(x, -level) + shift)); };
    return {index(p.x()), index(p.y()), index(p.z())};
  }

  std::size_t bucket(const Cell& c, int level) const {
    const std::uint64_t hash = (std::uint64_t(c[0]) * 0x9E3779B97F4A7C15U) ^
                               (std::uint64_t(c[1]) * 0xC2B2AE3D27D4EB4FU) ^
                               (std::uint64_t(c[2]) * 0x165667B19E3779F9U) ^ std::uint64_t(level) << 32;
    return std::size_t((hash ^ hash >> 29) & (heads_.size() - 1));
  }

  void link(std::uint32_t s) {
    const int level = level_of(seeds_[s]);
    auto& head = heads_[bucket(cell_of(seeds_[s].point, level), level)];
    next_[s] = head;
    head = s;
  }

  void grow() {
    heads_.assign(2 * heads_.size(), none);
    for (std::uint32_t s = 0; s < seeds_.size(); ++s) link(s);
  }

  std::vector<Seed> seeds_;
  std::uint32_t latest_ = none; // the seed near the latest crowded candidate, which often is near the next one, too
  std::vector<int> levels_;     // the levels of the seeds
  std::vector<std::uint32_t> heads_ = std::vector<std::uint32_t>(1024, none); // first seed of a bucket
  std::vector<std::uint32_t> next_;                                           // next seed of the same bucket, per seed
};

} // namespace equiaffine

#endif
