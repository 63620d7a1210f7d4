// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_PLAN_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_PLAN_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>
#include <equiaffine/marching_cubes/internal/marching_cubes_cases.h>
#include <equiaffine/marching_cubes/internal/node_signs.h>

#include <CGAL/MP_Float.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace equiaffine::internal {

// Exact decisions on the topology of the set where the trilinear interpolant f of eight values is positive. A value
// of zero counts as positive everywhere: at a corner, at a saddle on a face, and at a saddle inside. The topology is
// hence that of the set where f is greater than -e for all small e > 0, which is the same perturbation in all cells.

/// Computes signs of homogeneous polynomials in numbers of magnitude up to `scale`, and records whether all were
/// certain. The tolerances are generous bounds of the rounding errors of the expressions in `corners_joined_inside`.
/// With unit roundoff u, and including errors of u in the numbers, these are below 80 u scale^2, 400 u scale^3, and
/// 3000 u scale^4.
template <class FT>
class Filtered_sign {
public:
  explicit Filtered_sign(const FT& scale) {
    constexpr FT u = std::numeric_limits<FT>::epsilon();
    tolerance_ = {FT(128) * u * scale * scale, FT(1024) * u * scale * scale * scale,
                  FT(8192) * u * scale * scale * scale * scale};
  }
  int operator()(const FT& x, std::size_t degree) {
    if (!(std::abs(x) > tolerance_[degree - 2])) is_certain_ = false;
    return x > FT(0) ? 1 : x < FT(0) ? -1 : 0;
  }
  bool is_certain() const { return is_certain_; }

private:
  std::array<FT, 3> tolerance_;
  bool is_certain_ = true;
};

/// Computes signs of exact numbers, with the interface of Filtered_sign.
struct Exact_sign {
  template <class Number>
  int operator()(const Number& x, std::size_t) const {
    return int(CGAL::sign(x));
  }
};

/// Two corners of the same sign, on diagonally opposite vertical edges, that are joined in the horizontal slice where
/// the saddle of f is extremal; nothing if there is no such slice in the cell.
///
/// f is linear on the four vertical edges and bilinear in a slice. The signs at the corners of a slice determine the
/// components of its positive part, except for two diagonal positive corners, which are joined depending on the sign
/// of D(z) = f00 f11 - f10 f01. So regions of the cell's surface are joined inside only if D, a quadratic polynomial
/// A z^2 + B z + C, changes its sign twice between slices where other corners vanish, hence at its extremum
/// z = -B / 2A.
template <class Number, class Sign>
std::optional<std::pair<std::size_t, std::size_t>> corners_joined_inside(const std::array<Number, 8>& f, Sign& sign) {
  const std::array<Number, 4> slope = {f[4] - f[0], f[5] - f[1], f[6] - f[2], f[7] - f[3]};
  const Number A = slope[0] * slope[3] - slope[1] * slope[2];
  const Number B = (f[0] * slope[3] + f[3] * slope[0]) - (f[1] * slope[2] + f[2] * slope[1]);
  const int sign_of_A = sign(A, 2);
  if (sign_of_A == 0 || sign(B, 2) * sign_of_A >= 0) return std::nullopt;
  const Number two_A = A + A;
  if (sign(Number(two_A + B), 2) * sign_of_A <= 0) return std::nullopt;
  std::array<bool, 4> is_positive{};
  for (std::size_t c = 0; c < 4; ++c) is_positive[c] = sign(Number(two_A * f[c] - B * slope[c]), 3) * sign_of_A >= 0;
  if (is_positive[0] != is_positive[3] || is_positive[1] != is_positive[2] || is_positive[0] == is_positive[1])
    return std::nullopt;
  const Number C = f[0] * f[3] - f[1] * f[2];
  const int sign_of_D = sign(Number((two_A + two_A) * C - B * B), 4) * sign_of_A;
  const bool are_positive_joined = is_positive[0] ? sign_of_D >= 0 : sign_of_D <= 0;
  const std::size_t c = is_positive[0] == are_positive_joined ? 0 : 1;
  const auto end = [&](std::size_t column) {
    return (f[column] >= Number(0)) == is_positive[column] ? column : column + 4;
  };
  return std::pair(end(c), end(3 - c));
}

