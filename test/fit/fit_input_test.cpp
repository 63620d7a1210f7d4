// SPDX-License-Identifier: GPL-3.0-or-later
// What fits do with data that they were not made for: a status or an exception, and no number out of nowhere.
#include "fit/fit_input.h"
#include "support/fit_data.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/fitted_structures.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fit_input_test {

using namespace equiaffine;
using namespace equiaffine::test;
using Point_3 = Fit_kernel::Point_3;
using Vector_3 = Fit_kernel::Vector_3;

/// Returns the part of the points of `a`, among those with numbers, where K differs from that of `b` by no more than
/// the errors that both estimate.
double part_that_agrees(const std::vector<Fitted_structure_3<double>>& a,
                        const std::vector<Fitted_structure_3<double>>& b, std::size_t count) {
  double known = 0, agree = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double difference =
        std::abs(a[i].structure.affine.gaussian_curvature - b[i].structure.affine.gaussian_curvature);
    if (!std::isfinite(difference)) continue;
    ++known;
    agree += difference <= a[i].error.affine_gaussian_curvature + b[i].error.affine_gaussian_curvature;
  }
  return agree / known;
}

bool has_numbers(const Fitted_structure_3<double>& s) { return std::isfinite(s.structure.affine.gaussian_curvature); }

/// A grid of n x n points over [-1, 1]^2 with heights f(x, y), and triangles between them.
template <class F>
Fit_mesh height_field(std::size_t n, F f) {
  Fit_mesh mesh;
  std::vector<Fit_mesh::Vertex_index> v;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const double x = -1 + 2 * double(i) / double(n - 1), y = -1 + 2 * double(j) / double(n - 1);
      v.push_back(mesh.add_vertex(Point_3(x, y, f(x, y))));
    }
  for (std::size_t j = 0; j + 1 < n; ++j)
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const std::size_t k = j * n + i;
      mesh.add_face(v[k], v[k + 1], v[k + n + 1]);
      mesh.add_face(v[k], v[k + n + 1], v[k + n]);
    }
  return mesh;
}

double bowl(double x, double y) { return x * x + 0.5 * y * y + 0.1 * x * x * y; }

TEST(Fit_input, points_with_coordinates_that_are_no_numbers_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf}) {
    const std::vector<Point_3> points = {{0, 0, 0}, {1, bad, 0}};
    EXPECT_THROW(fitted_structures(points, {.scale = 0}), std::invalid_argument);
    EXPECT_THROW((Fitted_function_traits_3<Fit_kernel>(points, {.scale = 0})), std::invalid_argument);
  }
}

TEST(Fit_input, points_in_units_that_leave_double_precision_are_refused) {
  for (const double unit : {1e-43, 1e41}) {
    std::vector<Point_3> points;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) points.emplace_back(unit * i, unit * j, unit * bowl(i, j));
    EXPECT_THROW(fitted_structures(points, {.scale = 0}), std::invalid_argument) << unit;
    EXPECT_NO_THROW((Fitted_function_traits_3<Fit_kernel>(points, {.scale = 0}))) << unit;
  }
}

TEST(Fit_input, normals_of_vertices_that_agree_with_the_faces_are_those_of_the_data) {
  Fit_mesh mesh = height_field(5, bowl);
  using Vertex = Fit_mesh::Vertex_index;
  const auto normals = mesh.add_property_map<Vertex, Fit_kernel::Vector_3>("normals").first;
  for (const Vertex v : mesh.vertices()) {
    const auto p = mesh.point(v);
    normals[v] = Fit_kernel::Vector_3(-2 * p.x() - 0.2 * p.x() * p.y(), -p.y() - 0.1 * p.x() * p.x(), 1);
  }
  normals[Vertex(3)] = -normals[Vertex(3)];
  constexpr double feature_angle = 60;
  const auto by_faces =
      internal::fit_input_of_mesh(internal::fit_data_of_graph(mesh, internal::joined_parameters()), feature_angle).data;
  const auto given =
      internal::fit_input_of_mesh(
          internal::fit_data_of_graph(mesh, internal::joined_parameters(parameters::vertex_normal_map(normals))),
          feature_angle)
          .data;
  for (const Vertex v : mesh.vertices()) {
    const auto& n = normals[v];
    const Eigen::Matrix3d inverse = given.normalization.matrix.inverse();
    const Eigen::Vector3d normal = (inverse.transpose() * Eigen::Vector3d(n.x(), n.y(), n.z())).normalized();
    const Eigen::Vector3d& expected = v == Vertex(3) ? by_faces.data.normals[3] : normal;
    EXPECT_NEAR((given.data.normals[v] - expected).norm(), 0, 1e-12) << v;
  }
}

