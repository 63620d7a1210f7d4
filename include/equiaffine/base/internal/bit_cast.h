// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_BIT_CAST_H
#define EQUIAFFINE_BASE_INTERNAL_BIT_CAST_H

#include <bit>
#include <type_traits>

namespace equiaffine::internal {

/// std::bit_cast, which libc++ has from version 14 on.
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
#ifdef __cpp_lib_bit_cast
  return std::bit_cast<To>(from);
#else
  return __builtin_bit_cast(To, from);
#endif
}

} // namespace equiaffine::internal

#endif
