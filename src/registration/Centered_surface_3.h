// SPDX-License-Identifier: GPL-3.0-or-later
// Whole surfaces in coordinates with the centroid at 0, and their corners, which reveal exact symmetries.
#ifndef EQUIAFFINE_SRC_REGISTRATION_CENTERED_SURFACE_3_H
#define EQUIAFFINE_SRC_REGISTRATION_CENTERED_SURFACE_3_H

#include "registration/Affine_map_3.h"
#include "registration/Surface_distances.h"
#include "registration/map_of_quadrics.h"
#include "registration/mesh_samples.h"
#include "registration/solid_moments.h"
#include <equiaffine/base/internal/Point_tree.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A vertex whose angles do not add up to that of a plane or a half-plane, or where a border bends. Corners depend
/// only on the shape, not on the triangulation of faces: a symmetry moves corners to corners with the same angle.
struct Corner {
  Eigen::Vector3d point;
  double angle; ///< sum of the angles of its triangles and of that between border edges
  double error; ///< of the angle, due to rounding of coordinates
  bool is_on_border;
};

/// The sum of the angles between border edges at each vertex; 0 if there are not two. `edges` are sorted.
inline std::vector<double> angles_of_borders(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges) {
  constexpr auto none = std::numeric_limits<std::size_t>::max();
  std::vector<double> angles(mesh.points.size());
  std::vector<std::size_t> neighbors(mesh.points.size(), none);
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next].ends == edges[i].ends) ++next;
    if (next - i != 1) continue;
    const std::array<std::size_t, 2> ends = {edges[i].ends[0], edges[i].ends[1]};
    for (const std::size_t k : {0U, 1U}) {
      const std::size_t v = ends[k];
      if (neighbors[v] == none) {
        neighbors[v] = ends[1 - k];
        continue;
      }
      const Eigen::Vector3d a = mesh.points[neighbors[v]] - mesh.points[v],
                            b = mesh.points[ends[1 - k]] - mesh.points[v];
      angles[v] += std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  return angles;
}

/// The corners of a mesh whose coordinates have a rounding error. `edges` are sorted.
inline std::vector<Corner> corners_of(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges,
                                      double rounding) {
  constexpr double least_difference = 1e-3, greatest_error = 0.1, pi = std::numbers::pi;
  std::vector<double> angles(mesh.points.size()), errors(mesh.points.size());
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = mesh.points[triangle[k]], a = mesh.points[triangle[(k + 1) % 3]] - p,
                            b = mesh.points[triangle[(k + 2) % 3]] - p;
      angles[triangle[k]] += std::atan2(a.cross(b).norm(), a.dot(b));
      errors[triangle[k]] += 2 * rounding * (1 / a.norm() + 1 / b.norm());
    }
  const std::vector<double> of_borders = angles_of_borders(mesh, edges);
  std::vector<Corner> corners;
  for (std::size_t v = 0; v < angles.size(); ++v) {
    const bool is_on_border = of_borders[v] > 0;
    const double least = least_difference + errors[v];
    const bool is_flat = std::abs(angles[v] - (is_on_border ? pi : 2 * pi)) <= least;
    const bool is_straight = !is_on_border || std::abs(of_borders[v] - pi) <= least;
    if (!(angles[v] > 0) || (is_flat && is_straight) || !(errors[v] < greatest_error)) continue;
    corners.push_back({mesh.points[v], angles[v] + of_borders[v], 2 * errors[v] + 1e-9, is_on_border});
  }
  return corners;
}

/// Searches for all rotations and reflections about the origin that move the corners of a mesh to each other. Two
/// corners that are not collinear with the origin determine a map together with their images, which are among the
/// few corners at the same distance and with the same angle.
class Corner_symmetry_search {
public:
  /// Corners closer to each other than `tolerance` are equal.
  Corner_symmetry_search(std::vector<Corner> corners, double tolerance)
      : corners_(std::move(corners)), tolerance_(tolerance) {
    std::stable_sort(corners_.begin(), corners_.end(),
                     [](const Corner& a, const Corner& b) { return a.point.squaredNorm() < b.point.squaredNorm(); });
    std::vector<Eigen::Vector3d> points;
    for (const Corner& c : corners_) points.push_back(c.point);
    tree_ = Point_tree<3>(points);
  }

