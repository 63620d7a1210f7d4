// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/internal/mesh_readers.h>
#include <equiaffine/io/internal/polygons_of_file.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace equiaffine::internal {

Polygons_of_file polygons_of_file(const std::string& path) {
  Polygons_of_file result;
  const Mesh_receiver receiver = {[&](std::size_t points, std::size_t) { result.points.reserve(points); },
                                  [&](double x, double y, double z) { result.points.emplace_back(x, y, z); },
                                  [&](const std::vector<std::uint32_t>& face) { result.polygons.push_back(face); }};
  std::ifstream file = open_input(path);
  if (has_extension(path, ".ply")) result.attributes = read_PLY_elements(file, path, receiver);
  else if (has_extension(path, ".off")) read_OFF_elements(file, path, receiver);
  else fail_to_read(path, "its extension is not known", "use one of .ply .off");
  return result;
}

} // namespace equiaffine::internal
