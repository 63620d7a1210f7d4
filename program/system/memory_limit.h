// SPDX-License-Identifier: GPL-3.0-or-later
// How much memory there is, what is refused because it needs more, and the limit that users set.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_MEMORY_LIMIT_H
#define EQUIAFFINE_PROGRAM_SYSTEM_MEMORY_LIMIT_H

#include <array>
#include <cstddef>
#include <filesystem>
#include <sys/types.h>

namespace equiaffine {

/// The bytes of memory that this computer has, or infinity if it does not tell.
double physical_memory();

/// Says how much of the memory of this computer may be used: half of it, or all if the user agreed to that.
enum class Memory_use { HALF, ALL };

/// Throws `Input_error` if a volume of that many nodes and its spline need more memory than may be used.
void check_memory_of_volume(const std::array<std::size_t, 3>& resolution, Memory_use use);

/// Throws `Input_error` if a Delaunay mesh of a ten-thousandth of the sphere in a cube of the given diagonal, with the
/// given bounds for radius and distance, needs more memory than may be used.
void check_memory_of_delaunay_surface(double diagonal, double radius, double distance, Memory_use use);

/// Throws `Input_error` if the mesh of a surface that crosses the whole grid, as the sphere in a cube does, needs more
/// memory than may be used.
void check_memory_of_surface(const std::array<std::size_t, 3>& resolution, Memory_use use);

/// Bounds the resident memory of this process, together with that of its children, until it ends. Large arrays that do
/// not fit are in scratch memory, in a file in that folder. A thread gives the pages of these and of mapped files back
/// whenever the limit is near; where that is not enough, it ends the process with a sentence. Throws `Input_error` if
/// so few bytes cannot do for any command, or the folder cannot have scratch memory.
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
