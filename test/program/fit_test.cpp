// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/written_meshes.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace fit_test {

using namespace equiaffine::test;
using Json = nlohmann::json;

/// The surface is none of those that polynomials of the fits contain.
const std::string formula = "x^2 + y^2/2 + z^2 + sin(x*y)/5 = 2";

/// A fit of the vertices of s.ply, which lie on the surface exactly, as SOURCE of the commands.
class Program_fit : public Written_meshes_test {
protected:
  void SetUp() override {
    run_well({"mesh", "--function", formula, "--box", "-2", "2", "-3", "3", "-2", "2", "--resolution", "20",
              "--attributes", "none", "-o", "s.ply"});
  }

  /// Expects that K is that of the formula, or of its image under a map, to within the errors at 93 % of the vertices.
  void expect_right(const std::string& name, const Arguments& map = {}) {
    run_well(Arguments{"evaluate", "--function", formula, "--points", name, "-o", "exact.ply"} + map);
    const Mesh fitted = mesh(name), exact = mesh("exact.ply");
    const auto found = column(fitted, "affine_gaussian_curvature"),
               error = column(fitted, "affine_gaussian_curvature_error"),
               expected = column(exact, "affine_gaussian_curvature");
    std::size_t right = 0, known = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      right += std::abs(found[i] - expected[i]) <= error[i];
      known += error[i] < 0.1 * std::abs(found[i]);
    }
    EXPECT_GE(double(right), 0.93 * double(found.size()));
    EXPECT_GE(double(known), 0.5 * double(found.size()));
  }
};
using Program_fit_long = Program_fit;

const Arguments errors = {"--attributes", "basic,affine_gaussian_curvature_error"};

TEST_F(Program_fit, a_mesh_becomes_a_smooth_one_with_curvatures_that_are_right_to_within_their_errors) {
  for (const Arguments& method : {Arguments{"--resolution", "30"}, {"--method", "delaunay", "--radius", "0.15"}}) {
    run_well(Arguments{"mesh", "--fit", "s.ply", "-o", "fit.ply", "--stats", "fit.json"} + errors + method);
    const Json statistics = Json::parse(file("fit.json"));
    EXPECT_EQ(statistics["source"], "the fit to 's.ply'");
    EXPECT_EQ(statistics["euler_characteristic"], 2);
    EXPECT_EQ(statistics["boundary_edges"], 0);
    EXPECT_EQ(statistics["status"]["regular"], statistics["vertices"]);
    EXPECT_LT(statistics["max_distance_to_surface"], 1e-12);
    EXPECT_GT(statistics["fit"]["below_10"], 0.5);
    EXPECT_GT(statistics["fit"]["scales"]["least"], 0.2);
    expect_right("fit.ply");
  }
}

TEST_F(Program_fit, points_without_faces_are_a_source_too) {
  run_well({"evaluate", "--function", "x", "--points", "s.ply", "--attributes", "none", "-o", "s.csv"});
  run_well(Arguments{"mesh", "--fit", "s.csv", "--resolution", "25", "-o", "fit.ply"} + errors);
  expect_right("fit.ply");
}

TEST_F(Program_fit, an_affine_map_takes_curvatures_and_errors_along) {
  const Arguments map = {"--transform", "2", "0.5", "0", "0", "1", "0", "0", "0.3", "1.5"};
  run_well(Arguments{"mesh", "--fit", "s.ply", "--resolution", "25", "-o", "image.ply"} + errors + map);
  expect_right("image.ply", map);
}

TEST_F(Program_fit_long, box_and_resolution_are_those_of_distances) {
  for (const Arguments& resolution : {Arguments{"--resolution", "9"}, {}}) {
    run_well(Arguments{"sample", "--distance-to", "s.ply", "--type", "float", "-o", "distance.vti"} + resolution);
    run_well(Arguments{"sample", "--fit", "s.ply", "--type", "float", "-o", "fit.vti"} + resolution);
    const auto frame = [&](const std::string& name) {
      const std::string text = file(name);
      return text.substr(text.find("<ImageData"), text.find("<PointData") - text.find("<ImageData"));
    };
    EXPECT_EQ(frame("fit.vti"), frame("distance.vti"));
  }
  run_well(
      {"mesh", "--fit", "s.ply", "--box", "-3", "0", "-3", "3", "-3", "3", "--resolution", "20", "-o", "part.ply"});
  for (const auto& p : mesh("part.ply").mesh.points) EXPECT_LE(p.x(), 0);
}

