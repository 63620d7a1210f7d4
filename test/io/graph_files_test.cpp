// SPDX-License-Identifier: GPL-3.0-or-later
// Files of meshes and points of CGAL with their property maps.
#include "support/same_bits.h"
#include <equiaffine/attributes/annotate.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/io/point_files.h>
#include <equiaffine/io/polygon_mesh_files.h>

#include <CGAL/Point_set_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/helpers.h>

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace graph_files_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Surface_mesh = CGAL::Surface_mesh<Point>;
using Vertex = Surface_mesh::Vertex_index;

class Graph_files : public testing::Test {
protected:
  Graph_files() { // tests run at the same time
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::path(testing::TempDir()) / ("equiaffine_" + name);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Graph_files() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string text_file(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }

  std::size_t number_of_files() const {
    return std::size_t(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }

private:
  std::filesystem::path folder_;
};

auto torus() {
  return make_analytic_traits<Kernel>(analytic_functions::Torus{1, 0.4}, CGAL::Bbox_3(-1.5, -1.5, -1, 1.5, 1.5, 1));
}

template <class T>
void expect_same_maps(const Surface_mesh& a, const Surface_mesh& b) {
  for (const std::string& key : a.properties<Vertex>()) {
    const auto map = internal::Named_maps<Surface_mesh>::find<T>(a, key);
    if (!map) continue;
    const auto other = internal::Named_maps<Surface_mesh>::find<T>(b, key);
    ASSERT_TRUE(other) << key;
    for (const Vertex v : a.vertices()) ASSERT_TRUE(same_bits((*map)[v], (*other)[v])) << key;
  }
}

std::set<std::string> keys(const Surface_mesh& mesh) {
  const auto list = mesh.properties<Vertex>();
  return {list.begin(), list.end()};
}

TEST_F(Graph_files, an_annotated_mesh_comes_back_bit_for_bit_under_the_same_names) {
  Surface_mesh mesh, read;
  CGAL::make_icosahedron(mesh, Point(0.3, 0.2, 0.1), 0.5);
  annotate(mesh, torus());
  mesh.add_property_map<Vertex, int>("v:my count", 7);
  IO::write_polygon_mesh(path("torus.ply"), mesh, parameters::comments(std::array<std::string, 1>{"scale: 0.2"}));
  const auto comments = IO::read_polygon_mesh(path("torus.ply"), read, CGAL::parameters::verbose(false));
  EXPECT_EQ(comments.back(), "scale: 0.2");
  EXPECT_EQ(number_of_files(), 1U);
  ASSERT_EQ(read.number_of_vertices(), mesh.number_of_vertices());
  ASSERT_EQ(read.number_of_faces(), mesh.number_of_faces());
  EXPECT_TRUE(CGAL::is_closed(read));
  auto expected = keys(mesh);
  expected.erase("v:my count");
  expected.insert("v:my_count");
  EXPECT_EQ(keys(read), expected);
  EXPECT_GT(expected.size(), 30U);
  expect_same_maps<double>(mesh, read);
  expect_same_maps<Vector>(mesh, read);
  expect_same_maps<Point>(mesh, read);
  expect_same_maps<Point_status>(mesh, read);
  EXPECT_EQ((*internal::Named_maps<Surface_mesh>::find<double>(read, "v:my_count"))[Vertex(3)], 7);
}

TEST_F(Graph_files, vertices_that_were_removed_are_not_written) {
  Surface_mesh mesh, read;
  CGAL::make_icosahedron(mesh, Point(0.3, 0.2, 0.1), 0.5);
  annotate(mesh, torus());
  CGAL::Euler::remove_center_vertex(halfedge(Vertex(5), mesh), mesh);
  ASSERT_TRUE(mesh.has_garbage());
  IO::write_polygon_mesh(path("torus.ply"), mesh);
  IO::read_polygon_mesh(path("torus.ply"), read);
  ASSERT_EQ(read.number_of_faces(), mesh.number_of_faces()) << "one of them is a polygon";
  ASSERT_EQ(read.number_of_vertices(), mesh.number_of_vertices());
  const auto of = [](const Surface_mesh& m) {
    return *internal::Named_maps<Surface_mesh>::find<double>(m, "v:affine_mean_curvature");
  };
  EXPECT_EQ(of(read)[Vertex(4)], of(mesh)[Vertex(4)]);
  EXPECT_EQ(of(read)[Vertex(5)], of(mesh)[Vertex(6)]);
}

TEST_F(Graph_files, maps_that_are_given_are_columns_with_the_sign_of_files) {
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  using Descriptor = boost::graph_traits<Polyhedron>::vertex_descriptor;
  struct Principal {
    double min_curvature, max_curvature;
    Vector min_direction, max_direction;
  };
  Polyhedron cube, read;
  CGAL::make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), Point(0, 1, 1), Point(0, 0, 1),
                        Point(1, 0, 1), Point(1, 1, 1), cube);
  std::map<Descriptor, double> mean, error, mean_read, error_read;
  std::map<Descriptor, std::array<double, 6>> metric, metric_read;
  std::map<Descriptor, Principal> principal, principal_read;
  std::map<Descriptor, Point_status> status, status_read;
  double number = 1;
  for (const auto v : vertices(cube)) {
    mean[v] = ++number;
    error[v] = number / 8;
    metric[v] = {1, 2, 3, 4, 5, number};
    principal[v] = {number, number + 1, Vector(1, 0, 0), Vector(0, 1, number)};
    status[v] = Point_status::PARABOLIC;
  }
  const auto chain = [](auto& m, auto& e, auto& g, auto& p, auto& s) {
    return parameters::vertex_mean_curvature_map(boost::make_assoc_property_map(m))
        .vertex_affine_normal_error_map(boost::make_assoc_property_map(e))
        .vertex_affine_metric_map(boost::make_assoc_property_map(g))
        .vertex_principal_curvatures_and_directions_map(boost::make_assoc_property_map(p))
        .vertex_status_map(boost::make_assoc_property_map(s));
  };
  IO::write_polygon_mesh(path("cube.ply"), cube, chain(mean, error, metric, principal, status));
  IO::read_polygon_mesh(path("cube.ply"), read, chain(mean_read, error_read, metric_read, principal_read, status_read));
  EXPECT_EQ(num_faces(read), 6U) << "quads stay quads";
  ASSERT_EQ(num_vertices(read), 8U);
  auto w = vertices(read).begin();
  for (const auto v : vertices(cube)) {
    EXPECT_EQ(mean_read.at(*w), mean.at(v));
    EXPECT_EQ(error_read.at(*w), error.at(v));
    EXPECT_EQ(metric_read.at(*w), metric.at(v));
    EXPECT_EQ(principal_read.at(*w).min_curvature, principal.at(v).min_curvature);
    EXPECT_EQ(principal_read.at(*w).max_direction, principal.at(v).max_direction);
    EXPECT_EQ(status_read.at(*w++), Point_status::PARABOLIC);
  }
  const auto file = equiaffine::read_points<Kernel>(path("cube.ply"));
  EXPECT_EQ(find_column(file.attributes, "mean_curvature")->values[0], -2);
  EXPECT_EQ(find_column(file.attributes, "k1")->values[0], -2);
  EXPECT_TRUE(find_column(file.attributes, "affine_normal_error"));
}

