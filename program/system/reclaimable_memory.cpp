// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/reclaimable_memory.h"

#include <map>
#include <mutex>
#include <sys/mman.h>

namespace equiaffine {

namespace {

struct Ranges {
  std::mutex mutex;
  std::map<const void*, std::size_t> size_of;
};

/// They are never destroyed, since a thread may look at them until the process ends.
Ranges*& ranges() {
  static Ranges* ranges = new Ranges;
  return ranges;
}

/// Has the pages come back one by one: in large ones they would come faster than they can be given back.
void forgo_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t size) {
#ifdef __linux__
  ::madvise(memory, size, MADV_NOHUGEPAGE);
#endif
}

} // namespace

void add_reclaimable_memory(const void* first, std::size_t size) {
  const std::lock_guard guard(ranges()->mutex);
  ranges()->size_of[first] = size;
}

void remove_reclaimable_memory(const void* first) {
  const std::lock_guard guard(ranges()->mutex);
  ranges()->size_of.erase(first);
}

void give_back_reclaimable_memory() {
  const std::lock_guard guard(ranges()->mutex);
  for (const auto& [first, size] : ranges()->size_of) {
    void* const memory = const_cast<void*>(first);
    ::madvise(memory, size, MADV_DONTNEED);
    forgo_large_pages(memory, size);
  }
}

void forget_reclaimable_memory() { ranges() = new Ranges; }

} // namespace equiaffine
