// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/volume/signed_distance_volume.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace signed_distance_volume_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point_3>;
using Lattice_3 = equiaffine::Lattice_3<Kernel>;
using equiaffine::signed_distance_volume;

// The surface of the cube [lower, upper]^3, its triangles counterclockwise from outside unless reversed.
void add_cube(Mesh& mesh, double lower, double upper, bool is_reversed = false) {
  std::array<Mesh::Vertex_index, 8> v;
  for (unsigned n = 0; n < 8; ++n)
    v[n] = mesh.add_vertex(Point_3(n & 1 ? upper : lower, n & 2 ? upper : lower, n & 4 ? upper : lower));
  constexpr std::array<std::array<std::size_t, 4>, 6> squares = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : squares) {
    if (is_reversed) mesh.add_face(v[a], v[c], v[b]), mesh.add_face(v[a], v[d], v[c]);
    else mesh.add_face(v[a], v[b], v[c]), mesh.add_face(v[a], v[c], v[d]);
  }
}

Mesh cube(double lower, double upper, bool is_reversed = false) {
  Mesh mesh;
  add_cube(mesh, lower, upper, is_reversed);
  return mesh;
}

double distance_to_cube(const Point_3& p, double lower, double upper) {
  const auto beyond = [&](double x) { return std::max(lower - x, x - upper); };
  const double x = beyond(p.x()), y = beyond(p.y()), z = beyond(p.z());
  const double inside = std::max({x, y, z});
  return inside <= 0 ? inside : std::hypot(std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0));
}

// Nodes on and off the surfaces of the cubes below, long and short steps, rows oblique to all faces.
Lattice_3 skew_lattice() {
  return Lattice_3({16, 12, 14}, Point_3(-1.5, -1, -1.25),
                   {Vector_3(0.4, 0.11, 0.07), Vector_3(-0.1, 0.5, 0), Vector_3(0, -0.05, 0.35)});
}

Lattice_3 aligned_lattice() { return Lattice_3({13, 9, 17}, CGAL::Bbox_3(-1, -1, -2, 5, 3, 6)); }

// Distances are exact up to rounding of points whose coordinates are below 8 in absolute value.
constexpr double rounding = 8 * 8 * std::numeric_limits<double>::epsilon();

template <class Expected>
void expect_distances(const Mesh& mesh, const Lattice_3& lattice, const Expected& expected) {
  const auto volume = signed_distance_volume(mesh, lattice);
  ASSERT_EQ(volume.values.size(), lattice.number_of_nodes());
  const auto [nx, ny, nz] = lattice.size();
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        const Point_3 p = lattice.point(double(i), double(j), double(k));
        ASSERT_NEAR(volume(i, j, k), expected(p), rounding) << p;
      }
}

// The message is one line: what is wrong, a point (whose end is given), and what to do.
void expect_refusal(const Mesh& mesh, const std::string& what, const std::string& end_of_point,
                    const std::string& todo) {
  try {
    signed_distance_volume(mesh, aligned_lattice());
    ADD_FAILURE() << "accepted";
  } catch (const equiaffine::Input_error& error) {
    const std::string message = error.what(), end = end_of_point + todo;
    EXPECT_EQ(message.substr(0, what.size()), what);
    EXPECT_EQ(message.substr(message.size() - std::min(message.size(), end.size())), end) << message;
  }
}

Mesh cuboid(const Vector_3& sides, const Vector_3& offset) {
  Mesh mesh = cube(0, 1);
  for (const auto v : mesh.vertices()) {
    const Point_3 p = mesh.point(v);
    mesh.point(v) = Point_3(p.x() * sides.x(), p.y() * sides.y(), p.z() * sides.z()) + offset;
  }
  return mesh;
}

// A torus around `center` with radii 1 and r, of 2 n m triangles.
Mesh torus(unsigned n, unsigned m, double r, const Point_3& center = CGAL::ORIGIN) {
  Mesh mesh;
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < m; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m, d = 1 + r * std::cos(b);
      mesh.add_vertex(center + Vector_3(d * std::cos(a), d * std::sin(a), r * std::sin(b)));
    }
  const auto v = [&](unsigned i, unsigned j) { return Mesh::Vertex_index(i % n * m + j % m); };
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < m; ++j) {
      mesh.add_face(v(i, j), v(i + 1, j), v(i + 1, j + 1));
      mesh.add_face(v(i, j), v(i + 1, j + 1), v(i, j + 1));
    }
  return mesh;
}

