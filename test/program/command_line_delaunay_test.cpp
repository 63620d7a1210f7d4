// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line_fixture.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace command_line_delaunay_test {

using namespace equiaffine::test;
using namespace command_line_fixture;

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

} // namespace command_line_delaunay_test
