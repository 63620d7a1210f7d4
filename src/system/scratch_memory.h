// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that lies in a file without a name. Its pages can be given back at any time: what they hold stays in the file,
// or in what the system keeps of it.
#ifndef EQUIAFFINE_SRC_SYSTEM_SCRATCH_MEMORY_H
#define EQUIAFFINE_SRC_SYSTEM_SCRATCH_MEMORY_H

#include <cstddef>
#include <filesystem>

namespace equiaffine {

/// From now on there is scratch memory, in a file in that folder. Throws `Input_error` where the folder cannot have
/// such a file, or is in memory itself. Freed memory of up to `spare` bytes is kept for what has the same size.
void open_scratch_memory(const std::filesystem::path& folder, std::size_t spare);

/// A child process calls this first: it takes another file for what it allocates, and leaves its parent's alone.
void reopen_scratch_memory();

bool has_scratch_memory();

/// The bytes that the folder of the scratch memory has room for.
double room_for_scratch_memory();

/// Returns memory that need not be zero. Throws `std::bad_alloc` if the folder has no room left.
void* allocate_scratch_memory(std::size_t size);

/// Whether it was allocated as scratch memory.
bool is_scratch_memory(const void* memory);

void free_scratch_memory(void* memory);

/// The folder, if it had no room for what was to be allocated; else empty.
std::filesystem::path folder_without_room();

} // namespace equiaffine

#endif
