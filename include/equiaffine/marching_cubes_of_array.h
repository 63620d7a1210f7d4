// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_OF_ARRAY_H
#define EQUIAFFINE_MARCHING_CUBES_OF_ARRAY_H

#include <equiaffine/internal/Output_allocator.h>
#include <equiaffine/internal/inner_vertex.h>
#include <equiaffine/internal/isosurface_extraction.h>
#include <equiaffine/internal/trilinear_cell.h>
#include <equiaffine/internal/zero_area_repair.h>

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

/// Marching Cubes on a plain array: the surface where `values`, float or double with i fastest, pass `isovalue`. Node
/// (i, j, k) lies at origin + (i, j, k) * spacing. Topology and conventions of values at the isovalue and of NaN are
/// those of `marching_cubes`; vertices are the linear intersections.
/// \pre as many values as nodes, at least two nodes along each axis, positive spacing
template <class ConcurrencyTag = CGAL::Sequential_tag, class FT>
Array_isosurface_3<FT> marching_cubes_of_array(std::span<const FT> values, const std::array<std::size_t, 3>& size,
                                               FT isovalue, const std::array<FT, 3>& origin = {0, 0, 0},
                                               const std::array<FT, 3>& spacing = {1, 1, 1}) {
  const auto [nx, ny, nz] = size;
  CGAL_precondition(nx >= 2 && ny >= 2 && nz >= 2 && values.size() == nx * ny * nz);
  CGAL_precondition(spacing[0] > 0 && spacing[1] > 0 && spacing[2] > 0);
  internal::Node_signs signs(size);
  internal::parallel_for<ConcurrencyTag>(0, nz, [&, nx = nx, ny = ny](std::size_t k) {
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; i += 64) {
        const std::size_t n = std::min<std::size_t>(64, nx - i);
        signs.set(i, j, k, internal::sign_word(&values[(k * ny + j) * nx + i], n, isovalue));
      }
  });
  const std::array<std::size_t, 3> stride = {1, nx, nx * ny};
  const FT* const data = values.data();
  const auto value = [data, stride](std::size_t i, std::size_t j, std::size_t k) {
    return data[i + j * stride[1] + k * stride[2]];
  };
  const auto corner_values = [&](std::size_t i, std::size_t j, std::size_t k) {
    std::array<FT, 8> v;
    for (std::size_t c = 0; c < 8; ++c) v[c] = value(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
    return v;
  };
  const auto choose = [&](std::size_t i, std::size_t j, std::size_t k, unsigned s) {
    return internal::Trilinear_cell<FT>(corner_values(i, j, k), isovalue).sub_case(s);
  };
  internal::Isosurface_extraction<ConcurrencyTag, decltype(choose)> extraction(signs, internal::Case_table::instance(),
                                                                               choose);
  Array_isosurface_3<FT> result;
  result.points.resize(extraction.number_of_vertices());
  result.triangles.resize(extraction.number_of_triangles());
  auto* const points = result.points.data();
  const auto point = [&](const std::array<std::size_t, 3>& node, const std::array<FT, 3>& offset) {
    std::array<FT, 3> p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = origin[a] + (FT(std::ptrdiff_t(node[a])) + offset[a]) * spacing[a];
    return p;
  };
  extraction.for_each_edge_vertex([&](std::size_t v, std::size_t i, std::size_t j, std::size_t k, auto axis) {
    const std::array<std::size_t, 3> node = {i, j, k};
    const FT* const here = data + i + j * stride[1] + k * stride[2];
    std::array<FT, 3> offset{0, 0, 0};
    offset[axis] = internal::linear_zero(FT(here[0] - isovalue), FT(here[stride[axis]] - isovalue));
    const std::array<FT, 3> p = points[v] = point(node, offset);
    const FT first = FT(std::ptrdiff_t(node[axis]));
    return p[axis] == origin[axis] + first * spacing[axis] || p[axis] == origin[axis] + (first + 1) * spacing[axis];
  });
  const auto coordinates = [&](std::size_t v) -> const std::array<FT, 3>& { return points[v]; };
  extraction.emit(
      result.triangles.data(), false,
      [&](std::size_t first, std::size_t i, std::size_t j, std::size_t k, const auto& edges, auto triangles) {
        std::array<FT, 8> f;
        for (std::size_t c = 0; c < 8; ++c) f[c] = value(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) - isovalue;
        for (std::size_t n = 0; n < edges.size(); ++n)
          points[first + n] = point({i, j, k}, internal::inner_vertex(f, edges[n]));
        return internal::any_zero_area(triangles, coordinates);
      });
  const auto nudge = [&](std::size_t v, int round) {
    const auto edge = extraction.edge_of(v);
    const std::size_t axis = edge ? edge->axis : (v + std::size_t(round)) % 3;
    const std::array<FT, 3> old = points[v];
    const bool is_back = edge && old[axis] > origin[axis] + (FT(edge->node[axis]) + FT(0.5)) * spacing[axis];
    points[v] = internal::nudged(old, v, round, [&](double d) {
      auto p = old;
      p[axis] += FT(is_back ? -d : d) * spacing[axis];
      return p;
    });
  };
  const auto part = extraction.doubtful_triangles();
  if (!part.empty()) {
    internal::Zero_area_repair repair(std::span(result.triangles), part, coordinates, nudge);
    result.repairs = repair.repairs();
    repair.remove(
        result.triangles,
        [&](std::size_t v, const auto& visit) { extraction.for_each_part_with_vertices_from(v, visit); },
        result.points);
  }
  return result;
}

} // namespace equiaffine

#endif
