// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BINDINGS_VTK_GROWING_MEMORY_H
#define EQUIAFFINE_BINDINGS_VTK_GROWING_MEMORY_H

#include <cstddef>

namespace equiaffine {

/// Makes memory larger, which is null at first. On Linux its pages are moved, not copied, and do not mix with other
/// memory.
/// \throw std::bad_alloc
void* resized_memory(void* memory, std::size_t bytes);

/// Frees what resized_memory() has returned, or nothing for null.
void free_memory(void* memory);

} // namespace equiaffine

#endif
