// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_CENTERED_SURFACE_3_H
#define EQUIAFFINE_SRC_REGISTRATION_CENTERED_SURFACE_3_H

#include "registration/Area_samples_3.h"
#include "registration/Surface_distances.h"
#include "registration/corner_symmetries.h"
#include "registration/function_samples.h"
#include "registration/map_of_quadrics.h"
#include "registration/mesh_samples.h"
#include "registration/solid_moments.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Distances below this are zero, if coordinates have this rounding, both a part of the size.
inline double exact_distance(double rounding) { return 6 * rounding + 1e-11; }

/// A surface whose symmetries are sought, in coordinates in which its area has centroid 0 and size 1. For affine maps
/// the solid has, before that, covariance 1, and the area is the one there.
struct Centered_surface_3 {
  /// The proportions in which distances are stated: those of the surface, with its own centroid 0 and size 1.
  struct Proportions {
    Affine_map_3 map = {}; ///< from the coordinates of the samples
    std::shared_ptr<const Surface_distances> distances = {};
    double size = 1;         ///< of the surface, in its unit
    double rounding = 1e-12; ///< of points on the surface, a part of the size
    double spacing = 0;      ///< the greatest one of the samples

    /// The matrix of normals. The length of the image of a unit normal is the weight of its area.
    Eigen::Matrix3d of_normals() const { return map.matrix.inverse().transpose(); }

    /// The least length of the image of a unit vector.
    double least_stretch() const { return map.matrix.jacobiSvd().singularValues()[2]; }
  };

  Area_samples_3 samples = {};
  std::shared_ptr<const Surface_distances> distances = {};
  Proportions own = {};
  Affine_map_3 map = {};                           ///< from the coordinates of the surface to these
  std::array<std::vector<Corner>, 2> corners = {}; ///< of a mesh, to its rounding and to that of few digits
  std::vector<Eigen::Vector3d> checked = {};       ///< more points: each vertex and each triangle of a mesh has one
  double rounding = 1e-12;                         ///< of points on the surface
  bool is_exact = false;           ///< whether points are on a surface up to rounding, as those of a formula
  std::string reason_against = {}; ///< why its symmetries cannot be found, if they cannot

  /// The square roots of the eigenvalues of the covariance of the area.
  Eigen::Vector3d extents() const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(samples.area.covariance, Eigen::EigenvaluesOnly);
    return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  }

  /// 1 for surfaces as thick as they are wide, less for thin ones, whose distances are to be small beside their
  /// thickness.
  double thickness() const { return std::min(1.0, 3 * std::sqrt(3.0) * extents()[0]); }
};

/// Whether a mesh, whose coordinates have a rounding error, has rigid symmetries to rounding by its corners. Then it is a
/// solid with these corners: a scan has no such symmetries, and the corners of a fine sampling of a smooth surface are
/// flatter.
inline bool has_group_of_corners(bool in_threads, const Triangles_3& mesh, double rounding) {
  constexpr double least_defect = 0.05; // a prism with 100 sides has .063
  const Affine_map_3 map = centering_map(area_moments(mesh));
  rounding *= map.matrix.norm();
  std::vector<Corner> corners = corners_of(transformed(mesh, map), sorted_edges(mesh), rounding);
  std::erase_if(corners, [](const Corner& c) {
    return c.is_on_border || std::abs(c.angle - 2 * std::numbers::pi) < least_defect;
  });
  const Corner_symmetry_search search(std::move(corners), exact_distance(rounding));
  const auto maps = search.run(in_threads, true);
  return maps && !maps->empty();
}

/// The error of coordinates that have been written with four decimals, a part of the size.
constexpr double rounding_of_few_digits = 5e-5;

/// Holes of a mesh are closed for the moments of its solid if that changes these by less.
constexpr double greatest_change_by_holes = 0.01;

constexpr std::size_t samples_of_mesh = 24000, samples_of_function = 12000;

inline Centered_surface_3 surface_without_symmetries(std::string reason) {
  Centered_surface_3 result;
  result.reason_against = std::move(reason);
  return result;
}

