// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_POINT_BLOCKS_H
#define EQUIAFFINE_FUNCTION_INTERNAL_POINT_BLOCKS_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Cell_block.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace equiaffine {

/// The numbers of cells along each axis of a tile, the unit of work of a thread. The spline coefficients of a tile,
/// with a border as wide as the degree, fit into a processor's cache. 64 cells along i match the words of 64 signs in
/// Marching Cubes.
inline constexpr std::array<std::size_t, 3> cells_of_tile = {64, 32, 32};

namespace internal {

/// Points grouped by the tiles of a lattice that contain them.
template <class Function, class Point>
class Points_by_tile {
  using Cell = std::array<std::size_t, 3>;

public:
  template <class ConcurrencyTag>
  Points_by_tile(const Function& function, std::span<const Point> points, ConcurrencyTag)
      : function_(function), points_(points) {
    const auto size = function.lattice().size();
    std::array<std::size_t, 3> tiles;
    for (std::size_t a = 0; a < 3; ++a) tiles[a] = (size[a] - 2) / cells_of_tile[a] + 1;
    const std::size_t outside = tiles[0] * tiles[1] * tiles[2];
    std::vector<std::uint32_t> tile_of(points.size());
    parallel_for<ConcurrencyTag>(
        0, points.size(),
        [&](std::size_t n) {
          const std::optional<Cell> cell = function.cell_of(points[n]);
          tile_of[n] = std::uint32_t(
              !cell ? outside
                    : ((*cell)[2] / cells_of_tile[2] * tiles[1] + (*cell)[1] / cells_of_tile[1]) * tiles[0] +
                          (*cell)[0] / cells_of_tile[0]);
        },
        1024);
    std::vector<std::uint32_t> first_of(outside + 2); // start of each tile's points, and of those outside
    for (const std::uint32_t t : tile_of) ++first_of[t + 1];
    std::partial_sum(first_of.begin(), first_of.end(), first_of.begin());
    numbers_.resize(points.size());
    std::vector<std::uint32_t> next(first_of.begin(), first_of.end() - 1);
    for (std::size_t n = 0; n < points.size(); ++n) numbers_[next[tile_of[n]]++] = std::uint32_t(n);
    for (std::size_t t = 0; t + 1 < first_of.size(); ++t)
      for (std::uint32_t first = first_of[t]; first < first_of[t + 1]; first += points_of_task)
        tasks_.push_back({first, std::min(first + points_of_task, first_of[t + 1]), t == outside});
  }

  /// Calls visit(local, numbers) for groups of points of one tile, and for points outside of the lattice.
  template <class ConcurrencyTag, class Visit>
  void for_each_task(std::size_t margin, const Visit& visit) const {
    parallel_for<ConcurrencyTag>(0, tasks_.size(), [&](std::size_t n) {
      const Task& task = tasks_[n];
      const auto numbers = std::span(numbers_).subspan(task.first, task.end - task.first);
      if (task.is_outside) visit(function_, numbers);
      else visit(function_.restricted_to_cells(cells_around(numbers, margin)), numbers);
    });
  }

private:
  /// Upper bound on the points per task; a tile of a surface usually has fewer.
  static constexpr std::uint32_t points_of_task = 4096;

  struct Task {
    std::uint32_t first, end; ///< a range of numbers_
    bool is_outside;
  };

  /// The block of the cells of some points, with `margin` more cells on all sides.
  Cell_block cells_around(std::span<const std::uint32_t> numbers, std::size_t margin) const {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    Cell_block block{{most, most, most}, {0, 0, 0}};
    for (const std::uint32_t n : numbers) {
      const Cell cell = *function_.cell_of(points_[n]);
      for (std::size_t a = 0; a < 3; ++a) {
        block.first[a] = std::min(block.first[a], cell[a]);
        block.end[a] = std::max(block.end[a], cell[a] + 1);
      }
    }
    const auto size = function_.lattice().size();
    for (std::size_t a = 0; a < 3; ++a) {
      block.first[a] -= std::min(block.first[a], margin);
      block.end[a] = std::min(block.end[a] + margin, size[a] - 1);
    }
    return block;
  }

  const Function& function_;
  std::span<const Point> points_;
  std::vector<std::uint32_t> numbers_; // indices of the points, tile by tile
  std::vector<Task> tasks_;
};

} // namespace internal

/// Partitions the points into blocks of at most `most` points and calls visit(local, numbers) for each block, in
/// several threads. `numbers` are the indices of its points; evaluate `local` at them. If the function can be
/// restricted to cells, each block lies within one tile of its lattice, and `local` is restricted to the cells of the
/// block and `margin` more on all sides.
template <class ConcurrencyTag, class Function, class Point, class Visit>
void for_each_point_block(const Function& function, std::span<const Point> points, std::size_t most, std::size_t margin,
                          const Visit& visit) {
  const auto visit_blocks = [&](const Function& local, std::size_t count, const auto& number) {
    std::vector<std::size_t> numbers;
    for (std::size_t first = 0; first < count; first += most) {
      numbers.resize(std::min(most, count - first));
      for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = number(first + n);
      visit(local, std::span<const std::size_t>(numbers));
    }
  };
  if constexpr (requires(const Cell_block& cells) { function.restricted_to_cells(cells); }) {
    constexpr std::size_t points_at_once = std::size_t(1) << 22;
    for (std::size_t first = 0; first < points.size(); first += points_at_once) {
      const auto some = points.subspan(first, std::min(points_at_once, points.size() - first));
      const internal::Points_by_tile<Function, Point> tiles(function, some, ConcurrencyTag());
      tiles.template for_each_task<ConcurrencyTag>(
          margin, [&](const Function& local, std::span<const std::uint32_t> of_tile) {
            visit_blocks(local, of_tile.size(), [&](std::size_t n) { return first + of_tile[n]; });
          });
    }
  } else {
    constexpr std::size_t points_of_task = 256;
    const std::size_t of_task = (points_of_task + most - 1) / most * most;
    parallel_for<ConcurrencyTag>(0, (points.size() + of_task - 1) / of_task, [&](std::size_t task) {
      const std::size_t first = task * of_task;
      visit_blocks(function, std::min(of_task, points.size() - first), [&](std::size_t n) { return first + n; });
    });
  }
}

} // namespace equiaffine

#endif
