// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_LARGE_PAGES_H
#define EQUIAFFINE_BASE_INTERNAL_LARGE_PAGES_H

#include <cstddef>
#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace equiaffine {

inline constexpr std::size_t large_page = std::size_t(1) << 21;

/// Asks for large pages where memory is written for the first time: the first touch of every small page costs more than
/// what Marching Cubes or a spline computes for it. This is advice only: a system that ignores it makes programs
/// slower, not wrong.
inline void advise_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const auto first = (begin + large_page - 1) / large_page * large_page,
             end = (begin + bytes) / large_page * large_page;
  if (first < end) (void)madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#endif
}

/// Gives an empty vector n elements, in large pages where there are some.
template <class Vector>
void resize_with_large_pages(Vector& vector, std::size_t n) {
  vector.reserve(n);
  advise_large_pages(static_cast<void*>(vector.data()), n * sizeof(vector[0]));
  vector.resize(n);
}

} // namespace equiaffine

#endif
