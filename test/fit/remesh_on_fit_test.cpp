// SPDX-License-Identifier: GPL-3.0-or-later
// Remeshes on a fit stay whole.
#include "support/fit_meshes.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/move_to_fit.h>
#include <equiaffine/fit/remesh_on_fit.h>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/subdivision_method_3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace remesh_on_fit_test {

using namespace equiaffine;
using namespace fit_meshes;
namespace pmp = CGAL::Polygon_mesh_processing;

TEST(Remesh_on_fit, a_closed_surface_stays_closed_and_lies_on_the_fit) {
  Mesh mesh = torus(50);
  const Fit fit(mesh, {.scale = 0});
  const auto outcomes = outcomes_of(mesh);
  const auto report = remesh_on_fit(mesh, fit, {.edge_length = .06}, parameters::vertex_outcome_map(outcomes));
  EXPECT_TRUE(CGAL::is_closed(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_FALSE(pmp::does_self_intersect(mesh));
  EXPECT_GT(mesh.number_of_vertices(), 4000U) << "the triangles are smaller than those given";
  EXPECT_DOUBLE_EQ(report.edge_length, .06);
  expect_counted(mesh, outcomes, report);
  EXPECT_GT(double(report.number_on_fit()), .99 * double(report.number_of_vertices()));
  for (const auto v : mesh.vertices())
    if (outcomes[v] == Fit_outcome::ON_FIT) expect_on_fit(mesh.point(v), fit);
}

/// An icosphere with 2562 vertices.
Mesh sphere() {
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point_3(0, 0, 0), 1);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(4));
  for (const auto v : mesh.vertices()) {
    const Kernel::Vector_3 p = mesh.point(v) - CGAL::ORIGIN;
    mesh.point(v) = CGAL::ORIGIN + p / std::sqrt(p.squared_length());
  }
  return mesh;
}

