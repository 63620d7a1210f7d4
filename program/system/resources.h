// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_RESOURCES_H
#define EQUIAFFINE_PROGRAM_SYSTEM_RESOURCES_H

#include <array>
#include <cstddef>

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

} // namespace equiaffine

#endif
