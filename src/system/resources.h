// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SYSTEM_RESOURCES_H
#define EQUIAFFINE_SRC_SYSTEM_RESOURCES_H

#include <array>
#include <cstddef>

namespace equiaffine {

/// The bytes of memory that this computer has, or infinity if it does not tell.
double physical_memory();

/// Throws `Input_error` if this computer has less memory than a volume of that many nodes and its spline need.
void check_memory_of_volume(const std::array<std::size_t, 3>& resolution);

/// Throws `Input_error` if this computer has less memory than a Delaunay mesh needs of a ten-thousandth of the sphere
/// in a cube of the given diagonal, with the given bounds for radius and distance.
void check_memory_of_delaunay_surface(double diagonal, double radius, double distance);

/// Throws `Input_error` if this computer has less memory than the mesh of a surface needs that crosses the whole grid,
/// as the sphere in a cube does.
void check_memory_of_surface(const std::array<std::size_t, 3>& resolution);

} // namespace equiaffine

#endif
