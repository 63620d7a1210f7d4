// SPDX-License-Identifier: GPL-3.0-or-later
// Removes small fragments from a sampled fit.
#ifndef EQUIAFFINE_FIT_REMOVE_SMALL_FRAGMENTS_H
#define EQUIAFFINE_FIT_REMOVE_SMALL_FRAGMENTS_H

#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/surface_parts.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace equiaffine::internal {

/// Whether the inner box comes within a grid step of the sides of the outer one, where the surface may be cut off.
inline bool is_cut_off(const CGAL::Bbox_3& inner, const CGAL::Bbox_3& outer, const std::array<std::size_t, 3>& nodes) {
  for (int a = 0; a < 3; ++a) {
    const double step = (outer.max(a) - outer.min(a)) / double(nodes[std::size_t(a)] - 1);
    if (inner.min(a) < outer.min(a) + step || inner.max(a) > outer.max(a) - step) return true;
  }
  return false;
}

/// Marks the vertices on edges of one triangle.
template <class Kernel>
std::vector<bool> borders_of(const Isosurface_3<Kernel>& surface) {
  std::vector<bool> result(surface.points.size(), false);
  for_each_vertex_link(surface.triangles, surface.points.size(), [&](const auto& link) {
    link.for_each_neighbor([&](std::uint32_t, std::size_t triangles_at_edge) {
      if (triangles_at_edge == 1) result[link.vertex()] = true;
    });
  });
  return result;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Removes small fragments from the sampled zero set of a fit, a Fitted_function_traits_3: the connected components
/// that have a border and are no larger than the band around one point. They occur next to the border of the
/// surface, where the band is ragged; a polynomial needs the points of a larger region. Components cut off by the
/// box of the fit stay; `nodes` are those of the sampling grid. `to_data` maps points of the surface to the
/// coordinates of the data, if these differ.
///
/// Takes linear time, and a nearest-neighbor search for each component with a border.
template <class Kernel, class Fit, class To_data = std::identity>
void remove_small_fragments(Isosurface_3<Kernel>& surface, const Fit& fit, const std::array<std::size_t, 3>& nodes,
                            const To_data& to_data = {}) {
  constexpr double reach = 2.5; // extent of a fragment in spacings
  const std::size_t n = surface.points.size();
  auto parts = internal::components_of(surface);
  const std::vector<bool> is_on_border = internal::borders_of(surface);
  std::vector<CGAL::Bbox_3> boxes(n);
  std::vector<bool> have_border(n, false), are_fragments(n, false);
  for (std::uint32_t v = 0; v < n; ++v) {
    boxes[parts.find(v)] += to_data(surface.points[v]).bbox();
    if (is_on_border[v]) have_border[parts.find(v)] = true;
  }
  const auto is_small = [&](std::uint32_t v) {
    const CGAL::Bbox_3& box = boxes[v];
    return std::hypot(box.x_span(), box.y_span(), box.z_span()) < reach * fit.spacing(to_data(surface.points[v]));
  };
  for (std::uint32_t v = 0; v < n; ++v)
    are_fragments[v] =
        parts.find(v) == v && have_border[v] && is_small(v) && !internal::is_cut_off(boxes[v], fit.bbox(), nodes);
  if (std::find(are_fragments.begin(), are_fragments.end(), true) == are_fragments.end()) return;
  std::erase_if(surface.triangles, [&](const auto& t) { return are_fragments[parts.find(t[0])]; });
  internal::remove_isolated_vertices(surface);
}

} // namespace equiaffine

#endif
