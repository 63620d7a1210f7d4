// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_NODE_SIGNS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_NODE_SIGNS_H

#include <equiaffine/base/internal/large_pages.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace equiaffine::internal {

/// The signs of at most 64 numbers. Bit i belongs to number i.
struct Sign_word {
  std::uint64_t positive = 0;  ///< numbers that are at least the isovalue
  std::uint64_t undefined = 0; ///< numbers that are NaN
};

#ifdef __SSE2__
/// Whether each of four numbers is at least the level, 32 bits each.
inline __m128i are_positive(const float* x, float level) {
  return _mm_castps_si128(_mm_cmpge_ps(_mm_loadu_ps(x), _mm_set1_ps(level)));
}
inline __m128i are_positive(const double* x, double level) {
  const auto two = [&](const double* y) { return _mm_castpd_ps(_mm_cmpge_pd(_mm_loadu_pd(y), _mm_set1_pd(level))); };
  return _mm_castps_si128(_mm_shuffle_ps(two(x), two(x + 2), 0x88));
}

/// Bits that are all 0 unless one of eight numbers is NaN.
inline __m128 are_undefined(const float* x) { return _mm_cmpunord_ps(_mm_loadu_ps(x), _mm_loadu_ps(x + 4)); }
inline __m128 are_undefined(const double* x) {
  const auto four = [](const double* y) { return _mm_cmpunord_pd(_mm_loadu_pd(y), _mm_loadu_pd(y + 2)); };
  return _mm_castpd_ps(_mm_or_pd(four(x), four(x + 4)));
}

/// The signs of 16 numbers; sets bits in `undefined` if one of them is NaN.
template <class FT>
std::uint64_t sixteen_signs(const FT* x, FT level, __m128& undefined) {
  undefined = _mm_or_ps(undefined, _mm_or_ps(are_undefined(x), are_undefined(x + 8)));
  const __m128i low = _mm_packs_epi32(are_positive(x, level), are_positive(x + 4, level));
  const __m128i high = _mm_packs_epi32(are_positive(x + 8, level), are_positive(x + 12, level));
  return std::uint64_t(unsigned(_mm_movemask_epi8(_mm_packs_epi16(low, high))));
}

/// The signs of n <= 64 numbers; nothing if one of them is NaN.
template <class FT>
std::optional<Sign_word> sign_word_without_undefined(const FT* values, std::size_t n, FT isovalue) {
  Sign_word word;
  __m128 undefined = _mm_setzero_ps();
  std::size_t i = 0;
  for (; i + 16 <= n; i += 16) word.positive |= sixteen_signs(values + i, isovalue, undefined) << i;
  if (i < n) {
    FT rest[16] = {};
    std::copy(values + i, values + n, rest);
    word.positive |= (sixteen_signs(rest, isovalue, undefined) & ((std::uint64_t(1) << (n - i)) - 1)) << i;
  }
  return _mm_movemask_ps(undefined) == 0 ? std::optional(word) : std::nullopt;
}
#endif

/// The signs of n numbers. \pre n <= 64
template <class FT>
Sign_word sign_word(const FT* values, std::size_t n, const FT& isovalue) {
#ifdef __SSE2__
  if constexpr (std::is_same_v<FT, float> || std::is_same_v<FT, double>)
    if (const auto word = sign_word_without_undefined(values, n, isovalue)) return *word;
#endif
  Sign_word word;
  for (std::size_t i = 0; i < n; ++i) {
    word.positive |= std::uint64_t(values[i] >= isovalue) << i;
    word.undefined |= std::uint64_t(!(values[i] >= isovalue) && !(values[i] < isovalue)) << i;
  }
  return word;
}

/// The indices from `first` up to, but not including, `end`.
struct Index_range {
  std::size_t first = 0, end = 0;
  std::size_t size() const { return end - first; }
};

/// The nodes of a grid in a range along each axis.
using Node_block = std::array<Index_range, 3>;

/// The signs of the nodes of a grid, one bit each, in rows along i that begin with a new word. Bits past the end of a
/// row are 0. Different threads may write planes of different k.
///
/// A node for which `set` was not called must not be a corner of a cell that meets the surface. Its sign is negative
/// unless `set_positive` was called.
class Node_signs {
public:
  using Word = std::uint64_t;
  using Size = std::array<std::size_t, 3>;

  explicit Node_signs(const Size& size)
      : size_(size), words_((size[0] + 63) / 64), masks_((words_ + 63) / 64),
        cells_of_last_word_(within(~Word(0), words_ - 1, size[0] - 1)), evaluated_(masks_ * size[1] * size[2]),
        undefined_(size[2]) {
    resize_with_large_pages(positive_, words_ * size[1] * size[2] + 1);
  }

  const Size& size() const { return size_; }
  std::size_t words() const { return words_; }

  /// The words of a row. The word past its end may be read, but belongs to another row.
  const Word* row(std::size_t j, std::size_t k) const { return &positive_[(k * size_[1] + j) * words_]; }

  /// Sets the signs of the nodes of a row from `first` on. Their bits must all lie in one word.
  void set(std::size_t first, std::size_t j, std::size_t k, const Sign_word& signs) {
    const std::size_t row = k * size_[1] + j, w = first / 64;
    positive_[row * words_ + w] |= signs.positive << first % 64;
    evaluated_[row * masks_ + w / 64] |= Word(1) << w % 64;
    if (signs.undefined != 0) set_undefined(first, j, k, signs.undefined);
  }

