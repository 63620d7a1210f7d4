// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ACTIVE_CELLS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ACTIVE_CELLS_H

#include <equiaffine/marching_cubes/internal/node_signs.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace equiaffine::internal {

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

} // namespace equiaffine::internal

#endif
