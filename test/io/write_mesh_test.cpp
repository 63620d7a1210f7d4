// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/io/read_points.h>
#include <equiaffine/io/write_mesh.h>

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/IO/read_ply_points.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace write_mesh_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Mesh = equiaffine::Indexed_triangle_mesh_3<Kernel>;
using equiaffine::Mesh_format;
using equiaffine::Point_status;
using equiaffine::Vertex_attributes;
using Face = std::vector<std::size_t>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Coordinates that need all 17 digits, and an order of corners that shows reversals.
Mesh tetrahedron() {
  return {{Point_3(0.1, -1. / 3, 0), Point_3(1e-300, 2. / 3, 1e22), Point_3(1, -0.0, 0.7), Point_3(-4, 5, 1. / 7)},
          {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
}

Vertex_attributes attributes() {
  return {{{"nx", {1, 0, 0, 0.6}}, {"ny", {0, 1, 0, 0.8}}, {"nz", {0, 0, 1, nan}}, {"k1", {0.1, -nan, 3, -1. / 3}}},
          {{Point_status::REGULAR, Point_status::SINGULAR, Point_status::UNCONVERGED, Point_status::PARABOLIC}}};
}

const std::vector<Face> faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};

std::string written(Mesh_format format, const Mesh& mesh, const Vertex_attributes& values) {
  std::ostringstream stream;
  equiaffine::write_mesh(stream, format, mesh, values);
  return stream.str();
}

TEST(Write_mesh, cgal_reads_the_same_points_and_faces_from_ply) {
  for (const Vertex_attributes& values : {attributes(), Vertex_attributes{}}) {
    std::istringstream stream(written(Mesh_format::PLY, tetrahedron(), values));
    std::vector<Point_3> points;
    std::vector<Face> read_faces;
    ASSERT_TRUE(CGAL::IO::read_PLY(stream, points, read_faces, CGAL::parameters::use_binary_mode(true)));
    EXPECT_EQ(points, tetrahedron().points);
    EXPECT_EQ(read_faces, faces);
  }
}

TEST(Write_mesh, cgal_reads_every_attribute_from_ply) {
  Mesh points = tetrahedron();
  points.triangles.clear();
  std::istringstream stream(written(Mesh_format::PLY, points, attributes()));
  using Row = std::tuple<Point_3, double, double, double, double, std::uint8_t>;
  std::vector<Row> rows;
  ASSERT_TRUE(CGAL::IO::read_PLY_with_properties(
      stream, std::back_inserter(rows), CGAL::make_ply_point_reader(CGAL::Nth_of_tuple_property_map<0, Row>()),
      std::make_pair(CGAL::Nth_of_tuple_property_map<1, Row>(), CGAL::PLY_property<double>("nx")),
      std::make_pair(CGAL::Nth_of_tuple_property_map<2, Row>(), CGAL::PLY_property<double>("ny")),
      std::make_pair(CGAL::Nth_of_tuple_property_map<3, Row>(), CGAL::PLY_property<double>("nz")),
      std::make_pair(CGAL::Nth_of_tuple_property_map<4, Row>(), CGAL::PLY_property<double>("k1")),
      std::make_pair(CGAL::Nth_of_tuple_property_map<5, Row>(), CGAL::PLY_property<std::uint8_t>("status"))));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], Row(points.points[0], 1, 0, 0, 0.1, 0));
  EXPECT_EQ(rows[2], Row(points.points[2], 0, 0, 1, 3, 4));
  EXPECT_TRUE(std::isnan(std::get<4>(rows[1])));
  EXPECT_EQ(std::get<5>(rows[1]), 2);
  EXPECT_EQ(std::get<5>(rows[3]), 1);
}

TEST(Write_mesh, the_ply_header_is_the_documented_one) {
  const std::string text = written(Mesh_format::PLY, tetrahedron(), attributes());
  EXPECT_EQ(text.substr(0, text.find("end_header")),
            "ply\nformat binary_little_endian 1.0\n"
            "comment made by equiaffine; status: 0 regular 1 parabolic 2 singular 3 outside 4 unconverged\n"
            "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
            "property double nx\nproperty double ny\nproperty double nz\nproperty double k1\nproperty uchar status\n"
            "element face 4\nproperty list uchar int vertex_indices\n");
  const std::size_t header_size = text.find("end_header\n") + std::strlen("end_header\n");
  EXPECT_EQ(text.size(), header_size + 4 * (7 * 8 + 1) + 4 * (1 + 3 * 4));
}

