// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Scratch_file.h"
#include <equiaffine/io/read_points.h>
#include <equiaffine/io/write_mesh.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace read_points_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Mesh = equiaffine::Indexed_triangle_mesh_3<Kernel>;
using Table = equiaffine::Point_table_3<Kernel>;
using equiaffine::Input_error;
using equiaffine::Point_status;
using equiaffine::Vertex_attributes;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table csv(const std::string& text) {
  std::istringstream stream(text);
  return equiaffine::read_CSV<Kernel>(stream, "in.csv");
}

equiaffine::Annotated_mesh_3<Kernel> ply(const std::string& text) {
  std::istringstream stream(text);
  return equiaffine::read_PLY<Kernel>(stream, "in.ply");
}

Mesh off(const std::string& text) {
  std::istringstream stream(text);
  return equiaffine::read_OFF<Kernel>(stream, "in.off");
}

Mesh obj(const std::string& text) {
  std::istringstream stream(text);
  return equiaffine::read_OBJ<Kernel>(stream, "in.obj");
}

Mesh stl(const std::string& text) {
  std::istringstream stream(text);
  return equiaffine::read_STL<Kernel>(stream, "in.stl");
}

template <class Read>
std::string error_of(const Read& read, const std::string& text) {
  try {
    read(text);
  } catch (const Input_error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

std::string rewritten(const Table& table, const Vertex_attributes& attributes) {
  std::ostringstream stream;
  equiaffine::write_CSV(stream, table, attributes);
  return stream.str();
}

TEST(Read_points, csv_columns_may_have_any_order) {
  const Table table = csv("name,z,x,weight,y\na,3,1,0.5,2\nb,+6,4e0,-1, 5 \n");
  EXPECT_EQ(table.mesh.points, (std::vector<Point_3>{Point_3(1, 2, 3), Point_3(4, 5, 6)}));
  ASSERT_EQ(table.attributes.columns.size(), 1u);
  EXPECT_EQ(table.attributes.columns[0].name, "weight");
  EXPECT_EQ(table.attributes.columns[0].values, (std::vector<double>{0.5, -1}));
}

TEST(Read_points, csv_rows_come_back_as_they_were_written) {
  const std::string text =
      "\xef\xbb\xbf\"name\",x,y,z\r\n\r\n\"a, \"\"b\"\"\",1.50,2,3\r\n\"two\nlines\",+4, 5,6e0\r\n  \r\nc,7,8,9";
  const Table table = csv(text);
  EXPECT_EQ(table.mesh.points, (std::vector<Point_3>{Point_3(1.5, 2, 3), Point_3(4, 5, 6), Point_3(7, 8, 9)}));
  EXPECT_EQ(rewritten(table, {{{"k1", {1, nan, 0.1}}},
                              {{Point_status::REGULAR, Point_status::OUTSIDE, Point_status::REGULAR}}}),
            "\"name\",x,y,z,k1,status\n\"a, \"\"b\"\"\",1.50,2,3,1,regular\n\"two\nlines\",+4, 5,6e0,nan,outside\n"
            "c,7,8,9,0.10000000000000001,regular\n");
}

TEST(Read_points, columns_that_are_computed_again_are_replaced) {
  const Table table = csv("k1,x,\"status\",y,z\n9,1,outside,2,3\n");
  EXPECT_EQ(rewritten(table, {{{"k1", {0.5}}}, {{Point_status::REGULAR}}}), "x,y,z,k1,status\n1,2,3,0.5,regular\n");
  EXPECT_EQ(rewritten(table, {}), "k1,x,\"status\",y,z\n9,1,outside,2,3\n");
}

TEST(Read_points, cells_may_be_separated_by_semicolons_or_tabs_and_axes_be_capitals) {
  const Table semicolons = csv("\nX;Y;Z;name\n1;2;3;a, b\n");
  EXPECT_EQ(semicolons.mesh.points, std::vector<Point_3>{Point_3(1, 2, 3)});
  EXPECT_EQ(rewritten(semicolons, {{{"k1", {0.5}}}, {{Point_status::REGULAR}}}),
            "X;Y;Z;name;k1;status\n1;2;3;a, b;0.5;regular\n");
  const Table tabs = csv("x\ty\tz\tX\n1\t2\t3\t9\n");
  EXPECT_EQ(tabs.mesh.points, std::vector<Point_3>{Point_3(1, 2, 3)});
  EXPECT_EQ(rewritten(tabs, {{{"k1", {0.5}}}, {}}), "x\ty\tz\tX\tk1\n1\t2\t3\t9\t0.5\n");
}

TEST(Read_points, a_csv_file_may_have_no_rows) {
  const Table table = csv("x,y,z\n");
  EXPECT_TRUE(table.mesh.points.empty());
  EXPECT_EQ(rewritten(table, {{{"k1", {}}}, {}}), "x,y,z,k1\n");
  EXPECT_EQ(rewritten(table, {{{"k1", {}}}, std::vector<Point_status>()}), "x,y,z,k1,status\n");
}

TEST(Read_points, coordinates_that_are_no_finite_numbers_are_read_as_such) {
  const Table table = csv("x,y,z\nnan,2,-inf\n-nan,inf,3\n");
  ASSERT_EQ(table.mesh.points.size(), 2u);
  EXPECT_TRUE(std::isnan(table.mesh.points[0].x()) && std::isnan(table.mesh.points[1].x()));
  EXPECT_TRUE(table.mesh.points[0].z() < 0 && std::isinf(table.mesh.points[0].z()));
  EXPECT_TRUE(table.mesh.points[1].y() > 0 && std::isinf(table.mesh.points[1].y()));
}

TEST(Read_points, mistakes_in_csv_are_told_with_line_and_column) {
  EXPECT_EQ(error_of(csv, "x,y,z\n1,2,3\n\n1,two,3\n"),
            "cannot read 'in.csv': line 4, column 'y': 'two' is not a number; correct the cell");
  EXPECT_EQ(error_of(csv, "x,y,z,name\n\"1\",2,,a\n"),
            "cannot read 'in.csv': line 2, column 'z': '' is not a number; correct the cell");
  EXPECT_EQ(error_of(csv, "x,y,z\n\n1,2\n"),
            "cannot read 'in.csv': line 3, column 'z': the cell is missing; write as many cells as the header has");
  EXPECT_NE(error_of(csv, "x,y,z\n1,2,3,4\n").find("line 2 has more cells"), std::string::npos);
  EXPECT_NE(error_of(csv, "x,y,z\n1,2,1e999\n").find("'1e999' is not a number"), std::string::npos);
  EXPECT_NE(error_of(csv, "x,y,z\n1,2,3x\n").find("'3x'"), std::string::npos);
  EXPECT_NE(error_of(csv, "n,x,y,z\n\"a\nb\",1,2,3\nc,1,2,?\n").find("line 4"), std::string::npos);
  EXPECT_NE(error_of(csv, "x,y,z,n\n1,2,3,\"a\n4,5,6,b\n").find("line 2 opens a quote"), std::string::npos);
  EXPECT_NE(error_of(csv, "1,2,3\n").find("exactly one column 'x'"), std::string::npos);
  EXPECT_NE(error_of(csv, "x y z\n1 2 3\n").find("separated by commas, semicolons or tabs"), std::string::npos);
  EXPECT_NE(error_of(csv, "x;y;z\n1;2;0,5\n").find("'0,5' is not a number; write decimal points"), std::string::npos);
  EXPECT_NE(error_of(csv, "x;y;z\n1;2;3;4\n").find("put quotes around ';'"), std::string::npos);
  EXPECT_NE(error_of(csv, "x,y,z,x\n1,2,3,4\n").find("exactly one column 'x'"), std::string::npos);
  EXPECT_NE(error_of(csv, "").find("exactly one column 'x'"), std::string::npos);
}

Mesh square() {
  return {{Point_3(0, 0, 0.1), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, -1. / 3)}, {{0, 1, 2}, {0, 2, 3}}};
}

TEST(Read_points, ply_comes_back_as_it_was_written) {
  const Vertex_attributes attributes = {
      {{"k1", {1, 2, nan, 4}}, {"k2", {0.1, 0, 0, -1. / 3}}},
      {{Point_status::REGULAR, Point_status::PARABOLIC, Point_status::UNCONVERGED, Point_status::OUTSIDE}}};
  std::ostringstream stream;
  equiaffine::write_PLY(stream, square(), attributes);
  const auto copy = ply(stream.str());
  EXPECT_EQ(copy.mesh.points, square().points);
  EXPECT_EQ(copy.mesh.triangles, square().triangles);
  EXPECT_EQ(copy.attributes.status, attributes.status);
  ASSERT_EQ(copy.attributes.columns.size(), 2u);
  EXPECT_EQ(copy.attributes.columns[0].name, "k1");
  EXPECT_TRUE(std::isnan(copy.attributes.columns[0].values[2]));
  EXPECT_EQ(copy.attributes.columns[1].values, attributes.columns[1].values);
}

TEST(Read_points, no_beginning_of_a_ply_file_is_taken_for_the_whole) {
  std::ostringstream stream;
  equiaffine::write_PLY(stream, square(), {{{"k1", {1, 2, 3, 4}}}, {}});
  const std::string text = stream.str();
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_THROW(ply(text.substr(0, size)), Input_error) << size << " of " << text.size();
  EXPECT_NO_THROW(ply(text));
}

constexpr const char* ascii_ply = "ply\r\nformat ascii 1.0\r\ncomment c\r\nobj_info o\r\nelement camera 1\r\n"
                                  "property float u\r\nproperty list uchar int l\r\nelement vertex 4\r\n"
                                  "property float32 z\r\nproperty float x\r\nproperty list uint8 float w\r\n"
                                  "property double y\r\nproperty uchar status\r\nproperty int8 q\r\nelement face 1\r\n"
                                  "property uchar red\r\nproperty list uchar uint vertex_index\r\nend_header\r\n"
                                  "7 2 1 2\r\n0 0 1 9 0 7 -1\r\n0 1 0 0 1 -2\r\n0 1 2 9 9 1 2 -3\r\n"
                                  "0 0 0 1 3 -4\r\n255 4 0 1 2 3\r\n";

TEST(Read_points, ply_text_may_have_lists_other_elements_and_polygons) {
  const auto data = ply(ascii_ply);
  EXPECT_EQ(data.mesh.points,
            (std::vector<Point_3>{Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0)}));
  EXPECT_EQ(data.mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  // 7 is not the number of a status, so the column is one of numbers.
  EXPECT_FALSE(data.attributes.status);
  ASSERT_EQ(data.attributes.columns.size(), 2u);
  EXPECT_EQ(data.attributes.columns[0].values, (std::vector<double>{7, 1, 2, 3}));
  EXPECT_EQ(data.attributes.columns[1].values, (std::vector<double>{-1, -2, -3, -4}));
}

TEST(Read_points, ply_may_be_big_endian) {
  std::string text = "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty double y\n"
                     "property short z\nproperty uint n\nend_header\n";
  text += std::string("\x3f\x80\0\0", 4) + std::string("\x40\0\0\0\0\0\0\0", 8) + std::string("\xff\xfe", 2) +
          std::string("\xff\xff\xff\xff", 4);
  const auto data = ply(text);
  EXPECT_EQ(data.mesh.points, std::vector<Point_3>{Point_3(1, 2, -2)});
  EXPECT_EQ(data.attributes.columns.at(0).values, std::vector<double>{4294967295.});
}

TEST(Read_points, mistakes_in_ply_are_told) {
  const std::string header = "ply\nformat ascii 1.0\n";
  EXPECT_NE(error_of(ply, "OFF\n").find("not a PLY file"), std::string::npos);
  EXPECT_NE(error_of(ply, "ply\nformat text 1.0\nend_header\n").find("unknown format 'text' in line 2"),
            std::string::npos);
  EXPECT_NE(error_of(ply, header + "element vertex 1\nproperty real x\nend_header\n1\n")
                .find("unknown type 'real' in line 4"),
            std::string::npos);
  EXPECT_NE(error_of(ply, header + "element vertex 1\nproperty float x\nelement vertex 1\nend_header\n1\n")
                .find("a second element 'vertex' in line 5"),
            std::string::npos);
  EXPECT_NE(error_of(ply, header + "element vertex -1\nend_header\n").find("line 3"), std::string::npos);
  EXPECT_NE(error_of(ply, header + "element vertex 1\nproperty float x\nend_header\n1\n").find("no x, y and z"),
            std::string::npos);
  EXPECT_NE(error_of(ply, header + "element face 0\nend_header\n").find("no vertices"), std::string::npos);
  const std::string point = header + "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(error_of(ply, point + "0 0 0\n3 0 0 1\n").find("face 0 has a vertex that does not exist"),
            std::string::npos);
  std::string many = "ply\nformat ascii 1.0\nelement vertex 1\n";
  for (int n = 0; n <= 10000; ++n) many += "property float p" + std::to_string(n) + '\n';
  EXPECT_NE(error_of(ply, many + "end_header\n").find("more than 10000 properties"), std::string::npos);
  EXPECT_NE(error_of(ply, point + "0 0 zero\n3 0 0 0\n").find("'zero' is not a number"), std::string::npos);
  EXPECT_NE(error_of(ply, header + "element vertex 99999999999\nproperty float x\nproperty float y\nproperty float z\n"
                                   "end_header\n0 0 0\n")
                .find("ends before"),
            std::string::npos);
}