TEST(Fit_input, options_that_make_no_sense_are_refused) {
  const Fit_mesh mesh = height_field(5, bowl);
  const auto expect_refused = [&](const Fit_options& options, const std::string& field) {
    try {
      fitted_structures(mesh, options);
      ADD_FAILURE() << field;
    } catch (const Input_error& error) {
      EXPECT_EQ(error.field(), field);
    }
  };
  expect_refused({.scale = -1}, "scale");
  expect_refused({.scale = std::numeric_limits<double>::quiet_NaN()}, "scale");
  expect_refused({.noise = -1}, "noise");
  expect_refused({.degree = 7}, "degree");
  expect_refused({.feature_angle = 181}, "feature_angle");
}

TEST(Fit_input, fewer_points_than_a_fit_needs_have_no_structure) {
  EXPECT_TRUE(fitted_structures(std::vector<Point_3>(), {.scale = 0}).empty());
  EXPECT_TRUE(fitted_structures(Fit_mesh(), {.scale = 0}).empty());
  for (const std::size_t n : {1u, 2u, 3u}) {
    const Fit_mesh mesh = height_field(n + 1, bowl);
    for (const auto& s : fitted_structures(mesh, {.scale = 0})) EXPECT_EQ(s.structure.status, Point_status::OUTSIDE);
    const Fitted_function_traits_3<Fit_kernel> traits(mesh, {.scale = 0});
    EXPECT_TRUE(std::isnan(traits.value({0, 0, 0})));
  }
}

/// Expects that only the Euclidean structure exists.
void expect_parabolic(const std::vector<Fitted_structure_3<double>>& structures) {
  for (const auto& s : structures) {
    EXPECT_EQ(s.structure.status, Point_status::PARABOLIC);
    EXPECT_TRUE(std::isfinite(s.structure.euclidean.gaussian_curvature));
    EXPECT_FALSE(has_numbers(s) || std::isfinite(s.error.affine_gaussian_curvature));
  }
}

TEST(Fit_input_long, points_in_a_plane_are_parabolic) {
  for (const double slope : {0., 1.}) {
    const Fit_mesh mesh = height_field(20, [slope](double x, double y) { return slope * (2 * x - y); });
    for (const auto& structures :
         {fitted_structures(mesh, {.scale = 0}), fitted_structures(points_of(mesh), {.scale = 0})}) {
      expect_parabolic(structures);
      for (const auto& s : structures) {
        EXPECT_NEAR(s.structure.euclidean.gaussian_curvature, 0, 1e-6);
        EXPECT_NEAR(s.structure.euclidean.mean_curvature, 0, 1e-3);
      }
    }
  }
}

