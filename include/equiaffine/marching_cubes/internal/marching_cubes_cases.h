// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles of every topology of the zero set of a trilinear function in a cell. They are computed from the signs
// at the corners, the decision on every face with a diagonal pair of positive corners, and the pair of boundary
// curves that a tunnel joins, if there is one.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_MARCHING_CUBES_CASES_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_MARCHING_CUBES_CASES_H

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

// The curves in which a surface meets the faces of a cell, and the triangles between these curves. No edge inside a
// cell joins two points of the same face: the adjacent cell could have the same edge, which would then have four
// triangles.

// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 axis + p + 2 q runs along `axis`; p and q are
// its coordinates along the next two axes, cyclically. Face 2 axis + side lies where the coordinate along `axis` is
// `side`.

/// The corners at which an edge begins and ends.
constexpr int first_corner(int edge) {
  const int axis = edge / 4;
  return (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
}
constexpr int second_corner(int edge) { return first_corner(edge) | 1 << edge / 4; }

/// The edge between two corners.
constexpr int edge_between(int corner, int other) {
  const int axis = (corner ^ other) == 1 ? 0 : (corner ^ other) == 2 ? 1 : 2;
  return 4 * axis + (corner >> (axis + 1) % 3 & 1) + 2 * (corner >> (axis + 2) % 3 & 1);
}

/// The corners of a face, counterclockwise seen from outside.
constexpr std::array<int, 4> face_corners(int face) {
  const int axis = face / 2, side = face % 2;
  const int base = side << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
  return side ? std::array{base, base | u, base | u | v, base | v} : std::array{base, base | v, base | u | v, base | u};
}

/// Whether two edges lie in one face.
constexpr bool share_face(int edge, int other) {
  for (int axis = 0; axis < 3; ++axis)
    if (edge / 4 != axis && other / 4 != axis && ((first_corner(edge) ^ first_corner(other)) >> axis & 1) == 0)
      return true;
  return false;
}

/// A closed curve through points on edges of the cell.
using Polygon = std::vector<std::uint8_t>;

/// The boundary curves of the surface in a cell. Corner c is positive if bit c of `signs` is set, and the positive
/// corners of a face are joined if its bit in `joined` is set. On each face a segment leads from the edge after a run
/// of positive corners to the edge before it or, if the positive corners are joined, to the edge before the next run.
/// The two faces at an edge traverse it in opposite directions, so the segments of all faces form closed curves.
inline std::vector<Polygon> boundary_curves(unsigned signs, unsigned joined) {
  const auto is_positive = [&](int corner) { return (signs >> corner & 1) != 0; };
  std::array<int, 12> next;
  next.fill(-1);
  for (int face = 0; face < 6; ++face) {
    const auto corners = face_corners(face);
    const auto corner = [&](std::size_t m) { return corners[m % 4]; };
    for (std::size_t m = 0; m < 4; ++m) {
      if (!is_positive(corner(m)) || is_positive(corner(m + 1))) continue;
      std::size_t end = m; // the segment ends where corner(end) is negative and corner(end + 1) positive
      if (joined >> face & 1) {
        for (end = m + 1; !is_positive(corner(end + 1));) ++end;
      } else {
        for (end = m + 3; is_positive(corner(end));) end += 3;
      }
      next[std::size_t(edge_between(corner(m), corner(m + 1)))] = edge_between(corner(end), corner(end + 1));
    }
  }
  std::vector<Polygon> curves;
  for (std::size_t first = 0; first < 12; ++first) {
    Polygon curve;
    for (std::size_t edge = first; next[edge] >= 0;) {
      curve.push_back(std::uint8_t(edge));
      edge = std::size_t(std::exchange(next[edge], -1));
    }
    if (!curve.empty()) curves.push_back(curve);
  }
  return curves;
}

/// Appends a triangulation of a polygon without inner vertices. Returns false if there is none.
inline bool triangulate_disc(const Polygon& polygon, std::vector<std::array<std::uint8_t, 3>>& triangles) {
  const std::size_t n = polygon.size();
  if (n < 3) return true;
  const auto may_join = [&](std::size_t i, std::size_t j) {
    return j == i + 1 || (i == 0 && j + 1 == n) || !share_face(polygon[i], polygon[j]);
  };
  for (std::size_t apex = 1; apex + 1 < n; ++apex) {
    if (!may_join(0, apex) || !may_join(apex, n - 1)) continue;
    const std::size_t size = triangles.size();
    triangles.push_back({polygon[0], polygon[apex], polygon.back()});
    const auto at = polygon.begin() + std::ptrdiff_t(apex);
    if (triangulate_disc(Polygon(polygon.begin(), at + 1), triangles) &&
        triangulate_disc(Polygon(at, polygon.end()), triangles))
      return true;
    triangles.resize(size);
  }
  return false;
}

/// The squared distance between the midpoints of two edges of a cell whose edges have length 2.
inline int squared_distance(int edge, int other) {
  int sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = [&](int e) { return e / 4 == axis ? 1 : 2 * (first_corner(e) >> axis & 1); };
    const int d = coordinate(edge) - coordinate(other);
    sum += d * d;
  }
  return sum;
}

