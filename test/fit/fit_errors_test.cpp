// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/fit_data.h"
#include <equiaffine/fit/fitted_structures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace fit_errors_test {

using namespace equiaffine;
using namespace equiaffine::test;

// Sums of bumps whose ball held the whole shape: all degrees left out the same detail, and K was within its error at
// two thirds of the vertices.
TEST(Fitted_structures_long, what_every_degree_leaves_out_is_seen_in_smaller_balls) {
  const auto bumps = formula("exp(-(x-.5)^2-y^2-z^2)+exp(-(x+.6)^2-(y-.4)^2-z^2)+exp(-x^2-(y+.7)^2-(z-.3)^2)-.45",
                             CGAL::Bbox_3(-2.5, -2.5, -2.5, 2.5, 2.5, 2.5));
  const Fit_mesh exact = to_surface_mesh(surface_of(bumps, {.resolution = 26}));
  const auto points = points_of(exact);
  for (const auto& [noise, least] : {std::pair(0.01, 0.8), std::pair(0.05, 0.9)}) { // without: .61 and .69
    Fit_mesh mesh = exact;
    add_noise(mesh, noise * mean_edge(mesh));
    const auto fits = fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0});
    const auto K_covered = part_within(
        fits.size(),
        [&](std::size_t i) {
          return std::abs(fits[i].structure.affine.gaussian_curvature -
                          local_structure_at(bumps, points[i]).affine.gaussian_curvature);
        },
        [&](std::size_t i) { return fits[i].error.affine_gaussian_curvature; });
    EXPECT_GT(K_covered, least) << noise;
  }
}

TEST(Fitted_structures_long, outliers_have_no_curvature_and_spoil_none) {
  const Fit_mesh exact = metaballs_mesh(40);
  const auto points = points_of(exact);
  Fit_mesh mesh = exact;
  const double edge = mean_edge(mesh);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<bool> is_moved(points.size()), is_away(points.size()); // from the surface
  for (std::size_t i = 17; i < points.size(); i += 100) {
    Fit_kernel::Vector_3 way(normal(random), normal(random), normal(random));
    way = way / std::sqrt(way.squared_length());
    is_moved[i] = true;
    const auto& n = local_structure_at(metaballs(), points[i]).euclidean.normal;
    is_away[i] = 3 * std::abs(way * Fit_kernel::Vector_3(n[0], n[1], n[2])) > 2;
    mesh.point(Fit_mesh::Vertex_index(unsigned(i))) = points[i] + way * (3 * edge);
  }
  for (const bool has_faces : {true, false}) {
    const auto fits = has_faces ? fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0})
                                : fitted_structures<CGAL::Parallel_if_available_tag>(points_of(mesh), {.scale = 0});
    double fitted = 0, moved = 0;
    for (std::size_t i = 0; i < fits.size(); ++i) {
      const bool has_fit = fits[i].structure.status != Point_status::OUTSIDE;
      moved += is_moved[i];
      fitted += is_moved[i] && has_fit;
      EXPECT_FALSE(has_fit && is_away[i]) << points[i] << ' ' << has_faces;
      EXPECT_TRUE(has_fit || is_moved[i]) << points[i] << ' ' << has_faces;
    }
    if (has_faces) { // those that are moved along the surface
      EXPECT_LT(fitted, 0.1 * moved);
    }
  }
  const auto without = fitted_structures<CGAL::Parallel_if_available_tag>(exact, {.scale = 0}),
             with = fitted_structures<CGAL::Parallel_if_available_tag>(mesh, {.scale = 0});
  std::vector<double> differences;
  for (std::size_t i = 0; i < with.size(); ++i)
    if (!is_moved[i])
      differences.push_back(
          std::abs(with[i].structure.affine.gaussian_curvature / without[i].structure.affine.gaussian_curvature - 1));
  std::sort(differences.begin(), differences.end());
  EXPECT_LT(differences[differences.size() / 2], 1e-3);
}

// A bullet: a hemisphere with a cylinder behind it whose triangles are forty times as long as wide. They had set the
// coordinates of balls, which reached from the nose over the whole hemisphere.
TEST(Fitted_structures, long_triangles_elsewhere_do_not_spoil_a_hemisphere) {
  Fit_mesh mesh;
  constexpr int around = 80, rings = 20;
  const auto tip = mesh.add_vertex({0, 0, -1});
  std::vector<std::vector<Fit_mesh::Vertex_index>> circles;
  for (int r = 1; r <= rings; ++r) {
    circles.emplace_back();
    const double latitude = std::numbers::pi / 2 * r / rings;
    for (int a = 0; a < around; ++a) {
      const double longitude = 2 * std::numbers::pi * (a + r / 2.) / around;
      circles.back().push_back(mesh.add_vertex(
          {std::sin(latitude) * std::cos(longitude), std::sin(latitude) * std::sin(longitude), -std::cos(latitude)}));
    }
  }
  circles.emplace_back();
  for (const auto v : circles[rings - 1]) {
    const auto& p = mesh.point(v);
    circles.back().push_back(mesh.add_vertex({p.x(), p.y(), 3}));
  }
  for (int a = 0; a < around; ++a) {
    const auto next = std::size_t((a + 1) % around), here = std::size_t(a);
    mesh.add_face(tip, circles[0][next], circles[0][here]);
    for (std::size_t r = 0; r + 1 < circles.size(); ++r) {
      mesh.add_face(circles[r][here], circles[r][next], circles[r + 1][here]);
      mesh.add_face(circles[r][next], circles[r + 1][next], circles[r + 1][here]);
    }
  }
  const auto fits = fitted_structures<CGAL::Parallel_if_available_tag>(mesh);
  double within = 0;
  const std::size_t nose = 1 + around * rings, tip_part = 1 + around * (rings / 2 - 2);
  for (std::size_t i = 0; i < nose; ++i) {
    const double error = std::abs(fits[i].structure.affine.gaussian_curvature - 1);
    within += error <= fits[i].error.affine_gaussian_curvature;
    if (i < tip_part) {
      EXPECT_LT(error, 0.01) << mesh.point(Fit_mesh::Vertex_index(unsigned(i)));
    }
  }
  EXPECT_GT(within, 0.9 * double(nose));
}

} // namespace fit_errors_test