TEST(Remesh_on_fit, a_sphere_is_as_accurate_as_its_fit) {
  Mesh mesh = sphere();
  const Fit fit(mesh, {.scale = 0});
  const auto report = remesh_on_fit(mesh, fit);
  EXPECT_TRUE(CGAL::is_closed(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_EQ(report.number_on_fit(), mesh.number_of_vertices());
  for (const auto v : mesh.vertices()) {
    EXPECT_LT(std::abs(fit.taylor(mesh.point(v)).value()), 1e-12);
    EXPECT_NEAR(std::sqrt(CGAL::squared_distance(mesh.point(v), Point_3(0, 0, 0))), 1, 1e-5);
  }
}

TEST(Remesh_on_fit, borders_stay) {
  Mesh mesh = grid(30, 20, true, false, [](double s, double t) {
    const double u = 2 * std::numbers::pi * s, z = 2 * t - 1, r = std::sqrt(1 + z * z);
    return Point_3(r * std::cos(u), r * std::sin(u), z);
  });
  const Fit fit(mesh, {.scale = 0});
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

/// A cube of side 1 with edges of some .1.
Mesh cube() {
  Mesh mesh;
  CGAL::make_hexahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0), Point_3(0, 1, 1),
                        Point_3(0, 0, 1), Point_3(1, 0, 1), Point_3(1, 1, 1), mesh);
  pmp::triangulate_faces(mesh);
  const auto is_sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(mesh, 60, is_sharp);
  pmp::isotropic_remeshing(mesh.faces(), .1, mesh, CGAL::parameters::edge_is_constrained_map(is_sharp));
  mesh.collect_garbage();
  return mesh;
}

TEST(Remesh_on_fit, sharp_edges_stay_edges) {
  Mesh mesh = cube();
  EXPECT_NEAR(length_of_sharp_edges(mesh), 12, 1e-6);
  const Fit fit(mesh, {.scale = 0});
  const auto outcomes = outcomes_of(mesh);
  const auto report = remesh_on_fit(mesh, fit, {}, parameters::vertex_outcome_map(outcomes));
  EXPECT_TRUE(CGAL::is_closed(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_FALSE(pmp::does_self_intersect(mesh));
  EXPECT_NEAR(length_of_sharp_edges(mesh), 12, 1e-6);
  expect_counted(mesh, outcomes, report);
  for (const auto v : mesh.vertices()) {
    const Point_3 p = mesh.point(v);
    int sides = 0;
    for (int k = 0; k < 3; ++k) sides += p[k] == 0 || p[k] == 1;
    EXPECT_EQ(outcomes[v] == Fit_outcome::ON_FEATURE, sides >= 2)
        << "a vertex is on an edge of the cube, or else moves";
  }
}

/// A cylinder over an ellipse with axes 1 and .1, of length 2, with few rows of many points and fans at its ends. Its
/// edges are longer on average than it is thick.
Mesh blade() {
  constexpr std::size_t around = 400, rows = 3;
  Mesh mesh = grid(around, rows - 1, true, false, [](double s, double t) {
    const double u = 2 * std::numbers::pi * s;
    return Point_3(std::cos(u), .1 * std::sin(u), 2 * t);
  });
  for (const std::size_t row : {std::size_t(0), rows - 1}) {
    const auto center = mesh.add_vertex(Point_3(0, 0, double(row)));
    for (std::size_t i = 0; i < around; ++i) {
      Mesh::Vertex_index a(Mesh::size_type(i * rows + row)), b(Mesh::size_type((i + 1) % around * rows + row));
      if (row == 0) std::swap(a, b);
      mesh.add_face(center, a, b);
    }
  }
  return mesh;
}

TEST(Remesh_on_fit, detail_that_is_finer_than_the_edges_stays) {
  Mesh mesh = blade();
  const double volume = pmp::volume(mesh);
  const auto report = remesh_on_fit(mesh, Fit(mesh));
  EXPECT_TRUE(CGAL::is_closed(mesh));
  EXPECT_NEAR(pmp::volume(mesh) / volume, 1, .01);
  EXPECT_LT(report.distance_of_data, .03);
  EXPECT_LT(report.distance_from_data, .03);
}

/// The greatest distance of the vertices and the centers of the triangles of a mesh from another one.
double distance_of(const Mesh& mesh, const Mesh& other) {
  std::vector<Point_3> points(mesh.points().begin(), mesh.points().end());
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    points.push_back(
        CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h)))));
  }
  return pmp::max_distance_to_triangle_mesh<CGAL::Sequential_tag>(points, other);
}

TEST(Remesh_on_fit, the_distances_between_data_and_remesh_are_told) {
  const Mesh data = torus(12);
  Mesh mesh = data;
  const auto report = remesh_on_fit(mesh, Fit(mesh, {.scale = 0}), {.edge_length = .1});
  EXPECT_NEAR(report.distance_of_data, distance_of(data, mesh), 1e-12);
  EXPECT_NEAR(report.distance_from_data, distance_of(mesh, data), 1e-12);
}

TEST(Remesh_on_fit, vertices_stay_where_the_fit_is_farther_than_half_an_edge) {
  const Mesh data = grid(60, 60, false, false, [](double s, double t) { // waves as long as ten edges
    return Point_3(s, t, .01 * std::sin(12 * std::numbers::pi * s));
  });
  const Fit fit(data, {.scale = .4});
  Mesh mesh = data;
  const auto report = move_to_fit(mesh, fit);
  EXPECT_GT(report.number_of[std::size_t(Fit_outcome::NO_ZERO)], mesh.number_of_vertices() / 10);
  EXPECT_GT(report.number_on_fit(), mesh.number_of_vertices() / 2);
  for (const auto v : data.vertices()) {
    double sum = 0;
    for (const auto u : data.vertices_around_target(data.halfedge(v)))
      sum += std::sqrt(CGAL::squared_distance(data.point(u), data.point(v)));
    const double edge = std::max(sum / double(data.degree(v)), fit.spacing(data.point(v)));
    EXPECT_LE(std::sqrt(CGAL::squared_distance(data.point(v), mesh.point(v))), .5 * edge + 1e-12);
  }
}

