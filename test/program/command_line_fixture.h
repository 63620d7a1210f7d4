// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the program, mostly for a sphere, and takes apart what it writes.
#ifndef EQUIAFFINE_TEST_PROGRAM_COMMAND_LINE_FIXTURE_H
#define EQUIAFFINE_TEST_PROGRAM_COMMAND_LINE_FIXTURE_H

#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace command_line_fixture {

using namespace equiaffine::test;

using Json = nlohmann::json;

/// 1000 roundings: enough for every number compared here, at points where the invariants are well conditioned.
inline constexpr double rounding = 1000 * std::numeric_limits<double>::epsilon();

inline const Arguments sphere = {"--function", "x^2 + y^2 + z^2 = 1", "--box", "-1.5", "1.5", "-1.5", "1.5", "-1.5",
                                 "1.5"};
inline const Arguments delaunay = {"--method", "delaunay"};
inline const Arguments ellipsoid = {"--function", "x^2/4 + y^2 + 2*z^2 + x*y/3 = 1"};
inline const std::string basic_names =
    "nx,ny,nz,k1,k2,gaussian_curvature,mean_curvature,conormal_x,conormal_y,conormal_z,"
    "affine_normal_x,affine_normal_y,affine_normal_z,affine_gaussian_curvature,"
    "affine_mean_curvature,pick_invariant";
inline const std::string further_names =
    "affine_k1,affine_k2,direction1_x,direction1_y,direction1_z,direction2_x,direction2_y,"
    "direction2_z,metric_xx,metric_xy,metric_xz,metric_yy,metric_yz,metric_zz";
inline const std::string later_basic_names = "affine_normal_angle,affine_area_density";

inline Arguments split(const std::string& text, char separator) {
  Arguments parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// The rows of a CSV text by the names of its header.
inline std::vector<std::map<std::string, std::string>> rows(const std::string& text) {
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

} // namespace command_line_fixture

#endif