TEST(Write_mesh, ply_keeps_comments_and_reads_them_again) {
  Vertex_attributes values = attributes();
  values.comments = {"fit Scale: 0.18", "two\nlines", ""};
  std::istringstream stream(written(Mesh_format::PLY, tetrahedron(), values));
  const auto [mesh, read] = equiaffine::read_PLY<Kernel>(stream, "t.ply");
  EXPECT_EQ(read.comments, (std::vector<std::string>{"fit Scale: 0.18", "two lines", ""}));
  EXPECT_EQ(read.columns.size(), values.columns.size());
  EXPECT_EQ(mesh.points, tetrahedron().points);
}

TEST(Write_mesh, computed_comments_replace_those_of_the_same_name) {
  Vertex_attributes first, second;
  first.comments = {"by a scanner", "fit Scale: 0.18", "fit Noise: 1"};
  second.comments = {"fit Scale: 0.2"};
  EXPECT_EQ(equiaffine::merge_attributes(first, second).comments,
            (std::vector<std::string>{"by a scanner", "fit Noise: 1", "fit Scale: 0.2"}));
}

TEST(Write_mesh, cgal_reads_the_same_points_and_faces_from_off) {
  std::istringstream stream(written(Mesh_format::OFF, tetrahedron(), attributes()));
  std::vector<Point_3> points;
  std::vector<Face> read_faces;
  ASSERT_TRUE(CGAL::IO::read_OFF(stream, points, read_faces));
  EXPECT_EQ(points, tetrahedron().points);
  EXPECT_EQ(read_faces, faces);
}

TEST(Write_mesh, cgal_reads_the_same_points_and_faces_from_obj) {
  for (const Vertex_attributes& values : {attributes(), Vertex_attributes{}}) {
    std::istringstream stream(written(Mesh_format::OBJ, tetrahedron(), values));
    std::vector<Point_3> points;
    std::vector<Face> read_faces;
    ASSERT_TRUE(CGAL::IO::read_OBJ(stream, points, read_faces));
    EXPECT_EQ(points, tetrahedron().points);
    EXPECT_EQ(read_faces, faces);
  }
}

TEST(Write_mesh, obj_has_a_normal_per_vertex_if_the_columns_exist) {
  const std::string with = written(Mesh_format::OBJ, tetrahedron(), attributes());
  EXPECT_NE(with.find("\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\nvn 0.59999999999999998 0.80000000000000004 nan\n"
                      "f 1//1 2//2 3//3\n"),
            std::string::npos)
      << with;
  Vertex_attributes incomplete = attributes();
  incomplete.columns.erase(incomplete.columns.begin() + 1);
  const std::string without = written(Mesh_format::OBJ, tetrahedron(), incomplete);
  EXPECT_EQ(without.find("vn"), std::string::npos);
  EXPECT_NE(without.find("\nf 1 2 3\n"), std::string::npos);
}

TEST(Write_mesh, cgal_reads_the_nearest_floats_from_stl) {
  Mesh mesh = tetrahedron();
  mesh.points[1] = Point_3(0.5, 2. / 3, 3);
  std::istringstream stream(written(Mesh_format::STL, mesh, attributes()));
  std::vector<Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  ASSERT_TRUE(CGAL::IO::read_STL(stream, points, triangles, CGAL::parameters::use_binary_mode(true)));
  ASSERT_EQ(triangles.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Point_3& expected = mesh.points[mesh.triangles[t][corner]];
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(points[triangles[t][corner]][axis], double(float(expected[axis])));
    }
}

TEST(Write_mesh, stl_has_unit_normals_and_zero_where_there_is_none) {
  const Mesh mesh = {{Point_3(0, 0, 0), Point_3(2, 0, 0), Point_3(0, 3, 0), Point_3(1, 0, 0)},
                     {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}}};
  const std::string bytes = written(Mesh_format::STL, mesh, {});
  ASSERT_EQ(bytes.size(), 84u + 3u * 50u);
  std::array<std::array<float, 3>, 3> normals;
  for (std::size_t t = 0; t < 3; ++t) std::memcpy(normals[t].data(), &bytes[84 + 50 * t], sizeof normals[t]);
  using Normal = std::array<float, 3>;
  EXPECT_EQ(normals[0], (Normal{0, 0, 1}));
  EXPECT_EQ(normals[1], (Normal{0, 0, -1}));
  EXPECT_EQ(normals[2], (Normal{0, 0, 0}));
}

