// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are a soup of polygons in OBJ or STL or refused, whose readers are CGAL's, and of triangles CGAL makes a
// valid mesh. Other faces are left out: CGAL cuts them in a child process, because it may crash there.
#include "source/read_mesh.h"
#include "support/Scratch_file.h"
#include "support/fuzz_target.h"

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>

namespace Polygon_soup_fuzz_test {

EQUIAFFINE_FUZZ_TARGET(triangle_soup) {
  using namespace equiaffine;
  static const test::Scratch_file obj("mesh.obj"), stl("mesh.stl");
  for (const test::Scratch_file* const file : {&obj, &stl}) {
    const std::string path = file->write(input);
    test::accepts([&] {
      const Polygon_soup soup = read_foreign_soup(path);
      if (std::any_of(soup.polygons.begin(), soup.polygons.end(), [](const auto& face) { return face.size() > 3; }))
        return;
      const auto mesh = to_triangle_mesh(soup, path);
      test::expect(mesh.is_valid() && CGAL::is_triangle_mesh(mesh), "a mesh is valid and has triangles only");
    });
  }
}

} // namespace Polygon_soup_fuzz_test
