// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_MEMORY_LIMIT_H
#define EQUIAFFINE_PROGRAM_SYSTEM_MEMORY_LIMIT_H

#include <cstddef>
#include <filesystem>
#include <sys/types.h>

namespace equiaffine {

/// Bounds the resident memory of this process, together with that of its children, until it ends. Large arrays that do
/// not fit are in scratch memory, in a file in that folder. A thread gives the pages of these and of mapped files back
/// whenever the limit is near; where that is not enough, it ends the process with a sentence. Throws `Input_error` if so
/// few bytes cannot do for any command, or the folder cannot have scratch memory.
void limit_resident_memory(std::size_t bytes, const std::filesystem::path& folder);

bool is_resident_memory_limited();

/// Bounds the resident memory of a child process, at its beginning, by what its parent leaves.
void limit_resident_memory_of_child();

/// From now on the memory of this child counts as well, until a call with 0.
void count_memory_of_child(pid_t child);

/// Whether an array of that size is to be in scratch memory.
bool belongs_in_scratch_memory(std::size_t size);

} // namespace equiaffine

#endif
