// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes whose vertices are moved to a fit stay whole.
#include "support/fit_meshes.h"
#include <equiaffine/fit/move_to_fit.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace move_to_fit_test {

using namespace equiaffine;
using namespace fit_meshes;
namespace pmp = CGAL::Polygon_mesh_processing;

TEST(Move_to_fit, vertices_move_onto_the_fit_and_triangles_stay) {
  Mesh mesh = torus(50);
  const Fit fit(mesh, {.scale = 0});
  for (const auto v : mesh.vertices()) { // off the surface by less than a fifth of an edge
    const Point_3 p = mesh.point(v);
    const double r = std::hypot(p.x(), p.y());
    const Kernel::Vector_3 out(p.x() * (1 - 1 / r), p.y() * (1 - 1 / r), p.z());
    mesh.point(v) = p + (v.idx() % 2 == 0 ? .03 : -.03) * out;
  }
  const std::size_t faces = mesh.number_of_faces();
  const auto outcomes = outcomes_of(mesh);
  const auto report = move_to_fit(mesh, fit, parameters::vertex_outcome_map(outcomes));
  EXPECT_EQ(mesh.number_of_faces(), faces);
  expect_counted(mesh, outcomes, report);
  EXPECT_EQ(report.number_on_fit(), mesh.number_of_vertices());
  EXPECT_NEAR(report.largest_move, .012, .001);
  for (const auto v : mesh.vertices()) expect_on_fit(mesh.point(v), fit);
}

TEST(Move_to_fit, vertices_without_a_zero_follow_and_say_so) {
  Mesh mesh = torus(20);
  const Fit fit(mesh, {.scale = 0});
  Mesh apart = mesh;
  for (const auto v : apart.vertices()) // a bump that is no part of the fit
    if (apart.point(v).x() > 1.2) apart.point(v) = apart.point(v) + Kernel::Vector_3(.5, 0, 0);
  const auto outcomes = outcomes_of(apart);
  const auto report = move_to_fit(apart, fit, parameters::vertex_outcome_map(outcomes));
  EXPECT_LT(report.number_on_fit(), report.number_of_vertices());
  expect_counted(apart, outcomes, report);
  for (const auto v : apart.vertices())
    if (apart.point(v).x() > 1.6) {
      EXPECT_NE(outcomes[v], Fit_outcome::ON_FIT);
    }
  EXPECT_FALSE(pmp::does_self_intersect(apart));
}

TEST(Move_to_fit, nothing_moves_without_a_fit) {
  Mesh mesh = torus(12);
  const auto report = move_to_fit(mesh, Fit(Mesh(), {.scale = 0}));
  EXPECT_EQ(report.number_of[std::size_t(Fit_outcome::NO_VALUE)], mesh.number_of_vertices());
  EXPECT_EQ(report.largest_move, 0);
}

/// Two sheets of 12 x 12 points with a distance of 1, one above the other, of which the lower one is to move up.
internal::Triangle_array_3 two_sheets(double height) {
  constexpr std::uint32_t n = 12;
  std::vector<Eigen::Vector3d> points;
  std::vector<internal::Index_triangle> triangles;
  for (const double z : {0., height})
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        const auto i = std::uint32_t(points.size());
        points.emplace_back(x, y, z);
        if (x + 1 == n || y + 1 == n) continue;
        triangles.push_back({i, i + 1, i + n});
        triangles.push_back({i + 1, i + n + 1, i + n});
      }
  return {points, triangles};
}

std::size_t number_of(const internal::Whole_motion_3& motion, Fit_outcome outcome, std::size_t vertices) {
  std::size_t number = 0;
  for (std::size_t v = 0; v < vertices; ++v) number += motion.outcome(v) == outcome;
  return number;
}

TEST(Whole_motion_3, a_sheet_stops_at_another_one_where_it_would_cross) {
  const auto mesh = two_sheets(.2);
  std::vector<internal::Zero_of_fit_3> zeros(288, {Fit_outcome::NO_ZERO});
  for (std::size_t v = 0; v < 144; ++v) { // half of the sheet would go through the other one, the rest stays below
    const double move = mesh.points()[v].x() < 6 ? .3 : .1;
    zeros[v] = {Fit_outcome::ON_FIT, {0, 0, move}, {0, 0, 1}};
  }
  const internal::Whole_motion_3 motion(mesh, zeros, {});
  EXPECT_TRUE(internal::crossing_triangles(motion.points(), mesh.triangles()).empty());
  EXPECT_EQ(motion.crossings(), 0U);
  EXPECT_GT(number_of(motion, Fit_outcome::CROSSING, 288), 0U);
  EXPECT_GE(number_of(motion, Fit_outcome::ON_FIT, 288), 60U);
}

TEST(Whole_motion_3, zeros_of_other_sheets_and_triangles_that_turn_over_are_left) {
  const auto mesh = two_sheets(10);
  std::vector<internal::Zero_of_fit_3> zeros(288, {Fit_outcome::ON_FIT, {0, 0, 0}, {0, 0, 1}});
  zeros[40].move = {0, 0, 2};   // a peak
  zeros[80].move = {1.5, 0, 0}; // past its neighbor, on the same plane
  const internal::Whole_motion_3 motion(mesh, zeros, {});
  EXPECT_EQ(motion.outcome(40), Fit_outcome::TORN_AWAY);
  EXPECT_EQ(motion.outcome(80), Fit_outcome::TURNED);
  EXPECT_EQ(number_of(motion, Fit_outcome::ON_FIT, 288), 286U);
  EXPECT_EQ(motion.points()[40], mesh.points()[40]);
}

TEST(Whole_motion_3, vertices_beside_a_feature_do_not_leave_it) {
  const auto mesh = two_sheets(10);
  std::vector<internal::Zero_of_fit_3> zeros(288, {Fit_outcome::ON_FIT, {0, 0, -.3}, {0, 0, 1}});
  for (std::size_t v = 60; v < 72; ++v) zeros[v] = {Fit_outcome::ON_FEATURE}; // a row of the lower sheet
  const internal::Whole_motion_3 motion(mesh, zeros, {});
  EXPECT_EQ(motion.points()[65], mesh.points()[65]);
  for (const std::size_t v : {53U, 77U}) { // the rows beside it follow its place and their neighbors'
    EXPECT_EQ(motion.outcome(v), Fit_outcome::TORN_AWAY);
    EXPECT_LT(motion.points()[v].z(), 0);
    EXPECT_GT(motion.points()[v].z(), -.3);
  }
  EXPECT_EQ(number_of(motion, Fit_outcome::TORN_AWAY, 288), 24U);
  EXPECT_EQ(motion.outcome(41), Fit_outcome::ON_FIT);
}

} // namespace move_to_fit_test
