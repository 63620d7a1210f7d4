// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/resources.h"

#include "system/memory_limit.h"
#include "system/scratch_memory.h"
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <unistd.h>

namespace equiaffine {

namespace {

std::string gigabytes(double bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g GB", bytes / 1e9);
  return text.data();
}

/// Throws if more memory is needed than may be used. `reason` is what needs it, and `purpose` what it is for.
void check_memory(double needed, Memory_use use, const std::string& reason, const std::string& purpose,
                  const std::string& advice) {
  if (is_resident_memory_limited()) {
    const double room = room_for_scratch_memory();
    if (needed <= room) return;
    throw Input_error(reason + " need about " + gigabytes(needed) + " for " + purpose +
                      ", and the folder of the output has room for " + gigabytes(room) + "; " + advice +
                      ", or make room there");
  }
  const double all = physical_memory();
  if (needed <= (use == Memory_use::ALL ? all : all / 2)) return;
  const std::string need = reason + " need about " + gigabytes(needed) + " of memory for " + purpose + ", and ";
  if (needed > all) throw Input_error(need + "this computer has " + gigabytes(all) + "; " + advice);
  throw Input_error(need + "that is over half of the " + gigabytes(all) + " of this computer; " + advice +
                    ", or give --yes to use them all the same");
}

void check_memory(double needed, Memory_use use, const std::array<std::size_t, 3>& n, const std::string& purpose) {
  check_memory(needed, use,
               "--resolution: " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]) +
                   " nodes",
               purpose, "use a smaller one");
}

} // namespace

double physical_memory() {
  const double pages = double(::sysconf(_SC_PHYS_PAGES)), page_size = double(::sysconf(_SC_PAGE_SIZE));
  return pages > 0 && page_size > 0 ? pages * page_size : std::numeric_limits<double>::infinity();
}

void check_memory_of_volume(const std::array<std::size_t, 3>& resolution, Memory_use use) {
  constexpr double bytes_per_node = 16; // sample and coefficient
  double nodes = 1;
  for (const std::size_t n : resolution) nodes *= double(n);
  check_memory(bytes_per_node * nodes, use, resolution, "the samples");
}

void check_memory_of_surface(const std::array<std::size_t, 3>& resolution, Memory_use use) {
  // The sphere in a cube of n^3 nodes has 3 pi / 2 n^2 vertices: each axis sees two discs of diameter n. A vertex has
  // coordinates (24 bytes), its grid edge (40), two triangles (24) and the basic attributes (129).
  constexpr double vertices_per_node = 3.14159265 / 2, bytes_per_vertex = 217, bytes_per_node = 42;
  const auto [nx, ny, nz] = resolution;
  const double sides = double(nx) * double(ny) + double(ny) * double(nz) + double(nz) * double(nx);
  check_memory(vertices_per_node * bytes_per_vertex * sides + bytes_per_node * double(nx) * double(ny), use, resolution,
               "the surface");
}

void check_memory_of_delaunay_surface(double diagonal, double radius, double distance, Memory_use use) {
  // A ball of radius r about a point of the sphere of diameter d rises r^2 / d above the plane of its triangle. A
  // square of side r has 2/3 vertices, each with 7 tetrahedra of the triangulation, 2 triangles and its attributes.
  // The surface may be much smaller than the sphere: what is refused cannot have been meant.
  constexpr double vertices_per_square = 2.0 / 3, bytes_per_vertex = 1500, part_of_sphere = 1e-4;
  const double diameter = diagonal / std::sqrt(3.0), area = std::numbers::pi * diameter * diameter;
  const double squared_radius = std::min(radius * radius, distance * diameter);
  std::ostringstream reason;
  reason << "--radius and --distance: triangles within " << radius << " and " << distance;
  check_memory(part_of_sphere * bytes_per_vertex * vertices_per_square * area / squared_radius, use, reason.str(),
               "a ten-thousandth of the sphere in the box", "use larger ones");
}

} // namespace equiaffine
