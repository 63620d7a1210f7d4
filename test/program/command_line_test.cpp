// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/run_program.h"
#include "system/progress.h"
#include "volume/volume_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace command_line_test {

using namespace equiaffine::test;
using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

/// 1000 roundings: enough for every number compared here, at points where the invariants are well conditioned.
constexpr double rounding = 1000 * std::numeric_limits<double>::epsilon();

const Arguments sphere = {"--function", "x^2 + y^2 + z^2 = 1", "--box", "-1.5", "1.5", "-1.5", "1.5", "-1.5", "1.5"};
const Arguments delaunay = {"--method", "delaunay"};
const Arguments ellipsoid = {"--function", "x^2/4 + y^2 + 2*z^2 + x*y/3 = 1"};
const std::string basic_names = "nx,ny,nz,k1,k2,gaussian_curvature,mean_curvature,conormal_x,conormal_y,conormal_z,"
                                "affine_normal_x,affine_normal_y,affine_normal_z,affine_gaussian_curvature,"
                                "affine_mean_curvature,pick_invariant";
const std::string further_names =
    "affine_k1,affine_k2,direction1_x,direction1_y,direction1_z,direction2_x,direction2_y,"
    "direction2_z,metric_xx,metric_xy,metric_xz,metric_yy,metric_yz,metric_zz";
const std::string later_basic_names = "affine_normal_angle,affine_area_density";

