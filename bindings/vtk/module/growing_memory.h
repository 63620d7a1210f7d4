// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_GROWING_MEMORY_H
#define EQUIAFFINE_BINDINGS_VTK_GROWING_MEMORY_H

#include <cstddef>

namespace equiaffine {

/// Enlarges memory; null allocates it. On Linux its pages are moved, not copied, and are not shared with other memory.
/// \throw std::bad_alloc
void* resized_memory(void* memory, std::size_t bytes);

/// Frees memory that resized_memory() returned. Does nothing for null.
void free_memory(void* memory);

} // namespace equiaffine

#endif
