// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_RECLAIMABLE_MEMORY_H
#define EQUIAFFINE_PROGRAM_SYSTEM_RECLAIMABLE_MEMORY_H

#include <cstddef>

namespace equiaffine {

/// Says that the contents of a range of whole pages lie in a file: the process can give the pages back at any time, and
/// the system brings them again when they are looked at.
void add_reclaimable_memory(const void* first, std::size_t size);

/// Says that the range that begins there is no longer one of them, before it is unmapped.
void remove_reclaimable_memory(const void* first);

/// Gives back the pages of all these ranges, which loses nothing.
void give_back_reclaimable_memory();

/// Begins without any range, in a child process, whose parent had them.
void forget_reclaimable_memory();

} // namespace equiaffine

#endif
