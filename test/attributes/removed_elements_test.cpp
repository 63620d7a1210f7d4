// SPDX-License-Identifier: GPL-3.0-or-later
// Every function for meshes takes a CGAL::Surface_mesh with removed elements whose garbage is not collected, and gives
// what it gives for the same mesh without them.
#include "support/Scratch_file.h"
#include "support/formulas.h"
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/attributes/annotate_by_fit.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/fit/move_to_fit.h>
#include <equiaffine/fit/remesh_on_fit.h>
#include <equiaffine/io/polygon_mesh_files.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/register_surfaces.h>
#include <equiaffine/surface/parabolic_curves.h>
#include <equiaffine/volume/signed_distance_volume.h>

#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace removed_elements_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point_3>;
using Vertex = Mesh::Vertex_index;

auto quartic() {
  return test::formula("x^4+2*y^4+3*z^4+x*y*z/2+x^2*y/3-z*y^2/4-1", CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
}

/// A closed mesh of triangles with removed vertices, edges and faces at the beginning and in the middle, and a vertex
/// removed at the end.
Mesh mesh_with_garbage() {
  Mesh mesh = to_surface_mesh(test::surface_of(quartic(), {.resolution = 24}));
  const Vertex last = mesh.add_vertex(Point_3(0, 0, 0)); // it would take the place of a removed one later
  for (const unsigned v : {0u, 3u, 200u}) CGAL::Euler::remove_center_vertex(mesh.halfedge(Vertex(v)), mesh);
  CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
  mesh.remove_vertex(last);
  EXPECT_TRUE(mesh.has_garbage() && CGAL::is_closed(mesh) && mesh.is_valid());
  EXPECT_EQ(mesh.number_of_removed_vertices(), 4u);
  return mesh;
}

/// The same mesh, its elements in the same order, which collect_garbage() does not keep.
Mesh without_garbage(const Mesh& mesh) {
  Mesh result;
  std::map<Vertex, Vertex> copies;
  for (const Vertex v : mesh.vertices()) copies[v] = result.add_vertex(mesh.point(v));
  for (const auto f : mesh.faces()) {
    std::vector<Vertex> corners;
    for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) corners.push_back(copies[v]);
    result.add_face(corners);
  }
  EXPECT_TRUE(!result.has_garbage() && CGAL::is_closed(result));
  return result;
}

std::vector<Point_3> points_of(const Mesh& mesh) {
  std::vector<Point_3> points;
  for (const Vertex v : mesh.vertices()) points.push_back(mesh.point(v));
  return points;
}

/// The numbers that annotations put into a map of the vertices, in their order, as bits: NaN is equal to NaN.
std::vector<std::uint64_t> numbers_of(Mesh& mesh, const std::string& name) {
  const auto map = mesh.add_property_map<Vertex, double>(name, -1).first; // it is there
  std::vector<std::uint64_t> numbers;
  for (const Vertex v : mesh.vertices()) numbers.push_back(std::bit_cast<std::uint64_t>(map[v]));
  return numbers;
}

TEST(Removed_elements, annotations_are_those_of_the_mesh_without_them) {
  Mesh mesh = mesh_with_garbage();
  Mesh without = without_garbage(mesh);
  annotate<CGAL::Parallel_if_available_tag>(mesh, quartic());
  annotate(without, quartic());
  EXPECT_EQ(numbers_of(mesh, "v:affine_mean_curvature"), numbers_of(without, "v:affine_mean_curvature"));
  annotate_by_fit(mesh, {.scale = 0});
  annotate_by_fit(without, {.scale = 0});
  EXPECT_EQ(numbers_of(mesh, "v:affine_gaussian_curvature"), numbers_of(without, "v:affine_gaussian_curvature"));
  EXPECT_EQ(numbers_of(mesh, "v:mean_curvature_error"), numbers_of(without, "v:mean_curvature_error"));
}

