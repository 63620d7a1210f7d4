// SPDX-License-Identifier: GPL-3.0-or-later
// Samples, moments, nearest triangles and errors of triangle meshes, for the search for maps between meshes.
#ifndef EQUIAFFINE_SRC_REGISTRATION_MESH_SAMPLES_H
#define EQUIAFFINE_SRC_REGISTRATION_MESH_SAMPLES_H

#include "registration/Affine_map_3.h"
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/register_surfaces.h>
#include <equiaffine/volume/internal/Triangle_tree.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The moments of an area or a volume.
struct Moments_3 {
  double measure = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// The root mean square distance from the centroid.
  double size() const { return std::sqrt(covariance.trace()); }
};

/// Accumulates the integrals of 1, x and x x^T. Positions are relative to `origin`, to reduce cancellation.
class Moment_sums_3 {
public:
  explicit Moment_sums_3(const Eigen::Vector3d& origin) : origin_(origin) {}

  void add_point(const Eigen::Vector3d& p) {
    const Eigen::Vector3d x = p - origin_;
    add(1, x, x * x.transpose());
  }

  void add_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d x = (a + b) / 2 - origin_, half = (b - a) / 2;
    add(2 * half.norm(), x, x * x.transpose() + half * half.transpose() / 3);
  }

  /// Adds the area of a triangle.
  void add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d x = a - origin_, y = b - origin_, z = c - origin_, sum = x + y + z;
    add((b - a).cross(c - a).norm() / 2, sum / 3, (squares(x, y, z) + sum * sum.transpose()) / 12);
  }

  /// Adds the signed volume between the origin and a triangle.
  void add_cone(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d x = a - origin_, y = b - origin_, z = c - origin_, sum = x + y + z;
    add(x.dot(y.cross(z)) / 6, sum / 4, (squares(x, y, z) + sum * sum.transpose()) / 20);
  }

  /// Adds the sums of another measure about the same origin times `sign`.
  void add(const Moment_sums_3& other, double sign) {
    measure_ += sign * other.measure_;
    first_ += sign * other.first_;
    second_ += sign * other.second_;
  }

  double measure() const { return measure_; }

  Moments_3 moments() const {
    const Eigen::Vector3d mean = first_ / measure_;
    return {measure_, origin_ + mean, second_ / measure_ - mean * mean.transpose()};
  }

private:
  static Eigen::Matrix3d squares(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
    return x * x.transpose() + y * y.transpose() + z * z.transpose();
  }

  void add(double measure, const Eigen::Vector3d& mean, const Eigen::Matrix3d& mean_square) {
    measure_ += measure;
    first_ += measure * mean;
    second_ += measure * mean_square;
  }

  Eigen::Vector3d origin_, first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
  double measure_ = 0;
};

/// Points uniform in the area of a surface, as are the first n of them, with unit normals of either side.
struct Area_samples_3 {
  std::vector<Eigen::Vector3d> points, normals;
  Moments_3 area;
  std::optional<Moments_3> volume = {}; ///< of a function whose surface bounds a solid
  double facet_error = 0; ///< rms distance of the triangles from the smooth surface that they approximate
  double greatest_facet_error = 0;
  bool is_cut = false; ///< whether the surface ends at its box, so that symmetries need not preserve the centroid

  double spacing() const { return std::sqrt(area.measure / double(points.size())); }

  /// The largest distance of a point from the origin.
  double radius() const {
    double result = 0;
    for (const Eigen::Vector3d& p : points) result = std::max(result, p.norm());
    return result;
  }
};

/// The probability that a random point of the ball of a radius around a surface is closer to it than t is this
/// number times t.
inline double chance_of_nearness(double area, double radius) {
  return 2 * area / (4 * std::numbers::pi / 3 * std::pow(radius, 3));
}

/// Point n of a low-discrepancy sequence in a cube (M. Roberts, The unreasonable effectiveness of quasirandom
/// sequences, 2018).
template <std::size_t Dimension>
std::array<double, Dimension> quasirandom(std::size_t n) {
  static const double root = [] { // the root of x^(d + 1) = x + 1, as the limit of this iteration
    double x = 1.5;
    for (int step = 0; step < 40; ++step) x = std::pow(1 + x, 1 / (1.0 + double(Dimension)));
    return x;
  }();
  std::array<double, Dimension> result;
  double x = double(n + 1);
  for (double& coordinate : result) {
    x /= root;
    coordinate = x + 0.5 - std::floor(x + 0.5);
  }
  return result;
}

/// The map to coordinates in which a measure has centroid 0 and covariance 1. Affine symmetries of the solid are
/// orthogonal there.
inline Affine_map_3 whitening_map(const Moments_3& moments) {
  const Eigen::Matrix3d factor = moments.covariance.llt().matrixL();
  const Eigen::Matrix3d matrix = factor.inverse();
  return {matrix, -(matrix * moments.centroid)};
}