TEST(Read_points, off_comes_back_as_it_was_written) {
  std::ostringstream stream;
  equiaffine::write_OFF(stream, square());
  const Mesh copy = off(stream.str());
  EXPECT_EQ(copy.points, square().points);
  EXPECT_EQ(copy.triangles, square().triangles);
}

TEST(Read_points, off_may_have_comments_colors_and_polygons) {
  const Mesh mesh = off(
      "# c\r\nCOFF 4 1 0 # on the same line\r\n\r\n0 0 0 255 0 0\r\n1 0 0 1 1 1\n1 1 0 # c\n0 1 0\n4 0 1 2 3 0.5\n");
  EXPECT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Read_points, mistakes_in_off_are_told_with_the_line) {
  EXPECT_NE(error_of(off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").find("line 6 has a vertex that does not exist"),
            std::string::npos);
  EXPECT_NE(error_of(off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n").find("line 5 is the last one"), std::string::npos);
  EXPECT_NE(error_of(off, "OFF\n2 0 0\n0 0 0\n1 0\n").find("line 4 has a missing"), std::string::npos);
  EXPECT_NE(error_of(off, "4OFF\n1 0 0\n1 2 3 4\n").find("not in 3D"), std::string::npos);
  EXPECT_NE(error_of(off, "OFF BINARY\n").find("as text"), std::string::npos);
  EXPECT_NE(error_of(off, "OFF\n99999999 0 0\n0 0 0\n").find("more vertices"), std::string::npos);
  for (const char* empty : {"", " \n\n"}) EXPECT_NE(error_of(off, empty).find("it is empty"), std::string::npos);
}

TEST(Read_points, obj_and_stl_come_back_as_they_were_written) {
  std::ostringstream obj_stream, stl_stream;
  equiaffine::write_OBJ(obj_stream, square());
  EXPECT_EQ(obj(obj_stream.str()).points, square().points);
  EXPECT_EQ(obj(obj_stream.str()).triangles, square().triangles);
  const Mesh mesh = square();
  equiaffine::write_STL(stl_stream, mesh);
  const Mesh copy = stl(stl_stream.str());
  ASSERT_EQ(copy.triangles.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < copy.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point_3& p = mesh.points[mesh.triangles[t][k]];
      EXPECT_EQ(copy.points[copy.triangles[t][k]], Point_3(float(p.x()), float(p.y()), float(p.z())));
    }
}

TEST(Read_points, obj_may_have_textures_groups_polygons_and_relative_vertices) {
  const std::string head = "# by hand\r\nmtllib a.mtl\no square\nv 0 0 0\nv 1 0 0 1 0 0 # red\nvt 0 0\nvn 0 0 1\n";
  const Mesh mesh = obj(head + "v 1 1 0\ng side\nv +0 1e0 \\\n 0\nusemtl b\nf 1/1/1 2//1 3/1 4\nf -4 -3 -2\nl 1 2\n");
  EXPECT_EQ(mesh.points, (std::vector<Point_3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
  EXPECT_EQ(obj("# made in C:\\\\models\\\\\nmtllib C:\\\\\nv 1 2 3\n").points, (std::vector<Point_3>{{1, 2, 3}}));
  EXPECT_EQ(obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0").triangles, (Triangles{{0, 1, 2}})) << "vertices behind a face";
}

TEST(Read_points, mistakes_in_obj_are_told_with_the_line) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto expect = [&](const std::string& text, const std::string& reason) {
    EXPECT_NE(error_of(obj, text).find(reason), std::string::npos) << text << error_of(obj, text);
  };
  for (const char* face : {"f 1 2 2.5\n", "f 1/1/1 2//2 3x\n", "f 1 - 2\n", "f 1 2 99999999999999999999\n"})
    expect(points + face, "line 4 has a face with a vertex that is not an integer");
  for (const char* face : {"f 1 2 0\n", "f 1 2 -4\n", "f 1 2 4294967297\n"})
    expect(points + face, "line 4 has a face with a vertex that does not exist");
  expect(points + "f 1 2 3\nf 1 2 4\n", "face 1, counted from 0, has a vertex that does not exist");
  expect("v 0 0\n", "line 1 has a missing or unreadable coordinate");
  expect("v 0 0 \\\n z\n", "line 2 has a missing or unreadable coordinate");
  expect(points + "this is no mesh\n", "line 4 begins with 'this', which is not a statement of OBJ");
  expect("# nothing\n", "it has no vertices");
}

const std::string text_stl = "solid facet a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
                             "   vertex 0 1e0 0\n  endloop\n endfacet\n FACET normal 0 0 1 outer loop VERTEX 1 0 0\n"
                             "   vertex 1 1 0 vertex -0 1 0\n  endloop\n endfacet\nendsolid facet a\n";

TEST(Read_points, stl_as_text_has_vertices_with_the_same_coordinates_once) {
  const Mesh mesh = stl(text_stl + "solid b\nendsolid\n");
  EXPECT_EQ(mesh.points, (std::vector<Point_3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}}));
}

TEST(Read_points, binary_stl_may_begin_with_the_word_solid) {
  std::ostringstream stream;
  equiaffine::write_STL(stream, square());
  std::string bytes = stream.str();
  bytes.replace(0, 6, "solid ");
  EXPECT_EQ(stl(bytes).triangles.size(), square().triangles.size());
  EXPECT_EQ(stl(bytes + "more").triangles.size(), square().triangles.size());
  EXPECT_EQ(stl("header" + stream.str().substr(6) + "more").triangles.size(), square().triangles.size());
}

TEST(Read_points, stl_as_text_may_have_capitals_and_other_line_ends) {
  std::string text = text_stl;
  for (char& c : text) c = c == '\n' ? '\r' : char(std::toupper(c));
  EXPECT_EQ(stl("\xef\xbb\xbf" + text).triangles, stl(text_stl).triangles);
  std::string words = text_stl;
  for (std::size_t n = words.find('\n') + 1; n < words.rfind("endsolid") - 1; ++n)
    if (words[n] == ' ') words[n] = '\n';
  EXPECT_EQ(stl(words).points, stl(text_stl).points);
}

TEST(Read_points, corners_of_stl_that_are_not_numbers_take_no_longer) {
  constexpr std::uint32_t triangles = 100000;
  std::string bytes(84 + 50 * triangles, '\xff');
  for (int i = 0; i < 4; ++i) bytes[80 + std::size_t(i)] = char(triangles >> 8 * i & 255);
  const Mesh mesh = stl(bytes);
  EXPECT_EQ(mesh.triangles.size(), triangles);
  EXPECT_EQ(mesh.points.size(), 1U) << "all have the same bits";
}

TEST(Read_points, no_beginning_of_an_stl_file_is_taken_for_the_whole) {
  const std::size_t last_word = text_stl.rfind("endsolid");
  for (std::size_t size = 1; size < last_word; ++size)
    EXPECT_NE(error_of(stl, text_stl.substr(0, size)), "no error") << size;
  std::ostringstream stream;
  equiaffine::write_STL(stream, square());
  for (std::size_t size = 1; size < stream.str().size(); ++size)
    EXPECT_NE(error_of(stl, stream.str().substr(0, size)), "no error") << size;
  EXPECT_NE(error_of(stl, "this is no mesh").find("it is not an STL file"), std::string::npos);
  EXPECT_NE(error_of(stl, "solid\nfacet\nvertex 0 0\n").find("line 3 has a missing"), std::string::npos);
  EXPECT_NE(error_of(stl, "solid\nvertex 0 0 0\nendfacet\n").find("line 3 ends a facet that is not a triangle"),
            std::string::npos);
}

TEST(Read_points, attributes_with_the_same_name_are_replaced) {
  const Vertex_attributes merged = equiaffine::merge_attributes({{{"a", {1}}, {"b", {2}}}, {{Point_status::OUTSIDE}}},
                                                                {{{"b", {3}}, {"c", {4}}}, {}});
  ASSERT_EQ(merged.columns.size(), 3u);
  EXPECT_EQ(merged.columns[0].name + merged.columns[1].name + merged.columns[2].name, "abc");
  EXPECT_EQ(merged.columns[1].values[0], 3);
  EXPECT_EQ(merged.status, std::vector<Point_status>{Point_status::OUTSIDE});
}

TEST(Read_points, points_of_a_ply_file_become_csv) {
  const Table table = {ply(ascii_ply), {}, {}};
  EXPECT_EQ(rewritten(table, {{{"k1", {1, 2, 3, 4}}}, {}}).substr(0, 34), "x,y,z,status,q,k1\n0,0,0,7,-1,1\n1,0");
}

TEST(Read_points, unknown_and_missing_files_are_told) {
  const auto read = [](const std::string& path) { equiaffine::read_points<Kernel>(path); };
  EXPECT_NE(error_of(read, "/absent/points.csv").find("'/absent/points.csv': there is no such file"),
            std::string::npos);
  EXPECT_NE(error_of(read, "/dev/null").find("'/dev/null': it is a device"), std::string::npos);
  EXPECT_NE(error_of(read, EQUIAFFINE_TEST_DATA "/../CMakeLists.txt").find("use one of .csv .ply .off .obj .stl .xyz"),
            std::string::npos);
}

TEST(Read_points, the_numbers_of_an_OFF_file_may_follow_its_keyword_at_once) {
  const equiaffine::test::Scratch_file scratch("points.off");
  const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const std::string head : {"OFF3 1 0\n", "COFF3 1 0\n", "OFF 3 1 0\n", "OFF\n3 1 0\n", "OFF3 1\n", "3 1 0\n"}) {
    const Table points = equiaffine::read_points<Kernel>(scratch.write(head + triangle));
    EXPECT_EQ(points.mesh.points.size(), 3U) << head;
    EXPECT_EQ(points.mesh.triangles.size(), 1U) << head;
  }
  const auto read = [&](const std::string& text) { equiaffine::read_points<Kernel>(scratch.write(text)); };
  EXPECT_NE(error_of(read, "4OFF3 1 0\n" + triangle).find("not in 3D"), std::string::npos);
  EXPECT_NE(error_of(read, "OFFSET 3 1 0\n" + triangle).find("the numbers of vertices"), std::string::npos);
}

TEST(Read_points, three_numbers_without_names_are_normals_of_length_one_or_colors) {
  const equiaffine::test::Scratch_file scratch("points.xyz");
  const auto names = [&](const std::string& text) {
    const Table points = equiaffine::read_points<Kernel>(scratch.write(text));
    std::string text_of_names;
    for (const auto& column : points.attributes.columns) text_of_names += column.name + ' ';
    for (const std::string& comment : points.attributes.comments) text_of_names += "(" + comment.substr(0, 25) + ")";
    return text_of_names;
  };
  const std::string colors = "red green blue (columns 4 to 6 are colors)";
  EXPECT_EQ(names("1 2 3 0.6 0 -0.8\n4 5 6 0 0 0\n7 8 9 .58 .58 .58\n"), "nx ny nz ");
  EXPECT_EQ(names("1 2 3 nan nan nan\n4 5 6 0 1 0\n"), "nx ny nz ");
  EXPECT_EQ(names("1 2 3 120 130 140\n4 5 6 0 1 0\n"), colors);
  EXPECT_EQ(names("1 2 3 0.5 0.5 0.2\n"), colors);
  EXPECT_EQ(names("1 2 3 0 0 0\n"), colors) << "black";
  EXPECT_EQ(names("//X Y Z R G B\n1 2 3 0 1 0\n"), "red green blue ");
  EXPECT_EQ(names("//X Y Z R G B Intensity Nx Ny Nz\n1 2 3 9 9 9 0.5 0 0 5\n// end\n"),
            "red green blue Intensity nx ny nz ");
  EXPECT_EQ(names("# made by hand\n# x y z t\n1 2 3 4\n"), "t ");
  const auto read = [&](const std::string& text) { equiaffine::read_points<Kernel>(scratch.write(text)); };
  EXPECT_NE(error_of(read, "1 2 3 -4 5 6\n").find("neither normals, which have length 1, nor colors"),
            std::string::npos);
  EXPECT_NE(error_of(read, "//X Y Z R G B\n1 2 3\n").find("line 2 has 3 numbers; write as many as"), std::string::npos);
  EXPECT_NE(error_of(read, "//X Y Z T T\n1 2 3 4 5\n").find("two columns have the name 'T'"), std::string::npos);
}

TEST(Read_points, lines_of_three_or_six_numbers_are_points_and_normals) {
  const equiaffine::test::Scratch_file scratch("points.XYZ");
  const Table points = equiaffine::read_points<Kernel>(scratch.write("1 2 3\r\n\n -4\t5e0  +6 \n"));
  EXPECT_EQ(points.mesh.points, (std::vector<Kernel::Point_3>{{1, 2, 3}, {-4, 5, 6}}));
  EXPECT_TRUE(points.attributes.columns.empty());
  const Table oriented = equiaffine::read_points<Kernel>(scratch.write("1 2 3 0 0 1\n4 5 6 0 1 0"));
  ASSERT_EQ(oriented.attributes.columns.size(), 3U);
  EXPECT_EQ(oriented.attributes.columns[1].name, "ny");
  EXPECT_EQ(oriented.attributes.columns[1].values, (std::vector<double>{0, 1}));
  const auto read = [&](const std::string& text) { equiaffine::read_points<Kernel>(scratch.write(text)); };
  EXPECT_NE(error_of(read, "1 2 3\n4 5\n").find("line 2 has 2 numbers; write x y z"), std::string::npos);
  EXPECT_NE(error_of(read, "1 2 3 0 0 1\n4 5 6\n").find("line 2 has 3 numbers"), std::string::npos);
  EXPECT_NE(error_of(read, "1 2 3 4 5 6 7\n").find("line 1 has 7 numbers"), std::string::npos);
  EXPECT_NE(error_of(read, "1 2 3\n\n1 2 z\n").find("line 3: 'z' is not a number"), std::string::npos);
}

} // namespace read_points_test
