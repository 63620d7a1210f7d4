// SPDX-License-Identifier: GPL-3.0-or-later
// What tests ask of Delaunay meshes.
#ifndef EQUIAFFINE_TEST_DELAUNAY_MESHED_SURFACES_H
#define EQUIAFFINE_TEST_DELAUNAY_MESHED_SURFACES_H

#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace meshed_surfaces {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Surface = Delaunay_surface_3<Kernel>;

template <class Function>
auto traits_of(const Function& f) {
  return make_analytic_traits<Kernel>(f, f.box());
}

inline Mesh_topology topology(const Surface& surface) {
  return mesh_topology(surface.triangles, surface.points.size());
}

/// Of the triangles without a vertex on a feature.
inline double smallest_angle(const Surface& surface, const std::vector<bool>& is_on_feature) {
  double smallest = 180;
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (!is_on_feature[t[0]] && !is_on_feature[t[1]] && !is_on_feature[t[2]])
        smallest = std::min(smallest, CGAL::approximate_angle(surface.points[t[(i + 1) % 3]], surface.points[t[i]],
                                                              surface.points[t[(i + 2) % 3]]));
  return smallest;
}

/// Per vertex; a boundary edge is one of a single triangle.
inline std::vector<bool> is_on_boundary(const Surface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles;
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++triangles[std::minmax(t[i], t[(i + 1) % 3])];
  std::vector<bool> result(surface.points.size(), false);
  for (const auto& [edge, n] : triangles)
    if (n == 1) result[edge.first] = result[edge.second] = true;
  return result;
}

template <class Traits>
void expect_vertices_on_surface(const Traits& traits, const Surface& surface, double diagonal) {
  for (const Point_3& p : surface.points) ASSERT_LE(distance_estimate(first_order(traits, p)), 1e-14 * diagonal) << p;
  for (const Point_status status : surface.vertex_status) ASSERT_EQ(status, Point_status::REGULAR);
  ASSERT_EQ(surface.vertex_status.size(), surface.points.size());
}

} // namespace meshed_surfaces

#endif
