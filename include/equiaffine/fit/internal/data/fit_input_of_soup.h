// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_DATA_FIT_INPUT_OF_SOUP_H
#define EQUIAFFINE_FIT_INTERNAL_DATA_FIT_INPUT_OF_SOUP_H

#include <equiaffine/fit/internal/data/data_of_mesh.h>
#include <equiaffine/fit/internal/data/fit_input.h>
#include <equiaffine/surface/internal/shared/indexed_polygons.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <ranges>
#include <vector>

namespace equiaffine::internal {

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
template <std::ranges::input_range Points, std::ranges::input_range Polygons>
Fit_input_of_points fit_input_of_soup(const Points& range, const Polygons& polygon_range,
                                      std::optional<double> feature_angle) {
  const Indexed_polygons soup = indexed_polygons_of_soup(range, polygon_range);
  std::vector<Soup_point> points;
  for (const auto& p : soup.points) points.emplace_back(p[0], p[1], p[2]);
  std::vector<Soup_point> repaired = points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const auto& polygon : soup.polygons) polygons.emplace_back(polygon.begin(), polygon.end());
  CGAL::Polygon_mesh_processing::repair_polygon_soup(repaired, polygons);
  CGAL::Polygon_mesh_processing::orient_polygon_soup(repaired, polygons);

  Fit_input_of_points result;
  result.positions = positions_after_repair(points, repaired);
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& p : repaired) vertices.push_back(coordinates_of(p));
  std::vector<std::vector<std::uint32_t>> faces;
  for (const auto& polygon : polygons) faces.emplace_back(polygon.begin(), polygon.end());
  result.data = data_of_mesh(vertices, faces, feature_angle);
  return result;
}

} // namespace equiaffine::internal

#endif