/// Chooses the sub-case of a cell with the values v[c] - isovalue at its corners. Exact for float and double; with
/// other number types as exact as their arithmetic.
template <class FT>
class Trilinear_cell {
  static constexpr bool has_exact_signs =
      std::is_floating_point_v<FT> && std::numeric_limits<FT>::digits <= std::numeric_limits<double>::digits;
  using Number = std::conditional_t<has_exact_signs, double, FT>;
  using Exact = std::conditional_t<has_exact_signs, CGAL::MP_Float, FT>;

public:
  Trilinear_cell(const std::array<FT, 8>& v, const FT& isovalue) : v_(v), isovalue_(isovalue) {
    for (std::size_t c = 0; c < 8; ++c) f_[c] = Number(v_[c]) - Number(isovalue_);
  }

  std::size_t sub_case(unsigned signs) const {
    const auto& cases = Marching_cubes_cases::instance();
    unsigned joined = 0;
    for (unsigned faces = cases.ambiguous_faces(signs); faces != 0; faces &= faces - 1) {
      const int face = std::countr_zero(faces);
      if (are_positive_joined_on(face)) joined |= 1U << face;
    }
    const auto& variant = cases.variant(signs, joined);
    if (!variant.tunnels.empty())
      if (const auto corners = joined_inside()) {
        const auto r = variant.region[corners->first], s = variant.region[corners->second];
        const auto tunnel =
            std::find(variant.tunnels.begin(), variant.tunnels.end(), std::pair(std::min(r, s), std::max(r, s)));
        if (tunnel != variant.tunnels.end())
          return variant.sub_case + 1U + std::size_t(tunnel - variant.tunnels.begin());
      }
    return variant.sub_case;
  }

private:
  /// Whether the positive corners of a face with diagonal signs are joined on it. The corners are taken in ascending
  /// order, so that both cells at the face compute the same.
  bool are_positive_joined_on(int face) const {
    static constexpr std::uint8_t corners[6][4] = {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 1, 4, 5},
                                                   {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
    const auto& c = corners[face];
    const Number p = f_[c[0]] * f_[c[3]], q = f_[c[1]] * f_[c[2]];
    const bool is_first_positive = v_[c[0]] >= isovalue_;
    if constexpr (has_exact_signs) {
      // The relative bound covers 9 roundings; the absolute one excludes harmful underflow.
      constexpr double relative = 1e-15, absolute = 1e-290;
      const double difference = p - q;
      if (!(std::abs(difference) > relative * (std::abs(p) + std::abs(q)) + absolute) ||
          std::abs(difference) > std::numeric_limits<double>::max()) {
        const Exact D = exact(c[0]) * exact(c[3]) - exact(c[1]) * exact(c[2]);
        return is_first_positive ? D >= 0 : D <= 0;
      }
    }
    return is_first_positive ? p >= q : p <= q;
  }

  /// Two corners joined by a tunnel, as in `corners_joined_inside`.
  std::optional<std::pair<std::size_t, std::size_t>> joined_inside() const {
    if constexpr (has_exact_signs) {
      double scale = 0;
      for (const double x : f_) scale = std::max(scale, std::abs(x));
      if (scale > 1e-60 && scale < 1e60) { // no product overflows, and none underflows harmfully
        Filtered_sign<double> sign(scale);
        const auto result = corners_joined_inside(f_, sign);
        if (sign.is_certain()) return result;
      }
    }
    std::array<Exact, 8> f;
    for (std::size_t c = 0; c < 8; ++c) f[c] = exact(c);
    Exact_sign sign;
    return corners_joined_inside(f, sign);
  }

  /// The difference of a value and the isovalue; infinite values are clamped to the largest finite number.
  Exact exact(std::size_t c) const {
    if constexpr (has_exact_signs) {
      constexpr FT lowest = std::numeric_limits<FT>::lowest(), largest = std::numeric_limits<FT>::max();
      return Exact(double(std::clamp(v_[c], lowest, largest))) - Exact(double(isovalue_));
    } else {
      return f_[c];
    }
  }

  std::array<FT, 8> v_;
  FT isovalue_;
  std::array<Number, 8> f_{};
};

/// Transposes eight words: bit c of column i is bit i of word c.
class Bit_columns {
public:
  using Word = Node_signs::Word;

#ifdef __SSE2__
  explicit Bit_columns(const std::array<Word, 8>& words) {
    const auto load = [&](std::size_t c) { return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&words[c])); };
    const __m128i ab = _mm_unpacklo_epi8(load(0), load(1)), cd = _mm_unpacklo_epi8(load(2), load(3)),
                  ef = _mm_unpacklo_epi8(load(4), load(5)), gh = _mm_unpacklo_epi8(load(6), load(7));
    const auto join = [&](std::size_t n, const __m128i& abcd, const __m128i& efgh) {
      _mm_store_si128(&bytes_[n], _mm_unpacklo_epi32(abcd, efgh));
      _mm_store_si128(&bytes_[n + 1], _mm_unpackhi_epi32(abcd, efgh));
    };
    join(0, _mm_unpacklo_epi16(ab, cd), _mm_unpacklo_epi16(ef, gh));
    join(2, _mm_unpackhi_epi16(ab, cd), _mm_unpackhi_epi16(ef, gh));
  }

  unsigned operator[](unsigned i) const {
    const auto* const at = reinterpret_cast<const unsigned char*>(bytes_) + i / 8 * 8;
    const __m128i byte = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(at));
    return unsigned(_mm_movemask_epi8(_mm_sll_epi64(byte, _mm_cvtsi32_si128(int(7 - i % 8)))));
  }