TEST(Write_mesh, a_closed_mesh_is_closed_in_stl_although_points_coincide_in_single_precision) {
  // An octahedron far from the origin, whose apex is an edge of length 1e-12.
  const Mesh mesh = {
      {Point_3(5, 0, 0), Point_3(4, 1, 0), Point_3(3, 0, 0), Point_3(4, -1, 0), Point_3(4, 0, -1),
       Point_3(4 + 5e-13, 0, 1), Point_3(4 - 5e-13, 0, 1)},
      {{0, 1, 5}, {5, 1, 6}, {1, 2, 6}, {2, 3, 6}, {6, 3, 5}, {3, 0, 5}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}}};
  std::istringstream stream(written(Mesh_format::STL, mesh, {}));
  std::vector<Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  ASSERT_TRUE(CGAL::IO::read_STL(stream, points, triangles, CGAL::parameters::use_binary_mode(true)));
  EXPECT_EQ(triangles.size(), 8U);
  std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> sides; // of edges, less those of opposed ones
  for (const auto& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3 &p = points[triangle[k]], &q = points[triangle[(k + 1) % 3]];
      const std::array from{p.x() + 0, p.y() + 0, p.z() + 0}, to{q.x() + 0, q.y() + 0, q.z() + 0};
      ++sides[{from, to}], --sides[{to, from}];
    }
  for (const auto& [ends, count] : sides) EXPECT_EQ(count, 0);
}

TEST(Write_mesh, csv_has_17_significant_digits_nan_and_words_for_the_status) {
  Vertex_attributes values = attributes();
  values.columns.erase(values.columns.begin(), values.columns.begin() + 3);
  EXPECT_EQ(written(Mesh_format::CSV, tetrahedron(), values),
            "x,y,z,k1,status\n"
            "0.10000000000000001,-0.33333333333333331,0,0.10000000000000001,regular\n"
            "1e-300,0.66666666666666663,1e+22,nan,singular\n"
            "1,0,0.69999999999999996,3,unconverged\n"
            "-4,5,0.14285714285714285,-0.33333333333333331,parabolic\n");
  EXPECT_EQ(written(Mesh_format::CSV, Mesh{{Point_3(1, 2, 3)}, {}}, {}), "x,y,z\n1,2,3\n");
  EXPECT_EQ(written(Mesh_format::CSV, Mesh{}, {}), "x,y,z\n");
}

TEST(Write_mesh, text_does_not_depend_on_the_format_of_the_stream) {
  std::ostringstream stream;
  stream.precision(2);
  stream << std::hex << std::showpos;
  equiaffine::write_OFF(stream, tetrahedron());
  EXPECT_EQ(stream.str(), written(Mesh_format::OFF, tetrahedron(), {}));
}

TEST(Write_mesh, files_larger_than_the_buffer_are_complete) {
  Mesh mesh;
  for (int i = 0; i < 20000; ++i) mesh.points.emplace_back(i, std::sqrt(i), std::sin(i));
  for (std::uint32_t i = 2; i < mesh.points.size(); ++i) mesh.triangles.push_back({i - 2, i - 1, i});
  std::istringstream stream(written(Mesh_format::OFF, mesh, {}));
  std::vector<Point_3> points;
  std::vector<Face> read_faces;
  ASSERT_TRUE(CGAL::IO::read_OFF(stream, points, read_faces));
  EXPECT_EQ(points, mesh.points);
  EXPECT_EQ(read_faces.size(), mesh.triangles.size());
}

TEST(Write_mesh, the_extension_chooses_the_format) {
  EXPECT_EQ(equiaffine::mesh_format("a.b/mesh.PLY"), Mesh_format::PLY);
  EXPECT_EQ(equiaffine::mesh_format("x.off"), Mesh_format::OFF);
  EXPECT_EQ(equiaffine::mesh_format("x.obj"), Mesh_format::OBJ);
  EXPECT_EQ(equiaffine::mesh_format("x.stl"), Mesh_format::STL);
  EXPECT_EQ(equiaffine::mesh_format("x.csv"), Mesh_format::CSV);
  EXPECT_EQ(equiaffine::mesh_format("x.ply.txt"), std::nullopt);
  EXPECT_EQ(equiaffine::mesh_format("ply"), std::nullopt);
}

} // namespace write_mesh_test
