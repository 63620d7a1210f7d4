// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/written_meshes.h"
#include <equiaffine/io/write_mesh.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace annotate_test {

using namespace equiaffine::test;
using Json = nlohmann::json;

const std::string basic_names = "nx,ny,nz,k1,k2,gaussian_curvature,mean_curvature,conormal_x,conormal_y,conormal_z,"
                                "affine_normal_x,affine_normal_y,affine_normal_z,affine_gaussian_curvature,"
                                "affine_mean_curvature,pick_invariant,affine_normal_angle,affine_area_density",
                  error_names = "affine_gaussian_curvature_error,affine_mean_curvature_error,pick_invariant_error,"
                                "affine_normal_error,affine_normal_angle_error,affine_area_density_error,"
                                "conormal_error,normal_error,gaussian_curvature_error,mean_curvature_error,k1_error,"
                                "k2_error",
                  noise_names = "affine_gaussian_curvature_noise,affine_mean_curvature_noise,"
                                "affine_gaussian_curvature_detail,affine_mean_curvature_detail";

/// The surface is none of those that polynomials of the fits contain.
const Arguments surface = {"--function", "x^2 + y^2/2 + z^2 + sin(x*y)/5 = 2", "--box", "-3", "3", "-3", "3", "-3",
                           "3"};

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

class Program_annotate : public Written_meshes_test {
protected:
  /// Meshes the surface to a file whose attributes are exact.
  void make_surface(const std::string& name, const std::string& attributes = "none", const std::string& nodes = "16") {
    run_well(Arguments{"mesh", "-o", name, "--resolution", nodes, "--attributes", attributes} + surface);
  }

  /// Expects that K in a file is that of another one to within its error at 93 % of the points.
  void expect_right(const std::string& name, const std::string& exact_name) {
    const Mesh fitted = mesh(name), exact = mesh(exact_name);
    const auto found = column(fitted, "affine_gaussian_curvature"),
               error = column(fitted, "affine_gaussian_curvature_error"),
               expected = column(exact, "affine_gaussian_curvature");
    ASSERT_EQ(found.size(), expected.size());
    std::size_t right = 0;
    for (std::size_t i = 0; i < found.size(); ++i) right += std::abs(found[i] - expected[i]) <= error[i];
    EXPECT_GE(double(right), 0.93 * double(found.size()));
  }
};
using Program_annotate_long = Program_annotate;

TEST_F(Program_annotate, vertices_and_faces_stay_and_attributes_come) {
  make_surface("in.ply", "quadric_defect");
  run_well({"annotate", "in.ply", "-o", "out.ply"});
  const Mesh before = mesh("in.ply"), after = mesh("out.ply");
  EXPECT_EQ(after.mesh.points, before.mesh.points);
  EXPECT_EQ(after.mesh.triangles, before.mesh.triangles);
  std::string names;
  for (const auto& column : after.attributes.columns) names += (names.empty() ? "" : ",") + column.name;
  EXPECT_EQ(names, "quadric_defect," + basic_names + "," + error_names) << "what was there stays";
  EXPECT_EQ(column(after, "quadric_defect"), column(before, "quadric_defect"));
  ASSERT_TRUE(after.attributes.status);
}

TEST_F(Program_annotate, curvatures_are_right_to_within_their_errors) {
  make_surface("exact.ply", "basic", "28");
  run_well({"annotate", "exact.ply", "-o", "out.ply"});
  expect_right("out.ply", "exact.ply");
}

