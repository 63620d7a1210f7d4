// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_FIT_INPUT_H
#define EQUIAFFINE_SRC_FIT_FIT_INPUT_H

#include "fit/data_of_mesh.h"
#include "fit/data_of_points.h"
#include <equiaffine/fit/internal/Fit_data_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

// GCC 14 warns that a copy of a vector in this header of CGAL leaves its memory, which it does not.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Warray-bounds"
#pragma GCC diagnostic ignored "-Wstringop-overflow"
#endif
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

namespace equiaffine::internal {

/// The data points, and which of them each given point is: none for a mesh, whose vertices come first, in their order,
/// and behind them others at creases.
struct Fit_input_3 {
  Normalized_data data;
  std::vector<std::uint32_t> positions;
};

inline Fit_input_3 fit_input_of_mesh(const Fit_data_3& given) {
  Fit_input_3 result;
  result.data = data_of_mesh(given.points, given.polygons, given.feature_angle);
  improve_normals(result.data, given.normals);
  return result;
}

/// Equal points become one: returns which one each point is, and keeps the first of each kind in `points`.
inline std::vector<std::uint32_t> merge_equal_points(std::vector<Eigen::Vector3d>& points,
                                                     std::vector<Eigen::Vector3d>& normals) {
  const std::vector<std::uint32_t> first = first_of_equal(points);
  std::vector<std::uint32_t> positions(points.size());
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (first[i] != i) {
      positions[i] = positions[first[i]];
      continue;
    }
    points[kept] = points[i];
    if (!normals.empty()) normals[kept] = normals[i];
    positions[i] = kept++;
  }
  points.resize(kept);
  if (!normals.empty()) normals.resize(kept);
  return positions;
}

inline Fit_input_3 fit_input_of_points(bool in_threads, Fit_data_3 given) {
  Fit_input_3 result;
  result.positions = merge_equal_points(given.points, given.normals);
  result.data = data_of_points(in_threads, given.points, given.normals, given.orientation);
  return result;
}

using Soup_point = CGAL::Simple_cartesian<double>::Point_3;

/// Returns which point of `repaired` each point is. One that is in no polygon any more is appended.
inline std::vector<std::uint32_t> positions_after_repair(const std::vector<Soup_point>& points,
                                                         std::vector<Soup_point>& repaired) {
  std::map<Soup_point, std::uint32_t> position;
  for (std::size_t i = 0; i < repaired.size(); ++i) position.emplace(repaired[i], std::uint32_t(i));
  std::vector<std::uint32_t> result;
  for (const Soup_point& p : points) {
    const auto [place, is_new] = position.emplace(p, std::uint32_t(repaired.size()));
    if (is_new) repaired.push_back(p);
    result.push_back(place->second);
  }
  return result;
}

/// The data points are the points without those that come again, in any order; a point where sheets meet is data of
/// each of them, and gets what the first says, or at a crease the largest one.
inline Fit_input_3 fit_input_of_soup(const Fit_data_3& given) {
  std::vector<Soup_point> points;
  for (const auto& p : given.points) points.emplace_back(p[0], p[1], p[2]);
  std::vector<Soup_point> repaired = points;
  std::vector<std::vector<std::uint32_t>> polygons = given.polygons;
  CGAL::Polygon_mesh_processing::repair_polygon_soup(repaired, polygons);
  CGAL::Polygon_mesh_processing::orient_polygon_soup(repaired, polygons);

  Fit_input_3 result;
  result.positions = positions_after_repair(points, repaired);
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& p : repaired) vertices.push_back(coordinates_of(p));
  result.data = data_of_mesh(vertices, polygons, given.feature_angle);
  return result;
}

inline Fit_input_3 fit_input(bool in_threads, Fit_data_3 given) {
  if (given.kind == Fit_data_3::Kind::MESH) return fit_input_of_mesh(given);
  if (given.kind == Fit_data_3::Kind::SOUP) return fit_input_of_soup(given);
  return fit_input_of_points(in_threads, std::move(given));
}

} // namespace equiaffine::internal

#endif