/// Appends the triangles of an annulus between two curves. Edges between the curves are usually not enough, so a ring
/// of three inner vertices first, first + 1, first + 2 lies between them. Each is joined to an arc of either curve,
/// and the vertices of its two arcs are appended to `arcs`. The ring runs along a and against b, because the
/// boundaries of an annulus run in opposite directions.
inline void triangulate_annulus(const Polygon& a, const Polygon& b, std::uint8_t first,
                                std::vector<std::array<std::uint8_t, 3>>& triangles, std::vector<Polygon>& arcs) {
  const auto arc = [](const Polygon& curve, std::size_t offset, std::size_t m) {
    Polygon result;
    for (std::size_t i = m * curve.size() / 3; i <= (m + 1) * curve.size() / 3; ++i)
      result.push_back(curve[(offset + i) % curve.size()]);
    return result;
  };
  std::size_t best_offset = 0;
  int best_length = std::numeric_limits<int>::max();
  for (std::size_t offset = 0; offset < b.size(); ++offset) {
    int length = 0;
    for (std::size_t m = 0; m < 3; ++m)
      for (const auto p : arc(a, 0, m))
        for (const auto q : arc(b, offset, 2 - m)) length += squared_distance(p, q);
    if (length < best_length) best_offset = offset, best_length = length;
  }
  const auto add_side = [&](const Polygon& side, std::uint8_t here, std::uint8_t next) {
    for (std::size_t i = 0; i + 1 < side.size(); ++i) triangles.push_back({side[i], side[i + 1], here});
    triangles.push_back({side.back(), next, here});
  };
  for (std::uint8_t m = 0; m < 3; ++m) {
    Polygon both = arc(a, 0, m);
    const Polygon side_b = arc(b, best_offset, 2U - m);
    add_side(both, std::uint8_t(first + m), std::uint8_t(first + (m + 1) % 3));
    add_side(side_b, std::uint8_t(first + m), std::uint8_t(first + (m + 2) % 3));
    both.insert(both.end(), side_b.begin(), side_b.end());
    arcs.push_back(both);
  }
}

/// All sub-cases of a cell. Corners, edges, and faces are numbered as above. Bit c of `signs` is set if corner c is
/// positive. Bit f of `joined` is set if the positive corners of face f are connected across the face; it is only
/// relevant if they are diagonal.
///
/// The boundary curves cut the surface of the cell into regions, one more than there are curves. At most two regions
/// of the same sign are joined inside the cell (see isosurface_plan.h). In this case the two curves between them
/// bound one annulus; otherwise every curve bounds a disc.
class Marching_cubes_cases {
public:
  using Triangle = std::array<std::uint8_t, 3>;          ///< counterclockwise seen from the positive side
  static constexpr std::uint8_t first_inner_vertex = 12; ///< smaller numbers are edges of the cell

  /// One topology. Inner vertex n lies amid the vertices on the edges inner_edges[n].
  struct Sub_case {
    std::vector<Triangle> triangles;
    std::vector<Polygon> inner_edges;
    int boundary_curves = 0, tunnels = 0;
  };

  /// The regions of the corners for one choice on the faces, and the pairs of regions that may be joined inside the
  /// cell.
  struct Variant {
    std::array<std::uint8_t, 8> region{};
    std::uint16_t sub_case = 0; ///< the sub-case without a tunnel; sub_case + 1 + n has tunnel n
    std::vector<std::pair<std::uint8_t, std::uint8_t>> tunnels; ///< the two regions of each, the smaller first
  };

