// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/Part_writer.h"

#include "output/Vtp_writer.h"
#include "system/file_format.h"
#include <equiaffine/io/internal/Csv_writer.h>
#include <equiaffine/io/internal/Ply_writer.h>
#include <equiaffine/io/write_mesh.h>

namespace equiaffine {

namespace {

bool is_VTP_file(const std::string& path) { return file_format(path) == File_format::VTP; }

class Ply_parts : public Part_writer {
public:
  Ply_parts(std::ostream& stream, std::size_t vertices, std::size_t faces, const Vertex_attributes& layout)
      : writer_(stream, vertices, faces, layout) {}
  void write_vertices(std::span<const Kernel::Point_3> points, const Vertex_attributes& attributes) override {
    writer_.write_vertices(points, attributes);
  }
  void write_faces(const std::vector<std::array<std::uint32_t, 3>>& faces) override {
    writer_.write_faces(faces);
    writer_.flush();
  }

private:
  Ply_writer writer_;
};

class Csv_parts : public Part_writer {
public:
  Csv_parts(std::ostream& stream, const Vertex_attributes& layout) : writer_(stream, layout) {}
  void write_vertices(std::span<const Kernel::Point_3> points, const Vertex_attributes& attributes) override {
    writer_.write_points(points, attributes);
  }
  void write_faces(const std::vector<std::array<std::uint32_t, 3>>&) override {} // the format has none

private:
  Csv_writer writer_;
};

} // namespace

bool is_written_in_parts(const std::string& path) {
  const auto format = mesh_format(path);
  return format == Mesh_format::PLY || format == Mesh_format::CSV || is_VTP_file(path);
}

std::unique_ptr<Part_writer> part_writer(const std::string& path, std::ostream& stream, std::size_t vertices,
                                         std::size_t faces, const Vertex_attributes& layout) {
  if (is_VTP_file(path)) return std::make_unique<Vtp_writer>(stream, vertices, faces, layout);
  if (mesh_format(path) == Mesh_format::CSV) return std::make_unique<Csv_parts>(stream, layout);
  return std::make_unique<Ply_parts>(stream, vertices, faces, layout);
}

} // namespace equiaffine