TEST(Remesh_on_fit, with_an_angle_of_180_degrees_no_edge_is_kept) {
  Mesh mesh = cube();
  const auto report = remesh_on_fit(mesh, Fit(mesh, {.scale = 0}), {.feature_angle = 180});
  EXPECT_EQ(report.number_of[std::size_t(Fit_outcome::ON_FEATURE)], 0U);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_FALSE(pmp::does_self_intersect(mesh));
}

TEST(Remesh_on_fit, two_sheets_do_not_cross) {
  Mesh mesh;
  for (const double z : {0., .03}) { // nearer to each other than the points of each
    const Mesh sheet = grid(20, 20, false, false, [=](double s, double t) {
      return Point_3(s, t, z + .1 * std::sin(3 * s) * std::cos(2 * t));
    });
    mesh.join(sheet);
  }
  const Fit fit(mesh, {.scale = 0});
  remesh_on_fit(mesh, fit);
  EXPECT_EQ(number_of_border_loops(mesh), 2U);
  EXPECT_FALSE(pmp::does_self_intersect(mesh));
}

/// Two waves that go through each other along a line.
Mesh two_crossing_sheets() {
  Mesh mesh;
  for (const double slope : {-.5, .5}) {
    const Mesh sheet = grid(20, 20, false, false, [=](double s, double t) {
      return Point_3(s, t, slope * (s - .5) + .05 * std::sin(4 * t));
    });
    mesh.join(sheet);
  }
  return mesh;
}

TEST(Remesh_on_fit, a_mesh_that_crosses_itself_gets_no_other_crossings) {
  Mesh mesh = two_crossing_sheets();
  const Fit fit(mesh, {.scale = 0});
  const auto report = remesh_on_fit(mesh, fit);
  EXPECT_EQ(number_of_border_loops(mesh), 2U);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> crossings;
  pmp::self_intersections<CGAL::Sequential_tag>(mesh.faces(), mesh, std::back_inserter(crossings));
  EXPECT_EQ(crossings.size(), report.crossings);
  EXPECT_FALSE(crossings.empty());
  for (const auto& pair : crossings)
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(pair.first)))
      EXPECT_NEAR(mesh.point(v).x(), .5, 3 * report.edge_length);
}

