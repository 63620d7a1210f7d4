// SPDX-License-Identifier: GPL-3.0-or-later
// The `operator new` of this executable: with a limit of the memory, it allocates large arrays in scratch memory.
#include "system/file_memory.h"
#include "system/memory_limit.h"

#include <cstddef>
#include <cstdlib>
#include <new>

void* operator new(std::size_t size) {
  if (equiaffine::belongs_in_scratch_memory(size)) return equiaffine::allocate_scratch_memory(size);
  while (true) {
    if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
    const std::new_handler make_room = std::get_new_handler();
    if (!make_room) throw std::bad_alloc();
    make_room();
  }
}

void operator delete(void* memory) noexcept {
  if (equiaffine::is_scratch_memory(memory)) equiaffine::free_scratch_memory(memory);
  else std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
