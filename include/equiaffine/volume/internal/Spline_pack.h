// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_PACK_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_PACK_H

#include <cstddef>
#include <cstring>

namespace equiaffine::internal {

/// A pack has as many numbers as one register of the target holds, by the vector extension that g++ and clang share.
template <class FT>
struct Spline_pack {
#if defined(__AVX512F__)
  static constexpr int bytes = 64;
#elif defined(__AVX__)
  static constexpr int bytes = 32;
#else
  static constexpr int bytes = 16;
#endif
  static constexpr int lanes = bytes / int(sizeof(FT));
  typedef FT type __attribute__((vector_size(bytes)));

  static type load(const FT* from) {
    type pack;
    std::memcpy(&pack, from, sizeof pack);
    return pack;
  }
  static void store(const type& pack, FT* to) { std::memcpy(to, &pack, sizeof pack); }

  /// The least multiple of `lanes` that is >= n.
  static constexpr int round_up(int n) { return (n + lanes - 1) / lanes * lanes; }
};

/// The number of entries beyond the last coefficient that an evaluation may read, whose values have no influence. It is
/// the size of the largest pack of any target.
inline constexpr std::size_t overread = 16;

} // namespace equiaffine::internal

#endif