private:
  __m128i bytes_[4]; // byte 8 n + c is byte n of word c
#else
  explicit Bit_columns(const std::array<Word, 8>& words) : words_(words) {}

  unsigned operator[](unsigned i) const {
    unsigned column = 0;
    for (unsigned c = 0; c < 8; ++c) column |= unsigned(words_[c] >> i & 1) << c;
    return column;
  }

private:
  std::array<Word, 8> words_;
#endif
};

/// Calls visit(i, signs) for every cell (i, j, k) of a row that the surface meets, with the signs at its corners.
template <bool HasUndefined, class Visit>
void for_each_active_cell(const Node_signs& signs, std::size_t j, std::size_t k, const Visit& visit) {
  using Word = Node_signs::Word;
  const Word* const rows[4] = {signs.row(j, k), signs.row(j + 1, k), signs.row(j, k + 1), signs.row(j + 1, k + 1)};
  const auto differ = [&](std::size_t w) { // the nodes at which the four rows have different signs
    return (rows[0][w] ^ rows[1][w]) | (rows[0][w] ^ rows[2][w]) | (rows[0][w] ^ rows[3][w]);
  };
  // Bit i of a shifted word belongs to node i + 1.
  const auto shifted = [&](std::size_t r, std::size_t w) { return rows[r][w] >> 1 | rows[r][w + 1] << 63; };
  signs.for_each_word(j, k, [&](std::size_t w) {
    const Word differ_here = differ(w);
    Word active = signs.cells(differ_here | differ_here >> 1 | differ(w + 1) << 63 | (rows[0][w] ^ shifted(0, w)), w);
    if (active == 0) return;
    if constexpr (HasUndefined) active &= signs.defined_cells(j, k, w);
    const Bit_columns corners(
        {rows[0][w], shifted(0, w), rows[1][w], shifted(1, w), rows[2][w], shifted(2, w), rows[3][w], shifted(3, w)});
    for (; active != 0; active &= active - 1) {
      const unsigned bit = unsigned(std::countr_zero(active));
      visit(64 * w + bit, corners[bit]);
    }
  });
}