TEST(Fit_input, a_cylinder_is_parabolic) {
  Fit_mesh mesh = height_field(20, [](double, double) { return 0; });
  for (const auto v : mesh.vertices()) {
    const Point_3 p = mesh.point(v);
    mesh.point(v) = Point_3(std::sin(p.x()), p.y(), std::cos(p.x()));
  }
  const auto exact = fitted_structures(mesh, {.scale = 0});
  std::size_t known_parabolic = 0;
  for (const auto& s : exact) {
    known_parabolic += s.structure.status == Point_status::PARABOLIC;
    EXPECT_LE(std::abs(s.structure.euclidean.gaussian_curvature), s.error.euclidean_gaussian_curvature);
  }
  EXPECT_GE(double(known_parabolic), 0.99 * double(exact.size()));                 // not where a corner has few points
  EXPECT_NEAR(std::abs(exact[210].structure.euclidean.mean_curvature), 0.5, 1e-3); // in the middle
  add_noise(mesh, 0.001 * mean_edge(mesh));
  std::size_t parabolic = 0, unknown = 0;
  for (const auto& s : fitted_structures(mesh, {.scale = 0})) {
    parabolic += s.structure.status == Point_status::PARABOLIC;
    unknown += s.error.affine_gaussian_curvature >= std::abs(s.structure.affine.gaussian_curvature);
  }
  EXPECT_GT(double(parabolic), 0.7 * double(mesh.number_of_vertices()));
  EXPECT_GT(double(parabolic + unknown), 0.97 * double(mesh.number_of_vertices()));
}

TEST(Fit_input, points_on_a_line_have_no_structure) {
  std::vector<Point_3> line;
  for (int i = 0; i < 200; ++i) line.emplace_back(0.01 * i, 0.02 * i, -0.03 * i);
  for (const auto& s : fitted_structures(line, {.scale = 0})) EXPECT_FALSE(has_numbers(s));
}

TEST(Fit_input, many_points_in_one_place_count_once) {
  std::vector<Point_3> points = points_of(height_field(20, bowl));
  const auto before = fitted_structures(points, {.scale = 0});
  points.insert(points.end(), 100000, points[210]);
  const auto after = fitted_structures(points, {.scale = 0});
  ASSERT_EQ(after.size(), points.size());
  EXPECT_EQ(after[100].structure.affine.gaussian_curvature, before[100].structure.affine.gaussian_curvature);
  EXPECT_EQ(after.back().structure.affine.gaussian_curvature, before[210].structure.affine.gaussian_curvature);
  for (const auto& s : fitted_structures(std::vector<Point_3>(100000, Point_3(1, 2, 3)), {.scale = 0}))
    EXPECT_EQ(s.structure.status, Point_status::OUTSIDE);
}

TEST(Fit_input, a_vertex_without_faces_has_no_structure_and_the_others_do_not_notice) {
  Fit_mesh mesh = height_field(20, bowl);
  const auto before = fitted_structures(mesh, {.scale = 0});
  mesh.add_vertex(Point_3(0, 0, 0.01));
  const auto after = fitted_structures(mesh, {.scale = 0});
  EXPECT_EQ(after.back().structure.status, Point_status::OUTSIDE);
  EXPECT_NEAR(after[210].structure.affine.gaussian_curvature, before[210].structure.affine.gaussian_curvature, 1e-6);
}

TEST(Fit_input, given_normals_decide_the_side_and_unoriented_ones_are_turned_to_agree) {
  const Fit_mesh mesh = height_field(20, bowl);
  std::vector<std::pair<Point_3, Vector_3>> points;
  for (const auto& p : points_of(mesh)) {
    const Vector_3 normal(-2 * p.x() - 0.2 * p.x() * p.y(), -p.y() - 0.1 * p.x() * p.x(), 1);
    points.emplace_back(p, -normal / std::sqrt(normal.squared_length()));
  }
  const auto maps = parameters::point_map(CGAL::First_of_pair_property_map<std::pair<Point_3, Vector_3>>())
                        .normal_map(CGAL::Second_of_pair_property_map<std::pair<Point_3, Vector_3>>());
  const auto down = fitted_structures(points, {.scale = 0}, maps);
  for (std::size_t i = 0; i < points.size(); i += 3) points[i].second = -points[i].second;
  const auto turned =
      fitted_structures(points, {.scale = 0, .normal_orientation = Normal_orientation::UNORIENTED}, maps);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(down[i].structure.euclidean.normal[2], 0);
    EXPECT_EQ(turned[i].structure.status, down[i].structure.status);
    if (has_numbers(down[i])) {
      EXPECT_NEAR(std::abs(turned[i].structure.affine.mean_curvature),
                  std::abs(down[i].structure.affine.mean_curvature), 1e-6);
    }
    EXPECT_GT(turned[i].structure.euclidean.normal[2] * turned[0].structure.euclidean.normal[2], 0);
  }
}

