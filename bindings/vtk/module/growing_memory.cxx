// SPDX-License-Identifier: GPL-3.0-or-later
#include "growing_memory.h"

#include <cstdlib>
#include <new>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace equiaffine {

#ifdef __linux__

namespace {

/// Precedes the memory, and keeps it aligned.
union Header {
  std::size_t bytes; ///< including the header
  unsigned char padding[64];
};

} // namespace

void* resized_memory(void* memory, std::size_t bytes) {
  bytes += sizeof(Header);
  Header* const old = memory ? static_cast<Header*>(memory) - 1 : nullptr;
  void* const pages = old ? ::mremap(old, old->bytes, bytes, MREMAP_MAYMOVE)
                          : ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  auto* const header = static_cast<Header*>(pages);
  header->bytes = bytes;
  return header + 1;
}

void free_memory(void* memory) {
  if (!memory) return;
  Header* const header = static_cast<Header*>(memory) - 1;
  ::munmap(header, header->bytes);
}

#else

void* resized_memory(void* memory, std::size_t bytes) {
  void* const resized = std::realloc(memory, bytes > 0 ? bytes : 1);
  if (!resized) throw std::bad_alloc();
  return resized;
}

void free_memory(void* memory) { std::free(memory); }

#endif

} // namespace equiaffine
