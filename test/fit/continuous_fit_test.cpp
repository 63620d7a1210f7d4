// SPDX-License-Identifier: GPL-3.0-or-later
// The function of a fit is continuous, has the right sign and first derivatives beside the data, at creases, too.
#include "support/fit_meshes.h"
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/boost/graph/helpers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace continuous_fit_test {

using namespace fit_meshes;
using Vector_3 = Kernel::Vector_3;

/// A ring whose section is a square with four creases. `shift` moves points along the section; with 0 some are on
/// creases, and else triangles cut the corners off.
Mesh square_ring(std::size_t n, double shift = .013) {
  return grid(2 * n, n, true, true, [=](double s, double t) {
    const double u = 2 * std::numbers::pi * s, v = 2 * std::numbers::pi * (t + shift);
    const double side = .4 / std::max(std::abs(std::cos(v)), std::abs(std::sin(v))), r = 1 + side * std::cos(v);
    return Point_3(r * std::cos(u), r * std::sin(u), side * std::sin(v));
  });
}

/// The surface of cubes of a lattice, each face cut into triangles by n^2 squares.
Mesh cubes(const std::set<std::array<int, 3>>& cells, int n) {
  std::map<std::array<int, 3>, Mesh::Vertex_index> vertices;
  Mesh mesh;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [found, is_new] = vertices.emplace(at, Mesh::Vertex_index());
    if (is_new) found->second = mesh.add_vertex(Point_3(double(at[0]) / n, double(at[1]) / n, double(at[2]) / n));
    return found->second;
  };
  for (const auto& cell : cells)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        auto beside = cell;
        beside[axis] += side == 1 ? 1 : -1;
        if (cells.contains(beside)) continue;
        const std::size_t u = (axis + (side == 1 ? 1 : 2)) % 3, v = (axis + (side == 1 ? 2 : 1)) % 3;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) {
            const auto corner = [&](int a, int b) {
              std::array<int, 3> at;
              at[axis] = n * (cell[axis] + side), at[u] = n * cell[u] + i + a, at[v] = n * cell[v] + j + b;
              return vertex(at);
            };
            mesh.add_face(corner(0, 0), corner(1, 0), corner(1, 1));
            mesh.add_face(corner(0, 0), corner(1, 1), corner(0, 1));
          }
      }
  return mesh;
}

/// Solids with corners where convex and concave creases meet: an L, a cube without an eighth, and steps.
std::vector<Mesh> cornered_solids(int n) {
  std::set<std::array<int, 3>> notched;
  for (int i = 0; i < 7; ++i) notched.insert({i & 1, i >> 1 & 1, i >> 2});
  return {cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, n), cubes(notched, n),
          cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {2, 0, 0}}, n)};
}

/// The sides of a pyramid over a regular polygon, without its base.
Mesh pyramid(int sides, int rows) {
  Mesh mesh;
  const auto top = mesh.add_vertex(Point_3(0, 0, 1));
  std::vector<std::vector<Mesh::Vertex_index>> rings;
  for (int r = 1; r <= rows; ++r) {
    auto& ring = rings.emplace_back();
    const double size = double(r) / rows;
    for (int s = 0; s < sides; ++s) {
      const auto corner = [&](int k) {
        const double angle = 2 * std::numbers::pi * k / sides;
        return Point_3(size * std::cos(angle), size * std::sin(angle), 1 - size);
      };
      for (int k = 0; k < r; ++k) ring.push_back(mesh.add_vertex(CGAL::barycenter(corner(s), r - k, corner(s + 1), k)));
    }
  }
  for (int r = 0; r < rows; ++r)
    for (int s = 0; s < sides; ++s)
      for (int k = 0; k <= r; ++k) {
        const auto at = [&](int row, int place) {
          return row == 0 ? top : rings[std::size_t(row - 1)][std::size_t((s * row + place) % (sides * row))];
        };
        mesh.add_face(at(r, k), at(r + 1, k), at(r + 1, k + 1));
        if (k < r) mesh.add_face(at(r, k), at(r + 1, k + 1), at(r, k + 1));
      }
  return mesh;
}

struct Face {
  Point_3 center;
  Vector_3 normal;
};

std::vector<Face> faces_of(const Mesh& mesh) {
  std::vector<Face> result;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point_3 center =
        CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
    result.push_back({center, CGAL::Polygon_mesh_processing::compute_face_normal(f, mesh)});
  }
  return result;
}

