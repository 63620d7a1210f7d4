// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that lies in a file without a name. Its pages can be given back at any time: what they hold stays in the file,
// or in what the system keeps of it.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_SCRATCH_MEMORY_H
#define EQUIAFFINE_PROGRAM_SYSTEM_SCRATCH_MEMORY_H

#include <cstddef>
#include <filesystem>
#include <new>
#include <string>

namespace equiaffine {

/// From now on there is scratch memory, in a file in that folder. Throws `Input_error` where the folder cannot have
/// such a file, or is in memory itself. Freed memory of up to `spare` bytes is kept for what has the same size.
void open_scratch_memory(const std::filesystem::path& folder, std::size_t spare);

/// A child process calls this first: it takes another file for what it allocates, and what it changes of its parent's
/// memory stays its own. It may allocate nothing until it is allowed. Throws like open_scratch_memory().
void reopen_scratch_memory();

/// Allows a child process so many bytes of scratch memory beside what it has, or what it was allowed if that is more.
void allow_scratch_memory(double bytes);

bool has_scratch_memory();

/// The bytes that the folder of the scratch memory has room for.
double room_for_scratch_memory();

/// The folder has no room for the scratch memory that was to be allocated.
class No_room_for_scratch_memory : public std::bad_alloc {};

/// Says, in a sentence to which other advice may be added, that there was no room for what was to be allocated; is empty
/// if there always was. It is also for those who do not know what others made of the exception.
std::string lack_of_room_for_scratch_memory();

/// Returns memory that need not be zero. Throws `No_room_for_scratch_memory`, or `std::bad_alloc` where that much is
/// not allowed.
void* allocate_scratch_memory(std::size_t size);

/// Whether it was allocated as scratch memory.
bool is_scratch_memory(const void* memory);

void free_scratch_memory(void* memory);

} // namespace equiaffine

#endif
