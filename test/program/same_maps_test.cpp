// SPDX-License-Identifier: GPL-3.0-or-later
// The library gives the maps of the program, bit for bit.
#include "support/written_meshes.h"
#include <equiaffine/io/read_points.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/register_surfaces.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/tags.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace same_maps_test {

using equiaffine::affine_symmetries;
using equiaffine::Affine_symmetries_3;
using equiaffine::Map_kind;
using equiaffine::register_surfaces;
using equiaffine::Surface_registration_3;
using equiaffine::test::Arguments;
using equiaffine::test::operator+;
using equiaffine::test::write_file;
using Json = nlohmann::json;
using Kernel = CGAL::Simple_cartesian<double>;
using Tag = CGAL::Parallel_if_available_tag;

const Arguments box = {"--box", "-1.8", "1.8", "-1.8", "1.8", "-1.8", "1.8"};

class Same_maps : public equiaffine::test::Written_meshes_test {
protected:
  /// The points and triangles of a file, as arrays.
  equiaffine::Indexed_triangle_mesh_3<Kernel> read(const std::string& name) const {
    return equiaffine::read_points<Kernel>((folder_ / name).string()).mesh;
  }

  /// The same as a mesh of CGAL.
  CGAL::Surface_mesh<Kernel::Point_3> read_graph(const std::string& name) const {
    const auto arrays = read(name);
    CGAL::Surface_mesh<Kernel::Point_3> mesh;
    for (const auto& p : arrays.points) mesh.add_vertex(p);
    using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
    for (const auto& [a, b, c] : arrays.triangles) mesh.add_face(Vertex(a), Vertex(b), Vertex(c));
    return mesh;
  }

  Json registered(const std::string& source, const std::string& target, const Arguments& options = {}) {
    run_well(Arguments{"register", source, "to", target, "-o", "map.json"} + options);
    return Json::parse(file("map.json"));
  }

  Json symmetries(const std::string& name, const Arguments& options = {}) {
    run_well(Arguments{"symmetries", name, "-o", "maps.json"} + options);
    return Json::parse(file("maps.json"));
  }

  void write_box(const std::string& name, const std::string& height) {
    std::string text = "OFF\n8 6 0\n";
    for (const std::string& z : {std::string("0"), height})
      for (const char* xy : {"0 0 ", "2 0 ", "2 1.4 ", "0 1.4 "}) text += xy + z + '\n';
    write_file(folder_ / name, text + "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  }
};

void expect_same(const Json& json, const Kernel::Aff_transformation_3& map) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      EXPECT_EQ(double(json["matrix"][std::size_t(row)][std::size_t(column)]), map.m(row, column));
    EXPECT_EQ(double(json["translation"][std::size_t(row)]), map.m(row, 3));
  }
}

void expect_same(const Json& json, const Surface_registration_3<Kernel>& result) {
  ASSERT_EQ(json["found"], true);
  ASSERT_TRUE(result.found());
  expect_same(json, result.best().map);
  EXPECT_EQ(json["matched_by"], result.is_by_triangles ? "triangles" : "frames");
  EXPECT_EQ(double(json["log10_false_alarms"]), result.best().log10_false_alarms);
  EXPECT_EQ(double(json["rms"]), result.best().rms);
  EXPECT_EQ(json["hypotheses"], result.hypotheses);
  EXPECT_EQ(json.contains("scales") ? json["scales"].size() : 0, result.scales.size());
}

void expect_same(const Json& json, const Affine_symmetries_3<Kernel>& result) {
  ASSERT_TRUE(result.order());
  EXPECT_EQ(json["order"], *result.order());
  ASSERT_EQ(json["maps"].size(), result.maps.size());
  for (std::size_t n = 0; n < result.maps.size(); ++n) {
    expect_same(json["maps"][n], result.maps[n].map);
    EXPECT_EQ(double(json["maps"][n]["rms"]), result.maps[n].rms);
  }
}

TEST_F(Same_maps, of_a_noisy_mesh_at_a_scale_that_is_tried) {
  run_well(Arguments{"mesh", "--function",
                     "x^4+y^4+z^4-1+.31*x^3-.22*x^2*y+.13*x^2*z+.27*x*y^2-.35*x*y*z+.03*sin(25*x)", "--resolution",
                     "40", "-o", "a.off"} +
           box);
  const auto mesh = read_graph("a.off");
  const auto found = register_surfaces<Tag>(mesh, mesh, {.kind = Map_kind::RIGID});
  EXPECT_FALSE(found.scales.empty());
  expect_same(registered("a.off", "a.off", {"--kind", "rigid"}), found);
}

TEST_F(Same_maps, of_a_mesh_and_points) {
  const std::string formula = "x^4+y^4+z^4-1+.31*x^3-.22*x^2*y+.13*x^2*z+.27*x*y^2-.35*x*y*z+.18*x*z^2+.2*y^3";
  run_well(Arguments{"mesh", "--function", formula, "--resolution", "20", "-o", "a.off"} + box);
  run_well(Arguments{"mesh", "--function", formula, "--resolution", "22", "--attributes", "none", "-o", "b.csv", "--transform", "1", "0",
                     "0",    "0",          "0.8",   "0.6",          "0",  "-0.6", "0.8",   "1",           "2", "3"} +
           box);
  expect_same(registered("a.off", "b.csv", {"--kind", "similarity", "--no-reflections"}),
              register_surfaces<Tag>(read_graph("a.off"), read("b.csv").points,
                                     {.kind = Map_kind::SIMILARITY, .reflections = false}));
}

TEST_F(Same_maps, of_boxes_by_their_triangles) {
  write_box("a.off", ".8");
  write_box("b.off", ".801");
  const auto a = read("a.off"), b = read("b.off");
  expect_same(
      registered("a.off", "b.off", {"--tolerance", "0.01", "--number-of-maps", "8"}),
      register_surfaces<Tag>(a.points, a.triangles, b.points, b.triangles, {.number_of_maps = 8, .tolerance = 0.01}));
}

TEST_F(Same_maps, of_a_box_onto_itself_by_two_kinds) {
  write_box("a.off", ".8");
  const auto a = read("a.off");
  expect_same(symmetries("a.off"), affine_symmetries<Tag>(a.points, a.triangles));
  expect_same(symmetries("a.off", {"--kind", "rigid"}),
              affine_symmetries<Tag>(a.points, a.triangles, {.kind = Map_kind::RIGID}));
}

TEST_F(Same_maps, of_a_mesh_onto_itself) {
  run_well(
      Arguments{"mesh", "--function", "x^4+y^4/2+z^4+.5*x*y*z+x^2+y^2+z^2=1", "--resolution", "14", "-o", "a.off"} +
      box);
  expect_same(symmetries("a.off", {"--kind", "rigid", "--no-reflections"}),
              affine_symmetries<Tag>(read_graph("a.off"), {.kind = Map_kind::RIGID, .reflections = false}));
}

using Same_maps_long = Same_maps;

TEST_F(Same_maps_long, of_points_onto_themselves) {
  run_well(
      Arguments{"mesh", "--function", "x^4+y^4/2+z^4+.5*x*y*z+x^2+y^2+z^2=1", "--resolution", "20", "--attributes", "none", "-o", "a.csv"} +
      box);
  expect_same(symmetries("a.csv", {"--kind", "rigid"}),
              affine_symmetries<Tag>(read("a.csv").points, {.kind = Map_kind::RIGID}));
}

} // namespace same_maps_test
