// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles of every topology that the zero set of a trilinear function has in a cell. They are made from the signs
// at the corners, the decision on every face with a diagonal pair of positive corners, and the pair of boundary curves
// that are joined by a tunnel, if there is one.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_MARCHING_CUBES_CASES_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_MARCHING_CUBES_CASES_H

#include <equiaffine/marching_cubes/internal/cell_polygons.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Corners, edges and faces have the numbers of cell_polygons.h. Bit c of `signs` says that corner c is positive, bit f
/// of `joined` that the positive corners of face f are connected across the face; it counts only where they face each
/// other diagonally.
///
/// The boundary curves cut the surface of the cell into regions, one more than there are curves. Inside the cell at
/// most two regions of the same sign are joined (see trilinear_cell.h); then the two curves between them bound one
/// annulus, else every curve bounds a disc of its own.
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

  /// The faces whose positive corners face each other diagonally, bit f for face f.
  unsigned ambiguous_faces(unsigned signs) const { return ambiguous_faces_[signs]; }

  /// Whether the signs leave a choice. If not, the only sub-case is that of `variant(signs, 0)`.
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

  /// The region of every corner. A region has the smallest number of its corners.
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

  /// Whether a tunnel may join two regions. If so, along every axis there are corners of the two regions on edges that
  /// face each other diagonally.
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

  /// Adds the sub-case with discs in all curves but i and j, which are joined by an annulus if they exist.
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

} // namespace equiaffine::internal

#endif
