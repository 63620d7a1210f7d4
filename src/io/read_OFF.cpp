// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/Off_scanner.h"
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/internal/mesh_readers.h>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace equiaffine::internal {

void read_OFF_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::string text = read_all(stream);
  Off_scanner scanner(text, name);
  const auto [vertices, faces] = scanner.read_header();
  receiver.reserve(vertices, faces);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto [x, y, z] = scanner.read_vertex();
    receiver.add_point(x, y, z);
  }
  std::vector<std::uint32_t> face;
  for (std::size_t f = 0; f < faces; ++f) {
    scanner.read_face(vertices, face);
    receiver.add_face(face);
  }
}

} // namespace equiaffine::internal
