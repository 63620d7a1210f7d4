// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a formula, given as text at run time, to a mesh with attributes (PLY) and to a web page (HTML).
// An error in the formula throws an Input_error that shows its position.
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/display/write_HTML.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/io/write_mesh.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>

#include <cstdio>
#include <fstream>
#include <string>

using Kernel = CGAL::Simple_cartesian<double>;

void convert(const std::string& text) {
  const equiaffine::Expression_3 function(text, {{"c", 11.8}});
  const auto traits = equiaffine::make_analytic_traits<Kernel>(function, CGAL::Bbox_3(-3, -3, -3, 3, 3, 3));

  const auto surface = equiaffine::marching_cubes(traits);
  const auto attributes = equiaffine::compute_attributes(traits, surface.points, equiaffine::select_attributes("basic"),
                                                         surface.vertex_status);
  std::ofstream ply("tanglecube.ply", std::ios::binary);
  equiaffine::write_PLY(ply, surface, attributes);
  std::ofstream html("tanglecube.html", std::ios::binary);
  equiaffine::write_HTML(html, surface, attributes, {.title = "Tanglecube", .color = "affine_mean_curvature"});

  std::printf("%zu vertices, %zu triangles, %zu attribute columns\n", surface.points.size(), surface.triangles.size(),
              attributes.columns.size());
}

int main() {
  for (const std::string text : {"x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 = -c", "x^4 - 5x^2 + y^4"}) {
    try {
      convert(text);
    } catch (const equiaffine::Input_error& error) {
      std::printf("%s\n%s\n", error.what(), error.excerpt().c_str());
    }
  }
}