Mesh three_shells() {
  Mesh mesh = cube(-0.5, 2.5);
  add_cube(mesh, 0.25, 1.75, true);
  add_cube(mesh, 0.7, 1.3);
  return mesh;
}

Lattice_3 rotated(const Lattice_3& lattice) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  return lattice.transform(CGAL::Aff_transformation_3<Kernel>(c, -s, 0, s, c, 0, 0, 0, 1) *
                           CGAL::Aff_transformation_3<Kernel>(1, 0, 0, 0, c, -s, 0, s, c));
}

// The least of the distances that CGAL computes to all triangles, with the side that it decides.
std::vector<double> distances_one_by_one(const Mesh& mesh, const Lattice_3& lattice) {
  using Side_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Side_mesh = CGAL::Surface_mesh<Side_kernel::Point_3>;
  Side_mesh copy;
  CGAL::copy_face_graph(mesh, copy);
  const CGAL::Side_of_triangle_mesh<Side_mesh, Side_kernel> side(copy);
  // Of the copy, since another first vertex of a triangle would change the rounding.
  std::vector<Kernel::Triangle_3> triangles;
  for (const auto f : copy.faces()) {
    const auto corner = [&](const auto h) {
      const auto& p = copy.point(copy.target(h));
      return Point_3(p.x(), p.y(), p.z());
    };
    const auto h = copy.halfedge(f);
    triangles.emplace_back(corner(copy.opposite(h)), corner(h), corner(copy.next(h)));
  }
  std::vector<double> distances;
  const auto [nx, ny, nz] = lattice.size();
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        const Point_3 p = lattice.point(double(i), double(j), double(k));
        double least = std::numeric_limits<double>::infinity();
        for (const auto& t : triangles)
          least = std::min(least, CGAL::squared_distance(p, Kernel().construct_projected_point_3_object()(t, p)));
        distances.push_back(-int(side(Side_kernel::Point_3(p.x(), p.y(), p.z()))) * std::sqrt(least));
      }
  return distances;
}

void expect_distances_one_by_one(const Mesh& mesh, const Lattice_3& lattice) {
  const auto values = signed_distance_volume(mesh, lattice).values, expected = distances_one_by_one(mesh, lattice);
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t n = 0; n < values.size(); ++n) ASSERT_EQ(values[n], expected[n]) << "node " << n;
}

Mesh cube_without_a_triangle() {
  Mesh mesh = cube(0, 1);
  CGAL::Euler::remove_face(mesh.halfedge(Mesh::Face_index(3)), mesh);
  mesh.collect_garbage();
  return mesh;
}

TEST(Distance_function_3, distances_to_a_cube_are_exact_and_negative_inside) {
  for (const Lattice_3& lattice : {skew_lattice(), aligned_lattice()})
    expect_distances(cube(0, 2), lattice, [](const Point_3& p) { return distance_to_cube(p, 0, 2); });
}

TEST(Distance_function_3, distances_have_the_bits_of_the_least_that_CGAL_computes_over_all_triangles) {
  const Lattice_3 aligned({15, 13, 14}, CGAL::Bbox_3(-2, -1.5, -1.75, 2, 2, 2));
  for (const Lattice_3& lattice : {aligned, rotated(aligned)})
    for (const Mesh& mesh : {torus(12, 6, 0.4), torus(24, 6, 0.02), cube(-0.5, 1), three_shells(),
                             cuboid(Vector_3(1e-3, 2, 2.5), Vector_3(0.1, -1, -1))})
      expect_distances_one_by_one(mesh, lattice);
}

TEST(Distance_function_3, distances_have_these_bits_far_from_the_origin_and_on_lattices_of_any_shape) {
  const Lattice_3 far({10, 11, 12}, CGAL::Bbox_3(998, -2001.5, 499, 1002, -1998, 501));
  expect_distances_one_by_one(torus(24, 12, 0.4, Point_3(1000, -2000, 500)), far);
  const Mesh mesh = torus(24, 12, 0.4);
  const Lattice_3 flat({30, 20, 2}, CGAL::Bbox_3(-2, -2, -0.01, 2, 2, 0.02));
  const Lattice_3 needles({5, 4, 60}, CGAL::Bbox_3(-2, -2, -1, 2, 2, 1));
  const Lattice_3 much_larger_than_the_mesh({10, 11, 12}, CGAL::Bbox_3(-100, -100, -90, 110, 120, 100));
  for (const Lattice_3& lattice : {flat, needles, much_larger_than_the_mesh}) {
    expect_distances_one_by_one(mesh, lattice);
    expect_distances_one_by_one(mesh, rotated(lattice));
  }
}

