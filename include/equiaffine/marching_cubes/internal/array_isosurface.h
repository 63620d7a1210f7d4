// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ARRAY_ISOSURFACE_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ARRAY_ISOSURFACE_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/marching_cubes/Array_isosurface_3.h>
#include <equiaffine/marching_cubes/internal/grid_elements.h>
#include <equiaffine/marching_cubes/internal/isosurface_plan.h>
#include <equiaffine/marching_cubes/internal/linear_isosurface.h>
#include <equiaffine/marching_cubes/internal/node_signs.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// The values at the nodes of a grid, with i fastest, and where the nodes lie: a Grid as in grid_elements.h.
template <class Number>
class Array_grid {
public:
  using FT = Number;
  using Point = std::array<FT, 3>;
  using Node = std::array<std::size_t, 3>;

  Array_grid(std::span<const FT> values, const Node& size, FT isovalue, const Point& origin, const Point& spacing)
      : values_(values), size_(size), isovalue_(isovalue), origin_(origin), spacing_(spacing) {}

  const Node& size() const { return size_; }
  FT isovalue() const { return isovalue_; }
  static bool is_left_handed() { return false; } // spacings are positive
  std::size_t index_in_whole(const Node& n) const { return n[0] + size_[0] * (n[1] + size_[1] * n[2]); }
  static bool is_at_cut(const Grid_edge&) { return false; }
  static const Point& coordinates(const Point& p) { return p; }

  /// The value at a node, followed by those at the next nodes along i.
  const FT* values_from(const Node& n) const { return &values_[index_in_whole(n)]; }

  std::array<FT, 8> cell_values(const Node& cell) const {
    const FT* const first = values_from(cell);
    std::array<FT, 8> v;
    for (std::size_t c = 0; c < 8; ++c) v[c] = first[(c & 1) + (c >> 1 & 1) * stride()[1] + (c >> 2) * stride()[2]];
    return v;
  }

  Point point(const Node& cell, const std::array<FT, 3>& offset) const {
    Point p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = origin_[a] + (FT(std::ptrdiff_t(cell[a])) + offset[a]) * spacing_[a];
    return p;
  }

  template <class Axis>
  Edge_vertex<Point> edge_vertex(const Node& node, Axis axis) const {
    const FT* const here = values_from(node);
    std::array<FT, 3> offset{0, 0, 0};
    offset[axis] = linear_zero(FT(here[0] - isovalue_), FT(here[stride()[axis]] - isovalue_));
    const Point p = point(node, offset);
    const FT steps = FT(std::ptrdiff_t(node[axis]));
    return {p, p[axis] == origin_[axis] + steps * spacing_[axis] ||
                   p[axis] == origin_[axis] + (steps + 1) * spacing_[axis]};
  }

  bool is_nearer_to_end(const Grid_edge& edge, const Point& p) const {
    std::array<FT, 3> halfway{0, 0, 0};
    halfway[edge.axis] = FT(0.5);
    return p[edge.axis] > point(edge.node, halfway)[edge.axis];
  }

  Point moved(Point p, std::size_t axis, double steps) const {
    p[axis] += FT(steps) * spacing_[axis];
    return p;
  }

private:
  /// The distance in `values_` from a node to the next one along each axis.
  Node stride() const { return {1, size_[0], size_[0] * size_[1]}; }

  std::span<const FT> values_;
  Node size_;
  FT isovalue_;
  Point origin_, spacing_;
};

/// Prefetches the 64 numbers one page after these: the processor by itself does not prefetch beyond the end of a page.
template <class FT>
void fetch_ahead([[maybe_unused]] const FT* values) {
#ifdef __GNUC__
  constexpr std::size_t page = 4096, line = 64;
  const auto next = reinterpret_cast<std::uintptr_t>(values) + page;
  for (std::size_t b = 0; b < 64 * sizeof(FT); b += line) __builtin_prefetch(reinterpret_cast<const void*>(next + b));
#endif
}

template <class ConcurrencyTag, class FT>
Node_signs node_signs(const Array_grid<FT>& grid) {
  const std::size_t nx = grid.size()[0], ny = grid.size()[1], nz = grid.size()[2];
  Node_signs signs(grid.size());
  parallel_for<ConcurrencyTag>(0, nz, [&](std::size_t k) {
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; i += 64) {
        const FT* const values = grid.values_from({i, j, k});
        fetch_ahead(values);
        signs.set(i, j, k, sign_word(values, std::min<std::size_t>(64, nx - i), grid.isovalue()));
      }
  });
  return signs;
}

/// Computes the surface of an array with the cases of the given table.
template <class ConcurrencyTag, class FT>
Array_isosurface_3<FT> isosurface_of_array(const Array_grid<FT>& grid, const Case_table& table) {
  const Node_signs signs = node_signs<ConcurrencyTag>(grid);
  const Isosurface_plan plan = plan_isosurface<ConcurrencyTag>(signs, grid, table);
  Array_isosurface_3<FT> surface;
  surface.points.resize(plan.numbering.number_of_vertices());
  surface.triangles.resize(plan.numbering.number_of_triangles());
  std::vector<Inner_vertex<FT>> inner_vertices(plan.numbering.number_of_inner_vertices());
  const auto keep_inner = [&](std::size_t v, const std::array<std::size_t, 3>& cell, const std::array<FT, 3>& offset) {
    inner_vertices[plan.numbering.place_of_inner(v, cell[2])] = {cell, offset};
  };
  const Grid_rows suspects =
      place_linearly<ConcurrencyTag>(grid, plan, surface.points.data(), surface.triangles.data(), keep_inner);
  Layer_bounds bounds(plan.numbering);
  surface.repairs = repair_mesh(grid, plan, inner_vertices, suspects, bounds, surface.triangles, surface.points);
  return surface;
}

} // namespace equiaffine::internal

#endif
