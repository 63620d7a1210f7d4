// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are a mesh in PLY, OFF, OBJ or STL or refused. What is accepted, CGAL makes a valid mesh of triangles.
#include "source/read_mesh.h"
#include "support/Scratch_file.h"
#include "support/fuzz_target.h"

#include <CGAL/boost/graph/helpers.h>

namespace read_triangle_mesh_fuzz_test {

EQUIAFFINE_FUZZ_TARGET(triangle_mesh) {
  using namespace equiaffine;
  static const test::Scratch_file ply("mesh.ply"), off("mesh.off"), obj("mesh.obj"), stl("mesh.stl");
  const test::Scratch_file& file = input.starts_with("ply")                             ? ply
                                   : input.starts_with("solid")                         ? stl
                                   : input.starts_with("v ") || input.starts_with("# ") ? obj
                                                                                        : off;
  const std::string path = file.write(input);
  test::accepts([&] {
    const auto mesh = read_triangle_mesh(path);
    test::expect(mesh.is_valid() && CGAL::is_triangle_mesh(mesh), "a mesh is valid and has triangles only");
  });
}

} // namespace read_triangle_mesh_fuzz_test
