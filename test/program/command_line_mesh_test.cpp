// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line_fixture.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace command_line_mesh_test {

using namespace equiaffine::test;
using namespace command_line_fixture;

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

#ifdef EQUIAFFINE_WITH_ITK
TEST_F(Program_command_line, no_distance_is_claimed_of_linear_vertices_at_a_pole) {
  const Arguments pole = {"--function", "1/x", "--box", "-1", "1", "-1", "1", "-1", "1", "--vertices", "linear"};
  EXPECT_TRUE(stats_of(pole)["max_distance_to_surface"].is_null());
  const std::string summary = run_well(Arguments{"mesh", "-o", "out.ply"} + pole);
  EXPECT_NE(summary.find("distance from the surface: unknown"), std::string::npos) << summary;
}

TEST_F(Program_command_line, no_distance_is_claimed_of_unconverged_vertices) {
  const auto summary =
      run_well({"mesh", "--function", "max(abs(sin(5*x)), abs(sin(4*y+z))) - .9 + .1*z", "--box", "-2", "2", "-2", "2",
                "-2", "2", "--resolution", "14", "-o", "m.ply", "--stats", "stats.json"});
  const Json stats = Json::parse(file("stats.json"));
  EXPECT_GT(stats["status"]["unconverged"], 0); // where a triangle would turn over
  EXPECT_LE(stats["max_distance_to_surface"], 1e-15);
  const std::string text = "unknown for " + to_string(stats["status"]["unconverged"]) + " unconverged vertices";
  EXPECT_NE(summary.find(text), std::string::npos) << summary;
}
#endif

} // namespace command_line_mesh_test
