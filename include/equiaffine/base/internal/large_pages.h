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

/// Requests large pages for memory that is about to be written for the first time: the first access to each small page
/// costs more than Marching Cubes or a spline needs to compute its contents. If the system ignores the request,
/// programs are slower but correct.
inline void advise_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const auto first = (begin + large_page - 1) / large_page * large_page,
             end = (begin + bytes) / large_page * large_page;
  if (first < end) (void)madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#endif
}

/// Resizes an empty vector to n elements, in large pages if available.
template <class Vector>
void resize_with_large_pages(Vector& vector, std::size_t n) {
  vector.reserve(n);
  advise_large_pages(static_cast<void*>(vector.data()), n * sizeof(vector[0]));
  vector.resize(n);
}

} // namespace equiaffine

#endif