TEST(Distance_function_3, the_orientation_of_the_mesh_does_not_matter) {
  expect_distances(cube(0, 2, true), skew_lattice(), [](const Point_3& p) { return distance_to_cube(p, 0, 2); });
}

TEST(Distance_function_3, a_shell_within_a_shell_is_a_cavity_whatever_their_orientations) {
  for (const bool outer : {false, true})
    for (const bool inner : {false, true}) {
      Mesh mesh = cube(-0.5, 2.5, outer);
      add_cube(mesh, 0.25, 1.75, inner);
      expect_distances(mesh, skew_lattice(), [](const Point_3& p) {
        return std::max(distance_to_cube(p, -0.5, 2.5), -distance_to_cube(p, 0.25, 1.75));
      });
    }
}

TEST(Distance_function_3, a_node_on_the_surface_has_distance_zero_and_leaves_the_next_one_its_sign) {
  const auto volume = signed_distance_volume(cube(0, 2), Lattice_3({9, 2, 2}, CGAL::Bbox_3(-1, 1, 1, 3, 1.5, 1.5)));
  for (std::size_t i = 0; i < 9; ++i) {
    const double x = -1 + 0.5 * double(i);
    EXPECT_EQ(volume(i, 0, 0), std::max(std::max(-x, x - 2), -1.0)) << x;
  }
}

TEST(Distance_function_3, a_thin_plate_between_two_nodes_does_not_change_the_sign_behind_it) {
  // Rows along x cross a plate of thickness 1e-3 between the nodes x = 0 and x = 1.
  const Mesh mesh = cuboid(Vector_3(1e-3, 8, 8), Vector_3(0.5, -4, -4));
  const auto volume = signed_distance_volume(mesh, Lattice_3({5, 3, 3}, CGAL::Bbox_3(-2, -1, -1, 2, 1, 1)));
  for (const double value : volume.values) EXPECT_GT(value, 0);
}

TEST(Distance_function_3, the_distances_do_not_depend_on_threads_and_every_node_is_reported_once) {
  std::atomic<std::size_t> reported = 0;
  const auto parallel = signed_distance_volume<CGAL::Parallel_if_available_tag>(
      cube(0, 2), skew_lattice(), [&](std::size_t nodes) { reported += nodes; });
  EXPECT_EQ(reported, skew_lattice().number_of_nodes());
  EXPECT_EQ(parallel.values, signed_distance_volume<CGAL::Sequential_tag>(cube(0, 2), skew_lattice()).values);
  const Lattice_3 large = rotated(Lattice_3({24, 25, 26}, CGAL::Bbox_3(-2, -2, -2, 2, 2, 2)));
  EXPECT_EQ(signed_distance_volume<CGAL::Parallel_if_available_tag>(torus(24, 12, 0.4), large).values,
            signed_distance_volume<CGAL::Sequential_tag>(torus(24, 12, 0.4), large).values);
}

TEST(Distance_function_3, a_narrow_band_has_the_same_values_and_none_outside) {
  Mesh mesh = cube(0, 2);
  add_cube(mesh, 2.7, 3.1);
  const Lattice_3 lattice({61, 40, 50}, Point_3(-3, -2, -2.5),
                          {Vector_3(0.12, 0.03, 0.02), Vector_3(-0.03, 0.15, 0), Vector_3(0, -0.02, 0.15)});
  const auto whole = signed_distance_volume(mesh, lattice);
  for (const double band : {0.05, 0.3, 1.0}) {
    const auto narrow = signed_distance_volume(
        mesh, lattice, [](std::size_t) {}, band);
    std::size_t missing = 0;
    for (std::size_t n = 0; n < whole.values.size(); ++n)
      if (std::abs(whole.values[n]) > band) missing += std::isnan(narrow.values[n]);
      else ASSERT_EQ(narrow.values[n], whole.values[n]);
    EXPECT_EQ(std::ptrdiff_t(missing),
              std::count_if(whole.values.begin(), whole.values.end(), [&](double d) { return std::abs(d) > band; }));
  }
}

