// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FIT_INPUT_OF_SOUP_H
#define EQUIAFFINE_FIT_INTERNAL_FIT_INPUT_OF_SOUP_H

#include <equiaffine/base/check_argument.h>
#include <equiaffine/fit/internal/data_of_mesh.h>
#include <equiaffine/fit/internal/fit_input.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <map>
#include <ranges>
#include <vector>

namespace equiaffine::internal {

using Soup_point = CGAL::Simple_cartesian<double>::Point_3;

template <std::ranges::input_range Polygons>
std::vector<std::vector<std::size_t>> polygons_of_soup(const Polygons& polygons, std::size_t number_of_points) {
  std::vector<std::vector<std::size_t>> result;
  for (const auto& polygon : polygons) {
    auto& positions = result.emplace_back();
    for (const auto i : polygon) {
      check_argument(std::size_t(i) < number_of_points, "a polygon has the position of no point: give all points");
      positions.push_back(std::size_t(i));
    }
  }
  return result;
}

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
/// each of them, and gets what the first says.
template <std::ranges::input_range Points, std::ranges::input_range Polygons>
Fit_input_of_points fit_input_of_soup(const Points& range, const Polygons& polygon_range) {
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& p : range) vertices.push_back(coordinates_of(p));
  check_points(vertices);
  std::vector<Soup_point> points;
  for (const auto& v : vertices) points.emplace_back(v[0], v[1], v[2]);
  std::vector<Soup_point> repaired = points;
  auto polygons = polygons_of_soup(polygon_range, points.size());
  CGAL::Polygon_mesh_processing::repair_polygon_soup(repaired, polygons);
  CGAL::Polygon_mesh_processing::orient_polygon_soup(repaired, polygons);

  Fit_input_of_points result;
  result.positions = positions_after_repair(points, repaired);
  vertices.clear();
  for (const auto& p : repaired) vertices.push_back(coordinates_of(p));
  std::vector<std::vector<std::uint32_t>> faces;
  for (const auto& polygon : polygons) faces.emplace_back(polygon.begin(), polygon.end());
  result.data = data_of_mesh(vertices, faces);
  return result;
}

} // namespace equiaffine::internal

#endif