/// Halves a segment where the value changes most, and returns how steep it is there at last: very much at a jump.
/// Returns 0 if the value is not known at an end.
double steepest(const Fit& fit, Point_3 p, Point_3 q) {
  double a = fit.value(p), b = fit.value(q);
  for (int n = 0; n < 18 && std::isfinite(a) && std::isfinite(b); ++n) {
    const Point_3 middle = CGAL::midpoint(p, q);
    const double c = fit.value(middle);
    if (std::abs(c - a) > std::abs(b - c)) q = middle, b = c;
    else p = middle, a = c;
  }
  return std::isfinite(a) && std::isfinite(b) ? std::abs(b - a) / std::sqrt(CGAL::squared_distance(p, q)) : 0;
}

/// Checks that the value of a fit does not jump near its data, and that expansions have it.
void expect_continuous(const Mesh& mesh, const Fit& fit) {
  std::minstd_rand random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  std::size_t known = 0;
  for (const auto& [center, normal] : faces_of(mesh)) {
    const double spacing = fit.spacing(center);
    const auto point = [&] {
      return center + 1.5 * spacing * Vector_3(number(random), number(random), number(random));
    };
    for (int n = 0; n < 3; ++n) {
      const Point_3 p = point();
      const double slope = steepest(fit, p, point()), value = fit.value(p);
      known += slope > 0;
      EXPECT_LT(slope, 100) << center;
      EXPECT_TRUE(!std::isfinite(value) || std::abs(fit.first_order(p).value() - value) < 1e-14) << p;
    }
  }
  EXPECT_GT(known, 1000u);
}

TEST(Continuous_fit_long, the_value_does_not_jump) {
  for (const Mesh& mesh : {torus(24), square_ring(24), square_ring(24, 0)})
    expect_continuous(mesh, Fit(mesh, {.scale = 0}));
  for (const Mesh& mesh : cornered_solids(8)) expect_continuous(mesh, Fit(mesh, {.scale = 0}));
  const Mesh many_sides = pyramid(12, 10);
  expect_continuous(many_sides, Fit(many_sides, {.scale = 0, .feature_angle = 15}));
}

TEST(Creases, a_solid_with_corners_has_its_own_distance_as_the_value) {
  for (const Mesh& mesh : cornered_solids(8)) {
    const Fit fit(mesh, {.scale = 0});
    for (const auto v : mesh.vertices()) EXPECT_NEAR(fit.value(mesh.point(v)), 0, 1e-9) << mesh.point(v);
    for (const auto& [center, normal] : faces_of(mesh))
      for (const double height : {-.05, .05}) EXPECT_NEAR(fit.value(center + height * normal), height, .02) << center;
  }
}

TEST(Continuous_fit, the_sign_tells_the_sides_and_there_are_derivatives_at_every_face) {
  for (const Mesh& mesh : {torus(24), square_ring(24), square_ring(24, 0)}) {
    const Fit fit(mesh, {.scale = 0});
    for (const auto& [center, normal] : faces_of(mesh)) {
      const double height = fit.spacing(center) / 2;
      EXPECT_GT(fit.value(center + height * normal), 0) << center;
      EXPECT_LT(fit.value(center - height * normal), 0) << center;
      EXPECT_TRUE(std::isfinite(fit.first_order(center).value())) << center;
    }
  }
}

TEST(Continuous_fit, expansions_of_smooth_surfaces_have_all_orders_and_the_value) {
  const Mesh mesh = torus(24);
  const Fit fit(mesh, {.scale = 0});
  for (const auto& [center, normal] : faces_of(mesh)) {
    EXPECT_NEAR(fit.taylor(center).value(), fit.value(center), 1e-14);
    EXPECT_NEAR(fit.first_order(center).value(), fit.value(center), 1e-14);
  }
}

TEST(Continuous_fit_long, the_surface_is_whole_where_the_density_of_the_data_jumps) {
  const Mesh mesh = grid(80, 40, true, true, [](double s, double t) {
    const double part = s < .5 ? .1 * s : .05 + .95 * (2 * s - 1); // half of the points are in a twentieth of the torus
    const double u = 2 * std::numbers::pi * part, v = 2 * std::numbers::pi * t, r = 1 + .4 * std::cos(v);
    return Point_3(r * std::cos(u), r * std::sin(u), .4 * std::sin(v));
  });
  const Fit fit(mesh, {.scale = 0});
  const auto surface =
      equiaffine::marching_cubes<CGAL::Parallel_if_available_tag>(
          fit.in_box(CGAL::Bbox_3(-1.7, -1.7, -.7, 1.7, 1.7, .7)), {.resolution = 129});
  Mesh whole = equiaffine::to_surface_mesh(surface);
  CGAL::Polygon_mesh_processing::keep_largest_connected_components(whole, 1);
  EXPECT_TRUE(CGAL::is_closed(whole));
  EXPECT_EQ(std::int64_t(whole.number_of_vertices()) + std::int64_t(whole.number_of_faces()),
            std::int64_t(whole.number_of_edges()));
}