  /// Returns the maps without the identity; nothing if there are too few corners, or too many similar ones.
  std::optional<std::vector<Affine_map_3>> run(bool in_threads, bool allows_reflections) const {
    const auto base = choose_base();
    if (!base) return std::nullopt;
    const auto [first, second] = *base;
    std::vector<Affine_map_3> maps;
    const std::vector<std::size_t> images = alike(first), others = alike(second);
    if (double(images.size()) * double(others.size()) > most_pairs) return std::nullopt;
    const Eigen::Matrix3d frame = frame_of(first, second);
    const double distance = (corners_[first].point - corners_[second].point).norm();
    std::vector<std::vector<Affine_map_3>> found(images.size());
    parallel_for(in_threads, 0, images.size(), [&](std::size_t n) {
      for (const std::size_t j : others) {
        if (std::abs((corners_[images[n]].point - corners_[j].point).norm() - distance) > 4 * tolerance_) continue;
        Eigen::Matrix3d image = frame_of(images[n], j);
        for (const double side : {1.0, -1.0}) {
          if (side < 0 && !allows_reflections) continue;
          image.col(2) *= side;
          if (const auto map = refined(image * frame.transpose())) found[n].push_back(*map);
        }
      }
    });
    for (const auto& some : found) maps.insert(maps.end(), some.begin(), some.end());
    std::erase_if(maps, [](const Affine_map_3& m) { return (m.matrix - Eigen::Matrix3d::Identity()).norm() < 1e-4; });
    return maps;
  }

private:
  static constexpr std::size_t most_alike = 3000, most_verified = 5000;
  static constexpr double most_pairs = 4e6, least_sine = 0.2;

  bool are_alike(const Corner& a, const Corner& b) const {
    return std::abs(a.angle - b.angle) <= a.error + b.error &&
           std::abs(a.point.norm() - b.point.norm()) <= 2 * tolerance_;
  }

  /// The possible images of a corner.
  std::vector<std::size_t> alike(std::size_t i) const {
    const double radius = corners_[i].point.norm();
    const auto begin = std::lower_bound(corners_.begin(), corners_.end(), radius - 2 * tolerance_,
                                        [](const Corner& c, double r) { return c.point.norm() < r; });
    std::vector<std::size_t> result;
    for (auto c = begin; c != corners_.end() && c->point.norm() <= radius + 2 * tolerance_; ++c)
      if (are_alike(*c, corners_[i])) result.push_back(std::size_t(c - corners_.begin()));
    return result;
  }

  /// Returns the two corners with the fewest similar corners.
  std::optional<std::array<std::size_t, 2>> choose_base() const {
    constexpr std::size_t most_tried = 400; // counting is slow if many corners have the same distance
    if (corners_.size() < 3) return std::nullopt;
    const double greatest = corners_.back().point.norm();
    std::vector<std::pair<std::size_t, std::size_t>> order;
    const std::size_t step = 1 + corners_.size() / most_tried;
    for (std::size_t i = corners_.size() % step; i < corners_.size(); i += step)
      if (corners_[i].point.norm() > 0.1 * greatest) order.emplace_back(alike(i).size(), corners_.size() - i);
    std::stable_sort(order.begin(), order.end());
    for (const auto& [count, from_end] : order) {
      if (count > most_alike) break;
      const std::size_t first = corners_.size() - order.front().second, other = corners_.size() - from_end;
      const Eigen::Vector3d &p = corners_[first].point, &q = corners_[other].point;
      if (p.cross(q).norm() > least_sine * p.norm() * q.norm()) return std::array{first, other};
    }
    return std::nullopt;
  }

  /// An orthonormal frame from two corners.
  Eigen::Matrix3d frame_of(std::size_t i, std::size_t j) const {
    Eigen::Matrix3d frame;
    frame.col(0) = corners_[i].point.normalized();
    frame.col(2) = corners_[i].point.cross(corners_[j].point).normalized();
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
  }

