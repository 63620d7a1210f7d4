// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_MESH_SAMPLES_H
#define EQUIAFFINE_SRC_REGISTRATION_MESH_SAMPLES_H

#include "registration/Area_samples_3.h"
#include <equiaffine/mesh/internal/Triangles_3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace equiaffine::internal {

inline Triangles_3 turned_inside_out(Triangles_3 mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline Triangles_3 transformed(Triangles_3 mesh, const Affine_map_3& map) {
  for (Eigen::Vector3d& p : mesh.points) p = map(p);
  return map.matrix.determinant() < 0 ? turned_inside_out(std::move(mesh)) : mesh;
}

inline Moments_3 area_moments(const Triangles_3& mesh) {
  Moment_sums_3 sums(mesh.points.front());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sums.add_triangle(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
  return sums.moments();
}

inline Moments_3 volume_moments(const Triangles_3& mesh, const Eigen::Vector3d& origin) {
  Moment_sums_3 sums(origin);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sums.add_cone(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
  return sums.moments();
}

/// An edge of a mesh with one of its triangles.
struct Edge_of_triangle {
  std::array<std::uint32_t, 2> ends; ///< the smaller number first
  std::uint32_t triangle;
  bool is_forward; ///< whether the triangle has it in this order
};

/// Returns the three edges of every triangle, those with the same ends one after the other.
inline std::vector<Edge_of_triangle> sorted_edges(const Triangles_3& mesh) {
  std::vector<Edge_of_triangle> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      edges.push_back({{std::min(a, b), std::max(a, b)}, std::uint32_t(t), a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge_of_triangle& e, const Edge_of_triangle& f) {
    return e.ends != f.ends ? e.ends < f.ends : e.triangle < f.triangle;
  });
  return edges;
}

/// The distances between a smooth surface and triangles that touch it at their vertices.
struct Facet_error {
  double rms, greatest; ///< the rms over the area
};

/// Returns what the width of two triangles times the angle between them, over 8, tells of all edges. Those that bend by 50
/// degrees or more are edges of the surface itself.
inline Facet_error facet_error(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges) {
  constexpr double greatest_angle = 50 * std::numbers::pi / 180;
  double sum = 0, area = 0, greatest = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += mesh.double_area(t).norm();
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].ends != edges[i + 1].ends) continue;
    const Eigen::Vector3d m = mesh.double_area(edges[i].triangle), n = mesh.double_area(edges[i + 1].triangle);
    const double angle = std::atan2(m.cross(n).norm(), m.dot(n));
    const double length = (mesh.points[edges[i].ends[0]] - mesh.points[edges[i].ends[1]]).norm();
    if (!(angle < greatest_angle && length > 0)) continue;
    const double sagitta = (m.norm() + n.norm()) / 2 / length * angle / 8;
    sum += (m.norm() + n.norm()) * sagitta * sagitta;
    greatest = std::max(greatest, sagitta);
  }
  return {area > 0 ? std::sqrt(sum / (3 * area)) : 0, greatest};
}

/// How far coordinates may be from those that were meant: half a unit of the last decimal place of the largest ones if
/// many of these have it, as rounded numbers do, and if it is at most a millionth of the largest one; else half of the
/// last bit of a float or double.
inline double coordinate_rounding(const std::vector<Eigen::Vector3d>& points) {
  constexpr int most_places = 12;
  constexpr std::size_t many = 4;
  constexpr double part_of_all = 0.5, greatest_part = 1e-6;
  double greatest = 0;
  for (const Eigen::Vector3d& p : points) greatest = std::max(greatest, p.cwiseAbs().maxCoeff());
  const auto has_more = [](double c, int n) {
    const double scaled = c * std::pow(10, n);
    return std::abs(scaled - std::round(scaled)) > 4e-16 * std::abs(scaled);
  };
  std::vector<double> large;
  int places = -6;
  bool are_floats = true;
  for (const Eigen::Vector3d& p : points)
    for (const double c : p) {
      are_floats &= double(float(c)) == c;
      if (std::abs(c) < greatest / 10) continue;
      large.push_back(std::abs(c));
      while (places <= most_places && has_more(c, places)) ++places;
    }
  const double binary = greatest * std::ldexp(1, are_floats ? -24 : -53);
  const double decimal = 0.5 * std::pow(10, -places);
  if (places > most_places || decimal > greatest_part * greatest) return binary;
  const auto last = std::partition(large.begin(), large.end(), [&](double c) { return has_more(c, places - 1); });
  const auto with_all_places = double(last - large.begin());
  std::sort(large.begin(), last);
  const bool are_many = std::size_t(std::unique(large.begin(), last) - large.begin()) >= many;
  if (!are_many && with_all_places < part_of_all * double(large.size())) return binary;
  return std::max(decimal, binary);
}

/// Samples triangles by a sequence that is uniform in their area. The moments are those of the triangles themselves, and
/// `edges` are their sorted edges.
/// \pre the mesh has an area.
inline Area_samples_3 mesh_samples(const Triangles_3& mesh, const std::vector<Edge_of_triangle>& edges,
                                   std::size_t count) {
  Area_samples_3 result;
  result.area = area_moments(mesh);
  const Facet_error error = facet_error(mesh, edges);
  result.facet_error = error.rms;
  result.greatest_facet_error = error.greatest;
  std::vector<double> cumulated;
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) cumulated.push_back(sum += mesh.double_area(t).norm());
  for (std::size_t n = 0; n < count; ++n) {
    auto [u, v, w] = quasirandom<3>(n);
    const auto found = std::upper_bound(cumulated.begin(), cumulated.end(), u * sum);
    const std::size_t t = std::min(std::size_t(found - cumulated.begin()), cumulated.size() - 1);
    if (v + w > 1) v = 1 - v, w = 1 - w;
    const Eigen::Vector3d &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    result.points.push_back(a + v * (b - a) + w * (c - a));
    result.normals.push_back(mesh.double_area(t).normalized());
  }
  return result;
}

} // namespace equiaffine::internal

#endif
