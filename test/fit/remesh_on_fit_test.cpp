// SPDX-License-Identifier: GPL-3.0-or-later
// Remeshes on a fit, and meshes whose vertices are moved to it, stay whole.
#include <equiaffine/Fitted_function_traits_3.h>
#include <equiaffine/move_to_fit.h>
#include <equiaffine/remesh_on_fit.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/helpers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace {

using namespace equiaffine;
namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_3 = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point_3>;
using Fit = Fitted_function_traits_3<Kernel>;
using Outcomes = Mesh::Property_map<Mesh::Vertex_index, Fit_outcome>;

std::ptrdiff_t euler_characteristic(const Mesh& mesh) {
  return std::ptrdiff_t(mesh.number_of_vertices()) - std::ptrdiff_t(mesh.number_of_edges()) +
         std::ptrdiff_t(mesh.number_of_faces());
}

std::size_t number_of_border_loops(const Mesh& mesh) {
  std::vector<Mesh::Halfedge_index> loops;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(loops));
  return loops.size();
}

Outcomes outcomes_of(Mesh& mesh) {
  return mesh.add_property_map<Mesh::Vertex_index, Fit_outcome>("v:outcome", Fit_outcome::CROSSING).first;
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
Mesh torus(std::size_t n) {
  return grid(2 * n, n, true, true, [](double s, double t) {
    const double u = 2 * std::numbers::pi * s, v = 2 * std::numbers::pi * t, r = 1 + .4 * std::cos(v);
    return Point_3(r * std::cos(u), r * std::sin(u), .4 * std::sin(v));
  });
}

double distance_from_torus(const Point_3& p) { return std::abs(std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - .4); }

/// Points of the fit are on the torus to within its error, less than a tenth of that of the triangles.
void expect_on_fit(const Point_3& p, const Fit& fit) {
  EXPECT_LT(std::abs(fit.taylor(p).value()), 1e-12);
  EXPECT_LT(distance_from_torus(p), 5e-5);
}

TEST(Remesh_on_fit, a_closed_surface_stays_closed_and_lies_on_the_fit) {
  Mesh mesh = torus(60);
  const Fit fit(mesh);
  const auto outcomes = outcomes_of(mesh);
  const auto report = remesh_on_fit(mesh, fit, parameters::vertex_outcome_map(outcomes).target_edge_length(.04));
  EXPECT_TRUE(CGAL::is_closed(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_FALSE(pmp::does_self_intersect(mesh));
  EXPECT_GT(mesh.number_of_vertices(), 8000U) << "the triangles are smaller than those given";
  EXPECT_DOUBLE_EQ(report.edge_length, .04);
  EXPECT_EQ(report.number_of_vertices(), mesh.number_of_vertices());
  EXPECT_GT(double(report.number_on_fit()), .99 * double(report.number_of_vertices()));
  for (const auto v : mesh.vertices())
    if (outcomes[v] == Fit_outcome::ON_FIT) expect_on_fit(mesh.point(v), fit);
}

TEST(Remesh_on_fit, borders_stay) {
  Mesh mesh = grid(30, 20, true, false, [](double s, double t) {
    const double u = 2 * std::numbers::pi * s, z = 2 * t - 1, r = std::sqrt(1 + z * z);
    return Point_3(r * std::cos(u), r * std::sin(u), z);
  });
  const Fit fit(mesh);
  const auto report = remesh_on_fit(mesh, fit);
  EXPECT_EQ(number_of_border_loops(mesh), 2U);
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_GT(double(report.number_on_fit()), .9 * double(report.number_of_vertices()));
  double greatest = 0;
  for (const auto v : mesh.vertices()) greatest = std::max(greatest, std::abs(mesh.point(v).z()));
  EXPECT_NEAR(greatest, 1, .01);
}

double length_of_sharp_edges(Mesh mesh) {
  const auto is_sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharper", false).first;
  pmp::detect_sharp_edges(mesh, 45, is_sharp);
  double sum = 0;
  for (const auto e : mesh.edges())
    if (is_sharp[e])
      sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum;
}

TEST(Remesh_on_fit, sharp_edges_stay_edges) {
  Mesh mesh;
  CGAL::make_hexahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0), Point_3(0, 1, 1),
                        Point_3(0, 0, 1), Point_3(1, 0, 1), Point_3(1, 1, 1), mesh);
  pmp::triangulate_faces(mesh);
  const auto is_sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(mesh, 60, is_sharp);
  pmp::isotropic_remeshing(mesh.faces(), .1, mesh, CGAL::parameters::edge_is_constrained_map(is_sharp));
  mesh.collect_garbage();
  EXPECT_NEAR(length_of_sharp_edges(mesh), 12, 1e-6);
  const Fit fit(mesh);
  remesh_on_fit(mesh, fit, parameters::feature_angle(60).target_edge_length(.1));
  EXPECT_TRUE(CGAL::is_closed(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_FALSE(pmp::does_self_intersect(mesh));
  EXPECT_NEAR(length_of_sharp_edges(mesh), 12, .2);
}

TEST(Remesh_on_fit, two_sheets_do_not_cross) {
  Mesh mesh;
  for (const double z : {0., .03}) { // nearer to each other than the points of each
    const Mesh sheet = grid(20, 20, false, false, [=](double s, double t) {
      return Point_3(s, t, z + .1 * std::sin(3 * s) * std::cos(2 * t));
    });
    mesh.join(sheet);
  }
  const Fit fit(mesh);
  remesh_on_fit(mesh, fit);
  EXPECT_EQ(number_of_border_loops(mesh), 2U);
  EXPECT_FALSE(pmp::does_self_intersect(mesh));
}

TEST(Remesh_on_fit, threads_give_the_same_numbers) {
  Mesh a = torus(20), b = a;
  const Fit fit(a);
  remesh_on_fit<CGAL::Sequential_tag>(a, fit);
  remesh_on_fit<CGAL::Parallel_if_available_tag>(b, fit);
  ASSERT_EQ(a.number_of_vertices(), b.number_of_vertices());
  for (const auto v : a.vertices()) EXPECT_EQ(a.point(v), b.point(v));
}

TEST(Remesh_on_fit, what_makes_no_sense_is_refused) {
  Mesh mesh = torus(12);
  const Fit fit(mesh);
  const std::size_t before = mesh.number_of_vertices();
  EXPECT_THROW(remesh_on_fit(mesh, fit, parameters::target_edge_length(-1)), std::invalid_argument);
  EXPECT_THROW(remesh_on_fit(mesh, fit, parameters::target_edge_length(1e-9)), std::invalid_argument);
  EXPECT_THROW(remesh_on_fit(mesh, fit, parameters::feature_angle(200)), std::invalid_argument);
  EXPECT_EQ(mesh.number_of_vertices(), before);
  Mesh empty, squares;
  EXPECT_EQ(remesh_on_fit(empty, fit).number_of_vertices(), 0U);
  CGAL::make_grid(2, 2, squares);
  EXPECT_THROW(remesh_on_fit(squares, fit), std::invalid_argument);
}

TEST(Move_to_fit, vertices_move_onto_the_fit_and_triangles_stay) {
  Mesh mesh = torus(60);
  const Fit fit(mesh);
  for (const auto v : mesh.vertices()) { // off the surface by less than a fifth of an edge
    const Point_3 p = mesh.point(v);
    const double r = std::hypot(p.x(), p.y());
    const Kernel::Vector_3 out(p.x() * (1 - 1 / r), p.y() * (1 - 1 / r), p.z());
    mesh.point(v) = p + (v.idx() % 2 == 0 ? .02 : -.02) * out;
  }
  const std::size_t faces = mesh.number_of_faces();
  const auto outcomes = outcomes_of(mesh);
  const auto report = move_to_fit(mesh, fit, parameters::vertex_outcome_map(outcomes));
  EXPECT_EQ(mesh.number_of_faces(), faces);
  EXPECT_EQ(report.number_on_fit(), mesh.number_of_vertices());
  EXPECT_NEAR(report.largest_move, .008, .001);
  for (const auto v : mesh.vertices()) expect_on_fit(mesh.point(v), fit);
}

TEST(Move_to_fit, vertices_without_a_zero_follow_and_say_so) {
  Mesh mesh = torus(20);
  const Fit fit(mesh);
  Mesh apart = mesh;
  for (const auto v : apart.vertices()) // a bump that is no part of the fit
    if (apart.point(v).x() > 1.2) apart.point(v) = apart.point(v) + Kernel::Vector_3(.5, 0, 0);
  const auto outcomes = outcomes_of(apart);
  const auto report = move_to_fit(apart, fit, parameters::vertex_outcome_map(outcomes));
  EXPECT_LT(report.number_on_fit(), report.number_of_vertices());
  std::size_t beside = 0;
  for (const auto v : apart.vertices()) {
    if (apart.point(v).x() > 1.6) {
      EXPECT_NE(outcomes[v], Fit_outcome::ON_FIT);
    }
    beside += outcomes[v] != Fit_outcome::ON_FIT;
  }
  EXPECT_EQ(report.number_of_vertices() - report.number_on_fit(), beside);
  EXPECT_FALSE(pmp::does_self_intersect(apart));
}

} // namespace
