// SPDX-License-Identifier: GPL-3.0-or-later
// C++ users get from the library what the program makes of a fit.
#include "support/tori.h"
#include "support/written_meshes.h"
#include <equiaffine/attributes/remesh_by_fit.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/io/read_points.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fits_of_library_test {

using namespace equiaffine::test;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Triangles = equiaffine::Indexed_triangle_mesh_3<Kernel>;

class Program_and_library : public Written_meshes_test {
protected:
  void SetUp() override {
    run_well({"mesh", "--function", "(sqrt(x^2+y^2)-1)^2+z^2-.16", "--box", "-1.5", "1.5", "-1.5", "1.5", "-.5", ".5",
              "--resolution", "20", "--attributes", "none", "-o", "torus.ply"});
    torus = mesh("torus.ply").mesh;
  }

  /// The mesh that the program writes. It may warn that curvatures are unknown.
  Mesh written_by(const Arguments& arguments) const {
    const Result result = run(arguments + Arguments{"-o", "program.ply"});
    EXPECT_EQ(result.status, 0) << result.error;
    return mesh("program.ply");
  }

  Triangles torus;
};
using Program_and_library_long = Program_and_library;

Surface surface_of(const Triangles& mesh) {
  std::vector<std::vector<std::size_t>> polygons;
  for (const auto& [a, b, c] : mesh.triangles) polygons.push_back({std::size_t(a), std::size_t(b), std::size_t(c)});
  Surface surface;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(mesh.points, polygons, surface);
  return surface;
}

/// Expects vertices and faces in the order of a file.
void expect_same(const Surface& surface, const Triangles& mesh) {
  ASSERT_EQ(surface.number_of_vertices(), mesh.points.size());
  ASSERT_EQ(surface.number_of_faces(), mesh.triangles.size());
  std::size_t i = 0;
  for (const auto v : surface.vertices()) EXPECT_EQ(surface.point(v), mesh.points[i++]);
  std::size_t t = 0;
  for (const auto f : surface.faces()) {
    const auto h = surface.halfedge(f);
    const std::array<std::uint32_t, 3> corners = {surface.source(h), surface.target(h),
                                                  surface.target(surface.next(h))};
    EXPECT_EQ(corners, mesh.triangles[t++]);
  }
}

TEST_F(Program_and_library, remesh_alike) {
  const Mesh expected = written_by({"mesh", "--fit", "torus.ply", "--attributes", "none"});
  Surface surface = surface_of(torus);
  const auto result = equiaffine::remesh_by_fit<CGAL::Parallel_if_available_tag>(surface);
  expect_same(surface, expected.mesh);
  EXPECT_EQ(result.report.number_of_vertices(), surface.number_of_vertices());
}

TEST_F(Program_and_library, remesh_alike_with_options) {
  const Mesh expected = written_by({"mesh", "--fit", "torus.ply", "--scale", ".4", "--edge-length", ".2",
                                    "--feature-angle", "180", "--attributes", "none"});
  Surface surface = surface_of(torus);
  const auto result = equiaffine::remesh_by_fit(surface, {.scale = .4, .feature_angle = 180},
                                                {.edge_length = .2, .feature_angle = 180});
  expect_same(surface, expected.mesh);
  EXPECT_EQ(result.fit.scale(), .4);
}

TEST_F(Program_and_library_long, choose_the_same_smaller_scale) {
  write_file(folder_ / "tori.off", tori());
  Surface surface = surface_of(equiaffine::read_points<Kernel>((folder_ / "tori.off").string()).mesh);
  const Mesh expected = written_by({"mesh", "--fit", "tori.off", "--attributes", "none"});
  const auto result = equiaffine::remesh_by_fit<CGAL::Parallel_if_available_tag>(surface);
  expect_same(surface, expected.mesh);
  EXPECT_LT(result.fit.scale().value(), .8);
}

TEST_F(Program_and_library, annotate_alike) {
  const Mesh expected = written_by({"annotate", "torus.ply"});
  const auto structures = equiaffine::fitted_structures<CGAL::Parallel_if_available_tag>(torus.points, torus.triangles);
  const auto K = column(expected, "affine_gaussian_curvature"), H = column(expected, "affine_mean_curvature"),
             error = column(expected, "affine_gaussian_curvature_error");
  ASSERT_EQ(structures.size(), K.size());
  for (std::size_t i = 0; i < K.size(); ++i) {
    if (structures[i].structure.status != equiaffine::Point_status::REGULAR) continue;
    EXPECT_EQ(structures[i].structure.affine.gaussian_curvature, K[i]) << i;
    EXPECT_EQ(structures[i].structure.affine.mean_curvature, H[i]) << i;
    EXPECT_EQ(structures[i].error.affine_gaussian_curvature, error[i]) << i;
  }
}

} // namespace fits_of_library_test