  /// Makes all nodes of a block positive.
  void set_positive(const Node_block& block) {
    const auto& [is, js, ks] = block;
    for (std::size_t w = is.first / 64; 64 * w < is.end; ++w) {
      const Word bits = within(~Word(0), w, is.end) & ~within(~Word(0), w, is.first);
      for (std::size_t k = ks.first; k < ks.end; ++k)
        for (std::size_t j = js.first; j < js.end; ++j) positive_[(k * size_[1] + j) * words_ + w] |= bits;
    }
  }

  /// Whether some node has no value.
  bool has_undefined() const {
    return std::any_of(undefined_.begin(), undefined_.end(), [](const auto& plane) { return !plane.empty(); });
  }

  /// Calls visit(w) for the words w of a row in which edges or cells may begin that meet the surface.
  template <class Visit>
  void for_each_word(std::size_t j, std::size_t k, const Visit& visit) const {
    for (std::size_t m = 0; m < masks_; ++m)
      for (Word bits = evaluated_[(k * size_[1] + j) * masks_ + m]; bits != 0; bits &= bits - 1)
        visit(64 * m + std::size_t(std::countr_zero(bits)));
  }

  /// Word w of a row without its bits for nodes from n on.
  static Word within(Word word, std::size_t w, std::size_t n) {
    return 64 * (w + 1) <= n ? word : 64 * w >= n ? 0 : word & ((Word(1) << n % 64) - 1);
  }

  /// Word w of a row without its bits for nodes at which no cell begins.
  Word cells(Word word, std::size_t w) const { return w + 1 == words_ ? word & cells_of_last_word_ : word; }

  /// Bit i of the result is set if the cell (64 w + i, j, k) exists and its eight nodes have values.
  Word defined_cells(std::size_t j, std::size_t k, std::size_t w) const {
    if (j + 1 >= size_[1] || k + 1 >= size_[2] || w >= words_) return 0;
    const auto undefined = [&](std::size_t v) {
      Word word = 0;
      if (v < words_)
        for (std::size_t q = k; q <= k + 1; ++q)
          if (!undefined_[q].empty()) word |= undefined_[q][j * words_ + v] | undefined_[q][(j + 1) * words_ + v];
      return word;
    };
    const Word here = undefined(w);
    return cells(~(here | here >> 1 | undefined(w + 1) << 63), w);
  }

  /// The edges that begin at the nodes of a row.
  template <bool HasUndefined>
  class Edge_row {
  public:
    Edge_row(const Node_signs& signs, std::size_t j, std::size_t k)
        : signs_(signs), j_(j), k_(k), here_(signs.row(j, k)),
          along_j_(j + 1 < signs.size_[1] ? signs.row(j + 1, k) : here_),
          along_k_(k + 1 < signs.size_[2] ? signs.row(j, k + 1) : here_) {}

    /// One word per axis. Bit i is set if the edge at node 64 w + i has ends of different signs and belongs to a cell
    /// all of whose nodes have values.
    std::array<Word, 3> crossed(std::size_t w) const {
      const Word here = here_[w];
      std::array<Word, 3> crossed = {signs_.cells(here ^ (here >> 1 | here_[w + 1] << 63), w), here ^ along_j_[w],
                                     here ^ along_k_[w]};
      if constexpr (HasUndefined)
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (crossed[axis] != 0) crossed[axis] &= signs_.edges_of_defined_cells(axis, j_, k_, w);
      return crossed;
    }

  private:
    const Node_signs& signs_;
    std::size_t j_, k_;
    const Word *here_, *along_j_, *along_k_;
  };

private:
  void set_undefined(std::size_t first, std::size_t j, std::size_t k, Word bits) {
    if (undefined_[k].empty()) undefined_[k].resize(words_ * size_[1]);
    undefined_[k][j * words_ + first / 64] |= bits << first % 64;
  }

  /// Bit i of the result is set if the edge along `axis` at the node (64 w + i, j, k) belongs to such a cell.
  Word edges_of_defined_cells(std::size_t axis, std::size_t j, std::size_t k, std::size_t w) const {
    Word word = 0;
    for (std::size_t b = 0; b < (axis == 1 ? 1U : 2U); ++b)
      for (std::size_t c = 0; c < (axis == 2 ? 1U : 2U); ++c) {
        if (j < b || k < c) continue;
        const Word cells = defined_cells(j - b, k - c, w);
        word |= cells;
        if (axis != 0) word |= cells << 1 | (w > 0 ? defined_cells(j - b, k - c, w - 1) >> 63 : 0);
      }
    return word;
  }

  Size size_;
  std::size_t words_; // per row
  std::size_t masks_; // words of evaluated_ per row
  Word cells_of_last_word_;
  std::vector<Word> positive_;               // with one extra word at the end
  std::vector<Word> evaluated_;              // one bit per word of positive_, set if `set` was called for it
  std::vector<std::vector<Word>> undefined_; // per plane; empty for a plane whose nodes all have values
};

} // namespace equiaffine::internal

#endif