Arguments operator+(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Arguments split(const std::string& text, char separator) {
  Arguments parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// The rows of a CSV text by the names of its header.
std::vector<std::map<std::string, std::string>> rows(const std::string& text) {
  std::vector<std::map<std::string, std::string>> table;
  const Arguments lines = split(text, '\n'), header = split(lines.at(0), ',');
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Arguments cells = split(lines[i], ',');
    EXPECT_EQ(cells.size(), header.size()) << lines[i];
    table.emplace_back();
    for (std::size_t c = 0; c < cells.size(); ++c) table.back()[header[c]] = cells[c];
  }
  return table;
}

class Program_command_line : public Program_test {
protected:
  Json stats_of(const Arguments& arguments) {
    run_well(Arguments{"mesh", "-o", "stats.off", "--stats", "stats.json"} + arguments);
    return Json::parse(file("stats.json"));
  }

  void expect_surface(const std::string& expression, double half_side, int components, int euler_characteristic) {
    const std::string low = std::to_string(-half_side), high = std::to_string(half_side);
    for (const char* attributes : {"basic", "none"}) {
      const Json stats =
          stats_of({"--function", expression, "--box", low, high, low, high, low, high, "--attributes", attributes});
      EXPECT_EQ(stats["components"], components) << expression;
      EXPECT_EQ(stats["euler_characteristic"], euler_characteristic) << expression;
      EXPECT_EQ(stats["boundary_edges"], 0) << expression;
      EXPECT_EQ(stats["manifold"], true) << expression;
      EXPECT_LE(stats["max_distance_to_surface"], 1e-13 * 2 * half_side * std::sqrt(3))
          << expression; // 1e-13 of the diagonal of the box
      EXPECT_EQ(stats["status"]["unconverged"], 0) << expression;
    }
  }

  /// The triangles of an OFF file.
  std::vector<std::array<std::array<double, 3>, 3>> triangles(const std::string& name) const {
    std::istringstream text(file(name));
    std::string word;
    std::size_t points = 0, faces = 0, three = 0;
    text >> word >> points >> faces >> three;
    std::vector<std::array<double, 3>> position(points);
    for (auto& [x, y, z] : position) text >> x >> y >> z;
    std::vector<std::array<std::array<double, 3>, 3>> result(faces);
    for (auto& triangle : result) {
      text >> three;
      for (auto& corner : triangle) {
        std::size_t index = 0;
        text >> index;
        corner = position.at(index);
      }
    }
    EXPECT_TRUE(text) << name;
    return result;
  }

  std::map<std::string, std::string> evaluate(const Arguments& arguments, const std::string& point) {
    const auto table =
        rows(run_well(Arguments{"evaluate", "--attributes", "all", "--points", "-", "-o", "-"} + arguments,
                      "x,y,z\n" + point + "\n"));
    EXPECT_EQ(table.size(), 1U);
    return table.at(0);
  }
};

TEST_F(Program_command_line, help_and_version_go_to_standard_output) {
  EXPECT_NE(run_well({"--help"}).find("Usage: equiaffine COMMAND"), std::string::npos);
  for (const char* command : {"mesh", "evaluate", "sample", "view", "annotate", "register", "symmetries"})
    EXPECT_NE(run_well({command, "--help"}).find("Usage: equiaffine " + std::string(command)), std::string::npos);
  EXPECT_TRUE(run_well({"--version"}).starts_with("equiaffine "));
}

TEST_F(Program_command_line, numbers_and_formulas_may_begin_with_a_minus_sign) {
  const Json plain = stats_of(
      {"--function", "x^2 + y^2 + z^2 - 0.5", "--box", "-1", "1", "-1", "1", "-1", "1", "--isovalue", "-0.25"});
  for (const char* isovalue : {"-.25", "-2.5e-1"}) {
    const Json stats = stats_of({"--function",
                                 "x^2 + y^2 + z^2 + c",
                                 "--set",
                                 "c=-.5",
                                 "--isovalue",
                                 isovalue,
                                 "--transform",
                                 "-1",
                                 "0",
                                 "0",
                                 "0",
                                 "-1.0",
                                 "-.0",
                                 "-0",
                                 "0",
                                 "-1e0",
                                 "--box",
                                 "-1",
                                 "1",
                                 "-1.0",
                                 "1",
                                 "-.1e1",
                                 "1"});
    EXPECT_EQ(stats["vertices"], plain["vertices"]);
    EXPECT_EQ(stats["components"], 1);
  }
  EXPECT_EQ(
      stats_of({"--function", "-x^2 - y^2 - z^2 + 1", "--box=-1.5", "1.5", "-1.5", "1.5", "-1.5", "1.5"})["components"],
      1);
}

TEST_F(Program_command_line, known_surfaces_have_their_topology_and_lie_on_the_surface) {
  expect_surface("x^2 + y^2 + z^2 = 1", 1.5, 1, 2);
  expect_surface("(x^2 + y^2 + z^2 + 0.75)^2 = 4*(x^2 + y^2)", 2, 1, 0);
  expect_surface("(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*x^2 - 45*y^2 - 45*z^2 + 6", 1.2, 2, 4);
  expect_surface("x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + 11.8", 3, 1, -8);
}

TEST_F(Program_command_line, vertices_that_STL_cannot_tell_apart_are_warned_of) {
  const auto warnings = [&](const std::string& name, const std::string& x, double center) {
    return run({"mesh", "-o", name, "--function", x + "^2+y^2+z^2-1", "--box", std::to_string(center - 2),
                std::to_string(center + 2), "-2", "2", "-2", "2", "--resolution", "40"})
        .error;
  };
  const std::string warning = warnings("far.stl", "(x-4e6)", 4e6);
  EXPECT_NE(warning.find("single precision"), std::string::npos) << warning;
  EXPECT_NE(warning.find(".ply"), std::string::npos) << warning;
  EXPECT_EQ(warnings("far.ply", "(x-4e6)", 4e6), "");
  EXPECT_EQ(warnings("near.stl", "x", 0), "");
}

TEST_F(Program_command_line, statistics_have_the_fields_of_the_contract) {
  const Json stats = stats_of(sphere + Arguments{"--resolution", "16"});
  for (const char* field :
       {"vertices", "faces", "components", "euler_characteristic", "boundary_edges", "function_evaluations"})
    EXPECT_TRUE(stats.at(field).is_number_integer()) << field;
  EXPECT_TRUE(stats.at("manifold").is_boolean());
  EXPECT_TRUE(stats.at("max_distance_to_surface").is_number());
  ASSERT_EQ(stats.at("status").size(), 5U);
  for (const char* word : {"regular", "parabolic", "singular", "outside", "unconverged"})
    EXPECT_EQ(stats["status"].at(word), word == std::string("regular") ? stats["vertices"].get<int>() : 0);
  EXPECT_FALSE(stats.contains("certified")) << "Marching Cubes proves nothing";
  for (const char* stage : {"sample", "project", "annotate", "write"}) EXPECT_GE(stats.at("seconds").at(stage), 0.);
  EXPECT_EQ(split(file("stats.off"), '\n').at(1),
            std::to_string(stats["vertices"].get<int>()) + " " + std::to_string(stats["faces"].get<int>()) + " 0");
}

TEST_F(Program_command_line, vertices_left_linear_are_off_the_surface_and_regular) {
  const Json stats = stats_of(sphere + Arguments{"--vertices", "linear"});
  EXPECT_EQ(stats["status"]["regular"], stats["vertices"]);
  EXPECT_GT(stats["max_distance_to_surface"], 1e-5); // h^2 / 8 is 3e-4 for spacing h = 3 / 63
  EXPECT_LT(stats["max_distance_to_surface"], 3e-4);
}

TEST_F(Program_command_line, a_PLY_has_the_names_of_the_contract_in_order) {
  run_well(Arguments{"mesh", "-o", "s.ply", "--attributes", "all", "--resolution", "8"} + sphere);
  const std::string text = file("s.ply"), header = text.substr(0, text.find("end_header\n"));
  std::string names;
  for (const std::string& line : split(header, '\n'))
    if (line.starts_with("property double ")) names += line.substr(16) + ",";
  EXPECT_EQ(names, "x,y,z," + basic_names + "," + further_names + "," + later_basic_names + ",");
  EXPECT_TRUE(header.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_NE(header.find("affine_area_density\nproperty uchar status\nelement face "), std::string::npos);
  EXPECT_TRUE(header.ends_with("\nproperty list uchar int vertex_indices\n"));
}

TEST_F(Program_command_line, attributes_can_be_chosen) {
  const auto header = [&](const Arguments& choice) {
    run_well(Arguments{"mesh", "-o", "s.csv", "--resolution", "4"} + sphere + choice);
    return split(file("s.csv"), '\n').at(0);
  };
  EXPECT_EQ(header({}), "x,y,z," + basic_names + "," + later_basic_names + ",status");
  EXPECT_EQ(header({"--attributes", "all"}),
            "x,y,z," + basic_names + "," + further_names + "," + later_basic_names + ",status");
  EXPECT_EQ(header({"--attributes", "none"}), "x,y,z");
  EXPECT_EQ(header({"--attributes", "k2,normal"}), "x,y,z,k2,nx,ny,nz,status");
}

// The sphere of radius 1: all estimators agree where f_z is large; where it is small, z alone loses digits; and on the
// equator the paper's formulas along z have no value, as the status says.
TEST_F(Program_command_line, the_estimators_of_the_paper_can_be_chosen) {
  const auto row = [&](const std::string& estimator, const std::string& point) {
    return rows(
               run_well({"evaluate", "--function", "x^2+y^2+z^2", "--estimator", estimator, "--points", "-", "-o", "-"},
                        "x,y,z\n" + point + "\n"))
        .at(0);
  };
  for (const char* estimator : {"compact", "transformation", "direct", "direct-z"}) {
    auto attributes = row(estimator, "0.48,0.36,0.8");
    EXPECT_NEAR(std::stod(attributes["affine_gaussian_curvature"]), 1, rounding) << estimator;
    EXPECT_NEAR(std::stod(attributes["affine_mean_curvature"]), -1, rounding) << estimator;
    EXPECT_NEAR(std::stod(attributes["affine_normal_x"]), 0.48, rounding) << estimator;
    EXPECT_EQ(attributes["status"], "regular") << estimator;
  }
  const std::string near_equator = "0.6,0.79999999,0.0001264911";
  EXPECT_NEAR(std::stod(row("direct", near_equator)["affine_gaussian_curvature"]), 1, 1e-7);
  EXPECT_NE(row("direct", near_equator), row("direct-z", near_equator));
  EXPECT_EQ(row("direct", "0.6,0.8,0")["status"], "regular");
  EXPECT_EQ(row("direct-z", "0.6,0.8,0")["status"], "outside");
  EXPECT_EQ(row("direct-z", "0.6,0.8,0")["affine_gaussian_curvature"], "nan");

  const auto mesh = [&](const Arguments& choice) {
    run_well(Arguments{"mesh", "-o", "s.csv", "--resolution", "5"} + sphere + choice);
    return file("s.csv");
  };
  EXPECT_EQ(mesh({"--estimator", "compact"}), mesh({}));
  EXPECT_NE(mesh({"--estimator", "transformation"}), mesh({}));
}

TEST_F(Program_command_line, evaluate_keeps_rows_columns_and_order) {
  const std::string out =
      run_well({"evaluate", "--function", "x^2 + y^2 + z^2", "--attributes", "k1", "--points", "-", "-o", "-"},
               "name,z,y,x,k1\nfar,0,0,-4,old\n\"a, b\",1,0,0,old\norigin,0,0,0,old\nfar,0,0,-4,old\n");
  EXPECT_EQ(out, "name,z,y,x,k1,status\nfar,0,0,-4,-0.25,regular\n\"a, b\",1,0,0,-1,regular\n"
                 "origin,0,0,0,nan,singular\nfar,0,0,-4,-0.25,regular\n");
}

TEST_F(Program_command_line, evaluate_writes_the_whole_header_for_no_points) {
  const Arguments arguments = {"evaluate", "--function", "x", "--attributes", "k1", "--points", "-", "-o"};
  EXPECT_EQ(run_well(arguments + Arguments{"-"}, "name,x,y,z\n"), "name,x,y,z,k1,status\n");
  run_well(arguments + Arguments{"p.ply"}, "x,y,z\n");
  EXPECT_NE(file("p.ply").find("element vertex 0\nproperty double x\nproperty double y\nproperty double z\n"
                               "property double k1\nproperty uchar status\nelement face 0\n"),
            std::string::npos);
  EXPECT_EQ(run_well({"evaluate", "--function", "x", "--points", "p.ply", "--attributes", "none", "-o", "-"}),
            "x,y,z,k1,status\n");
}

TEST_F(Program_command_line, points_without_finite_coordinates_are_outside) {
  write_file(folder_ / "p.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
                                "property double z\nend_header\nnan 0 0\n0 inf 0\n0 0 -inf\n0.5 0.5 0.5\n");
  const Arguments choice = {"evaluate", "--points", "p.ply", "--attributes", "nx,k1", "-o", "-"};
  const Arguments transformation = {"--transform", "1", "1", "0", "0", "1", "0", "0", "0", "2"};
  const Arguments spline = {"--derivatives", "spline", "--resolution", "24"};
  for (const Arguments& way : {Arguments{}, transformation, spline, spline + transformation}) {
    const auto table = rows(run_well(choice + sphere + way));
    ASSERT_EQ(table.size(), 4U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(table[i].at("status"), "outside") << i;
      EXPECT_EQ(table[i].at("nx") + table[i].at("k1"), "nannan") << i;
    }
    EXPECT_EQ(table[3].at("status"), "regular");
  }
  const std::string cells = "x,y,z\nnan,0,0\n0,-nan,0\n0,0,-inf\n";
  for (const auto& row : rows(run_well(Arguments{"evaluate", "--points", "-", "-o", "-"} + sphere, cells))) {
    EXPECT_EQ(row.at("status"), "outside");
    EXPECT_EQ(row.at("k1"), "nan");
  }
}

TEST_F(Program_command_line, evaluate_writes_PLY_from_CSV_and_back) {
  write_file(folder_ / "p.csv", "x,y,z,weight\n1,2,3,7\n-1,.5,2,8\n");
  const Arguments choice = {"--attributes", "mean_curvature"};
  run_well(Arguments{"evaluate", "--points", "p.csv", "-o", "p.ply"} + ellipsoid + choice);
  EXPECT_NE(file("p.ply").find("property double weight\nproperty double mean_curvature\nproperty uchar status\n"),
            std::string::npos);
  run_well(Arguments{"evaluate", "--points", "p.ply", "-o", "again.csv"} + ellipsoid + choice);
  run_well(Arguments{"evaluate", "--points", "p.csv", "-o", "direct.csv"} + ellipsoid + choice);
  const auto again = rows(file("again.csv")), direct = rows(file("direct.csv"));
  ASSERT_EQ(again.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].at("mean_curvature"), direct[i].at("mean_curvature"));
    EXPECT_EQ(std::stod(again[i].at("weight")), std::stod(direct[i].at("weight")));
  }
}