TEST(Fit_input, normals_that_contradict_give_no_number_out_of_nowhere) {
  const Fit_mesh mesh = height_field(20, bowl);
  std::vector<std::pair<Point_3, Vector_3>> points;
  for (const auto& p : points_of(mesh)) points.emplace_back(p, Vector_3(0, 0, points.size() % 2 == 0 ? 1 : -1));
  const auto maps = parameters::point_map(CGAL::First_of_pair_property_map<std::pair<Point_3, Vector_3>>())
                        .normal_map(CGAL::Second_of_pair_property_map<std::pair<Point_3, Vector_3>>());
  EXPECT_GE(part_that_agrees(fitted_structures(points, {.scale = 0}, maps), fitted_structures(mesh, {.scale = 0}),
                             points.size()),
            0.93);
}

TEST(Fit_input, close_sheets_of_a_mesh_have_the_curvatures_that_each_has_alone) {
  const Fit_mesh single = height_field(20, bowl);
  Fit_mesh both = single;
  const double gap = 0.7 * mean_edge(single);
  const Fit_mesh upper = height_field(20, [&](double x, double y) { return bowl(x, y) + gap; });
  std::vector<Fit_mesh::Vertex_index> moved;
  for (const auto v : upper.vertices()) moved.push_back(both.add_vertex(upper.point(v)));
  for (const auto f : upper.faces()) {
    std::vector<Fit_mesh::Vertex_index> corners;
    for (const auto v : upper.vertices_around_face(upper.halfedge(f))) corners.push_back(moved[v]);
    both.add_face(corners[0], corners[2], corners[1]);
  }
  const auto alone = fitted_structures(single, {.scale = 0}), together = fitted_structures(both, {.scale = 0});
  EXPECT_GE(part_that_agrees(together, alone, alone.size()), 0.93);
  // The blend has both sheets, with opposite normals.
  const Fitted_function_traits_3<Fit_kernel> traits(both, {.scale = 0});
  std::size_t close = 0;
  for (const auto v : single.vertices()) {
    EXPECT_GT(traits.first_order(single.point(v)).coefficients()[3], 0);
    EXPECT_LT(traits.first_order(upper.point(v)).coefficients()[3], 0);
    close += std::abs(traits.value(single.point(v))) < 0.05 * gap;
    close += std::abs(traits.value(upper.point(v))) < 0.05 * gap;
  }
  EXPECT_GE(double(close), 0.98 * double(both.number_of_vertices())); // fits extrapolate at corners
}

TEST(Fit_input, at_a_crease_the_error_says_that_curvatures_mean_nothing) {
  const Fit_mesh mesh = height_field(31, [](double x, double y) { return std::abs(x) + 0.3 * y * y + 0.2 * x * x; });
  const auto structures = fitted_structures(mesh, {.scale = 0});
  for (const auto v : mesh.vertices()) {
    const auto& s = structures[v];
    if (std::abs(mesh.point(v).x()) > 0.03 || !has_numbers(s)) continue;
    EXPECT_GT(s.error.affine_gaussian_curvature, 0.5 * std::abs(s.structure.affine.gaussian_curvature))
        << mesh.point(v);
  }
}

TEST(Fit_input, a_hole_stays_a_hole_of_the_blend) {
  std::vector<Point_3> points = points_of(height_field(41, bowl));
  std::erase_if(points, [](const Point_3& p) { return std::hypot(p.x(), p.y()) < 0.4; });
  const Fitted_function_traits_3<Fit_kernel> traits(points, {.scale = 0});
  EXPECT_TRUE(std::isnan(traits.value({0, 0, 0})));
  for (const auto& p : points) EXPECT_NEAR(traits.value(p), 0, 1e-4);
}

} // namespace fit_input_test
