// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/Affine_map_3.h"
#include "registration/Centered_surface_3.h"
#include "registration/Piece_of_surface_3.h"
#include "registration/refine_map.h"
#include "registration/slippage.h"
#include <equiaffine/registration/Registration_options.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The points of a piece after a motion, with their distances from the piece; NaN if they crossed its border.
std::vector<Mapped_point> points_after(const Affine_map_3& motion, const Piece_of_surface_3& piece, double tolerance) {
  std::vector<Mapped_point> result;
  for (const Eigen::Vector3d& p : piece.samples().points) {
    const Eigen::Vector3d moved = motion(p);
    const auto [nearest, normal, is_on_border] = piece.nearest(moved, tolerance);
    const double side = normal.dot(moved - nearest) < 0 ? -1 : 1;
    const double distance = is_on_border ? std::numeric_limits<double>::quiet_NaN() : side * (moved - nearest).norm();
    result.push_back({moved, {distance, normal}});
  }
  return result;
}

/// The rms distance; nothing if fewer than half of the points have a distance, or one exceeds the tolerance.
std::optional<double> rms_within(const std::vector<Mapped_point>& points, double tolerance) {
  double sum = 0, count = 0;
  for (const Mapped_point& p : points) {
    const double distance = std::abs(p.to_other.distance);
    if (distance > tolerance) return std::nullopt;
    if (distance <= tolerance) sum += distance * distance, ++count;
  }
  if (2 * count < double(points.size())) return std::nullopt;
  return std::sqrt(sum / count);
}

/// The velocities at the points, concatenated.
Eigen::VectorXd velocities_at(const std::vector<Eigen::Vector3d>& points, const Infinitesimal_map_3& map) {
  Eigen::VectorXd result(3 * Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    result.segment<3>(3 * Eigen::Index(i)) = map.matrix * points[i] + map.translation;
  return result;
}

/// Tries motions in both directions along a velocity, for a piece with centroid 0 and size 1. Returns the larger rms
/// distance, or nothing if the piece does not slide. Corrects the velocity by least squares, since facets determine the
/// normals of a smooth surface less accurately than its position.
std::optional<double> rms_of_sliding(Infinitesimal_map_3& velocity, const Piece_of_surface_3& piece, Map_kind kind,
                                     double length, double tolerance) {
  constexpr int most_steps = 4;
  constexpr double nearness = 20, threshold = 0.005;
  for (int step = 0;; ++step) {
    const auto& points = piece.samples().points;
    const double time = length * std::sqrt(double(points.size())) / velocities_at(points, velocity).norm();
    const auto forth = points_after(flow(velocity, time), piece, tolerance);
    const auto back = points_after(flow(velocity, -time), piece, tolerance);
    const auto rms_forth = rms_within(forth, tolerance), rms_back = rms_within(back, tolerance);
    if (rms_forth && rms_back) return std::max(*rms_forth, *rms_back);
    if (step == most_steps) return std::nullopt;
    Refinement_equations equations(infinitesimal_maps(kind), Eigen::Vector3d::Zero(), 1);
    equations.add(forth, nearness * tolerance, 1);
    equations.add(back, nearness * tolerance, -1);
    if (2 * equations.size() < forth.size()) return std::nullopt;
    const Eigen::Matrix<double, 12, 1> change = equations.solution(threshold) / time;
    velocity.matrix += Eigen::Map<const Eigen::Matrix3d>(change.data()).transpose();
    velocity.translation += change.tail<3>();
  }
}

} // namespace

/// Velocities compatible with the normals of the triangles are tested by finite motions, which may not move a point
/// farther off than the facets deviate from a smooth surface. The facets of a solid with corners are its faces, so they do
/// not explain any distance.
Affine_slippage_3 slippage_of_triangles(bool in_threads, const Triangles_3& mesh, Map_kind kind) {
  constexpr double greatest_rms = 0.2, factor = 3; // the factor for regular triangles on a sphere is 8 / 3
  const Moments_3 area = area_moments(mesh);
  if (!(area.measure > 0)) return {};
  const Affine_map_3 to = centering_map(area);
  const Triangles_3 centered = transformed(mesh, to);
  const auto edges = sorted_edges(centered);
  const double rounding = coordinate_rounding(mesh.points);
  double tolerance = exact_distance(rounding * to.matrix.norm());
  if (!has_group_of_corners(in_threads, mesh, rounding)) tolerance += factor * facet_error(centered, edges).greatest;
  const Piece_of_surface_3 piece(centered, edges, samples_of_piece, 2 * tolerance);
  const Area_samples_3& samples = piece.samples();
  const Sliding_maps maps = sliding_maps(samples.points, samples.normals, kind, 1);
  constexpr double length = 0.31, length_of_narrow = 0.17, independent = 0.5;
  Affine_slippage_3 result;
  std::vector<Eigen::VectorXd> directions; // orthonormal
  for (std::size_t k = 0; k < maps.maps.size() && maps.rms[k] < greatest_rms; ++k) {
    Infinitesimal_map_3 velocity = maps.maps[k];
    auto rms = rms_of_sliding(velocity, piece, kind, length, tolerance);
    if (!rms && !piece.is_closed()) {
      velocity = maps.maps[k];
      rms = rms_of_sliding(velocity, piece, kind, length_of_narrow, tolerance);
    }
    if (!rms) continue;
    Eigen::VectorXd direction = velocities_at(samples.points, velocity).normalized();
    for (const Eigen::VectorXd& known : directions) direction -= known.dot(direction) * known;
    if (direction.norm() < independent) continue;
    directions.push_back(direction.normalized());
    result.generators.push_back(velocity);
    result.rms = std::max(result.rms, *rms);
  }
  if (result.rms < exact_distance(rounding * to.matrix.norm())) result.rms = 0;
  const Affine_map_3 back = to.inverse();
  for (auto& [matrix, translation] : result.generators) {
    translation = back.matrix * (matrix * to.translation + translation);
    matrix = back.matrix * matrix * to.matrix;
  }
  return result;
}

} // namespace equiaffine::internal