TEST_F(Program_command_line, a_transform_may_have_a_translation) {
  const Arguments square = {"--function", "x^2 + y^2 + z^2"},
                  map = {"--transform", "1", "0", "0", "0", "1", "0", "0", "0", "2", "-.5", "-1e1", "-.25"};
  const auto at_origin = evaluate(square + Arguments(map.begin(), map.begin() + 10), ".5,1,1.5"),
             translated = evaluate(map + square, "0,-9,1.25");
  EXPECT_EQ(translated.at("status"), "regular");
  for (const char* name : {"gaussian_curvature", "affine_mean_curvature", "nx", "ny", "nz"})
    EXPECT_NEAR(std::stod(at_origin.at(name)), std::stod(translated.at(name)), 1e-13) << name;
}

TEST_F(Program_command_line, a_transform_changes_affine_curvatures_by_their_weights) {
  // |det A| = 6; the image of (0.5, 0.6, 0.4) is (1.6, 1.2, 1.2).
  const auto before = evaluate(ellipsoid, "0.5,0.6,0.4");
  const auto after =
      evaluate(ellipsoid + Arguments{"--transform", "2", "1", "0", "0", "-2", "6", "0", "0", "-1.5"}, "1.6,1.2,-.6");
  const auto ratio = [&](const std::string& name) { return std::stod(after.at(name)) / std::stod(before.at(name)); };
  EXPECT_NEAR(ratio("affine_gaussian_curvature") * 6, 1, rounding);
  EXPECT_NEAR(ratio("affine_mean_curvature") * std::sqrt(6), 1, rounding);
  EXPECT_EQ(after.at("status"), "regular");
}

TEST_F(Program_command_line, orientation_against_the_gradient_changes_signs) {
  const auto along = evaluate(ellipsoid, "0.5,0.6,0.4"),
             against = evaluate(ellipsoid + Arguments{"--orientation", "against"}, "0.5,0.6,0.4");
  for (const std::string name :
       {"nx", "mean_curvature", "affine_mean_curvature", "conormal_x", "affine_normal_y", "metric_xx"})
    EXPECT_DOUBLE_EQ(std::stod(against.at(name)), -std::stod(along.at(name))) << name;
  for (const std::string name : {"gaussian_curvature", "affine_gaussian_curvature"})
    EXPECT_DOUBLE_EQ(std::stod(against.at(name)), std::stod(along.at(name))) << name;
}