  static const Marching_cubes_cases& instance() {
    static const Marching_cubes_cases cases;
    return cases;
  }

  std::size_t size() const { return sub_cases_.size(); }
  const Sub_case& operator[](std::size_t sub_case) const { return sub_cases_[sub_case]; }

  /// The faces with diagonal positive corners, bit f for face f.
  unsigned ambiguous_faces(unsigned signs) const { return ambiguous_faces_[signs]; }

  /// Whether the signs allow several sub-cases. If not, the only sub-case is that of `variant(signs, 0)`.
  bool is_ambiguous(unsigned signs) const { return is_ambiguous_[signs]; }

  const Variant& variant(unsigned signs, unsigned joined) const { return variants_[signs][joined]; }

private:
  Marching_cubes_cases() {
    for (unsigned signs = 0; signs < 256; ++signs) {
      const unsigned faces = ambiguous_faces_[signs] = find_ambiguous_faces(signs);
      is_ambiguous_[signs] = faces != 0;
      variants_[signs].resize(faces + 1);
      for (unsigned joined = 0; joined <= faces; ++joined) {
        if ((joined & ~faces) != 0) continue;
        variants_[signs][joined] = make_variant(signs, joined);
        if (!variants_[signs][joined].tunnels.empty()) is_ambiguous_[signs] = true;
      }
    }
  }

  static unsigned find_ambiguous_faces(unsigned signs) {
    unsigned faces = 0;
    for (int f = 0; f < 6; ++f) {
      const auto c = face_corners(f);
      const auto s = [&](std::size_t m) { return signs >> c[m] & 1; };
      if (s(0) == s(2) && s(1) == s(3) && s(0) != s(1)) faces |= 1U << f;
    }
    return faces;
  }

  /// The region of every corner. The index of a region is its smallest corner.
  static std::array<std::uint8_t, 8> find_regions(unsigned signs, unsigned joined) {
    std::array<std::uint8_t, 8> region{};
    for (std::uint8_t c = 0; c < 8; ++c) region[c] = c;
    const auto join = [&](int a, int b) {
      const auto from = region[std::size_t(a)], to = region[std::size_t(b)];
      std::replace(region.begin(), region.end(), std::max(from, to), std::min(from, to));
    };
    for (int e = 0; e < 12; ++e) {
      const int a = first_corner(e), b = second_corner(e);
      if ((signs >> a & 1) == (signs >> b & 1)) join(a, b);
    }
    for (int f = 0; f < 6; ++f) {
      if (!(find_ambiguous_faces(signs) >> f & 1)) continue;
      const auto c = face_corners(f);
      const bool are_even_joined = (signs >> c[0] & 1) == (joined >> f & 1);
      join(c[are_even_joined ? 0 : 1], c[are_even_joined ? 2 : 3]);
    }
    return region;
  }

  Variant make_variant(unsigned signs, unsigned joined) {
    Variant variant{find_regions(signs, joined), std::uint16_t(sub_cases_.size()), {}};
    const auto curves = boundary_curves(signs, joined);
    const auto& region = variant.region;
    add_sub_case(curves, curves.size(), curves.size());
    for (std::size_t i = 0; i < curves.size(); ++i)
      for (std::size_t j = i + 1; j < curves.size(); ++j) {
        const auto sides = [&](const Polygon& curve) {
          return std::array{region[std::size_t(first_corner(curve[0]))], region[std::size_t(second_corner(curve[0]))]};
        };
        for (const auto r : sides(curves[i]))
          for (const auto s : sides(curves[j])) {
            const auto other_r = sides(curves[i])[sides(curves[i])[0] == r],
                       other_s = sides(curves[j])[sides(curves[j])[0] == s];
            if (other_r != other_s || !may_be_joined(region, r, s)) continue;
            variant.tunnels.emplace_back(std::min(r, s), std::max(r, s));
            add_sub_case(curves, i, j);
          }
      }
    return variant;
  }

  /// Whether a tunnel may join two regions. This requires that along every axis there are corners of the two regions
  /// on diagonally opposite edges.
  static bool may_be_joined(const std::array<std::uint8_t, 8>& region, std::uint8_t r, std::uint8_t s) {
    for (int axis = 0; axis < 3; ++axis) {
      bool is_seen = false;
      for (std::size_t c = 0; c < 8; ++c)
        for (std::size_t d = 0; d < 8; ++d)
          if (region[c] == r && region[d] == s && ((c ^ d) | std::size_t(1) << axis) == 7) is_seen = true;
      if (!is_seen) return false;
    }
    return true;
  }

