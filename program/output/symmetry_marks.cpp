// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/symmetry_marks.h"

#include "output/arrow_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace equiaffine {

namespace {

using Map = CGAL::Aff_transformation_3<Kernel>;
using Mesh = Indexed_triangle_mesh_3<Kernel>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

constexpr double tolerance = 1e-3; // of directions of length 1 that count as equal

Eigen::Matrix3d matrix_of(const Map& map) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix(i, j) = map.m(i, j);
  return matrix;
}

Vector vector_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// The direction that a matrix maps to 0, or nearly so.
Eigen::Vector3d null_direction(const Eigen::Matrix3d& matrix) {
  return Eigen::JacobiSVD<Eigen::Matrix3d>(matrix, Eigen::ComputeFullV).matrixV().col(2);
}

/// The point that all maps of a group leave in its place.
Point fixed_point(const Affine_symmetries_3<Kernel>& symmetries) {
  Vector sum(0, 0, 0);
  for (const auto& symmetry : symmetries.maps)
    sum = sum + (symmetry.map(Point(0, 0, 0)) - CGAL::ORIGIN) / double(symmetries.maps.size());
  return CGAL::ORIGIN + sum;
}

/// Adds a line, unless it is there.
void add_axis(const Point& point, const Eigen::Vector3d& direction, std::vector<Kernel::Line_3>& axes) {
  const Vector v = vector_of(direction.normalized());
  const bool is_known = std::any_of(axes.begin(), axes.end(), [&](const Kernel::Line_3& axis) {
    return CGAL::cross_product(axis.to_vector(), v).squared_length() < tolerance * tolerance;
  });
  if (!is_known) axes.emplace_back(point, v);
}

void add(const Mesh& part, Mesh& whole) {
  const auto first = std::uint32_t(whole.points.size());
  whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
  for (const auto& [a, b, c] : part.triangles) whole.triangles.push_back({a + first, b + first, c + first});
}

} // namespace

Symmetry_marks marks_of(const Affine_symmetries_3<Kernel>& symmetries) {
  Symmetry_marks marks;
  if (symmetries.continuous.dimension() == 1) {
    const auto& [matrix, translation] = symmetries.continuous.generators[0];
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector3d values = svd.singularValues();
    if (values[2] > tolerance * values[0]) return marks; // it turns about no axis
    const Eigen::Vector3d inverse(1 / values[0], 1 / values[1], 0);
    const Eigen::Vector3d on_axis = -(svd.matrixV() * inverse.cwiseProduct(svd.matrixU().transpose() * translation));
    add_axis(CGAL::ORIGIN + vector_of(on_axis), svd.matrixV().col(2), marks.axes);
    return marks;
  }
  const Point center = fixed_point(symmetries);
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  for (std::size_t i = 1; i < symmetries.maps.size(); ++i) {
    const Eigen::Matrix3d matrix = matrix_of(symmetries.maps[i].map);
    const bool is_involution = (matrix * matrix - identity).norm() < 0.1;
    if (matrix.determinant() > 0) add_axis(center, null_direction(matrix - identity), marks.axes);
    else if (is_involution && matrix.trace() > 0)
      marks.planes.emplace_back(center, vector_of(null_direction(matrix.transpose() + identity)));
  }
  return marks;
}

Mesh mesh_of_planes(const std::vector<Kernel::Plane_3>& planes, const Mesh& surface, double radius) {
  Mesh result;
  std::vector<double> heights(surface.points.size());
  for (const Kernel::Plane_3& plane : planes) {
    const Vector normal = plane.orthogonal_vector();
    const Point origin = plane.point();
    std::transform(surface.points.begin(), surface.points.end(), heights.begin(),
                   [&](const Point& p) { return normal * (p - origin); });
    for (const auto& triangle : surface.triangles) {
      std::vector<Point> ends;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = triangle[k], b = triangle[(k + 1) % 3];
        if ((heights[a] < 0) == (heights[b] < 0)) continue;
        const double part = heights[a] / (heights[a] - heights[b]);
        ends.push_back(surface.points[a] + part * (surface.points[b] - surface.points[a]));
      }
      if (ends.size() == 2) add(rod_mesh(ends[0], ends[1], radius), result);
    }
  }
  return result;
}

Mesh mesh_of_axes(const std::vector<Kernel::Line_3>& axes, const Mesh& surface, double radius) {
  constexpr double overhang = 0.1;
  Mesh result;
  for (const Kernel::Line_3& axis : axes) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    const Point origin = axis.point();
    for (const Point& p : surface.points) {
      const double place = axis.to_vector() * (p - origin);
      least = std::min(least, place);
      greatest = std::max(greatest, place);
    }
    const double more = overhang * (greatest - least);
    add(rod_mesh(origin + (least - more) * axis.to_vector(), origin + (greatest + more) * axis.to_vector(), radius),
        result);
  }
  return result;
}

} // namespace equiaffine