TEST_F(Program_command_line, the_number_of_threads_changes_no_bit) {
  for (const std::string threads : {"1", "2"}) { // a page is named after the mesh
    std::filesystem::create_directory(folder_ / threads);
    run_well(Arguments{"mesh", "-o", threads + "/s.ply", "--html", threads + "/s.html", "--threads", threads} + sphere);
    run_well(Arguments{"mesh", "--derivatives", "spline", "--resolution", "24", "-o", threads + "/s.csv", "--threads",
                       threads} +
             sphere);
  }
  for (const std::string name : {"s.ply", "s.html", "s.csv"}) EXPECT_EQ(file("1/" + name), file("2/" + name)) << name;
}

TEST_F(Program_command_line, standard_output_carries_one_file_and_nothing_else) {
  run_well(Arguments{"mesh", "-o", "s.off", "--resolution", "8"} + sphere);
  EXPECT_EQ(run_well(Arguments{"mesh", "-o", "-", "--resolution", "8"} + sphere), file("s.off"));
  run_well(Arguments{"mesh", "-o", "s.off", "--resolution", "8", "--stats", "-"} + sphere);
  EXPECT_EQ(Json::parse(
                run_well(Arguments{"mesh", "-o", "s.off", "--resolution", "8", "--stats", "-"} + sphere))["components"],
            1);
}

TEST_F(Program_command_line, a_page_is_made_with_the_mesh_or_from_it_later) {
  run_well(Arguments{"mesh", "-o", "s.ply", "--html", "s.html", "--resolution", "8", "--color", "k1"} + sphere);
  run_well({"view", "s.ply", "-o", "later.html", "--color", "k1", "--up", "z"});
  const std::string page = file("s.html"), later = file("later.html");
  const auto data = [](const std::string& text) {
    const std::size_t begin = text.find("<script type=\"application/json\"");
    return text.substr(begin);
  };
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(page.find("x^2 + y^2 + z^2 = 1"), std::string::npos);
  EXPECT_EQ(data(page), data(later));
  EXPECT_NE(page.find("<title>s</title>"), std::string::npos);
}

TEST_F(Program_command_line, attributes_that_are_written_as_they_are_computed_are_those_that_are_kept_for_a_page) {
  // The sphere has more vertices than are computed at once.
  const Arguments mesh = Arguments{"mesh", "--resolution", "520", "--attributes", "k1,status"} + sphere;
  const std::string alone = run_well(mesh + Arguments{"-o", "alone.ply", "--stats", "alone.json"});
  const std::string with_page = run_well(mesh + Arguments{"-o", "paged.ply", "--html", "page.html"});
  EXPECT_GT(file("alone.ply").size(), (std::size_t(1) << 19) * (33 + 2 * 13)) << "a row has 33 bytes, a triangle 13";
  EXPECT_EQ(file("alone.ply"), file("paged.ply"));
  const auto first_lines = [](const std::string& text) { return text.substr(0, text.find("wrote")); };
  EXPECT_EQ(first_lines(alone), first_lines(with_page));
}

TEST_F(Program_command_line, a_page_of_samples_has_the_errors_that_the_mesh_gets_on_request_only) {
  const Arguments mesh = Arguments{"mesh", "-o", "s.ply", "--html", "s.html", "--resolution", "16"} + sphere;
  const std::string errors = "affine_gaussian_curvature_error";
  const auto has_errors = [&](const char* name) { return file(name).find(errors) != std::string::npos; };
  run_well(mesh + Arguments{"--derivatives", "spline"});
  EXPECT_TRUE(has_errors("s.html"));
  EXPECT_FALSE(has_errors("s.ply"));
  run_well(mesh + Arguments{"--derivatives", "spline", "--attributes", "affine_gaussian_curvature," + errors});
  EXPECT_TRUE(has_errors("s.html"));
  EXPECT_TRUE(has_errors("s.ply"));
  run_well(mesh);
  EXPECT_FALSE(has_errors("s.html"));
}

TEST_F(Program_command_line, two_pages_can_share_a_range) {
  run_well(Arguments{"mesh", "-o", "s.ply", "--html", "s.html", "--resolution", "8", "--range", "-3", "0.5"} + sphere);
  run_well({"view", "s.ply", "-o", "later.html", "--range", "-3", "0.5"});
  for (const char* name : {"s.html", "later.html"})
    EXPECT_NE(file(name).find("\"range\":[-3,0.5]"), std::string::npos) << name;
}