TEST_F(Program_fit, points_away_from_the_data_are_outside_and_a_warning_says_so) {
  write_file(folder_ / "points.csv", "x,y,z\n0,0,1.4142\n0,0,0\n5,5,5\n");
  const Result result = run({"evaluate", "--fit", "s.ply", "--points", "points.csv", "--attributes",
                             "gaussian_curvature,affine_gaussian_curvature_noise", "-o", "-"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.error.find("2 of 3 points are outside"), std::string::npos) << result.error;
  std::istringstream lines(result.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "x,y,z,gaussian_curvature,affine_gaussian_curvature_noise,status");
  for (const std::string status : {"regular", "outside", "outside"}) {
    std::getline(lines, line);
    EXPECT_TRUE(line.ends_with(status)) << line;
  }
}

TEST_F(Program_fit, scale_and_degree_are_obeyed) {
  const Result result = run({"mesh", "--fit", "s.ply", "--scale", "1.3", "--degree", "5", "--resolution", "20", "-o",
                             "fit.ply", "--stats", "fit.json"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find("at scale 1.3: "), std::string::npos) << result.out;
  const Json scales = Json::parse(file("fit.json"))["fit"]["scales"];
  EXPECT_NEAR(scales["median"], 1.3, 0.2);
}

TEST_F(Program_fit, any_number_of_threads_gives_the_same_bytes) {
  for (const std::string threads : {"1", "3"})
    run_well(Arguments{"mesh", "--fit", "s.ply", "--resolution", "20", "--threads", threads, "-o", threads + ".ply"} +
             errors);
  EXPECT_EQ(file("1.ply"), file("3.ply"));
}

TEST_F(Program_fit, pages_show_what_can_be_trusted) {
  run_well({"mesh", "--fit", "s.ply", "--resolution", "20", "-o", "fit.ply", "--html", "fit.html"});
  EXPECT_NE(file("fit.html").find("affine_gaussian_curvature_error"), std::string::npos);
  EXPECT_NE(file("fit.ply").find("affine_gaussian_curvature_error"), std::string::npos);
}

TEST_F(Program_fit_long, an_open_surface_ends_with_the_data_and_has_no_small_fragments) {
  const Arguments torus = {"--function", "(sqrt(x^2+y^2)-1)^2+z^2-0.16", "--box", "-1.5", "1.5", "0", "1.5", "-0.5",
                           "0.5"};
  run_well(Arguments{"mesh", "--resolution", "40", "--attributes", "none", "-o", "open.ply"} + torus);
  for (const std::string resolution : {"60", "90"}) {
    run({"mesh", "--fit", "open.ply", "--resolution", resolution, "-o", "fit.ply", "--stats", "fit.json"});
    const Json statistics = Json::parse(file("fit.json"));
    EXPECT_EQ(statistics["components"], 1) << resolution;
    EXPECT_EQ(statistics["manifold"], true) << resolution;
    EXPECT_EQ(statistics["status"]["outside"], 0) << resolution;
    EXPECT_EQ(statistics["status"]["unconverged"], 0) << resolution;
    EXPECT_LT(statistics["max_distance_to_surface"], 1e-12) << resolution;
  }
}

TEST_F(Program_fit, a_hole_of_the_data_stays_open) {
  run_well({"mesh", "--function", "z-0.2*x^2-0.1*y^2+0.1*x*y^2+0*sqrt(x^2+y^2-0.16)", "--box", "-1", "1", "-1", "1",
            "-1", "1", "--resolution", "30", "--attributes", "none", "-o", "hole.ply"});
  run({"mesh", "--fit", "hole.ply", "--resolution", "60", "-o", "fit.ply", "--stats", "fit.json"});
  const Json statistics = Json::parse(file("fit.json"));
  EXPECT_EQ(statistics["components"], 1);
  EXPECT_EQ(statistics["euler_characteristic"], 0);
  EXPECT_EQ(statistics["status"]["outside"], 0);
  EXPECT_EQ(statistics["status"]["unconverged"], 0);
}

TEST_F(Program_fit_long, sheets_that_the_grid_does_not_tell_apart_are_warned_of) {
  run_well({"mesh", "--function", "(z-0.3*x^2)^2 = 0.0009", "--box", "-1", "1", "-1", "1", "-0.1", "0.4",
            "--resolution", "40", "--attributes", "none", "-o", "sheets.ply"});
  const Arguments remesh = {"mesh", "--fit", "sheets.ply", "-o", "fit.ply", "--stats", "fit.json", "--resolution"};
  const Result coarse = run(remesh + Arguments{"25"});
  EXPECT_EQ(coarse.status, 0);
  EXPECT_NE(coarse.error.find("points are nearer to another sheet of the surface than a step of the grid"),
            std::string::npos)
      << coarse.error;
  const Json sheets = Json::parse(file("fit.json"))["fit"]["close_sheets"];
  EXPECT_GT(sheets["points"], 1000);
  EXPECT_NEAR(sheets["distance"], 0.06, 0.015);
  const std::string advice = "give --resolution ";
  const std::size_t at = coarse.error.find(advice);
  ASSERT_NE(at, std::string::npos) << coarse.error;
  const Result fine = run(remesh + Arguments{std::to_string(std::stoi(coarse.error.substr(at + advice.size())))});
  EXPECT_EQ(fine.error.find("another sheet"), std::string::npos) << fine.error;
  const Json statistics = Json::parse(file("fit.json"));
  EXPECT_EQ(statistics["fit"]["close_sheets"]["points"], 0);
  EXPECT_EQ(statistics["components"], 2);
  EXPECT_EQ(statistics["euler_characteristic"], 2);
}

TEST_F(Program_fit_long, every_reason_for_no_surface_has_its_sentence) {
  expect_error({"mesh", "--fit", "s.ply", "--level", "7", "-o", "a.ply"},
               {"no surface f = 7", "'s.ply'", "two spacings", "nearer to 0"});
  expect_error({"mesh", "--fit", "s.ply", "--box", "5", "6", "5", "6", "5", "6", "-o", "a.ply"},
               {"no part of the fit to 's.ply' is in the box", "it lies in -1.", "--box that overlaps this one"});
  expect_error({"mesh", "--fit", "s.ply", "--box", "-0.1", "0.1", "-0.1", "0.1", "-0.1", "0.1", "-o", "a.ply"},
               {"no part of the surface of the fit to 's.ply'", "more of the data", "--resolution"});
}

TEST_F(Program_fit, a_small_box_cuts_a_small_part_out) {
  run_well({"mesh", "--fit", "s.ply", "--box", "1.3", "1.6", "-0.1", "0.1", "-0.1", "0.1", "--resolution", "10", "-o",
            "part.ply"});
  const Mesh part = mesh("part.ply");
  EXPECT_GT(part.mesh.triangles.size(), 50U);
  for (const auto& p : part.mesh.points) EXPECT_NEAR(p.x(), std::sqrt(2), 0.05);
}

TEST_F(Program_fit, what_cannot_be_used_is_refused) {
  expect_error({"mesh", "--function", "x", "--box", "-1", "1", "-1", "1", "-1", "1", "--scale", "1", "-o", "a.ply"},
               {"--scale", "only to fits"});
  expect_error({"mesh", "--fit", "s.ply", "--distance-to", "s.ply", "-o", "a.ply"}, {"both given"});
  expect_error({"mesh", "--fit", "no.ply", "-o", "a.ply"}, {"no.ply", "no such file"});
  expect_error({"mesh", "--fit", "s.ply", "-o", "s.ply"}, {"overwrite"});
  expect_error({"mesh", "--fit", "s.ply", "--smoothing", "2", "-o", "a.ply"}, {"--smoothing", "splines"});
  expect_error({"mesh", "--fit", "s.ply", "--derivatives", "spline", "-o", "a.ply"},
               {"--derivatives", "the fit's own"});
  expect_error({"mesh", "--function", "x", "--box", "-1", "1", "-1", "1", "-1", "1", "--attributes",
                "affine_mean_curvature_noise", "-o", "a.ply"},
               {"noise", "--fit"});
  write_file(folder_ / "line.csv", "x,y,z\n0,0,0\n1,0,0\n2,0,0\n3,0,0\n4,0,0\n");
  expect_error({"mesh", "--fit", "line.csv", "-o", "a.ply"}, {"line.csv", "enough", "more points"});
}

} // namespace fit_test
