// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_CROSSING_PLACES_3_H
#define EQUIAFFINE_FIT_INTERNAL_CROSSING_PLACES_3_H

#include <equiaffine/mesh/internal/Triangle_array_3.h>
#include <equiaffine/mesh/internal/crossing_triangles.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// The places where triangles of a mesh cross each other, and what is near them.
class Crossing_places_3 {
public:
  Crossing_places_3(const Triangle_array_3& mesh, const std::vector<Triangle_pair>& crossings, double distance)
      : boxes_(boxes_of(mesh, crossings, distance)) {}

  /// Returns whether all crossings of another mesh are at these places.
  bool contain(const Triangle_array_3& mesh, const std::vector<Triangle_pair>& crossings) const {
    std::vector<Triangle_box_3> mine = boxes_, others = boxes_of(mesh, crossings, 0);
    std::vector<char> is_here(others.size());
    CGAL::box_intersection_d(others.begin(), others.end(), mine.begin(), mine.end(),
                             [&](const auto& other, const auto&) { is_here[other.info()] = 1; });
    return std::find(is_here.begin(), is_here.end(), 0) == is_here.end();
  }

private:
  /// The boxes that both triangles of a pair have in common, widened by a distance.
  static std::vector<Triangle_box_3> boxes_of(const Triangle_array_3& mesh, const std::vector<Triangle_pair>& crossings,
                                              double distance) {
    std::vector<Triangle_box_3> boxes;
    for (std::size_t n = 0; n < crossings.size(); ++n) {
      const Triangle_box_3 a = box_of(crossings[n].first, mesh.points(), mesh.triangles());
      const Triangle_box_3 b = box_of(crossings[n].second, mesh.points(), mesh.triangles());
      const auto lower = [&](int axis) { return std::max(a.min_coord(axis), b.min_coord(axis)) - distance; };
      const auto upper = [&](int axis) { return std::min(a.max_coord(axis), b.max_coord(axis)) + distance; };
      boxes.emplace_back(CGAL::Bbox_3(lower(0), lower(1), lower(2), upper(0), upper(1), upper(2)), std::uint32_t(n));
    }
    return boxes;
  }

  std::vector<Triangle_box_3> boxes_;
};

} // namespace equiaffine::internal

#endif
