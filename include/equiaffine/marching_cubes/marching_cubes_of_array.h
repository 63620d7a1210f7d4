// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_OF_ARRAY_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_OF_ARRAY_H

#include <equiaffine/marching_cubes/internal/Output_allocator.h>
#include <equiaffine/marching_cubes/internal/inner_vertex.h>
#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>
#include <equiaffine/marching_cubes/internal/split_fans.h>
#include <equiaffine/marching_cubes/internal/trilinear_cell.h>
#include <equiaffine/marching_cubes/internal/zero_area_repair.h>
#include <equiaffine/surface/sign_change.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace equiaffine {

/// A triangle mesh as plain arrays, triangles counterclockwise seen from the side of the greater values.
template <class FT>
struct Array_isosurface_3 {
  std::vector<std::array<FT, 3>, internal::Output_allocator<std::array<FT, 3>>> points;
  std::vector<std::array<std::uint32_t, 3>, internal::Output_allocator<std::array<std::uint32_t, 3>>> triangles;
  Isosurface_repairs repairs;
};

namespace internal {

/// Node values with i fastest, and where the nodes lie.
template <class FT>
struct Array_grid {
  using Node = std::array<std::size_t, 3>;
  std::span<const FT> values;
  Node size;
  FT isovalue;
  std::array<FT, 3> origin, spacing;

  Node stride() const { return {1, size[0], size[0] * size[1]}; }
  const FT* at(const Node& n) const { return &values[n[0] + size[0] * (n[1] + size[1] * n[2])]; }

  std::array<FT, 3> point(const Node& node, const std::array<FT, 3>& offset) const {
    std::array<FT, 3> p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = origin[a] + (FT(std::ptrdiff_t(node[a])) + offset[a]) * spacing[a];
    return p;
  }

  std::array<FT, 8> cell_values(const Node& cell) const {
    const FT* const first = at(cell);
    std::array<FT, 8> v;
    for (std::size_t c = 0; c < 8; ++c) v[c] = first[(c & 1) + (c >> 1 & 1) * stride()[1] + (c >> 2) * stride()[2]];
    return v;
  }
};

/// Asks for the 64 numbers that are read a page after these: what the processor fetches by itself ends with the page.
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
  Node_signs signs(grid.size);
  const std::size_t nx = grid.size[0];
  parallel_for<ConcurrencyTag>(0, grid.size[2], [&](std::size_t k) {
    for (std::size_t j = 0; j < grid.size[1]; ++j)
      for (std::size_t i = 0; i < nx; i += 64) {
        const FT* const values = grid.at({i, j, k});
        fetch_ahead(values);
        signs.set(i, j, k, sign_word(values, std::min<std::size_t>(64, nx - i), grid.isovalue));
      }
  });
  return signs;
}

template <class Extraction, class FT>
void repair(const Extraction& extraction, const Array_grid<FT>& grid, Array_isosurface_3<FT>& surface) {
  const auto part = extraction.doubtful_triangles();
  if (part.empty()) return;
  auto& points = surface.points;
  const auto nudge = [&](std::size_t v, int round) {
    const auto edge = extraction.numbering().edge_of(v);
    const std::size_t axis = edge ? edge->axis : (v + std::size_t(round)) % 3;
    const std::array<FT, 3> old = points[v];
    std::array<FT, 3> halfway{0, 0, 0};
    halfway[axis] = FT(0.5);
    const bool is_back = edge && old[axis] > grid.point(edge->node, halfway)[axis];
    points[v] = nudged(old, v, round, [&](double d) {
      auto p = old;
      p[axis] += FT(is_back ? -d : d) * grid.spacing[axis];
      return p;
    });
  };
  const auto coordinates = [&](std::size_t v) -> const std::array<FT, 3>& { return points[v]; };
  Zero_area_repair repair(std::span(surface.triangles), part, coordinates, nudge);
  surface.repairs = repair.repairs();
  repair.remove(extraction.numbering(), surface.triangles, points);
}

/// With the decisions of a table; those it leaves open are made by the trilinear interpolant.
template <class ConcurrencyTag, class FT>
Array_isosurface_3<FT> extract(const Array_grid<FT>& grid, const Case_table& table) {
  const Node_signs signs = node_signs<ConcurrencyTag>(grid);
  const auto choose = [&](std::size_t i, std::size_t j, std::size_t k, unsigned corner_signs) {
    return Trilinear_cell<FT>(grid.cell_values({i, j, k}), grid.isovalue).sub_case(corner_signs);
  };
  Isosurface_extraction<ConcurrencyTag, decltype(choose)> extraction(signs, table, choose);
  Array_isosurface_3<FT> surface;
  surface.points.resize(extraction.numbering().number_of_vertices());
  surface.triangles.resize(extraction.numbering().number_of_triangles());
  auto* const points = surface.points.data();
  extraction.for_each_edge_vertex([&](std::size_t v, std::size_t i, std::size_t j, std::size_t k, auto axis) {
    const std::array<std::size_t, 3> node = {i, j, k};
    const FT* const here = grid.at(node);
    std::array<FT, 3> offset{0, 0, 0};
    offset[axis] = linear_zero(FT(here[0] - grid.isovalue), FT(here[grid.stride()[axis]] - grid.isovalue));
    const std::array<FT, 3> p = points[v] = grid.point(node, offset);
    const FT first = FT(std::ptrdiff_t(node[axis]));
    return p[axis] == grid.origin[axis] + first * grid.spacing[axis] ||
           p[axis] == grid.origin[axis] + (first + 1) * grid.spacing[axis];
  });
  extraction.emit(
      surface.triangles.data(), false,
      [&](std::size_t first, std::size_t i, std::size_t j, std::size_t k, const auto& edges, const auto& triangles) {
        auto f = grid.cell_values({i, j, k});
        for (FT& x : f) x -= grid.isovalue;
        for (std::size_t n = 0; n < edges.size(); ++n)
          points[first + n] = grid.point({i, j, k}, inner_vertex(f, edges[n]));
        return any_zero_area(
            triangles, [&](std::size_t v) -> const auto& { return points[v]; });
      });
  repair(extraction, grid, surface);
  if (signs.has_undefined())
    split_fans(surface.triangles, surface.points.size(),
               [&](std::size_t v) { surface.points.push_back(std::array<FT, 3>(surface.points[v])); });
  return surface;
}

} // namespace internal

/// Marching Cubes on a plain array: the surface where `values`, float or double with i fastest, pass `isovalue`. Node
/// (i, j, k) lies at origin + (i, j, k) * spacing. Topology and conventions of values at the isovalue and of NaN are
/// those of `marching_cubes`; vertices are the linear intersections.
/// \pre as many values as nodes, at least two nodes along each axis, positive spacing
template <class ConcurrencyTag = CGAL::Sequential_tag, class FT>
Array_isosurface_3<FT> marching_cubes_of_array(std::span<const FT> values, const std::array<std::size_t, 3>& size,
                                               FT isovalue, const std::array<FT, 3>& origin = {0, 0, 0},
                                               const std::array<FT, 3>& spacing = {1, 1, 1}) {
  [[maybe_unused]] const auto [nx, ny, nz] = size;
  CGAL_precondition(nx >= 2 && ny >= 2 && nz >= 2 && values.size() == nx * ny * nz);
  CGAL_precondition(spacing[0] > 0 && spacing[1] > 0 && spacing[2] > 0);
  return internal::extract<ConcurrencyTag, FT>({values, size, isovalue, origin, spacing},
                                               internal::Case_table::instance());
}

} // namespace equiaffine

#endif