/// What determines the vertices and triangles of an isosurface: their indices, so that planes of nodes and layers of
/// cells can be processed in any order, and the sub-cases of cells with ambiguous signs, 2 bytes each.
struct Isosurface_plan {
  const Node_signs& signs;
  const Case_table& table;
  bool has_undefined; ///< whether a node has no value
  Isosurface_numbering numbering;
  std::vector<std::vector<std::uint16_t>> sub_cases; ///< for each layer, one per ambiguous cell in the order of cells

  std::size_t number_of_ambiguous_cells() const {
    std::size_t sum = 0;
    for (const auto& layer : sub_cases) sum += layer.size();
    return sum;
  }
};

/// The number of crossed edges along each axis that begin in a row of nodes.
template <bool HasUndefined>
std::array<Isosurface_numbering::Index, 3> count_crossed_edges(const Node_signs& signs, std::size_t j, std::size_t k) {
  std::array<Isosurface_numbering::Index, 3> counts{};
  const Node_signs::Edge_row<HasUndefined> edges(signs, j, k);
  signs.for_each_word(j, k, [&](std::size_t w) {
    const auto crossed = edges.crossed(w);
    if ((crossed[0] | crossed[1] | crossed[2]) == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
      counts[axis] += Isosurface_numbering::Index(std::popcount(crossed[axis]));
  });
  return counts;
}

/// Counts the vertices and triangles of a layer of cells and of the plane of nodes at its lower end. The sub-case of an
/// ambiguous cell is `choose(i, j, k, signs)`.
template <bool HasUndefined, class Choose>
void plan_layer(Isosurface_plan& plan, std::size_t k, const Choose& choose) {
  const Case_table& table = plan.table;
  const Node_signs& signs = plan.signs;
  auto& sub_cases = plan.sub_cases[k];
  auto& layer = plan.numbering.layer(k);
  for (std::size_t j = 0; j < signs.size()[1]; ++j) {
    Isosurface_numbering::Row counts;
    counts.first = count_crossed_edges<HasUndefined>(signs, j, k);
    if (j + 1 < signs.size()[1] && k + 1 < signs.size()[2])
      for_each_active_cell<HasUndefined>(signs, j, k, [&](std::size_t i, unsigned corner_signs) {
        const Case_table::Entry* entry = &table.of_signs[corner_signs];
        if (entry->is_ambiguous) {
          sub_cases.push_back(std::uint16_t(choose(i, j, k, corner_signs)));
          entry = &table.of_sub_case[sub_cases.back()];
          layer.inner_vertices += entry->inner_vertices;
        }
        counts.triangles += entry->triangles;
      });
    plan.numbering.row(j, k) = counts;
  }
}

/// Computes the plan of the surface in a grid. The trilinear interpolant decides in ambiguous cells. The plan keeps
/// references to the signs and the table.
template <class ConcurrencyTag, class Grid>
Isosurface_plan plan_isosurface(const Node_signs& signs, const Grid& grid, const Case_table& table) {
  const auto choose = [&](std::size_t i, std::size_t j, std::size_t k, unsigned corner_signs) {
    return Trilinear_cell<typename Grid::FT>(grid.cell_values({i, j, k}), grid.isovalue()).sub_case(corner_signs);
  };
  const std::size_t planes = signs.size()[2];
  Isosurface_plan plan{signs, table, signs.has_undefined(), Isosurface_numbering(signs), {}};
  plan.sub_cases.resize(planes);
  parallel_for<ConcurrencyTag>(0, planes, [&](std::size_t k) {
    plan.has_undefined ? plan_layer<true>(plan, k, choose) : plan_layer<false>(plan, k, choose);
  });
  plan.numbering.turn_counts_into_numbers();
  return plan;
}

} // namespace equiaffine::internal

#endif