TEST(Remesh_on_fit, edges_longer_than_the_mesh_leave_it_whole) {
  Mesh mesh = torus(12);
  const Fit fit(mesh, {.scale = 0});
  remesh_on_fit(mesh, fit, {.edge_length = 1e300});
  EXPECT_TRUE(CGAL::is_closed(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_FALSE(pmp::does_self_intersect(mesh));
}

TEST(Remesh_on_fit_long, other_meshes_and_point_maps_are_taken) {
  CGAL::Polyhedron_3<Kernel> polyhedron;
  CGAL::copy_face_graph(torus(20), polyhedron);
  remesh_on_fit(polyhedron, Fit(torus(20), {.scale = 0}));
  EXPECT_TRUE(CGAL::is_closed(polyhedron));
  EXPECT_EQ(polyhedron.size_of_vertices() + polyhedron.size_of_facets(), polyhedron.size_of_halfedges() / 2);

  Mesh mesh = torus(40);
  const auto doubled = mesh.add_property_map<Mesh::Vertex_index, Point_3>("v:doubled").first;
  for (const auto v : mesh.vertices()) doubled[v] = CGAL::ORIGIN + 2 * (mesh.point(v) - CGAL::ORIGIN);
  const auto map = parameters::vertex_point_map(doubled);
  remesh_on_fit(mesh, Fit(mesh, {.scale = 0}, map), {}, map);
  for (const auto v : mesh.vertices())
    EXPECT_LT(distance_from_torus(CGAL::ORIGIN + (doubled[v] - CGAL::ORIGIN) / 2), 5e-4);
}

TEST(Remesh_on_fit, threads_give_the_same_numbers) {
  Mesh a = torus(20), b = a;
  const Fit fit(a, {.scale = 0});
  const auto report_a = remesh_on_fit<CGAL::Sequential_tag>(a, fit);
  const auto report_b = remesh_on_fit<CGAL::Parallel_if_available_tag>(b, fit);
  EXPECT_EQ(report_a.number_of, report_b.number_of);
  EXPECT_EQ(report_a.largest_move, report_b.largest_move);
  ASSERT_EQ(a.number_of_vertices(), b.number_of_vertices());
  for (const auto v : a.vertices()) EXPECT_EQ(a.point(v), b.point(v));
}

TEST(Remesh_on_fit, meshes_without_faces_or_area_are_taken) {
  const Fit fit(torus(12), {.scale = 0});
  Mesh empty, point, line, triangle;
  EXPECT_EQ(remesh_on_fit(empty, fit).number_of_vertices(), 0U);
  point.add_face(point.add_vertex(Point_3(1, 0, 0)), point.add_vertex(Point_3(1, 0, 0)),
                 point.add_vertex(Point_3(1, 0, 0)));
  EXPECT_EQ(remesh_on_fit(point, fit).number_of_vertices(), 3U);
  line.add_face(line.add_vertex(Point_3(0, 0, 0)), line.add_vertex(Point_3(1, 0, 0)),
                line.add_vertex(Point_3(2, 0, 0)));
  EXPECT_EQ(remesh_on_fit(line, fit, {.edge_length = .001}).number_of_vertices(), 3U);
  triangle.add_face(triangle.add_vertex(Point_3(1.4, 0, 0)), triangle.add_vertex(Point_3(1.4, .1, 0)),
                    triangle.add_vertex(Point_3(1.4, 0, .1)));
  triangle.add_vertex(Point_3(9, 9, 9));
  EXPECT_EQ(remesh_on_fit(triangle, fit).number_of_vertices(), 3U) << "a vertex in no triangle is removed";
  EXPECT_EQ(euler_characteristic(triangle), 1);
}

TEST(Remesh_on_fit, a_mesh_with_triangles_without_area_keeps_them) {
  Mesh mesh = torus(20);
  const Fit fit(mesh, {.scale = 0});
  for (std::size_t i = 200; i < 220; ++i)
    mesh.point(Mesh::Vertex_index(Mesh::size_type(i))) = mesh.point(Mesh::Vertex_index(200));
  const std::size_t faces = mesh.number_of_faces();
  const auto report = remesh_on_fit(mesh, fit);
  EXPECT_EQ(report.edge_length, 0);
  EXPECT_EQ(mesh.number_of_faces(), faces);
  EXPECT_GT(report.number_on_fit(), faces / 4);
}

void expect_refused(Mesh& mesh, const Fit& fit, const Remesh_options& options, const std::string& field) {
  try {
    remesh_on_fit(mesh, fit, options);
    ADD_FAILURE() << field;
  } catch (const Input_error& error) {
    EXPECT_EQ(error.field(), field);
  }
}

TEST(Remesh_on_fit, what_makes_no_sense_is_refused) {
  Mesh mesh = torus(12);
  const Fit fit(mesh, {.scale = 0});
  const std::size_t before = mesh.number_of_vertices();
  expect_refused(mesh, fit, {.edge_length = -1}, "edge_length");
  expect_refused(mesh, fit, {.edge_length = 1e-9}, "edge_length");
  expect_refused(mesh, fit, {.feature_angle = 200}, "feature_angle");
  expect_refused(mesh, fit, {.edge_length = std::nan("")}, "edge_length");
  EXPECT_EQ(mesh.number_of_vertices(), before);
  Mesh thin, squares;
  thin.add_face(thin.add_vertex(Point_3(0, 0, 0)), thin.add_vertex(Point_3(1, 0, 0)),
                thin.add_vertex(Point_3(0, 1e-9, 0)));
  expect_refused(thin, fit, {.edge_length = 1e-5}, "edge_length"); // few triangles, but many parts of an edge
  CGAL::make_grid(2, 2, squares);
  EXPECT_THROW(remesh_on_fit(squares, fit), std::invalid_argument);
}

} // namespace remesh_on_fit_test