  /// Adds the sub-case with a disc in each curve except i and j, which are joined by an annulus if they exist.
  void add_sub_case(const std::vector<Polygon>& curves, std::size_t i, std::size_t j) {
    Sub_case sub_case;
    sub_case.boundary_curves = int(curves.size());
    for (std::size_t n = 0; n < curves.size(); ++n) {
      if (n == i || n == j || triangulate_disc(curves[n], sub_case.triangles)) continue;
      const auto center = std::uint8_t(first_inner_vertex + sub_case.inner_edges.size());
      const Polygon& curve = curves[n];
      for (std::size_t m = 0; m < curve.size(); ++m)
        sub_case.triangles.push_back({curve[m], curve[(m + 1) % curve.size()], center});
      sub_case.inner_edges.push_back(curve);
    }
    if (i < curves.size()) {
      sub_case.tunnels = 1;
      triangulate_annulus(curves[i], curves[j], std::uint8_t(first_inner_vertex + sub_case.inner_edges.size()),
                          sub_case.triangles, sub_case.inner_edges);
    }
    sub_cases_.push_back(std::move(sub_case));
  }

  std::vector<Sub_case> sub_cases_;
  std::array<unsigned, 256> ambiguous_faces_{};
  std::array<bool, 256> is_ambiguous_{};
  std::array<std::vector<Variant>, 256> variants_;
};

/// The sub-cases of Marching_cubes_cases in flat arrays, for speed. The vertices of a cell are stored in slots: first
/// those on the edges 0, 1, 2, 3, which run along i, then those on 4, 5, 8, 10 at the lower end of the cell along i,
/// then those on the opposite edges 6, 7, 9, 11 at its upper end, then the inner vertices.
struct Case_table {
  static constexpr std::size_t first_lower_slot = 4, first_upper_slot = 8, first_inner_slot = 12, number_of_slots = 16;

  /// One number for each edge of the first eight slots, which begin at the lower end of the cell: 1 if the edge is
  /// crossed, else 0.
  using Crossed_edges = std::array<std::uint32_t, 8>;

  struct Entry {
    std::uint32_t first_slot;
    std::uint8_t triangles, inner_vertices;
    bool is_ambiguous;
  };

  /// Few cells have more triangles than this. The slots of this many triangles can be read from any entry on.
  static constexpr std::size_t triangles_of_most_cells = 4;

  static const Case_table& instance() {
    static const Case_table table;
    return table;
  }

  Case_table() {
    const auto& cases = Marching_cubes_cases::instance();
    constexpr std::uint8_t slot_of_edge[15] = {0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12, 13, 14};
    for (std::size_t s = 0; s < cases.size(); ++s) {
      of_sub_case.push_back({std::uint32_t(slots[0].size()), std::uint8_t(cases[s].triangles.size()),
                             std::uint8_t(cases[s].inner_edges.size()), false});
      for (const auto& t : cases[s].triangles)
        for (std::size_t m = 0; m < 3; ++m) {
          slots[0].push_back(slot_of_edge[t[m]]);
          slots[1].push_back(slot_of_edge[t[(3 - m) % 3]]);
        }
    }
    for (auto& side : slots) side.resize(side.size() + 3 * triangles_of_most_cells);
    for (unsigned signs = 0; signs < 256; ++signs) {
      of_signs[signs] = of_sub_case[cases.variant(signs, 0).sub_case];
      of_signs[signs].is_ambiguous = cases.is_ambiguous(signs);
      const auto differ = [&](int c, int d) { return (signs >> c ^ signs >> d) & 1; };
      crossed[signs] = {differ(0, 1), differ(2, 3), differ(4, 5), differ(6, 7),
                        differ(0, 2), differ(4, 6), differ(0, 4), differ(2, 6)};
    }
  }

  std::vector<Entry> of_sub_case;
  std::array<Entry, 256> of_signs; ///< for all signs of the corners; if is_ambiguous is set, only that is valid
  std::array<std::vector<std::uint8_t>, 2> slots; ///< three per triangle; in reverse order in slots[1]
  std::array<Crossed_edges, 256> crossed;         ///< for all signs of the corners
};

} // namespace equiaffine::internal

#endif