TEST_F(Program_annotate, points_without_faces_are_fitted_too) {
  make_surface("exact.ply", "basic", "28");
  std::string csv = "name;x;y;z\n", xyz, with_normals;
  const Mesh exact = mesh("exact.ply");
  const auto nx = column(exact, "nx"), ny = column(exact, "ny"), nz = column(exact, "nz");
  std::ostringstream normals, points, colors;
  normals.precision(17);
  points.precision(17);
  colors.precision(17);
  for (std::size_t i = 0; i < exact.mesh.points.size(); ++i) {
    const auto& p = exact.mesh.points[i];
    points << p << '\n';
    colors << p << " 120 130 140\n";
    normals << p << "  " << -nx[i] << '\t' << -ny[i] << ' ' << -nz[i] << '\n';
    std::ostringstream row;
    row.precision(17);
    row << "p" << i << ';' << p.x() << ';' << p.y() << ';' << p.z() << '\n';
    csv += row.str();
  }
  write_file(folder_ / "in.csv", csv);
  write_file(folder_ / "in.xyz", points.str());
  write_file(folder_ / "inward.xyz", normals.str());
  write_file(folder_ / "colored.xyz", colors.str());
  for (const char* name : {"in.csv", "in.xyz", "inward.xyz"}) {
    run_well({"annotate", name, "-o", "out.ply"});
    EXPECT_EQ(mesh("out.ply").mesh.points, exact.mesh.points) << name;
    expect_right("out.ply", "exact.ply");
  }
  EXPECT_LT(column(mesh("out.ply"), "nx")[0] * nx[0], 0) << "the normals of the file say what is outside";
  const std::string summary = run_well({"annotate", "colored.xyz", "-o", "out.ply"});
  EXPECT_NE(summary.find("points\ncolumns 4 to 6 are colors; normals"), std::string::npos) << summary;
  expect_right("out.ply", "exact.ply");
  EXPECT_EQ(column(mesh("out.ply"), "green")[0], 130);
  run_well({"annotate", "in.csv", "-o", "out.csv", "--degree", "4", "--attributes", "affine_gaussian_curvature"});
  EXPECT_EQ(first_line(file("out.csv")), "name;x;y;z;affine_gaussian_curvature;status");
  EXPECT_EQ(file("out.csv").substr(first_line(file("out.csv")).size() + 1, 3), "p0;");
}

TEST_F(Program_annotate, corners_of_STL_become_vertices) {
  make_surface("in.stl");
  make_surface("in.ply");
  run_well({"annotate", "in.stl", "-o", "out.ply"});
  EXPECT_EQ(mesh("out.ply").mesh.points.size(), mesh("in.ply").mesh.points.size());
  EXPECT_EQ(mesh("out.ply").mesh.triangles.size(), mesh("in.ply").mesh.triangles.size());
}

TEST_F(Program_annotate, faces_that_are_no_surface_stay_as_they_are) {
  make_surface("in.off");
  std::string text = file("in.off");
  const std::size_t face = text.find("\n3 ") + 1, end = text.find('\n', face);
  std::istringstream words(text.substr(face, end - face));
  int count = 0, a = 0, b = 0, c = 0;
  words >> count >> a >> b >> c;
  std::ostringstream turned;
  turned << "3 " << b << ' ' << a << ' ' << c;
  text.replace(face, end - face, turned.str());
  write_file(folder_ / "in.off", text);
  run_well({"annotate", "in.off", "-o", "out.ply"});
  const std::array<std::uint32_t, 3> first = {std::uint32_t(b), std::uint32_t(a), std::uint32_t(c)};
  EXPECT_EQ(mesh("out.ply").mesh.triangles.at(0), first);
}

TEST_F(Program_annotate, faces_that_are_turned_at_random_are_a_manifold) {
  make_surface("in.ply");
  Mesh turned = mesh("in.ply");
  for (std::size_t t = 0; t < turned.mesh.triangles.size(); t += 3)
    std::swap(turned.mesh.triangles[t][0], turned.mesh.triangles[t][1]);
  std::ostringstream text;
  equiaffine::write_OFF(text, turned.mesh);
  write_file(folder_ / "in.off", text.str());
  run_well({"annotate", "in.off", "-o", "out.ply", "--stats", "stats.json"});
  EXPECT_TRUE(Json::parse(file("stats.json")).at("manifold"));
}

