// SPDX-License-Identifier: GPL-3.0-or-later
// Compares writing a mesh with 16 columns of attributes as binary PLY with CGAL's writer of a Surface_mesh with the
// same property maps, in one process with one thread, to a new file. Runs alternate; figures are medians. Removing the
// file is not timed. Usage: benchmark_files [folder] [runs]
#include "measure.h"
#include <equiaffine/io/write_mesh.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The total time of removing files in seconds, which writing_clock() excludes.
double removing_seconds = 0;

double writing_clock() { return wall_clock() - removing_seconds; }

void remove_untimed(const std::filesystem::path& path) {
  const double begin = wall_clock();
  std::filesystem::remove(path);
  removing_seconds += wall_clock() - begin;
}

constexpr std::uint32_t side = 1000;
constexpr std::size_t columns = 16;

equiaffine::Indexed_triangle_mesh_3<Kernel> wavy_square() {
  equiaffine::Indexed_triangle_mesh_3<Kernel> mesh;
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i) mesh.points.emplace_back(i, j, 10 * std::sin(0.1 * i) * std::cos(0.1 * j));
  for (std::uint32_t j = 0; j + 1 < side; ++j)
    for (std::uint32_t i = 0; i + 1 < side; ++i) {
      const std::uint32_t v = j * side + i;
      mesh.triangles.push_back({v, v + 1, v + side});
      mesh.triangles.push_back({v + 1, v + side + 1, v + side});
    }
  return mesh;
}

equiaffine::Vertex_attributes attributes_of(const equiaffine::Indexed_triangle_mesh_3<Kernel>& mesh) {
  equiaffine::Vertex_attributes attributes;
  for (std::size_t c = 0; c < columns; ++c) {
    attributes.columns.push_back({std::string(1, char('a' + c)), {}});
    for (const auto& p : mesh.points) attributes.columns.back().values.push_back(p.z() + double(c));
  }
  return attributes;
}

Mesh to_CGAL(const equiaffine::Indexed_triangle_mesh_3<Kernel>& mesh, const equiaffine::Vertex_attributes& attributes) {
  Mesh result;
  for (const auto& p : mesh.points) result.add_vertex(p);
  for (const auto& [a, b, c] : mesh.triangles)
    result.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
  for (const auto& column : attributes.columns) {
    auto map = result.add_property_map<Mesh::Vertex_index, double>("v:" + column.name, 0).first;
    for (const auto v : result.vertices()) map[v] = column.values[v];
  }
  return result;
}

} // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".", path = folder / "benchmark_files.ply";
  const int runs = argc > 2 ? std::atoi(argv[2]) : 7;
  const auto mesh = wavy_square();
  const auto attributes = attributes_of(mesh);
  const Mesh of_CGAL = to_CGAL(mesh, attributes);
  double gigabytes = 0;
  const auto to_file = [&](const auto& write) {
    return [&, write] {
      remove_untimed(path);
      std::ofstream file(path, std::ios::binary);
      write(file);
      file.close();
      gigabytes = double(std::filesystem::file_size(path)) / 1e9;
    };
  };
  const auto ours = to_file([&](std::ostream& file) { equiaffine::write_PLY(file, mesh, attributes); });
  const auto theirs = to_file([&](std::ostream& file) {
    CGAL::IO::set_binary_mode(file);
    CGAL::IO::write_PLY(file, of_CGAL);
  });
  const Comparison comparison = compare(writing_clock, runs, theirs, ours);
  ours();
  std::printf("%.2f GB: equiaffine %.3f s, CGAL %.3f s\n", gigabytes, comparison.b, comparison.a);
  std::printf("figure files_ply %.2f GB/s target >=1\n", gigabytes / comparison.b);
  std::printf("figure files_ply_over_cgal %.2f ratio target >=1\n", comparison.ratio);
  std::filesystem::remove(path);
}
