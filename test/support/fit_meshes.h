// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes for tests of remeshing by fits, and checks of their invariants.
#ifndef EQUIAFFINE_TEST_SUPPORT_FIT_MESHES_H
#define EQUIAFFINE_TEST_SUPPORT_FIT_MESHES_H

#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>

namespace fit_meshes {

using equiaffine::Fit_outcome;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point_3>;
using Fit = equiaffine::Fitted_function_traits_3<Kernel>;
using Outcomes = Mesh::Property_map<Mesh::Vertex_index, Fit_outcome>;

inline std::ptrdiff_t euler_characteristic(const Mesh& mesh) {
  return std::ptrdiff_t(mesh.number_of_vertices()) - std::ptrdiff_t(mesh.number_of_edges()) +
         std::ptrdiff_t(mesh.number_of_faces());
}

inline std::size_t number_of_border_loops(const Mesh& mesh) {
  std::size_t loops = 0;
  std::set<Mesh::Halfedge_index> seen;
  for (const auto first : mesh.halfedges())
    if (mesh.is_border(first) && !seen.contains(first)) {
      ++loops;
      for (auto h = first; seen.insert(h).second;) h = mesh.next(h);
    }
  return loops;
}

inline Outcomes outcomes_of(Mesh& mesh) {
  return mesh.add_property_map<Mesh::Vertex_index, Fit_outcome>("v:outcome", Fit_outcome::CROSSING).first;
}

/// Expects the counts of a report to be those of the outcomes of the vertices.
inline void expect_counted(const Mesh& mesh, const Outcomes& outcomes, const equiaffine::Fit_move_report& report) {
  std::array<std::size_t, equiaffine::number_of_fit_outcomes> number_of = {};
  for (const auto v : mesh.vertices()) ++number_of[std::size_t(outcomes[v])];
  EXPECT_EQ(report.number_of, number_of);
  EXPECT_EQ(report.number_of_vertices(), mesh.number_of_vertices());
}

/// A grid of n x m squares, cut into triangles, that is closed in one direction or both, mapped by f.
template <class F>
Mesh grid(std::size_t n, std::size_t m, bool is_closed_1, bool is_closed_2, const F& f) {
  Mesh mesh;
  const std::size_t rows = n + !is_closed_1, columns = m + !is_closed_2;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) mesh.add_vertex(f(double(i) / double(n), double(j) / double(m)));
  const auto vertex = [&](std::size_t i, std::size_t j) {
    return Mesh::Vertex_index(Mesh::size_type((i % rows) * columns + j % columns));
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  return mesh;
}

/// A torus with 2 n^2 vertices.
inline Mesh torus(std::size_t n) {
  return grid(2 * n, n, true, true, [](double s, double t) {
    const double u = 2 * std::numbers::pi * s, v = 2 * std::numbers::pi * t, r = 1 + .4 * std::cos(v);
    return Point_3(r * std::cos(u), r * std::sin(u), .4 * std::sin(v));
  });
}

inline double distance_from_torus(const Point_3& p) {
  return std::abs(std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - .4);
}

/// Expects the points of the fit to be on the torus within the error of the fit, a tenth of that of the triangles.
inline void expect_on_fit(const Point_3& p, const Fit& fit) {
  EXPECT_LT(std::abs(fit.taylor(p).value()), 1e-12);
  EXPECT_LT(distance_from_torus(p), 1e-4);
}

} // namespace fit_meshes

#endif