#ifdef EQUIAFFINE_WITH_VTK
TEST_F(Program_command_line, a_picture_is_made_with_the_mesh_or_from_it_later_without_a_display) {
  const Arguments options = {"--color", "k1", "--up", "y", "--size", "120", "150", "--arrows", "affine_normal"};
  run_well(Arguments{"mesh", "-o", "s.ply", "--png", "s.png", "--resolution", "8"} + sphere + options);
  EXPECT_EQ(run_well(Arguments{"view", "s.ply", "--png", "later.png"} + options), "wrote later.png\n");
  const std::string picture = file("s.png");
  ASSERT_GT(picture.size(), 1000U);
  EXPECT_EQ(picture.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(picture.substr(16, 8), std::string("\0\0\0\x78\0\0\0\x96", 8)) << "120 by 150";
  EXPECT_EQ(picture, file("later.png"));
  run_well(Arguments{"view", "s.ply", "--png", "range.png", "--range", "-2", "2"} + options);
  EXPECT_NE(picture, file("range.png"));
}

TEST_F(Program_command_line, a_picture_shows_the_parabolic_curves_that_are_computed) {
  const Arguments torus = {"mesh",
                           "-o",
                           "t.off",
                           "--function",
                           "(sqrt(x^2+y^2)-0.5)^2 + z^2 - 0.04",
                           "--box",
                           "-1",
                           "1",
                           "-1",
                           "1",
                           "-1",
                           "1",
                           "--resolution",
                           "24",
                           "--color",
                           "plain",
                           "--size",
                           "100",
                           "100"};
  run_well(torus + Arguments{"--png", "without.png"});
  run_well(torus + Arguments{"--png", "with.png", "--parabolic-curves", "c.obj"});
  EXPECT_NE(file("without.png"), file("with.png"));
}
#endif

TEST_F(Program_command_line, the_signature_is_computed_on_request_alone) {
  const std::string names = "affine_gaussian_curvature,affine_mean_curvature,pick_invariant";
  const std::string header = "x,y,z," + names + ",affine_gaussian_curvature_gradient,affine_mean_curvature_gradient," +
                             "pick_invariant_gradient,status";
  const Arguments evaluate = {"evaluate", "--function", "x*y*z + x^3", "--points", "-", "-o", "-", "--attributes"};
  const std::string signature = run_well(evaluate + Arguments{"signature"}, "x,y,z\n1,2,3\n");
  EXPECT_EQ(signature.substr(0, signature.find('\n')), header);
  const auto row = rows(signature).at(0);
  for (const char* name : {"affine_gaussian_curvature", "affine_mean_curvature", "pick_invariant"})
    EXPECT_GT(std::stod(row.at(std::string(name) + "_gradient")), 0) << name;
  const std::string one = run_well(evaluate + Arguments{"pick_invariant_gradient"}, "x,y,z\n1,2,3\n");
  EXPECT_EQ(rows(one).at(0).at("pick_invariant_gradient"), row.at("pick_invariant_gradient"));
  EXPECT_EQ(run_well(evaluate + Arguments{"all"}, "x,y,z\n").find("gradient"), std::string::npos);
  EXPECT_EQ(run_well(evaluate + Arguments{"quadric_defect"}, "x,y,z\n"), "x,y,z,quadric_defect,status\n");
}

TEST_F(Program_command_line, the_parabolic_curves_of_a_torus_are_two_closed_ones) {
  const Arguments torus = {"mesh",
                           "-o",
                           "t.off",
                           "--function",
                           "(x^2 + y^2 + z^2 + 0.75)^2 = 4*(x^2 + y^2)",
                           "--box",
                           "-2",
                           "2",
                           "-2",
                           "2",
                           "-1",
                           "1",
                           "--resolution",
                           "24",
                           "--parabolic-curves"};
  EXPECT_NE(run_well(torus + Arguments{"c.obj"}).find("\n2 parabolic curves\nwrote t.off\nwrote c.obj\n"),
            std::string::npos);
  std::size_t curves = 0;
  for (const std::string& line : split(file("c.obj"), '\n')) {
    const Arguments words = split(line, ' ');
    if (words.at(0) == "v") {
      EXPECT_NEAR(std::hypot(std::stod(words.at(1)), std::stod(words.at(2))), 1, rounding);
      EXPECT_NEAR(std::abs(std::stod(words.at(3))), 0.5, rounding);
    } else {
      EXPECT_EQ(words.at(0), "l");
      EXPECT_EQ(words.at(1), words.back());
      ++curves;
    }
  }
  EXPECT_EQ(curves, 2U);
  EXPECT_EQ(run_well(torus + Arguments{"-", "--transform", "1", "0", "0", "0", "1", "0", "0", "0", "1"}),
            file("c.obj"));
}

TEST_F(Program_command_line, a_surface_without_parabolic_curves_gives_an_empty_file) {
  const std::string out = run_well(Arguments{"mesh", "-o", "s.off", "--html", "s.html", "--parabolic-curves", "c.obj",
                                             "--stats", "s.json", "--resolution", "9"} +
                                   sphere);
  EXPECT_NE(out.find("\n0 parabolic curves\n"), std::string::npos);
  EXPECT_EQ(names(), (Arguments{"c.obj", "s.html", "s.json", "s.off"}));
  EXPECT_EQ(file("c.obj"), "");
  EXPECT_EQ(Json::parse(file("s.json"))["components"], 1);
  EXPECT_TRUE(file("s.html").starts_with("<!DOCTYPE html>"));
}

TEST_F(Program_command_line, the_largest_components_are_kept_on_request) {
  const Arguments three_spheres = {"--function", "min(x^2+y^2+z^2-.04, (x-1)^2+y^2+z^2-.25, (x+1)^2+y^2+z^2-.09)",
                                   "--box",      "-2",
                                   "2",          "-2",
                                   "2",          "-2",
                                   "2",          "--largest"};
  const auto largest_x = [&](const Arguments& options, std::size_t left, std::size_t left_out) {
    const Json stats = stats_of(three_spheres + options);
    EXPECT_EQ(stats["components"], left);
    EXPECT_EQ(stats["components_left_out"], left_out);
    EXPECT_EQ(stats["euler_characteristic"], 2 * left);
    EXPECT_EQ(stats["boundary_edges"], 0);
    double sum = 0, count = 0;
    for (const std::string& line : split(file("stats.off"), '\n'))
      if (split(line, ' ').size() == 3 && line.find('.') != std::string::npos) sum += std::stod(line), ++count;
    return sum / count;
  };
  EXPECT_NEAR(largest_x({"1"}, 1, 2), 1, 1e-2);
  EXPECT_NEAR(largest_x(Arguments{"1"} + delaunay, 1, 2), 1, 2e-2);
  EXPECT_GT(largest_x({"2"}, 2, 1), 0);
  largest_x({"3"}, 3, 0);
  largest_x({"9"}, 3, 0);
  const std::string out = run_well(Arguments{"mesh", "-o", "s.off"} + three_spheres + Arguments{"2"});
  EXPECT_NE(out.find(" 2 components, 1 smaller one left out, Euler characteristic 4, closed"), std::string::npos)
      << out;
}

TEST_F(Program_command_line, a_Delaunay_mesh_misses_nothing_and_says_so) {
  const Arguments two_spheres = {
      "--function", "min(x^2+y^2+z^2-1, (x-1.31)^2+(y-0.73)^2+z^2-1e-5)", "--box", "-2", "2", "-2", "2", "-2", "2"};
  EXPECT_EQ(stats_of(two_spheres + Arguments{"--resolution", "16"})["components"], 1) << "the test shows nothing";
  const Json stats = stats_of(two_spheres + delaunay);
  EXPECT_EQ(stats["components"], 2);
  EXPECT_EQ(stats["euler_characteristic"], 4);
  EXPECT_EQ(stats["boundary_edges"], 0);
  EXPECT_EQ(stats["manifold"], true);
  EXPECT_EQ(stats["certified"], true);
  EXPECT_EQ(stats["undecided_boxes"], Json::array());
  EXPECT_LE(stats["max_distance_to_surface"], 1e-14);
  EXPECT_NE(run_well(Arguments{"mesh", "-o", "s.off"} + two_spheres + delaunay).find("\ncertified: "),
            std::string::npos);
}

TEST_F(Program_command_line, a_Delaunay_mesh_of_a_singular_surface_has_undecided_boxes) {
  const Arguments cone = {"--function", "x^2+y^2=z^2", "--box", "-1", "1.1", "-1.2", "1.3", "-1.4", "1.5"};
  const Json stats = stats_of(cone + delaunay);
  EXPECT_EQ(stats["certified"], false);
  ASSERT_GT(stats["undecided_boxes"].size(), 0U);
  for (const Json& box : stats["undecided_boxes"]) { // in the order of --box
    ASSERT_EQ(box.size(), 6U);
    for (const std::size_t a : {0u, 2u, 4u}) {
      EXPECT_LT(box.at(a), box.at(a + 1));
      EXPECT_LT(std::abs(box.at(a).get<double>()), 0.05) << "far from the apex";
    }
  }
  EXPECT_NE(run_well(Arguments{"mesh", "-o", "s.off"} + cone + delaunay).find("\nnot certified: "), std::string::npos);
}

TEST_F(Program_command_line, a_Delaunay_mesh_satisfies_its_criteria) {
  const double diagonal = 3 * std::sqrt(3.0);
  const auto expect_criteria = [&](const Arguments& arguments, double angle, double radius, double distance) {
    stats_of(sphere + delaunay + arguments);
    std::size_t number = 0;
    for (const auto& [p, q, r] : triangles("stats.off")) {
      const auto length = [](const auto& a, const auto& b) {
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      };
      std::array<double, 3> side = {length(p, q), length(q, r), length(r, p)};
      std::sort(side.begin(), side.end());
      const auto& [a, b, c] = side;
      const double cosine = (b * b + c * c - a * a) / (2 * b * c);
      const double circumradius = a / (2 * std::sqrt(1 - cosine * cosine));
      EXPECT_LE(cosine, std::cos(angle * std::numbers::pi / 180) + 1e-9);
      EXPECT_LE(circumradius, radius);
      EXPECT_LE(1 - std::sqrt(1 - circumradius * circumradius), distance);
      ++number;
    }
    return double(number);
  };
  const double usual = expect_criteria({}, 30, diagonal / 50, diagonal / 500);
  EXPECT_NEAR(expect_criteria({"--radius", ".0519615"}, 30, .0519615, .00519615), 4 * usual, 0.4 * usual);
  EXPECT_GT(expect_criteria({"--angle", "20", "--distance", "1e-3"}, 20, diagonal / 50, 1e-3), 2 * usual);
}

TEST_F(Program_command_line, a_Delaunay_mesh_follows_the_curvature_on_request) {
  const Arguments long_one = {"--function", "x^2 + y^2/9 + z^2 = 1",
                              "--box",      "-1.5",
                              "1.5",        "-3.5",
                              "3.5",        "-1.5",
                              "1.5",        "--radius",
                              "0.3",        "--distance",
                              "1"};
  const auto faces = [&](const std::string& sizing) {
    return stats_of(long_one + delaunay + Arguments{"--sizing", sizing})["faces"].get<int>();
  };
  EXPECT_EQ(faces("uniform"), stats_of(long_one + delaunay)["faces"]);
  EXPECT_GT(faces("euclidean"), faces("uniform"));
  EXPECT_NE(faces("affine"), faces("uniform"));
  EXPECT_NE(faces("affine"), faces("euclidean"));
}

TEST_F(Program_command_line, a_Delaunay_mesh_is_cut_off_at_the_box_or_at_a_ball) {
  const Arguments plane = {"--function", "x + y/9 - 0.1", "--box", "-2", "2", "-1", "1", "-1.5", "1.5"};
  const auto farthest = [&](const std::string& clip) {
    const Json stats = stats_of(plane + delaunay + Arguments{"--clip", clip});
    EXPECT_EQ(stats["components"], 1);
    EXPECT_EQ(stats["euler_characteristic"], 1);
    double distance = 0;
    for (const auto& triangle : triangles("stats.off"))
      for (const auto& [x, y, z] : triangle) distance = std::max(distance, std::hypot(x, y, z));
    return distance;
  };
  EXPECT_GT(farthest("box"), 1.5);
  EXPECT_LE(farthest("ball"), 1 + 1e-15);
  EXPECT_GT(farthest("ball"), 0.9);
}

TEST_F(Program_command_line, every_kind_of_source_has_a_Delaunay_mesh) {
  const Arguments grid = {"--resolution", "24"};
  const auto expect_sphere = [&](const Arguments& source) {
    const Json stats = stats_of(source + delaunay);
    EXPECT_EQ(stats["components"], 1);
    EXPECT_EQ(stats["euler_characteristic"], 2);
    EXPECT_EQ(stats["boundary_edges"], 0);
    EXPECT_LE(stats["max_distance_to_surface"], 1e-13);
    EXPECT_EQ(stats["certified"], true);
    EXPECT_EQ(stats["undecided_boxes"].size(), 0U);
  };
  expect_sphere(sphere + grid + Arguments{"--derivatives", "spline"});
  run_well(Arguments{"mesh", "-o", "sphere.off"} + sphere);
  expect_sphere(Arguments{"--distance-to", "sphere.off"} + grid);
#ifdef EQUIAFFINE_WITH_VTK
  run_well(Arguments{"sample", "-o", "sphere.vti"} + sphere + grid);
  expect_sphere({"--volume", "sphere.vti", "--orientation", "against"});
#endif
}

TEST_F(Program_command_line, all_outputs_are_made_of_a_Delaunay_mesh_too) {
  const Arguments torus = Arguments{"mesh",   "-o",         "t.csv",
                                    "--html", "t.html",     "--parabolic-curves",
                                    "c.obj",  "--function", "(x^2 + y^2 + z^2 + 0.75)^2 = 4*(x^2 + y^2)",
                                    "--box",  "-2",         "2",
                                    "-2",     "2",          "-1",
                                    "1"} +
                          delaunay;
  EXPECT_NE(run_well(torus).find("\n2 parabolic curves\nwrote t.csv\nwrote t.html\nwrote c.obj\n"), std::string::npos);
  for (const std::string& line : split(file("c.obj"), '\n')) {
    const Arguments words = split(line, ' ');
    if (words.at(0) == "v") {
      EXPECT_NEAR(std::abs(std::stod(words.at(3))), 0.5, rounding);
    }
  }
  const std::string along = file("t.csv");
  EXPECT_TRUE(file("t.html").starts_with("<!DOCTYPE html>"));
  run_well(torus + Arguments{"--threads", "1"});
  EXPECT_EQ(file("t.csv"), along);
  run_well(torus + Arguments{"--orientation", "against"});
  const auto first = rows(along), second = rows(file("t.csv"));
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(std::stod(first[i].at("nx")), -std::stod(second[i].at("nx"))) << "the mesh is the same";
}

TEST_F(Program_command_line, standard_input_may_be_a_mesh) {
  const std::string cube = "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                           "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  write_file(folder_ / "cube.off", cube);
  const Arguments options = {"--resolution", "17", "--attributes", "none", "-o", "-", "--distance-to"};
  EXPECT_EQ(run_well(Arguments{"mesh"} + options + Arguments{"-"}, cube),
            run_well(Arguments{"mesh"} + options + Arguments{"cube.off"}));
  const Arguments evaluate = {"evaluate", "--function", "x + y", "--attributes", "nx", "-o", "-", "--points"};
  run_well({"evaluate", "--function", "x", "--attributes", "none", "--points", "cube.off", "-o", "cube.ply"});
  const std::string expected = run_well(evaluate + Arguments{"cube.off"});
  EXPECT_EQ(rows(expected).size(), 8U);
  EXPECT_EQ(run_well(evaluate + Arguments{"-"}, cube), expected);
  EXPECT_EQ(run_well(evaluate + Arguments{"-"}, file("cube.ply")), expected);
}

TEST_F(Program_command_line, any_axis_may_point_up_on_a_page) {
  run_well(Arguments{"mesh", "-o", "s.ply", "--html", "usual.html", "--resolution", "8"} + sphere);
  EXPECT_NE(file("usual.html").find("\"up\":[0,0,1]"), std::string::npos);
  run_well(Arguments{"mesh", "-o", "s.ply", "--html", "s.html", "--resolution", "8", "--up", "y"} + sphere);
  EXPECT_NE(file("s.html").find("\"up\":[0,1,0]"), std::string::npos);
  run_well({"view", "s.ply", "-o", "guessed.html"});
  EXPECT_NE(file("guessed.html").find("\"up\":[0,1,0]"), std::string::npos) << "a ball stands on nothing";
  run_well({"view", "s.ply", "-o", "later.html", "--up", "x"});
  EXPECT_NE(file("later.html").find("\"up\":[1,0,0]"), std::string::npos);
}

TEST_F(Program_command_line, a_page_can_have_the_colors_of_another_page_or_of_a_mesh) {
  const auto mapping_of = [&](const std::string& page) { // range, scale and ranks of the affine Gaussian curvature
    const std::string text = file(page), begin = "<script type=\"application/json\" id=\"facts\">";
    const auto at = text.find(begin) + begin.size();
    const Json facts = Json::parse(text.substr(at, text.find("</script>", at) - at));
    for (const Json& column : facts.at("columns"))
      if (column.at("name") == "affine_gaussian_curvature") {
        const Json& ranges = column.at("ranges");
        return Json{ranges.at(ranges.size() == 1 ? 0 : 5), column.at("knots")};
      }
    return Json();
  };
  const Arguments torus = {
      "--function", "(sqrt(x^2+y^2)-0.5)^2 + z^2 - 0.04", "--box", "-1", "1", "-1", "1", "-1", "1", "--resolution",
      "24"};
  run_well(Arguments{"mesh", "-o", "t.ply", "--html", "t.html"} + torus);
  run_well(Arguments{"mesh", "-o", "s.ply", "--html", "own.html", "--resolution", "8"} + sphere);
  for (const char* other : {"t.html", "t.ply"}) {
    run_well({"view", "s.ply", "-o", "s.html", "--range-of", other});
    EXPECT_EQ(mapping_of("s.html"), mapping_of("t.html")) << other;
  }
  EXPECT_NE(mapping_of("own.html"), mapping_of("t.html"));
}

TEST_F(Program_command_line, the_scale_of_colors_can_be_chosen) {
  run_well(Arguments{"mesh", "-o", "s.ply", "--html", "s.html", "--resolution", "8"} + sphere);
  EXPECT_NE(file("s.html").find("\"scale\":\"auto\""), std::string::npos);
  run_well({"view", "s.ply", "-o", "equal.html", "--colors", "equalized"});
  EXPECT_NE(file("equal.html").find("\"range\":null,\"scale\":\"equalized\""), std::string::npos);
}

TEST_F(Program_command_line, a_run_that_is_interrupted_leaves_nothing_behind) {
  using namespace std::chrono_literals;
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child =
        start(Arguments{"mesh", "-o", "s.ply", "--html", "s.html", "--resolution", "400", "--threads", "1"} + sphere);
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (names().size() < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(5ms);
    EXPECT_EQ(names().size(), 2U) << "a temporary folder for each output";
    ::kill(child, signal);
    EXPECT_EQ(wait_for(child).status, 128 + signal);
    EXPECT_EQ(names(), Arguments());
  }
}

#ifdef EQUIAFFINE_WITH_ITK
TEST_F(Program_command_line, a_volume_sampled_and_read_again_gives_the_same_surface) {
  const Arguments surface = {"--resolution", "20",   "18",  "22",   "--function", "x^2 + y^2 + 2*z^2 + x*y = 1",
                             "--box",        "-1.5", "1.4", "-1.3", "1.6",        "-1",
                             "1.1"};
  run_well(Arguments{"mesh", "--derivatives", "spline", "-o", "direct.csv"} + surface);
  run_well(Arguments{"sample", "-o", "v.nrrd"} + surface);
  run_well({"mesh", "--volume", "v.nrrd", "-o", "read.csv"});
  const auto direct = rows(file("direct.csv")), read = rows(file("read.csv"));
  ASSERT_EQ(direct.size(), read.size());
  ASSERT_GT(direct.size(), 100U);
  for (std::size_t i = 0; i < direct.size(); ++i)
    for (const std::string name : {"x", "y", "z", "mean_curvature"})
      EXPECT_NEAR(std::stod(read[i].at(name)), std::stod(direct[i].at(name)), 1e6 * rounding)
          << name; // the file has the spacings as rounded decimals
}

TEST_F(Program_command_line, a_volume_of_two_nodes_per_axis_is_extracted_without_attributes) {
  run_well({"sample", "--function", "x + y + z", "--box", "0", "1", "0", "1", "0", "1", "--resolution", "2", "-o",
            "v.nrrd"});
  const Json stats = stats_of({"--volume", "v.nrrd", "--isovalue", "1.5", "--attributes", "none"});
  EXPECT_EQ(stats["vertices"], 6);
  EXPECT_EQ(stats["status"]["outside"], 6);
  EXPECT_EQ(stats["euler_characteristic"], 1);
  EXPECT_TRUE(stats["max_distance_to_surface"].is_null());
  const Result result = run({"mesh", "--volume", "v.nrrd", "--isovalue", "1.5", "-o", "out.ply"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.error, "equiaffine: warning: 6 of 6 vertices are outside and have no attributes: a spline of degree "
                          "7 needs 8 nodes along each axis, and there are 2 along one; give more nodes\n");
}

TEST_F(Program_command_line, no_distance_is_claimed_of_linear_vertices_at_a_pole) {
  const Arguments pole = {"--function", "1/x", "--box", "-1", "1", "-1", "1", "-1", "1", "--vertices", "linear"};
  EXPECT_TRUE(stats_of(pole)["max_distance_to_surface"].is_null());
  const std::string summary = run_well(Arguments{"mesh", "-o", "out.ply"} + pole);
  EXPECT_NE(summary.find("distance from the surface: unknown"), std::string::npos) << summary;
}

TEST_F(Program_command_line, constants_are_arithmetic_and_formulas_may_come_from_a_file) {
  write_file(folder_ / "formula", "\xef\xbb\xbfx^2 + y^2\r\n  + z^2 = r^2\r\n");
  const auto mesh = [&](const std::string& function, const std::string& radius) {
    return run_well({"mesh", "--function", function, "--set", "r=" + radius, "--box", "-2", "2", "-2", "2", "-2", "2",
                     "--resolution", "9", "-o", "-"});
  };
  const std::string typed = mesh("x^2 + y^2 + z^2 = r^2", "1.5");
  EXPECT_EQ(typed, mesh("@formula", "1.5"));
  EXPECT_EQ(typed, mesh("@formula", "3*cos(0*pi)/2"));
}

TEST_F(Program_command_line, names_of_files_that_could_upset_a_terminal_are_shown_as_codes) {
  const std::string sampled = run_well(
      {"sample", "--function", "x", "--box", "0", "1", "0", "1", "0", "1", "--resolution", "2", "-o", "a\x1b[31m.vti"});
  EXPECT_EQ(sampled, "2 x 2 x 2 nodes\nwrote a\\x1b[31m.vti\n");
}

TEST_F(Program_command_line, files_are_named_without_the_folders_above_them) {
  std::filesystem::create_directory(folder_ / "private");
  run_well({"mesh", "--function", "x^2+y^2+z^2-1", "--box", "-2", "2", "-2", "2", "-2", "2", "--resolution", "9", "-o",
            "private/s.ply"});
  const std::string path = (folder_ / "private/s.ply").string();
  EXPECT_EQ(stats_of({"--distance-to", path, "--resolution", "12", "--html", "page.html"})["source"],
            "the distance to 's.ply'");
  run_well({"view", path, "-o", "view.html"});
  for (const char* page : {"page.html", "view.html"}) {
    EXPECT_EQ(file(page).find("private"), std::string::npos) << page;
    EXPECT_NE(file(page).find("s.ply"), std::string::npos) << page;
  }
}

TEST_F(Program_command_line, no_distance_is_claimed_of_unconverged_vertices) {
  const auto summary =
      run_well({"mesh", "--function", "max(abs(sin(5*x)), abs(sin(4*y+z))) - .9 + .1*z", "--box", "-2", "2", "-2", "2",
                "-2", "2", "--resolution", "14", "-o", "m.ply", "--stats", "stats.json"});
  const Json stats = Json::parse(file("stats.json"));
  EXPECT_GT(stats["status"]["unconverged"], 0); // where a triangle would turn over
  EXPECT_LE(stats["max_distance_to_surface"], 1e-15);
  const std::string text =
      "nothing is known of the " + to_string(stats["status"]["unconverged"]) + " unconverged vertices";
  EXPECT_NE(summary.find(text), std::string::npos) << summary;
}

TEST_F(Program_command_line, distances_are_sampled_in_the_box_of_the_mesh_and_a_tenth_around_it) {
  write_file(folder_ / "slab.off", "OFF\n8 6 0\n0 0 0\n4 0 0\n4 2 0\n0 2 0\n0 0 1\n4 0 1\n4 2 1\n0 2 1\n"
                                   "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  run_well({"sample", "--distance-to", "slab.off", "--resolution", "9", "-o", "d.nrrd"});
  const auto volume = equiaffine::read_volume(folder_ / "d.nrrd").to_volume();
  const CGAL::Bbox_3 expected(-.4, -.4, -.4, 4.4, 2.4, 1.4), box = volume.lattice.bbox();
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(box.min(a), expected.min(a), rounding);
    EXPECT_NEAR(box.max(a), expected.max(a), rounding);
  }
  EXPECT_NEAR(volume(4, 4, 4), -0.5, rounding);               // the middle
  EXPECT_NEAR(volume(0, 0, 0), 0.4 * std::sqrt(3), rounding); // a corner, positive outside
  EXPECT_EQ(stats_of({"--distance-to", "slab.off", "--resolution", "33"})["euler_characteristic"], 2);
}
#endif

TEST(Program_progress, is_shown_on_a_terminal_and_wiped_away) {
  std::ostringstream terminal;
  {
    equiaffine::Progress progress(terminal, true, std::chrono::milliseconds(0));
    progress.begin("counting", 4);
    progress.advance(3);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  EXPECT_NE(terminal.str().find("[##################......]  75 %  counting, 0 s, about 0 s left"), std::string::npos)
      << terminal.str();
  EXPECT_TRUE(terminal.str().ends_with("\r\x1b[K"));
}

TEST(Program_progress, is_not_shown_in_a_pipe_or_for_short_work) {
  std::ostringstream pipe, terminal;
  equiaffine::Progress(pipe, false, std::chrono::milliseconds(0)).begin("working");
  equiaffine::Progress(terminal, true).begin("working");
  EXPECT_EQ(pipe.str() + terminal.str(), "");
}

} // namespace command_line_test