TEST_F(Graph_files, every_format_that_is_written_has_the_mesh) {
  Surface_mesh cube;
  CGAL::make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), Point(0, 1, 1), Point(0, 0, 1),
                        Point(1, 0, 1), Point(1, 1, 1), cube);
  for (const char* name : {"a.off", "a.obj", "a.stl", "a.csv", "a.PLY"}) IO::write_polygon_mesh(path(name), cube);
  Surface_mesh off, ply;
  IO::read_polygon_mesh(path("a.off"), off);
  IO::read_polygon_mesh(path("a.PLY"), ply);
  EXPECT_EQ(off.number_of_faces(), 6U);
  EXPECT_EQ(ply.number_of_faces(), 6U);
  EXPECT_EQ(std::filesystem::file_size(path("a.stl")), 84U + 12 * 50);
  EXPECT_EQ(equiaffine::read_points<Kernel>(path("a.csv")).mesh.points.size(), 8U);
}

template <class Call>
std::string sentence_of(const Call& call) {
  try {
    call();
  } catch (const Input_error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(Graph_files, a_file_that_cannot_become_a_mesh_gets_a_sentence) {
  Surface_mesh mesh;
  const auto read = [&](const std::string& name, const auto&... parameters) {
    return sentence_of([&] { IO::read_polygon_mesh(name, mesh, parameters...); });
  };
  const std::string fins = text_file("fins.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n"
                                                 "3 0 1 2\n3 1 0 3\n3 0 1 4\n");
  EXPECT_NE(read(fins).find("not a manifold at face 2"), std::string::npos) << read(fins);
  const std::string one = text_file("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  std::map<Vertex, double> K;
  const auto map = parameters::vertex_affine_Gaussian_curvature_map(boost::make_assoc_property_map(K));
  EXPECT_NE(read(one, map).find("it has no column 'affine_gaussian_curvature' for a property map"), std::string::npos);
  const std::string two = text_file("two.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n");
  EXPECT_NE(read(two).find("its face 0 has fewer than three corners"), std::string::npos) << read(two);
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string again = text_file("again.ply", header + "property float x\nend_header\n0 0 0 0\n");
  EXPECT_NE(read(again).find("a second property 'x'"), std::string::npos) << read(again);
  const std::string many = text_file("many.ply", header + "element face 18446744073709551615\nend_header\n0 0 0\n");
  EXPECT_EQ(read(many), "no error") << "faces without properties are not counted one by one";
  EXPECT_NE(read(path("none.ply")).find("there is no such file"), std::string::npos);
  EXPECT_NE(read(text_file("a.txt", "solid")).find("use one of .ply .off .obj .stl"), std::string::npos);
}

TEST_F(Graph_files, a_file_that_cannot_be_written_leaves_nothing_behind) {
  Surface_mesh mesh;
  const auto write = [&](const std::string& name) { return sentence_of([&] { IO::write_polygon_mesh(name, mesh); }); };
  EXPECT_NE(write(path("mesh.vtk")).find("its extension is not known"), std::string::npos);
  EXPECT_NE(write(path("no/folder.ply")).find("cannot write"), std::string::npos);
  std::filesystem::create_directory(path("folder.ply"));
  EXPECT_NE(write(path("folder.ply")).find("cannot write"), std::string::npos);
  EXPECT_EQ(number_of_files(), 1U) << "the folder";
}

TEST_F(Graph_files, a_file_that_is_replaced_hands_on_its_permissions_and_a_link_stays_one) {
  using std::filesystem::perms;
  const auto permissions = perms::owner_read | perms::owner_write;
  std::filesystem::permissions(text_file("old.ply", "old"), permissions);
  std::filesystem::create_symlink(path("old.ply"), path("link.ply"));
  IO::write_polygon_mesh(path("link.ply"), Surface_mesh());
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.ply")));
  EXPECT_EQ(std::filesystem::status(path("old.ply")).permissions(), permissions);
  EXPECT_GT(std::filesystem::file_size(path("old.ply")), 3U);
}

TEST_F(Graph_files, maps_whose_columns_would_have_one_name_are_refused) {
  const auto sentence = [&](const std::vector<std::string>& keys) {
    Surface_mesh mesh;
    mesh.add_vertex(Point(1, 2, 3));
    for (const std::string& key : keys) mesh.add_property_map<Vertex, double>(key, 7);
    return sentence_of([&] { IO::write_polygon_mesh(path("names.ply"), mesh); });
  };
  EXPECT_NE(sentence({"v:x"}).find("'x' would be the name of two property maps, or of a map and a coordinate"),
            std::string::npos);
  EXPECT_NE(sentence({"v:a b", "v:a_b"}).find("'a_b' would be the name of two"), std::string::npos);
  EXPECT_EQ(sentence({"v:a,b", "v:c"}), "no error");
  EXPECT_EQ(equiaffine::read_points<Kernel>(path("names.ply")).attributes.columns[0].name, "a_b");
}

TEST_F(Graph_files, maps_of_all_numbers_are_kept_and_filled_again) {
  Surface_mesh mesh, read;
  mesh.add_vertex(Point(1, 2, 3));
  mesh.add_property_map<Vertex, std::size_t>("v:component", 5);
  mesh.add_property_map<Vertex, bool>("v:is_selected", true);
  mesh.add_property_map<Vertex, float>("v:weight", 0.5F);
  IO::write_polygon_mesh(path("numbers.ply"), mesh);
  const auto weight = read.add_property_map<Vertex, float>("v:weight", 0).first;
  IO::read_polygon_mesh(path("numbers.ply"), read);
  EXPECT_EQ(weight[Vertex(0)], 0.5F);
  EXPECT_FALSE(internal::Named_maps<Surface_mesh>::find<double>(read, "v:weight")) << "there is one of float";
  EXPECT_EQ((*internal::Named_maps<Surface_mesh>::find<double>(read, "v:component"))[Vertex(0)], 5);
  EXPECT_EQ((*internal::Named_maps<Surface_mesh>::find<double>(read, "v:is_selected"))[Vertex(0)], 1);
}

TEST_F(Graph_files, points_of_a_point_set_come_back_with_their_maps) {
  CGAL::Point_set_3<Point> points, read;
  points.insert(Point(1.4, 0, 0));
  points.insert(Point(0, 0.6, 0));
  const auto conormals = points.add_property_map<Vector>("conormal").first;
  const auto K = points.add_property_map<double>("affine_gaussian_curvature").first;
  const auto status = points.add_property_map<Point_status>("status").first;
  annotate(
      points, torus(),
      parameters::vertex_conormal_map(conormals).vertex_affine_Gaussian_curvature_map(K).vertex_status_map(status));
  status[1] = Point_status::PARABOLIC;
  for (const char* name : {"points.ply", "points.csv"}) {
    IO::write_points(path(name), points);
    read.clear();
    read.insert(Point(9, 9, 9));
    IO::read_points(path(name), read);
    ASSERT_EQ(read.size(), 3U);
    EXPECT_EQ(read.point(1), points.point(0));
    const auto vectors = internal::Named_maps<decltype(read)>::find<Vector>(read, "conormal");
    const auto numbers = internal::Named_maps<decltype(read)>::find<double>(read, "affine_gaussian_curvature");
    ASSERT_TRUE(vectors && numbers) << name;
    EXPECT_EQ((*vectors)[2], conormals[1]);
    EXPECT_EQ((*numbers)[1], K[0]);
    const auto statuses = internal::Named_maps<decltype(read)>::find<Point_status>(read, "status");
    ASSERT_TRUE(statuses) << name;
    EXPECT_EQ((*statuses)[2], Point_status::PARABOLIC);
  }
  EXPECT_NE(sentence_of([&] { IO::write_points(path("points.stl"), points); }).find("written as .ply or .csv"),
            std::string::npos);
  std::vector<Point> plain;
  IO::read_points(path("points.csv"), plain);
  EXPECT_EQ(plain.size(), 2U);
  std::map<Point, double> H{{plain[0], 3}, {plain[1], 4}}, H_read;
  IO::write_points(path("H.csv"), plain,
                   parameters::vertex_affine_mean_curvature_map(boost::make_assoc_property_map(H)));
  IO::read_points(path("H.csv"), plain,
                  parameters::vertex_affine_mean_curvature_map(boost::make_assoc_property_map(H_read)));
  EXPECT_EQ(plain.size(), 4U);
  EXPECT_EQ(H_read, H);
}

} // namespace graph_files_test
