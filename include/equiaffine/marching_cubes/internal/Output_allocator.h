// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_OUTPUT_ALLOCATOR_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_OUTPUT_ALLOCATOR_H

#include <equiaffine/base/internal/large_pages.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

namespace equiaffine::internal {

/// An allocator for large arrays that are written once, right after they are made: it leaves numbers uninitialized and
/// asks for large pages.
template <class T>
struct Output_allocator {
  using value_type = T;

  Output_allocator() = default;
  template <class U>
  Output_allocator(const Output_allocator<U>&) {}

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T), rounded = (bytes + large_page - 1) / large_page * large_page;
    const bool is_large = bytes >= 2 * large_page;
    void* const memory = is_large ? std::aligned_alloc(large_page, rounded) : std::malloc(bytes);
    if (!memory) throw std::bad_alloc();
    if (is_large) advise_large_pages(memory, rounded);
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