  /// Returns the map that moves corners closest to their images (K. Arun et al., Least-squares fitting of two 3-D
  /// point sets, 1987), if each corner has an image.
  std::optional<Affine_map_3> refined(const Eigen::Matrix3d& matrix) const {
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    const double limit = 8 * tolerance_; // the two corners of the base amplify the errors of others
    const std::size_t count = std::min(corners_.size(), most_verified);
    for (std::size_t n = 0; n < count; ++n) {
      const Corner& c = corners_[corners_.size() - 1 - n * corners_.size() / count];
      const Eigen::Vector3d p = matrix * c.point;
      const auto nearest = tree_.neighbors(p, 1);
      const Corner& image = corners_[nearest[0].index];
      if (nearest[0].distance > limit || !are_alike(c, image)) return std::nullopt;
      products += image.point * c.point.transpose();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    const Eigen::Matrix3d v = svd.matrixV();
    if ((u * v.transpose()).determinant() * matrix.determinant() < 0) u.col(2) *= -1;
    return Affine_map_3{u * v.transpose(), Eigen::Vector3d::Zero()};
  }

  std::vector<Corner> corners_; ///< sorted by distance from the origin
  double tolerance_;
  Point_tree<3> tree_;
};

/// Distances below this are zero for coordinates with this rounding; both are relative to the size.
inline double exact_distance(double rounding) { return 6 * rounding + 1e-11; }

/// A surface in a search for symmetries, in coordinates in which its area has centroid 0 and size 1. For affine maps
/// the solid is first transformed to covariance 1, and the area is the transformed one.
struct Centered_surface_3 {
  /// The proportions in which distances are reported: those of the surface, with its own centroid 0 and size 1.
  struct Proportions {
    Affine_map_3 map = {}; ///< from the coordinates of the samples
    std::shared_ptr<const Surface_distances> distances = {};
    double size = 1;         ///< of the surface, in its unit
    double rounding = 1e-12; ///< of points on the surface, relative to the size
    double spacing = 0;      ///< the largest one of the samples

    /// The matrix for normals. The length of the image of a unit normal is the weight of its area.
    Eigen::Matrix3d of_normals() const { return map.matrix.inverse().transpose(); }

    /// The smallest length of the image of a unit vector.
    double least_stretch() const { return map.matrix.jacobiSvd().singularValues()[2]; }
  };

  Area_samples_3 samples = {};
  std::shared_ptr<const Surface_distances> distances = {};
  Proportions own = {};
  Affine_map_3 map = {};                           ///< from the coordinates of the surface to these
  std::array<std::vector<Corner>, 2> corners = {}; ///< of a mesh, to its rounding and to that of few digits
  std::vector<Eigen::Vector3d> checked = {};       ///< more points: one for each vertex and each triangle of a mesh
  double rounding = 1e-12;                         ///< of points on the surface
  bool is_exact = false;           ///< whether points are on the surface up to rounding, as for a formula
  std::string reason_against = {}; ///< why its symmetries cannot be found, if they cannot

  /// The square roots of the eigenvalues of the covariance of the area.
  Eigen::Vector3d extents() const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(samples.area.covariance, Eigen::EigenvaluesOnly);
    return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  }

  /// 1 for surfaces as thick as they are wide, less for thin ones, whose distances must be small relative to their
  /// thickness.
  double thickness() const { return std::min(1.0, 3 * std::sqrt(3.0) * extents()[0]); }
};

/// Whether a mesh, whose coordinates have a rounding error, has rigid symmetries to rounding according to its
/// corners. Then it is a solid with these corners: a scan has no such symmetries, and the corners of a fine sampling
/// of a smooth surface are flatter.
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

/// The error of coordinates written with four decimals, relative to the size.
constexpr double rounding_of_few_digits = 5e-5;

/// Holes of a mesh are closed for the moments of its solid if that changes these by less.
constexpr double greatest_change_by_holes = 0.01;

constexpr std::size_t samples_of_mesh = 24000, samples_of_function = 12000;

inline Centered_surface_3 surface_without_symmetries(std::string reason) {
  Centered_surface_3 result;
  result.reason_against = std::move(reason);
  return result;
}

/// The used vertices of a mesh, and the centroids of its triangles.
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
    if (!volume) return surface_without_symmetries("the mesh does not bound a solid, which affine maps need");
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

/// Moves samples near an ellipsoid to the sphere with center 0 and radius 1, by least squares for a quadric, and
/// returns the map. Moments from lines are too inaccurate to distinguish such a surface from an ellipsoid.
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

/// The proportions of the zero set of a function, from samples in other coordinates, which are the image of those of
/// the function under a map.
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
    if (first.is_cut) return surface_without_symmetries("the box of the function cuts the surface");
    if (!first.volume || first.volume->covariance.llt().info() != Eigen::Success)
      return surface_without_symmetries("the surface does not bound a solid, which affine maps need");
    result.map = whitening_map(*first.volume);
  }
  result.samples = function_samples(in_threads, Mapped_function_3(function, result.map), samples_of_function);
  Area_samples_3& samples = result.samples;
  if (samples.is_cut) return surface_without_symmetries("the box of the function cuts the surface");
  if (samples.points.size() < samples_of_function)
    return surface_without_symmetries("too few sample points of the surface were found on random lines");
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