/// The corners of all triangles, and their centroids.
inline std::vector<Eigen::Vector3d> points_of_facets(const Triangles_3& mesh) {
  std::vector<Eigen::Vector3d> points;
  std::vector<bool> is_used(mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    points.push_back((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3);
    for (const auto v : mesh.triangles[t]) is_used[v] = true;
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (is_used[v]) points.push_back(mesh.points[v]);
  return points;
}

inline Centered_surface_3 centered_surface(const Triangles_3& mesh, Map_kind kind) {
  const Moments_3 area = area_moments(mesh);
  if (!(area.measure > 0)) return surface_without_symmetries("the mesh has no area");
  const auto edges = sorted_edges(mesh);
  Centered_surface_3 result;
  if (!keeps_angles(kind)) {
    const auto volume = Solid_moments(mesh, edges).moments(area.centroid, greatest_change_by_holes);
    if (!volume) return surface_without_symmetries("the mesh bounds no solid, by whose moments affine maps are found");
    result.map = whitening_map(*volume);
  }
  result.map = centering_map(area_moments(transformed(mesh, result.map))) * result.map;
  const Triangles_3 centered = transformed(mesh, result.map);
  result.samples = mesh_samples(centered, edges, samples_of_mesh);
  result.distances = std::make_shared<Mesh_distances>(centered);
  const double rounding = coordinate_rounding(mesh.points);
  const auto rounding_after = [&](const Affine_map_3& map) { return std::max(1e-12, rounding * map.matrix.norm()); };
  const Affine_map_3 centering = centering_map(area);
  result.own = {{}, result.distances, area.size(), rounding_after(centering)};
  if (!keeps_angles(kind)) {
    result.own.map = centering * result.map.inverse();
    result.own.distances = std::make_shared<Mesh_distances>(transformed(mesh, centering));
  }
  result.rounding = rounding_after(result.map);
  result.corners = {corners_of(centered, edges, result.rounding),
                    corners_of(centered, edges, std::max(result.rounding, rounding_of_few_digits))};
  result.checked = points_of_facets(centered);
  return result;
}

/// Moves samples near an ellipsoid to the sphere with center 0 and radius 1, by the least squares of a quadric, and returns
/// the map. What moments of lines are off is much beside what tells such a surface from an ellipsoid.
inline Affine_map_3 move_to_sphere(Area_samples_3& samples) {
  constexpr double nearness = 0.02;
  const auto quadric = quadric_near(samples.points, nearness);
  const auto form = quadric ? normal_form(*quadric) : std::nullopt;
  if (!form || form->positive != 3) return {};
  Affine_map_3 map = form->map;
  const double determinant = map.matrix.determinant();
  if (determinant < 0) map = {-map.matrix, -map.translation};
  const Eigen::Matrix3d of_normals = map.matrix.inverse().transpose();
  for (Eigen::Vector3d& p : samples.points) p = map(p);
  for (Eigen::Vector3d& n : samples.normals) n = (of_normals * n).normalized();
  samples.area = {samples.area.measure * std::pow(std::abs(determinant), 2.0 / 3), Eigen::Vector3d::Zero(),
                  map.matrix * samples.area.covariance * map.matrix.transpose()};
  return map;
}

/// The proportions of the zero set of a function, by samples in other coordinates to which a map leads.
inline Centered_surface_3::Proportions own_proportions(const Any_function_3& function, Area_samples_3 samples,
                                                       const Affine_map_3& to) {
  const Affine_map_3 back = to.inverse();
  const auto weight = [&](std::size_t i) { return (to.matrix.transpose() * samples.normals[i]).norm(); }; // of its area
  double total = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    total += weight(i);
    centroid += weight(i) * back(samples.points[i]);
  }
  centroid /= total;
  double square = 0;
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    square += weight(i) / total * (back(samples.points[i]) - centroid).squaredNorm();
  Centered_surface_3::Proportions result;
  result.size = std::sqrt(square);
  const Affine_map_3 centering = {Eigen::Matrix3d::Identity() / result.size, -centroid / result.size};
  result.map = centering * back;
  const double stretch = result.map.matrix.jacobiSvd().singularValues()[0];
  samples.area.measure *= stretch * stretch;
  result.spacing = samples.spacing();
  for (Eigen::Vector3d& p : samples.points) p = result.map(p);
  result.distances = std::make_shared<Function_distances>(Mapped_function_3(function, centering), samples);
  return result;
}

inline Centered_surface_3 centered_surface(bool in_threads, const Any_function_3& function, Map_kind kind) {
  Centered_surface_3 result;
  result.is_exact = true;
  if (!keeps_angles(kind)) {
    const Area_samples_3 first = function_samples(in_threads, Mapped_function_3(function, {}), samples_of_function);
    if (first.is_cut) return surface_without_symmetries("the surface is cut by the box of the function");
    if (!first.volume || first.volume->covariance.llt().info() != Eigen::Success)
      return surface_without_symmetries("the surface bounds no solid, by whose moments affine maps are found");
    result.map = whitening_map(*first.volume);
  }
  result.samples = function_samples(in_threads, Mapped_function_3(function, result.map), samples_of_function);
  Area_samples_3& samples = result.samples;
  if (samples.is_cut) return surface_without_symmetries("the surface is cut by the box of the function");
  if (samples.points.size() < samples_of_function)
    return surface_without_symmetries("lines met the surface at too few points");
  if (!keeps_angles(kind)) result.map = move_to_sphere(samples) * result.map;
  const Affine_map_3 centering = centering_map(samples.area);
  for (Eigen::Vector3d& p : samples.points) p = centering(p);
  const double size = samples.area.size();
  samples.area = {samples.area.measure / (size * size), Eigen::Vector3d::Zero(),
                  samples.area.covariance / (size * size)};
  result.map = centering * result.map;
  result.distances = std::make_shared<Function_distances>(Mapped_function_3(function, result.map), samples);
  result.own = keeps_angles(kind) ? Centered_surface_3::Proportions{.distances = result.distances,
                                                                    .size = 1 / result.map.matrix.col(0).norm(),
                                                                    .spacing = samples.spacing()}
                                  : own_proportions(function, samples, result.map);
  return result;
}

} // namespace equiaffine::internal

#endif
