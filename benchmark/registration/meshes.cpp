// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of meshes and points by fits to their vertices.
#include "runs.h"
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace registration_runs {
namespace {

using Fit = Fitted_function_traits_3<Kernel>;

struct Mesh {
  Points points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  double mean_edge() const {
    double sum = 0;
    for (const auto& t : triangles)
      for (std::size_t k = 0; k < 3; ++k)
        sum += std::sqrt(CGAL::squared_distance(points[t[k]], points[t[(k + 1) % 3]]));
    return sum / (3 * double(triangles.size()));
  }

  Fit fit() const { return Fit(points, triangles, {.scale = 0}); }
};

/// An irregular mesh with about this number of vertices on the surface, found by adapting the radius of the mesher's
/// triangles.
Mesh mesh_of(const Formula& function, double vertices) {
  const CGAL::Bbox_3 box = function.bbox();
  double radius = 0.02 * box.x_span();
  Mesh mesh;
  for (int n = 0; n < 5; ++n) {
    auto surface = delaunay_surface(function, {.radius = radius, .distance = 1});
    mesh = {std::move(surface.points), std::move(surface.triangles)};
    const double ratio = double(mesh.points.size()) / vertices;
    if (std::abs(ratio - 1) < 0.06) break;
    radius *= std::sqrt(ratio);
  }
  return mesh;
}

/// Moves points by normal deviates along each axis.
void disturb(Points& points, double deviation, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, deviation);
  for (Point_3& p : points) {
    const double x = normal(random), y = normal(random), z = normal(random);
    p = Point_3(p.x() + x, p.y() + y, p.z() + z);
  }
}

/// The fraction `part` of the vertices that is farthest in a direction, with the triangles between them.
Mesh piece_of(const Mesh& mesh, const Eigen::Vector3d& direction, double part) {
  const auto height = [&](const Point_3& p) { return -direction.dot(Eigen::Vector3d(p.x(), p.y(), p.z())); };
  std::vector<double> heights;
  for (const Point_3& p : mesh.points) heights.push_back(height(p));
  const double greatest = lower_quantile(heights, part);
  Mesh piece;
  std::vector<std::uint32_t> positions(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    positions[i] = std::uint32_t(piece.points.size());
    if (heights[i] <= greatest) piece.points.push_back(mesh.points[i]);
  }
  for (const auto& [a, b, c] : mesh.triangles)
    if (std::max({heights[a], heights[b], heights[c]}) <= greatest)
      piece.triangles.push_back({positions[a], positions[b], positions[c]});
  return piece;
}

void image_of(Points& points, const Map& map) {
  for (Point_3& p : points) p = map(p);
}

/// The standard deviation of noise along each axis, in mean edges.
constexpr double disturbance = 0.01;

} // namespace

/// Meshes of 10,000 vertices and the images of meshes of 11,000 vertices of the same surface.
void register_meshes(int repeats) {
  Row exact("meshes", 1e-4), noisy("meshes_noise_1_percent_of_edge", 1e-2), piece("meshes_piece_of_30_percent", 1e-2);
  Random random(800);
  for (const Surface& s : generic_surfaces()) {
    const Formula function = s.traits();
    const Mesh source = mesh_of(function, 10000), other = mesh_of(function, 11000);
    Mesh disturbed_source = source;
    disturb(disturbed_source.points, disturbance * source.mean_edge(), 1);
    const Fit fit = source.fit(), disturbed_fit = disturbed_source.fit();
    for (int r = 0; r < repeats; ++r) {
      const Map map = random_map(random, 5, random_determinant(random));
      Mesh target = other, disturbed_target = other;
      image_of(target.points, map);
      disturb(disturbed_target.points, disturbance * other.mean_edge(), unsigned(2 + r));
      image_of(disturbed_target.points, map);
      const Fit target_fit = target.fit();
      exact.run(fit, source.points, target_fit, target.points, map);
      noisy.run(disturbed_fit, disturbed_source.points, disturbed_target.fit(), disturbed_target.points, map);
      const Eigen::Vector3d direction = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      const Mesh part = piece_of(source, direction, 0.3);
      piece.run(part.fit(), part.points, target_fit, target.points, map);
    }
  }
  exact.report({.greatest_error = "<=1e-4"});
  noisy.report({.right = ">=0.9", .greatest_error = "<=1e-2"});
  piece.report({.right = ">=0.9", .greatest_error = "<=1e-2"});
}

/// The bunny and its image under the map of the paper's figure 11, as points without faces.
void register_bunny(const std::string& folder) {
  CGAL::Surface_mesh<Point_3> bunny;
  if (!CGAL::IO::read_OFF(folder + "/meshes/bunny00.off", bunny)) return;
  double edge = 0;
  for (const auto e : bunny.edges())
    edge += std::sqrt(CGAL::squared_distance(bunny.point(bunny.vertex(e, 0)), bunny.point(bunny.vertex(e, 1)))) /
            double(bunny.number_of_edges());
  const Points points(bunny.points().begin(), bunny.points().end());
  const Map map(1.4, -0.2, 0, 0, 0.1, 0.7, 0, 0, 0, 0, 1, 0);
  const Fit_options at_scale = {.scale = 0.18};
  const Fit fit(bunny, at_scale);
  Row row("bunny_half_of_the_vertices", 1e-2);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Points half = points;
    disturb(half, disturbance * edge, seed);
    std::mt19937 random(seed);
    std::erase_if(half, [&](const Point_3&) { return random() & 1; });
    image_of(half, map);
    row.run(fit, points, Fit(half, at_scale), half, map);
  }
  row.report({.greatest_error = "none"});
}

} // namespace registration_runs
