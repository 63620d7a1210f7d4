// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_CREASED_POLYGONS_3_H
#define EQUIAFFINE_FIT_INTERNAL_CREASED_POLYGONS_3_H

#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/fit/internal/Charts_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Points with polygons that can be cut apart at creases.
class Creased_polygons_3 {
public:
  using Index = std::uint32_t;
  using Vector = Eigen::Vector3d;
  using Edge = std::array<Index, 2>; ///< smaller index first

  Creased_polygons_3(std::vector<Vector> points, std::vector<std::vector<Index>> faces)
      : points_(std::move(points)), faces_(std::move(faces)) {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      first_corner_.push_back(corners_);
      corners_ += faces_[f].size();
      Vector area = double_area_of_polygon(points_, faces_[f]);
      areas_.push_back(area.stableNorm());
      area.stableNormalize();
      normals_.push_back(area);
      for (std::size_t k = 0; k < faces_[f].size(); ++k) {
        const Index a = faces_[f][k], b = faces_[f][(k + 1) % faces_[f].size()];
        sides_.push_back({{std::min(a, b), std::max(a, b)}, f, k});
      }
    }
    for (Index v = 0; v < points_.size(); ++v) given_.push_back(v);
    std::stable_sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) { return a.ends < b.ends; });
  }

  const std::vector<Vector>& points() const { return points_; }
  const std::vector<std::vector<Index>>& faces() const { return faces_; }

  /// Marks the points on edges of one face.
  std::vector<char> borders() const {
    std::vector<char> result(points_.size());
    for_each_edge([&](std::size_t first, std::size_t last) {
      if (last - first == 1) result[sides_[first].ends[0]] = result[sides_[first].ends[1]] = 1;
    });
    for (std::size_t v = 0; v < points_.size(); ++v) result[v] = result[given_[v]];
    return result;
  }

  /// Returns, in order, the edges of two faces that bend by more than an angle in degrees and form creases. A
  /// connected set of sharp edges is a crease if it is at least ten mean edges long, and ten more for each loose
  /// end, and if fewer than half as many edges at it bend by a third of the angle. Otherwise noise or thin triangles
  /// explain them: isolated sharp edges, a few around a small triangle, or many next to less sharp ones.
  std::vector<Edge> creases(double angle) const {
    constexpr double length_per_end = 10, most_others = 0.5;
    const double least = angle * std::numbers::pi / 180;
    std::vector<Edge> sharp;
    for_each_edge([&](std::size_t first, std::size_t last) {
      if (last - first == 2 && std::abs(bend(first)) > least) sharp.push_back(sides_[first].ends);
    });
    if (sharp.empty()) return sharp;
    std::vector<std::size_t> degree(points_.size());
    Disjoint_sets<std::size_t> chains(points_.size());
    for (const auto& [a, b] : sharp) ++degree[a], ++degree[b], chains.unite(a, b);
    struct Chain {
      double length = 0, edges = 0, others = 0, ends = 0;
    };
    std::vector<Chain> chain(points_.size());
    for (std::size_t v = 0; v < points_.size(); ++v) chain[chains.find(v)].ends += degree[v] == 1;
    double sum = 0, count = 0;
    for_each_edge([&](std::size_t first, std::size_t last) {
      const Edge& ends = sides_[first].ends;
      const double edge_length = length(ends);
      sum += edge_length, ++count;
      if (last - first != 2) return;
      const double size = std::abs(bend(first));
      Chain& of_edge = chain[chains.find(ends[0])];
      if (size > least) of_edge.length += edge_length, ++of_edge.edges;
      else if (3 * size > least)
        for (const Index v : ends) chain[chains.find(v)].others += degree[v] > 0;
    });
    std::erase_if(sharp, [&](const Edge& edge) {
      const Chain& c = chain[chains.find(edge[0])];
      return c.length < length_per_end * (1 + c.ends) * sum / count || c.others > most_others * c.edges;
    });
    return sharp;
  }

  /// Cuts polygons apart at creases: a point shared by several smooth parts is duplicated for each part. The part
  /// with the largest area around the point keeps its index; the others get new ones.
  Charts_3 split(const std::vector<Edge>& creases) {
    Charts_3 charts;
    if (creases.empty()) return charts;
    Disjoint_sets<std::size_t> sectors = sectors_of(creases);
    charts.is_on_crease.assign(points_.size(), 0);
    give_points_to_sectors(sectors, charts);
    Disjoint_sets<Index> parts(points_.size());
    for (const auto& face : faces_)
      for (const Index v : face) parts.unite(face.front(), v);
    for (Index v = 0; v < points_.size(); ++v) charts.of_point.push_back(parts.find(v));
    for_each_edge([&](std::size_t first, std::size_t last) {
      if (last - first != 2) return;
      const Index a = charts.of_point[faces_[sides_[first].face].front()],
                  b = charts.of_point[faces_[sides_[first + 1].face].front()];
      if (a != b) charts.add_crease(a, b, bend(first) * length(sides_[first].ends));
    });
    std::map<Index, std::vector<Index>> parts_at;
    for (Index v = 0; v < points_.size(); ++v)
      if (charts.is_on_crease[v]) parts_at[given_[v]].push_back(charts.of_point[v]);
    for (const auto& [v, parts_there] : parts_at) charts.add_corner(parts_there);
    return charts;
  }

