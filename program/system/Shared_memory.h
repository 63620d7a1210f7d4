// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_SHARED_MEMORY_H
#define EQUIAFFINE_PROGRAM_SYSTEM_SHARED_MEMORY_H

#include <cstddef>

namespace equiaffine {

/// Bytes that a process shares with the children that it makes afterwards: what a child writes, its parent reads.
/// Memory is taken only for what is written. Every member throws `std::bad_alloc` if the system has none left.
class Shared_memory {
public:
  Shared_memory();
  ~Shared_memory();
  Shared_memory(const Shared_memory&) = delete;
  Shared_memory& operator=(const Shared_memory&) = delete;

  /// Makes room for this many bytes, which are zero at first, and returns the first of them. Throws `Input_error` where
  /// the limit of the size of files forbids that, since the system takes these bytes for a file.
  std::byte* allocate(std::size_t size);

  /// The bytes that this process or a child of it made room for; null if there are none.
  const std::byte* data();

private:
  void map(std::size_t size);

  int descriptor_;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace equiaffine

#endif