TEST(Distance_function_3, a_mesh_without_faces_is_refused) {
  expect_refusal(Mesh(), "the mesh has no faces", "", ": give a closed mesh of triangles");
}

TEST(Distance_function_3, a_mesh_with_holes_is_refused_with_the_number_of_border_edges_and_a_place) {
  expect_refusal(cube_without_a_triangle(), "the mesh is not closed, it has 3 border edges, one of them at (", "1)",
                 ": fill its holes first");
}

TEST(Distance_function_3, a_mesh_with_other_faces_than_triangles_is_refused) {
  Mesh mesh;
  const auto v = [](unsigned n) { return Mesh::Vertex_index(n); };
  for (unsigned n = 0; n < 4; ++n) mesh.add_vertex(Point_3(n & 1, n >> 1, 0));
  mesh.add_face(v(0), v(1), v(3), v(2));
  expect_refusal(mesh, "the mesh has a face with 4 vertices, one of them at (", "0)", ": triangulate its faces first");
}

TEST(Distance_function_3, a_mesh_that_intersects_itself_is_refused_with_a_place) {
  Mesh mesh = cube(0, 2);
  add_cube(mesh, 1, 3);
  expect_refusal(mesh, "the mesh has degenerate triangles or intersects itself near (", ")",
                 ", so its inside is not defined: repair it first");
}

TEST(Distance_function_3, a_mesh_with_a_degenerate_triangle_is_refused) {
  Mesh mesh = cube(0, 1);
  mesh.point(Mesh::Vertex_index(7)) = mesh.point(Mesh::Vertex_index(3));
  expect_refusal(mesh, "the mesh has degenerate triangles or intersects itself near (", "1, 1, 0)",
                 ", so its inside is not defined: repair it first");
}

TEST(Distance_function_3, a_mesh_with_a_triangle_whose_squared_area_vanishes_by_rounding_is_refused) {
  const auto expect_too_small = [](const Mesh& mesh, const std::string& end_of_point) {
    expect_refusal(mesh, "the mesh has a triangle near (", end_of_point,
                   " whose squared area underflows double precision: choose a smaller unit of length, or remove the "
                   "triangle if the others are larger");
  };
  for (const double tiny : {1e-77, 1e-100, 1e-300}) expect_too_small(cube(0, tiny), ")");
  Mesh sliver; // a tetrahedron, to which a triangle of height 1e-170 is added at one side
  std::array<Mesh::Vertex_index, 5> v = {sliver.add_vertex(Point_3(0, 0, 0)), sliver.add_vertex(Point_3(1, 0, 0)),
                                         sliver.add_vertex(Point_3(0, 1, 0)), sliver.add_vertex(Point_3(0, 0, 1)),
                                         sliver.add_vertex(Point_3(0.5, -1e-170, 0))};
  constexpr std::array<std::array<std::size_t, 3>, 6> triangles = {
      {{0, 2, 1}, {1, 2, 3}, {0, 3, 2}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}}};
  for (const auto& [a, b, c] : triangles) sliver.add_face(v[a], v[b], v[c]);
  expect_too_small(sliver, "0)");
}

TEST(Distance_function_3, the_smallest_meshes_that_are_accepted_have_the_distances_of_larger_ones) {
  const double tiny = std::ldexp(1, -250);
  const Lattice_3 lattice = aligned_lattice();
  const auto scaled = [tiny](const Vector_3& v) { return tiny * v; };
  const Lattice_3 tiny_lattice(lattice.size(), CGAL::ORIGIN + scaled(lattice.origin() - CGAL::ORIGIN),
                               {scaled(lattice.steps()[0]), scaled(lattice.steps()[1]), scaled(lattice.steps()[2])});
  const auto expected = signed_distance_volume(cube(0, 2), lattice);
  const auto volume = signed_distance_volume(cube(0, 2 * tiny), tiny_lattice);
  for (std::size_t n = 0; n < volume.values.size(); ++n) EXPECT_EQ(volume.values[n], tiny * expected.values[n]) << n;
}

TEST(Distance_function_3, a_mesh_with_a_coordinate_that_is_not_finite_is_refused) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mesh mesh = cube(0, 1);
    mesh.point(Mesh::Vertex_index(5)) = Point_3(1, bad, 1);
    expect_refusal(mesh, "the mesh has a vertex with a coordinate that is not a finite number, (1, ", ", 1)",
                   ": correct or remove it");
  }
}

} // namespace signed_distance_volume_test