private:
  /// An edge of a face, from corner `position` to the next one.
  struct Side {
    Edge ends;
    std::size_t face, position;
  };

  template <class F>
  void for_each_edge(const F& f) const {
    for (std::size_t first = 0, last = 0; first < sides_.size(); first = last) {
      while (last < sides_.size() && sides_[last].ends == sides_[first].ends) ++last;
      f(first, last);
    }
  }

  /// The angle between the normals of the two faces at an edge, positive if it is convex.
  double bend(std::size_t first) const {
    const Side &a = sides_[first], &b = sides_[first + 1];
    const Vector &m = normals_[a.face], &n = normals_[b.face];
    const Vector start = points_[faces_[a.face][a.position]],
                 along = points_[faces_[a.face][(a.position + 1) % faces_[a.face].size()]] - start;
    const double angle = std::atan2(m.cross(n).norm(), m.dot(n));
    return m.cross(n).dot(along) >= 0 ? angle : -angle;
  }

  double length(const Edge& ends) const { return (points_[ends[0]] - points_[ends[1]]).norm(); }

  /// The face corners in sets, one set for each smooth part around a point. A point without a crease has one set.
  Disjoint_sets<std::size_t> sectors_of(const std::vector<Edge>& creases) const {
    Disjoint_sets<std::size_t> sectors(corners_);
    const auto corner = [&](std::size_t side, Index v) {
      const auto& [ends, f, k] = sides_[side];
      return first_corner_[f] + (faces_[f][k] == v ? k : (k + 1) % faces_[f].size());
    };
    for_each_edge([&](std::size_t first, std::size_t last) {
      if (std::binary_search(creases.begin(), creases.end(), sides_[first].ends)) return;
      for (std::size_t side = first + 1; side < last; ++side)
        for (const Index v : sides_[first].ends) sectors.unite(corner(first, v), corner(side, v));
    });
    std::vector<char> has_crease(points_.size());
    for (const auto& [a, b] : creases) has_crease[a] = has_crease[b] = 1;
    std::vector<std::size_t> first_at(points_.size(), corners_);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < faces_[f].size(); ++k) {
        const Index v = faces_[f][k];
        if (has_crease[v]) continue;
        if (first_at[v] == corners_) first_at[v] = first_corner_[f] + k;
        sectors.unite(first_at[v], first_corner_[f] + k);
      }
    return sectors;
  }

  void give_points_to_sectors(Disjoint_sets<std::size_t>& sectors, Charts_3& charts) {
    std::map<std::pair<Index, std::size_t>, double> areas; // of the sectors of points
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < faces_[f].size(); ++k)
        areas[{faces_[f][k], sectors.find(first_corner_[f] + k)}] += areas_[f];
    std::map<std::size_t, Index> point_of; // of sectors that are not the largest of their point
    for (auto it = areas.begin(); it != areas.end();) {
      const Index v = it->first.first;
      auto end = it, largest = it;
      for (; end != areas.end() && end->first.first == v; ++end)
        if (end->second > largest->second) largest = end;
      for (; it != end; ++it) {
        if (it == largest) continue;
        point_of[it->first.second] = Index(points_.size());
        const Vector p = points_[v];
        points_.push_back(p);
        given_.push_back(v);
        charts.is_on_crease[v] = 1;
        charts.is_on_crease.push_back(1);
      }
    }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < faces_[f].size(); ++k)
        if (const auto found = point_of.find(sectors.find(first_corner_[f] + k)); found != point_of.end())
          faces_[f][k] = found->second;
  }

  std::vector<Vector> points_;
  std::vector<Index> given_; ///< the given point of which this is a copy
  std::vector<std::vector<Index>> faces_;
  std::vector<Vector> normals_; ///< of faces; 0 if the area is 0
  std::vector<double> areas_;   ///< of faces, doubled
  std::vector<std::size_t> first_corner_;
  std::size_t corners_ = 0;
  std::vector<Side> sides_; ///< sorted by their ends
};

} // namespace equiaffine::internal

#endif
