// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are triangles in OBJ and in STL or refused, and triangles that are read, written as OBJ and read again are
// the same.
#include "support/fuzz_target.h"
#include <equiaffine/io/read_points.h>
#include <equiaffine/io/write_mesh.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace triangle_soup_fuzz_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = Indexed_triangle_mesh_3<Kernel>;

void check_mesh(const Mesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const std::size_t v : triangle) test::expect(v < mesh.points.size(), "triangles have vertices that exist");
  if (mesh.points.empty() || std::any_of(mesh.points.begin(), mesh.points.end(), [](const Kernel::Point_3& p) {
        return !std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z());
      }))
    return;
  std::stringstream stream;
  write_OBJ(stream, mesh);
  const Mesh again = read_OBJ<Kernel>(stream, "written");
  test::expect(again.points == mesh.points && again.triangles == mesh.triangles, "what is written is read again");
}

EQUIAFFINE_FUZZ_TARGET(triangle_soup) {
  for (const char* const extension : {".obj", ".stl"})
    test::accepts([&] {
      std::istringstream stream{std::string(input)};
      check_mesh(read_points<Kernel>(stream, "fuzzed", extension).mesh);
    });
}

} // namespace triangle_soup_fuzz_test