/// A ring whose section is a square with points at its corners: two cylinders and two planes between four creases.
Mesh creased_ring() { return square_ring(48, 0); }

/// The error of a mean curvature on the ring beside that of the nearer cylinder, with the radius .6 or 1.4. On a crease
/// either side may be meant.
double error_on_ring(const Point_3& p, double mean_curvature) {
  const double radius = std::hypot(p.x(), p.y()), of_cylinder = radius < 1 ? 1 / 1.2 : 1 / 2.8;
  const bool is_in_plane = std::abs(p.z()) > .4 - 1e-9, is_on_cylinder = std::abs(std::abs(radius - 1) - .4) < 5e-3;
  const double in_plane = std::abs(mean_curvature), on_cylinder = std::abs(in_plane - of_cylinder);
  return (!is_in_plane ? on_cylinder : is_on_cylinder ? std::min(in_plane, on_cylinder) : in_plane) / of_cylinder;
}

TEST(Creases, they_are_there_in_every_unit) {
  for (const double unit : {1e-60, 1e60}) {
    Mesh mesh = cornered_solids(8).front();
    for (const auto v : mesh.vertices()) mesh.point(v) = CGAL::ORIGIN + unit * (mesh.point(v) - CGAL::ORIGIN);
    const Fit fit(mesh, {.scale = 0});
    for (const auto v : mesh.vertices()) EXPECT_NEAR(fit.value(mesh.point(v)) / unit, 0, 1e-9) << mesh.point(v);
  }
}

TEST(Creases, each_side_has_its_own_curvature_and_planes_and_cylinders_are_parabolic) {
  const Mesh mesh = creased_ring();
  const auto structures = equiaffine::fitted_structures(mesh, {.scale = 0});
  ASSERT_EQ(structures.size(), mesh.number_of_vertices());
  std::size_t parabolic = 0;
  for (const auto v : mesh.vertices()) {
    const auto& [structure, error, noise, detail, scale, is_at_scale, deviation] = structures[v];
    parabolic += structure.status == equiaffine::Point_status::PARABOLIC;
    EXPECT_LT(error_on_ring(mesh.point(v), structure.euclidean.mean_curvature), .02 + error.euclidean_mean_curvature)
        << mesh.point(v);
  }
  EXPECT_GT(double(parabolic), .99 * double(structures.size()));
}

/// The part of the vertices that lie on the zero set of a fit.
double part_on_zero_set(const Mesh& mesh, const Fit& fit) {
  double count = 0;
  for (const auto v : mesh.vertices()) count += std::abs(fit.value(mesh.point(v))) < 1e-4;
  return count / double(mesh.number_of_vertices());
}

TEST(Creases_long, the_fit_ends_at_them_as_the_data_do) {
  const Mesh mesh = creased_ring();
  const Fit fit(mesh, {.scale = 0});
  EXPECT_GT(part_on_zero_set(mesh, fit), .99);
  EXPECT_LT(part_on_zero_set(mesh, Fit(mesh, {.scale = 0, .feature_angle = 180})), .9);
  double covered = 0;
  for (const auto& [center, normal] : faces_of(mesh)) {
    const auto [structure, error, noise, detail, scale, is_at_scale, deviation] = fit.structure(center);
    covered += error_on_ring(center, structure.euclidean.mean_curvature) < .02 + error.euclidean_mean_curvature;
  }
  EXPECT_GT(covered, .99 * double(mesh.number_of_faces()));
}

TEST(Creases_long, sharp_edges_without_followers_are_none) {
  Mesh mesh = torus(24);
  const auto v = *mesh.vertices().begin();
  mesh.point(v) = mesh.point(v) + .2 * (mesh.point(v) - CGAL::ORIGIN);
  const Fit fit(mesh, {.scale = 0}), round(mesh, {.scale = 0, .feature_angle = 180});
  for (const auto& [center, normal] : faces_of(mesh)) EXPECT_EQ(fit.value(center), round.value(center));
}

} // namespace continuous_fit_test
