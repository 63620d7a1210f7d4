// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes on a plain array of values.
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_OF_ARRAY_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_OF_ARRAY_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>
#include <equiaffine/marching_cubes/internal/isosurface_plan.h>
#include <equiaffine/marching_cubes/internal/linear_isosurface.h>
#include <equiaffine/marching_cubes/internal/node_signs.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// An allocator for large arrays that are written once, right after allocation: it leaves numbers uninitialized and
/// requests large pages.
template <class T>
struct Output_allocator {
  using value_type = T;

  Output_allocator() = default;
  template <class U>
  Output_allocator(const Output_allocator<U>&) {}

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T), rounded = (bytes + large_page - 1) / large_page * large_page;
    const bool is_large = bytes >= 2 * large_page;
    void* const memory = is_large ? std::aligned_alloc(large_page, rounded) : std::malloc(bytes);
    if (!memory) throw std::bad_alloc();
    if (is_large) advise_large_pages(memory, rounded);
    return static_cast<T*>(memory);
  }
  void deallocate(T* p, std::size_t) { std::free(p); }

  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const Output_allocator&, const Output_allocator&) { return true; }
};

} // namespace equiaffine::internal

namespace equiaffine {

/// A triangle mesh in plain arrays. Triangles are counterclockwise seen from the side of the greater values.
template <class FT>
struct Array_isosurface_3 {
  std::vector<std::array<FT, 3>, internal::Output_allocator<std::array<FT, 3>>> points; ///< the points
  /// Three point indices each.
  std::vector<std::array<std::uint32_t, 3>, internal::Output_allocator<std::array<std::uint32_t, 3>>> triangles;
  Isosurface_repairs repairs; ///< the repairs that were made
};

} // namespace equiaffine

namespace equiaffine::internal {

/// The values at the nodes of a grid, with i fastest, and the positions of the nodes: a Grid as in
/// isosurface_numbering.h.
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

  /// A pointer to the value at a node, followed by those at the next nodes along i.
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
  /// The distance in `values_` between neighbors along each axis.
  Node stride() const { return {1, size_[0], size_[0] * size_[1]}; }

  std::span<const FT> values_;
  Node size_;
  FT isovalue_;
  Point origin_, spacing_;
};

/// Prefetches 64 numbers one page ahead: the processor does not prefetch beyond the end of a page by itself.
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

/// Computes the surface of an array with the given table of cases.
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

namespace equiaffine {

/// Marching Cubes on a plain array: meshes the surface where `values`, float or double with i fastest, cross
/// `isovalue`. Node (i, j, k) lies at origin + (i, j, k) * spacing. The topology and the treatment of NaN and of
/// values equal to the isovalue are those of marching_cubes(). Vertices are placed by linear interpolation along
/// edges.
/// \throw std::invalid_argument unless there is one value per node, at least two nodes along each axis, and the
/// spacing is positive and finite
template <class ConcurrencyTag = CGAL::Sequential_tag, class FT>
Array_isosurface_3<FT> marching_cubes_of_array(std::span<const FT> values, const std::array<std::size_t, 3>& size,
                                               FT isovalue, const std::array<FT, 3>& origin = {0, 0, 0},
                                               const std::array<FT, 3>& spacing = {1, 1, 1}) {
  const auto [nx, ny, nz] = size;
  check_argument(nx >= 2 && ny >= 2 && nz >= 2,
                 "an array has fewer than two nodes along an axis: choose a larger size");
  check_argument(values.size() / nx / ny == nz && values.size() == nx * ny * nz,
                 "the number of values does not match the size of the array: give one value per node");
  for (const FT& step : spacing)
    check_argument(step > 0 && step - step == 0,
                   "the spacing of an array is not positive and finite: choose a positive length along each axis");
  const internal::Array_grid<FT> grid(values, size, isovalue, origin, spacing);
  return internal::isosurface_of_array<ConcurrencyTag>(grid, internal::Case_table::instance());
}

} // namespace equiaffine

#endif