TEST_F(Program_annotate, attributes_can_be_chosen) {
  make_surface("in.ply");
  const auto header = [&](const Arguments& choice) {
    return first_line(run_well(Arguments{"annotate", "in.ply", "-o", "-"} + choice));
  };
  EXPECT_EQ(header({}), "x,y,z," + basic_names + "," + error_names + ",status");
  EXPECT_EQ(header({"--attributes", "none"}), "x,y,z");
  EXPECT_EQ(header({"--attributes", "affine_mean_curvature_noise"}), "x,y,z,affine_mean_curvature_noise,status");
  EXPECT_EQ(header({"--attributes", "k1,affine_gaussian_curvature_error"}),
            "x,y,z,k1,affine_gaussian_curvature_error,status");
  EXPECT_TRUE(header({"--attributes", "all"})
                  .ends_with("metric_zz,affine_normal_angle,affine_area_density," + error_names + "," + noise_names +
                             ",status"));
  expect_error({"annotate", "in.ply", "-o", "out.ply", "--attributes", "signature"}, {"--attributes", "'signature'"});
}

TEST_F(Program_annotate, against_turns_normals_and_not_faces) {
  make_surface("in.ply");
  run_well({"annotate", "in.ply", "-o", "along.ply"});
  run_well({"annotate", "in.ply", "-o", "against.ply", "--orientation", "against"});
  const Mesh along = mesh("along.ply"), against = mesh("against.ply");
  EXPECT_EQ(along.mesh.triangles, against.mesh.triangles);
  const auto a = column(along, "nx"), b = column(against, "nx");
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i], -b[i]);
}

TEST_F(Program_annotate, scale_noise_and_degree_are_obeyed) {
  make_surface("in.ply");
  const auto fit = [&](const Arguments& choice) {
    run(Arguments{"annotate", "in.ply", "-o", "out.ply", "--stats", "stats.json"} + choice);
    return Json::parse(file("stats.json")).at("fit");
  };
  EXPECT_TRUE(fit({}).at("scale").is_null());
  EXPECT_NEAR(fit({"--scale", "1.2"}).at("scales").at("median"), 1.2, 1e-12);
  EXPECT_EQ(fit({"--scale", "1.2"}).at("scale"), 1.2);
  EXPECT_TRUE(fit({"--scale", "none"}).at("scale").is_null());
  EXPECT_NEAR(fit({"--noise", "0.0001"}).at("noise"), 0.0001, 1e-16);
  const Json chosen = fit({"--scale", "auto", "--degree", "auto", "--noise", "auto"});
  const std::string by_data = file("out.ply");
  EXPECT_EQ(fit({}), chosen);
  EXPECT_EQ(file("out.ply"), by_data);
  fit({"--degree", "4"});
  EXPECT_NE(file("out.ply"), by_data);
}

TEST_F(Program_annotate, an_extreme_unit_is_refused_and_the_last_ones_before_it_are_not) {
  make_surface("in.csv");
  std::istringstream lines(file("in.csv"));
  std::string header;
  std::getline(lines, header);
  std::vector<std::array<double, 3>> points;
  char comma = 0;
  for (std::array<double, 3> p{}; lines >> p[0] >> comma >> p[1] >> comma >> p[2];) points.push_back(p);
  const auto write = [&](const std::string& name, double unit) {
    std::ostringstream text;
    text.precision(17);
    for (const auto& [x, y, z] : points) text << unit * x << ' ' << unit * y << ' ' << unit * z << '\n';
    write_file(folder_ / name, text.str());
  };
  for (const double unit : {1e-39, 1e39}) {
    write("in.xyz", unit);
    run_well({"annotate", "in.xyz", "-o", "out.ply", "--stats", "stats.json"});
    EXPECT_EQ(Json::parse(file("stats.json")).at("status").at("regular"), points.size());
  }
  for (const double unit : {1e-200, 1e200, 1e307}) {
    write("in.xyz", unit);
    expect_error({"annotate", "in.xyz", "-o", "other.ply"}, {"'in.xyz'", "diagonal", "choose another unit"});
  }
}