TEST(Removed_elements_long, fits_are_those_of_the_mesh_without_them) {
  Mesh mesh = mesh_with_garbage(), without = without_garbage(mesh);
  const auto structures = fitted_structures(mesh, {.scale = 0}), expected = fitted_structures(without, {.scale = 0});
  ASSERT_EQ(structures.size(), expected.size());
  for (std::size_t i = 0; i < structures.size(); ++i)
    EXPECT_EQ(structures[i].structure.euclidean.k1, expected[i].structure.euclidean.k1) << i;
  const Fitted_function_traits_3<Kernel> fit(mesh, {.scale = 0}), fit_without(without, {.scale = 0});
  const Point_3 p = points_of(mesh)[50];
  EXPECT_EQ(fit.value(p), fit_without.value(p));
  EXPECT_EQ(move_to_fit(mesh, fit).number_on_fit(), move_to_fit(without, fit).number_on_fit());
  EXPECT_EQ(points_of(mesh), points_of(without));
  const auto report = remesh_on_fit(mesh, fit);
  EXPECT_TRUE(mesh.is_valid() && CGAL::is_closed(mesh));
  EXPECT_EQ(report.number_of_vertices(), mesh.number_of_vertices());
  EXPECT_GT(double(report.number_on_fit()), 0.99 * mesh.number_of_vertices());
}

TEST(Removed_elements_long, maps_between_meshes_are_those_of_the_meshes_without_them) {
  const Mesh mesh = mesh_with_garbage(), without = without_garbage(mesh);
  const Registration_options rigid = {.kind = Map_kind::RIGID};
  const auto found = register_surfaces(mesh, without, rigid), expected = register_surfaces(without, without, rigid);
  ASSERT_TRUE(found.found() && expected.found());
  EXPECT_NEAR(found.best().rms, expected.best().rms, 1e-9);
  EXPECT_EQ(affine_symmetries(mesh, {.kind = Map_kind::RIGID}).order(),
            affine_symmetries(without, {.kind = Map_kind::RIGID}).order());
}

TEST(Removed_elements, distances_curves_and_files_are_those_of_the_mesh_without_them) {
  const Mesh mesh = mesh_with_garbage(), without = without_garbage(mesh);
  const Lattice_3<Kernel> lattice({9, 9, 9}, CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  const auto distances = signed_distance_volume(mesh, lattice),
             expected_distances = signed_distance_volume(without, lattice);
  for (std::size_t n = 0; n < lattice.number_of_nodes(); ++n)
    EXPECT_NEAR(distances.values[n], expected_distances.values[n], 1e-12) << n;
  const auto curves = parabolic_curves(mesh, quartic()), expected = parabolic_curves(without, quartic());
  ASSERT_EQ(curves.polylines.size(), expected.polylines.size());
  for (std::size_t n = 0; n < curves.polylines.size(); ++n)
    EXPECT_EQ(curves.polylines[n].points, expected.polylines[n].points);
  Mesh read;
  const test::Scratch_file file("removed_elements.ply");
  const std::string path = file.write("");
  IO::write_polygon_mesh(path, mesh);
  IO::read_polygon_mesh(path, read);
  EXPECT_EQ(points_of(read), points_of(without));
  EXPECT_EQ(read.number_of_faces(), without.number_of_faces());
}

TEST(Removed_elements, a_mesh_that_has_them_gets_the_surface_of_a_sampler) {
  const auto surface = test::surface_of(quartic(), {.resolution = 12});
  Mesh mesh = mesh_with_garbage();
  const std::size_t vertices = mesh.number_of_vertices() + surface.points.size();
  const std::size_t faces = mesh.number_of_faces() + surface.triangles.size();
  marching_cubes(quartic(), mesh, {.resolution = 12});
  EXPECT_TRUE(mesh.is_valid() && CGAL::is_closed(mesh));
  EXPECT_EQ(mesh.number_of_faces(), faces);
  EXPECT_EQ(mesh.number_of_vertices(), vertices);
  const auto sampled = delaunay_surface(quartic(), mesh, {.angle = 20, .radius = 0.5, .distance = 0.1});
  EXPECT_TRUE(mesh.is_valid() && CGAL::is_closed(mesh));
  EXPECT_EQ(mesh.number_of_vertices(), vertices + sampled.vertex_status.size());
}

} // namespace removed_elements_test
