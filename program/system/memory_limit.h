// SPDX-License-Identifier: GPL-3.0-or-later
// The available memory, checks before large computations, and the limit that users set.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_MEMORY_LIMIT_H
#define EQUIAFFINE_PROGRAM_SYSTEM_MEMORY_LIMIT_H

#include <array>
#include <cstddef>
#include <filesystem>
#include <sys/types.h>

namespace equiaffine {

/// The bytes of memory of this computer, or infinity if unknown.
double physical_memory();

/// How much of the memory of this computer may be used: half, or all if the user agreed.
enum class Memory_use { HALF, ALL };

/// Throws `Input_error` if a volume of `resolution` nodes and its spline need more memory than allowed.
void check_memory_of_volume(const std::array<std::size_t, 3>& resolution, Memory_use use);

/// Throws `Input_error` if a Delaunay mesh with these bounds of radius and distance needs more memory than allowed for
/// 1/10000 of the sphere in a cube of this diagonal.
void check_memory_of_delaunay_surface(double diagonal, double radius, double distance, Memory_use use);

/// Throws `Input_error` if the mesh of a surface that crosses the whole grid, such as the sphere in a cube, needs more
/// memory than allowed.
void check_memory_of_surface(const std::array<std::size_t, 3>& resolution, Memory_use use);

/// Limits the resident memory of this process and its children. Large arrays that do not fit go to scratch memory, a
/// file in the folder. A thread releases the pages of scratch memory and mapped files near the limit; if that is not
/// enough, it ends the process with an error message. Throws `Input_error` if the limit is too low for any command, or
/// the folder does not support scratch memory.
void limit_resident_memory(std::size_t bytes, const std::filesystem::path& folder);

bool is_resident_memory_limited();

/// Limits the resident memory of a child process, at its start, to what its parent leaves.
void limit_resident_memory_of_child();

/// Includes the memory of this child in the limit, until a call with 0.
void count_memory_of_child(pid_t child);

/// Whether to allocate an array of this size in scratch memory.
bool belongs_in_scratch_memory(std::size_t size);

} // namespace equiaffine

#endif