TEST_F(Program_annotate, statistics_say_what_was_fitted) {
  make_surface("in.ply");
  const std::string out = run_well({"annotate", "in.ply", "-o", "out.ply", "--stats", "stats.json"});
  const Json stats = Json::parse(file("stats.json"));
  EXPECT_EQ(stats.at("source"), "in.ply");
  EXPECT_EQ(stats.at("euler_characteristic"), 2);
  EXPECT_EQ(stats.at("status").at("regular"), stats.at("vertices"));
  const Json& fit = stats.at("fit");
  EXPECT_LE(fit.at("scales").at("least"), fit.at("scales").at("median"));
  EXPECT_LE(fit.at("scales").at("median"), fit.at("scales").at("greatest"));
  EXPECT_GE(fit.at("noise"), 0.);
  EXPECT_LE(fit.at("below_10"), fit.at("below_20"));
  EXPECT_LE(fit.at("below_20"), fit.at("below_50"));
  EXPECT_LE(fit.at("below_50"), 1.);
  EXPECT_EQ(fit.at("known").at("affine_gaussian_curvature").at("below_20"), fit.at("below_20"));
  EXPECT_GE(fit.at("known").at("affine_area_density").at("below_20"), fit.at("below_20"));
  EXPECT_NE(out.find("% of vertices with errors below 20 / 50 %: K "), std::string::npos) << out;
  EXPECT_NE(out.find("wrote out.ply\nwrote stats.json\n"), std::string::npos) << out;
  EXPECT_NE(out.find("Euler characteristic 2, closed"), std::string::npos) << out;
}

TEST_F(Program_annotate, view_knows_the_fit_that_a_mesh_comes_from) {
  make_surface("in.ply");
  const auto page_of = [&](const Arguments& options) {
    run_well(Arguments{"annotate", "in.ply", "-o", "out.ply", "--html", "own.html"} + options);
    run_well({"view", "out.ply", "-o", "view.html"});
    return file("view.html");
  };
  const std::string lost = "missing: the file has no columns NAME_error";
  const std::string with_errors = page_of({"--scale", "1.2"});
  for (const char* fact : {"<dt>Scale</dt><dd>1.2</dd>", "<dt>Noise</dt>",
                           "<dt>% of vertices with errors below 20 / 50 %</dt><dd>K ", " at scale 1.2"}) {
    EXPECT_NE(with_errors.find(fact), std::string::npos) << fact;
    EXPECT_NE(file("own.html").find(fact), std::string::npos) << fact;
  }
  EXPECT_EQ(with_errors.find(lost), std::string::npos);
  EXPECT_NE(page_of({"--scale", "1.2", "--attributes", "affine_gaussian_curvature"}).find(lost), std::string::npos);
  EXPECT_EQ(page_of({"--scale", "none"}).find(" at scale"), std::string::npos);
}

TEST_F(Program_annotate, a_scale_that_is_too_large_or_too_small_is_refused) {
  make_surface("in.ply");
  expect_error({"annotate", "in.ply", "-o", "out.ply", "--scale", "180"}, {"--scale", "180", "third", "give at most"});
  expect_error({"annotate", "in.ply", "-o", "out.ply", "--scale", "0.01"}, {"--scale", "0.01", "give at least"});
  expect_error({"mesh", "--fit", "in.ply", "-o", "out.ply", "--scale", "180"}, {"--scale", "180", "give at most"});
}

TEST_F(Program_annotate, any_number_of_threads_gives_the_same_bytes) {
  make_surface("in.ply");
  run_well({"annotate", "in.ply", "-o", "one.ply", "--threads", "1"});
  run_well({"annotate", "in.ply", "-o", "four.ply", "--threads", "4"});
  EXPECT_EQ(file("one.ply"), file("four.ply"));
}

