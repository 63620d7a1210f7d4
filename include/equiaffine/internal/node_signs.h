// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_NODE_SIGNS_H
#define EQUIAFFINE_INTERNAL_NODE_SIGNS_H

#include <equiaffine/internal/sign_word.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// The signs of the nodes of a grid, one bit each, in rows along i that begin with a new word; bits behind the end of a
/// row are 0. Planes of constant k may be written by different threads.
class Node_signs {
public:
  using Word = std::uint64_t;
  using Size = std::array<std::size_t, 3>;

  explicit Node_signs(const Size& size)
      : size_(size), words_((size[0] + 63) / 64), positive_(words_ * size[1] * size[2]), undefined_(size[2]) {}

  const Size& size() const { return size_; }
  std::size_t words() const { return words_; }

  const Word* row(std::size_t j, std::size_t k) const { return &positive_[(k * size_[1] + j) * words_]; }

  /// Sets the bits of a row from `first` on; all must lie in one word.
  void set(std::size_t first, std::size_t j, std::size_t k, const Sign_word& signs) {
    positive_[(k * size_[1] + j) * words_ + first / 64] |= signs.positive << first % 64;
    if (signs.undefined != 0) set_undefined(first, j, k, signs.undefined);
  }

  /// Whether some node of some plane has no value.
  bool has_undefined() const {
    return std::any_of(undefined_.begin(), undefined_.end(), [](const auto& plane) { return !plane.empty(); });
  }

  /// The word without its bits behind the end of a row of n.
  static Word within(Word word, std::size_t w, std::size_t n) {
    return 64 * (w + 1) <= n ? word : 64 * w >= n ? 0 : word & ((Word(1) << n % 64) - 1);
  }

  /// Bit i: the cell (i, j, k) exists and its eight nodes have values.
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
    return within(~(here | here >> 1 | undefined(w + 1) << 63), w, size_[0] - 1);
  }

  /// For the edges along each axis: bit i says that the one that begins at node (i, j, k) has ends of different signs
  /// and a cell all of whose nodes have values.
  template <bool HasUndefined>
  std::array<Word, 3> crossed_edges(std::size_t j, std::size_t k, std::size_t w) const {
    const Word* const word = row(j, k) + w;
    const Word next = *word >> 1 | (w + 1 < words_ ? word[1] << 63 : 0);
    std::array<Word, 3> crossed = {within(*word ^ next, w, size_[0] - 1), j + 1 < size_[1] ? *word ^ word[words_] : 0,
                                   k + 1 < size_[2] ? *word ^ word[words_ * size_[1]] : 0};
    if constexpr (HasUndefined)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (crossed[axis] != 0) crossed[axis] &= edges_of_defined_cells(axis, j, k, w);
    return crossed;
  }

private:
  void set_undefined(std::size_t first, std::size_t j, std::size_t k, Word bits) {
    if (undefined_[k].empty()) undefined_[k].resize(words_ * size_[1]);
    undefined_[k][j * words_ + first / 64] |= bits << first % 64;
  }

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
  std::size_t words_;
  std::vector<Word> positive_;
  std::vector<std::vector<Word>> undefined_; // per plane; empty: every node has a value
};

} // namespace equiaffine::internal

#endif
