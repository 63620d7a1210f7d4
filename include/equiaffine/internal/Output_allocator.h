// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_OUTPUT_ALLOCATOR_H
#define EQUIAFFINE_INTERNAL_OUTPUT_ALLOCATOR_H

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace equiaffine::internal {

/// For large arrays that are written once, right after they are made: leaves numbers uninitialised and asks for large
/// pages, since the first touch of every small one costs more than what is computed for it.
template <class T>
struct Output_allocator {
  using value_type = T;

  Output_allocator() = default;
  template <class U>
  Output_allocator(const Output_allocator<U>&) {}

  T* allocate(std::size_t n) {
    constexpr std::size_t page = std::size_t(1) << 21;
    const std::size_t bytes = n * sizeof(T);
    void* memory;
    if (bytes < 2 * page) {
      memory = std::malloc(bytes);
    } else {
      const std::size_t rounded = (bytes + page - 1) / page * page;
      memory = std::aligned_alloc(page, rounded);
#ifdef __linux__
      if (memory) (void)madvise(memory, rounded, MADV_HUGEPAGE); // advice: without it the array is but slower
#endif
    }
    if (!memory) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* p, std::size_t) { std::free(p); }

  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const Output_allocator&, const Output_allocator&) { return true; }
};

} // namespace equiaffine::internal

#endif