TEST_F(Program_annotate, page_and_picture_show_the_mesh) {
  make_surface("in.ply");
  run_well({"annotate", "in.ply", "-o", "out.ply", "--attributes", "k1,affine_gaussian_curvature", "--html",
            "page.html", "--png", "picture.png", "--color", "k1", "--size", "200", "200"});
  EXPECT_NE(file("page.html").find("affine_gaussian_curvature_error"), std::string::npos);
  EXPECT_TRUE(file("picture.png").starts_with("\x89PNG"));
  write_file(folder_ / "p.xyz", "0 0 0\n1 0 0\n");
  expect_error({"annotate", "p.xyz", "-o", "p.ply", "--html", "p.html"}, {"'p.xyz'", "no faces", "--html"});
}

TEST_F(Program_annotate, pictures_of_points_show_them) {
  write_file(folder_ / "none.xyz", "0 0 0\n1 1 1\n");
  std::string points;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      points += std::to_string(i / 20.) + ' ' + std::to_string(j / 20.) + ' ' + std::to_string(i * j / 400.) + '\n';
  write_file(folder_ / "many.xyz", points);
  for (const std::string name : {"none", "many"})
    EXPECT_EQ(
        run({"annotate", name + ".xyz", "-o", name + ".ply", "--png", name + ".png", "--size", "200", "200"}).status,
        0);
  EXPECT_GT(file("many.png").size(), file("none.png").size()) << "there is more to see of 400 points than of two";
}

