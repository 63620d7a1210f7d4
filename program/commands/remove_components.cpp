// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/remove_components.h"

#include "source/source.h"
#include <equiaffine/base/internal/disjoint_sets.h>
#include <equiaffine/mesh/Isosurface_3.h>
#include <equiaffine/mesh/internal/vertex_links.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

double diagonal(const CGAL::Bbox_3& box) { return std::hypot(box.x_span(), box.y_span(), box.z_span()); }

/// Whether the inner box comes within a step of the grid to the sides of the outer one, where it may be cut off.
bool is_cut_off(const CGAL::Bbox_3& inner, const CGAL::Bbox_3& outer, const std::array<std::size_t, 3>& nodes) {
  for (int a = 0; a < 3; ++a) {
    const double step = (outer.max(a) - outer.min(a)) / double(nodes[std::size_t(a)] - 1);
    if (inner.min(a) < outer.min(a) + step || inner.max(a) > outer.max(a) - step) return true;
  }
  return false;
}

Disjoint_sets<std::uint32_t> components_of(const Isosurface_3<Kernel>& surface) {
  Disjoint_sets<std::uint32_t> components(surface.points.size());
  for (const auto& [a, b, c] : surface.triangles) components.unite(a, b), components.unite(a, c);
  return components;
}

/// Removes the vertices that are in no triangle, and keeps the order of the others.
void remove_isolated_vertices(Isosurface_3<Kernel>& surface) {
  std::vector<bool> is_used(surface.points.size(), false);
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t v : triangle) is_used[v] = true;
  std::vector<std::uint32_t> number(surface.points.size());
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    if (!is_used[v]) continue;
    surface.points[kept] = surface.points[v];
    surface.vertex_status[kept] = surface.vertex_status[v];
    number[v] = kept++;
  }
  surface.points.erase(surface.points.begin() + std::ptrdiff_t(kept), surface.points.end());
  surface.vertex_status.resize(kept);
  for (auto& triangle : surface.triangles)
    for (std::uint32_t& v : triangle) v = number[v];
}

} // namespace

void remove_crumbs(Isosurface_3<Kernel>& surface, const Fit_traits& fit, const Source_options& options) {
  constexpr double reach = 2.5; // in spacings, from side to side
  const std::size_t n = surface.points.size();
  auto parts = components_of(surface);
  std::vector<CGAL::Bbox_3> boxes(n);
  std::vector<bool> have_border(n, false), are_crumbs(n, false);
  const auto back =
      options.transformation ? options.transformation->inverse() : CGAL::Aff_transformation_3<Kernel>(CGAL::IDENTITY);
  const auto to_data = [&](const Kernel::Point_3& p) { return options.transformation ? back(p) : p; };
  const auto nodes = options.resolution.value_or(default_resolution(options.kind));
  for (std::uint32_t v = 0; v < n; ++v) boxes[parts.find(v)] += to_data(surface.points[v]).bbox();
  for_each_vertex_link(surface.triangles, n, [&](const auto& link) {
    link.for_each_neighbor([&](std::uint32_t, std::size_t triangles_at_edge) {
      if (triangles_at_edge == 1) have_border[parts.find(link.vertex())] = true;
    });
  });
  for (std::uint32_t v = 0; v < n; ++v)
    are_crumbs[v] = parts.find(v) == v && have_border[v] &&
                    diagonal(boxes[v]) < reach * fit.spacing(to_data(surface.points[v])) &&
                    !is_cut_off(boxes[v], fit.bbox(), nodes);
  if (std::find(are_crumbs.begin(), are_crumbs.end(), true) == are_crumbs.end()) return;
  std::erase_if(surface.triangles, [&](const auto& t) { return are_crumbs[parts.find(t[0])]; });
  remove_isolated_vertices(surface);
}

std::size_t keep_largest(Isosurface_3<Kernel>& surface, std::size_t count, std::vector<double>& values) {
  auto components = components_of(surface);
  std::map<std::uint32_t, double> areas;
  for (const auto& [a, b, c] : surface.triangles)
    areas[components.find(a)] +=
        std::sqrt(CGAL::cross_product(surface.points[b] - surface.points[a], surface.points[c] - surface.points[a])
                      .squared_length());
  if (areas.size() <= count) return 0;
  std::vector<std::pair<double, std::uint32_t>> sorted;
  for (const auto& [component, area] : areas) sorted.emplace_back(-area, component);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = count; i < sorted.size(); ++i) areas.erase(sorted[i].second);
  const auto is_left_out = [&](std::uint32_t v) { return !areas.contains(components.find(v)); };
  std::erase_if(surface.triangles, [&](const auto& t) { return is_left_out(t[0]); });
  std::uint32_t v = 0;
  std::erase_if(values, [&](double) { return is_left_out(v++); });
  remove_isolated_vertices(surface);
  return sorted.size() - count;
}

} // namespace equiaffine