/// The map to coordinates in which an area has centroid 0 and size 1.
inline Affine_map_3 centering_map(const Moments_3& area) {
  return {Eigen::Matrix3d::Identity() / area.size(), -area.centroid / area.size()};
}

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
  std::array<std::uint32_t, 2> ends; ///< smaller index first
  std::uint32_t triangle;
  bool is_forward; ///< whether the triangle has it in this order
};

/// Returns the three edges of every triangle; edges with the same ends are adjacent.
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
  double rms, greatest; ///< rms over the area
};

/// Estimates the error from all edges: for each, the width of its two triangles times the angle between them, over
/// 8. Edges that bend by 50 degrees or more are edges of the surface itself.
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

/// Returns the usual tolerance, or less for the facets of solids bounded by planes, which are flat to the rounding
/// of their coordinates.
inline double tolerance_of_facets(double facet_error, double usual) {
  constexpr double rounding = 2e-5, distance_per_error = 1000;
  return std::min(usual, std::max(rounding, distance_per_error * facet_error));
}

/// The smallest and the largest distance between points in contact if the noise is unknown.
constexpr double usual_contact = 1e-3, greatest_contact = 1e-2;

/// The distance up to which points of two pieces are in contact.
inline double tolerance_of_contact(double facet_error, const Registration_options& options) {
  if (options.tolerance) return *options.tolerance;
  return tolerance_of_facets(facet_error, std::clamp(4 * facet_error, usual_contact, greatest_contact));
}

/// The rounding error of coordinates. It is half a unit of the last decimal place of the largest coordinates, if
/// many of these use it, as rounded numbers do, and if it is at most a millionth of the largest one; else half of
/// the last bit of a float or double.
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

/// Samples triangles by a sequence that is uniform in their area. The moments are those of the triangles themselves;
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

inline Distance_kernel::Point_3 to_CGAL(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }
inline Eigen::Vector3d to_Eigen(const Distance_kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// A tree of triangles; trees require at least two of them.
inline Triangle_tree tree_of(std::vector<Triangle_tree::Triangle_3> triangles) {
  if (triangles.size() == 1) triangles.push_back(triangles.front());
  return Triangle_tree(std::move(triangles), 0);
}

/// The triangles whose area is not negligible relative to the largest one, because others have no normal.
/// \pre the mesh has an area.
inline std::vector<Triangle_tree::Triangle_3> triangles_with_area(const Triangles_3& mesh) {
  constexpr double rounding = 1e-14;
  double greatest = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) greatest = std::max(greatest, mesh.double_area(t).norm());
  std::vector<Triangle_tree::Triangle_3> result;
  result.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.double_area(t).norm() > rounding * greatest)
      result.emplace_back(to_CGAL(mesh.corner(t, 0)), to_CGAL(mesh.corner(t, 1)), to_CGAL(mesh.corner(t, 2)));
  return result;
}

inline Eigen::Vector3d unit_normal(const Triangle_tree::Triangle_3& t) {
  const Eigen::Vector3d a = to_Eigen(t[0]);
  return (to_Eigen(t[1]) - a).cross(to_Eigen(t[2]) - a).normalized();
}

/// The point of the triangles of a tree that is nearest to another point.
struct Nearest_triangle {
  Triangle_tree::Part part = 0; ///< the triangle
  Distance_kernel::Point_3 point;
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// Finds the nearest triangle, visiting the nearer of two children first. The depth of a tree halved by medians is
/// below 64.
/// \pre the tree has at least two triangles.
inline Nearest_triangle nearest_triangle(const Triangle_tree& tree, const Distance_kernel::Point_3& p) {
  Nearest_triangle best;
  const auto try_triangle = [&](Triangle_tree::Part part, const Distance_kernel::Point_3& q, double d) {
    if (d < best.squared_distance) best = {part, q, d};
  };
  std::array<std::pair<Triangle_tree::Part, double>, 128> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0.0};
  while (size > 0) {
    const auto [box, box_distance] = stack[--size];
    if (box_distance >= best.squared_distance) continue;
    std::array<std::pair<Triangle_tree::Part, double>, 2> open;
    std::size_t count = 0;
    for (const Triangle_tree::Part child : tree.children(box)) {
      const auto q = tree.nearest_point(child, p);
      const double d = (p - q).squared_length();
      if (Triangle_tree::is_triangle(child)) try_triangle(child, q, d);
      else open[count++] = {child, d};
    }
    if (count == 2 && open[0].second < open[1].second) std::swap(open[0], open[1]);
    for (std::size_t i = 0; i < count; ++i)
      if (open[i].second < best.squared_distance) stack[size++] = open[i];
  }
  return best;
}

} // namespace equiaffine::internal

#endif