TEST_F(Program_annotate, points_that_are_too_few_are_outside_and_a_warning_says_so) {
  write_file(folder_ / "few.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n");
  const Result result = run({"annotate", "few.csv", "-o", "-", "--attributes", "status"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "x,y,z,status\n0,0,0,outside\n1,0,0,outside\n0,1,0,outside\n");
  EXPECT_EQ(result.error, "equiaffine: warning: 100 % of the vertices have no fit, which needs at least 15 connected "
                          "points nearby; give more points\n");
  run({"annotate", "few.csv", "-o", "few.ply", "--stats", "stats.json"});
  EXPECT_TRUE(Json::parse(file("stats.json")).at("fit").at("noise").is_null());
}

TEST_F(Program_annotate_long, doubts_of_affine_curvatures_are_left_out_where_none_are_written) {
  std::ostringstream noisy;
  for (int i = 0; i < 900; ++i) // a bowl with dents of a tenth of its depth, as long as the points are apart
    noisy << i % 30 << ' ' << i / 30 << ' ' << 0.02 * (i % 30) * (i % 30) + 0.7 * ((7 * i * i + i / 30) % 3) << '\n';
  write_file(folder_ / "noisy.xyz", noisy.str());
  const auto warnings = [&](const std::string& attributes) {
    return run({"annotate", "noisy.xyz", "-o", "out.csv", "--attributes", attributes}).error;
  };
  EXPECT_NE(warnings("basic").find("estimated error of the affine Gaussian curvature"), std::string::npos);
  EXPECT_NE(warnings("affine_gaussian_curvature").find("affine Gaussian curvature"), std::string::npos);
  for (const char* attributes : {"none", "mean_curvature", "status"}) EXPECT_EQ(warnings(attributes), "") << attributes;
}

TEST_F(Program_annotate_long, normals_that_contradict_are_warned_of) {
  make_surface("in.ply", "normal", "24");
  const Mesh exact = mesh("in.ply");
  const auto nx = column(exact, "nx"), ny = column(exact, "ny"), nz = column(exact, "nz");
  std::ostringstream agreeing, opposed;
  for (std::size_t i = 0; i < exact.mesh.points.size(); ++i) {
    const auto& p = exact.mesh.points[i];
    const double side = i % 3 == 0 ? -1 : 1;
    agreeing << p << ' ' << nx[i] << ' ' << ny[i] << ' ' << nz[i] << '\n';
    opposed << p << ' ' << side * nx[i] << ' ' << side * ny[i] << ' ' << side * nz[i] << '\n';
  }
  write_file(folder_ / "agreeing.xyz", agreeing.str());
  write_file(folder_ / "opposed.xyz", opposed.str());
  run_well({"annotate", "agreeing.xyz", "-o", "out.ply"});
  for (const Arguments& command : {Arguments{"annotate", "opposed.xyz"}, {"mesh", "--fit", "opposed.xyz"}}) {
    const Result result = run(command + Arguments{"-o", "out.ply"});
    EXPECT_NE(result.error.find("of the points have a normal opposite to that of the nearest point; orient"),
              std::string::npos)
        << result.error;
  }
}

TEST_F(Program_annotate_long, many_points_in_one_place_take_no_longer_than_one) {
  std::string text;
  for (int i = 0; i < 1000000; ++i) text += "1 2 3\n";
  write_file(folder_ / "place.xyz", text);
  const Result result = run({"annotate", "place.xyz", "-o", "out.ply", "--attributes", "status"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find("1000000 outside"), std::string::npos) << result.out;
  expect_error({"mesh", "--fit", "place.xyz", "-o", "mesh.ply"}, {"place.xyz", "enough", "more points"});
}

TEST_F(Program_annotate, what_cannot_be_used_is_refused) {
  write_file(folder_ / "in.xyz", "0 0 0\n1 0 0\n");
  write_file(folder_ / "bad.xyz", "0 0 0\n\n1 0 x\n");
  write_file(folder_ / "uneven.xyz", "0 0 0\n1 0 0 1\n");
  write_file(folder_ / "nan.csv", "x,y,z\n0,0,0\nnan,0,0\n");
  write_file(folder_ / "empty.csv", "x,y,z\n");
  write_file(folder_ / "broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  const Arguments to = {"-o", "out.ply"};
  expect_error(Arguments{"annotate"} + to, {"the mesh is missing"});
  expect_error({"annotate", "in.xyz"}, {"--output is missing"});
  expect_error(Arguments{"annotate", "in.xyz", "--scale", "-1"} + to,
               {"--scale", "'-1'", "not a length", "auto or none"});
  expect_error(Arguments{"annotate", "in.xyz", "--noise", "-1"} + to, {"--noise", "'-1'", "standard deviation"});
  expect_error(Arguments{"annotate", "in.xyz", "--degree", "7"} + to, {"--degree", "'7'", "4 or 5 or 6 or 8 or 10"});
  expect_error(Arguments{"annotate", "bad.xyz"} + to, {"'bad.xyz'", "line 3", "'x' is not a number"});
  expect_error(Arguments{"annotate", "uneven.xyz"} + to, {"'uneven.xyz'", "line 2 has 4 numbers"});
  expect_error(Arguments{"annotate", "nan.csv"} + to, {"'nan.csv'", "point 1", "not a finite number"});
  expect_error(Arguments{"annotate", "empty.csv"} + to, {"'empty.csv'", "no points"});
  expect_error(Arguments{"annotate", "broken.obj"} + to, {"broken.obj", "get the complete file again"});
  expect_error(Arguments{"annotate", "none.ply"} + to, {"'none.ply'", "no such file"});
  expect_error(Arguments{"annotate", "in.txt"} + to, {"'in.txt'", "extension", ".ply .off .obj .stl"});
  expect_error({"annotate", "in.xyz", "-o", "in.xyz"}, {"would overwrite an input"});
  expect_error({"annotate", "in.xyz", "-o", "out.stl"}, {"'out.stl'", "has no attributes", ".ply .csv"});
  EXPECT_EQ(file("in.xyz"), "0 0 0\n1 0 0\n");
}

} // namespace annotate_test
