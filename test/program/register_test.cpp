// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/written_meshes.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace register_test {

using namespace equiaffine::test;
using Json = nlohmann::json;

/// A surface without any symmetry.
const std::string formula =
    "x^4+y^4+z^4-1+.31*x^3-.22*x^2*y+.13*x^2*z+.27*x*y^2-.35*x*y*z+.18*x*z^2+.2*y^3-.11*y^2*z+.24*y*z^2-.3*z^3";

const Arguments box = {"--box", "-1.8", "1.8", "-1.8", "1.8", "-1.8", "1.8"};
const Arguments surface = Arguments{"--function", formula, "--resolution", "24"} + box;

/// The map of the tests, as the words of --transform: a shear with stretches, and a translation.
const std::array<double, 12> map = {2, 1, 0, 0, 1, .3, .2, 0, .5, 1, -2, 3};
const Arguments transform = {"--transform", "2", "1", "0", "0", "1", ".3", ".2", "0", ".5", "1", "-2", "3"};

/// The image of the surface, with points of its own.
const Arguments image = Arguments{"--function", formula, "--resolution", "27"} + box + transform;

/// The largest difference of an entry from that of the map.
double error_of(const Json& found) {
  double error = 0;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      error = std::max(error, std::abs(double(found["matrix"][row][column]) - map[3 * row + column]));
    error = std::max(error, std::abs(double(found["translation"][row]) - map[9 + row]));
  }
  return error;
}

class Program_register : public Written_meshes_test {
protected:
  /// Registers, expects that nothing goes wrong, and returns what is written.
  Json registered(const Arguments& source, const Arguments& target, const Arguments& options = {}) {
    run_well(Arguments{"register"} + source + Arguments{"to"} + target + Arguments{"-o", "map.json"} + options);
    return Json::parse(file("map.json"));
  }

  Json symmetries(const Arguments& source) {
    run_well(Arguments{"symmetries"} + source + Arguments{"-o", "maps.json"});
    return Json::parse(file("maps.json"));
  }
};
using Program_register_long = Program_register;

TEST_F(Program_register, a_formula_and_its_image_give_the_map_and_what_there_is_to_trust_it) {
  const Json found = registered(surface, image);
  EXPECT_EQ(found["found"], true);
  EXPECT_LT(error_of(found), 1e-11);
  EXPECT_NEAR(found["determinant"], 1.06, 1e-11);
  EXPECT_LT(found["log10_false_alarms"], -50);
  EXPECT_GT(found["inliers"][0], 0.9);
  EXPECT_GT(found["inliers"][1], 0.9);
  EXPECT_LT(found["rms"], 1e-11);
  EXPECT_GE(found["hypotheses"], 1);
  EXPECT_TRUE(found["next_best_rms"].is_null() || found["next_best_rms"] > 1e-9);
  EXPECT_EQ(found["slippage"]["dimension"], 0);
  EXPECT_EQ(found["slippage"]["generators"], Json::array());
  EXPECT_FALSE(found.contains("maps"));
  EXPECT_TRUE(std::string(found["source"]).starts_with("the formula x^4"));
}

TEST_F(Program_register, samples_are_matched_smoothed_and_refined_unsmoothed) {
  run_well(Arguments{"sample", "-o", "a.vti", "--function", formula, "--resolution", "56"} + box);
  EXPECT_LT(error_of(registered({"a.vti"}, image)), 1e-6);
  const Json smoothed = registered({"--volume", "a.vti", "--smoothing", "2.5"}, image);
  EXPECT_LT(error_of(smoothed), 1e-6) << "smoothing does not commute with the map";
}

TEST_F(Program_register_long, vertices_and_points_are_registered_by_fits) {
  run_well(Arguments{"mesh", "-o", "a.ply", "--attributes", "none"} + surface);
  run_well(Arguments{"mesh", "-o", "b.off"} + image);
  run_well(Arguments{"mesh", "-o", "b.csv", "--attributes", "none"} + image);
  const Json of_points = registered({"a.ply"}, {"b.csv"});
  ASSERT_EQ(of_points["found"], true);
  EXPECT_LT(error_of(of_points), 1e-3);
  EXPECT_EQ(of_points["source"], "the fit to 'a.ply'");
  EXPECT_EQ(of_points["target"], "the fit to 'b.csv'");
  const Json found = registered(Arguments{"--fit", "a.ply"} + transform, {"--fit", "b.off"});
  EXPECT_NEAR(found["matrix"][0][0], 1, 1e-3) << "a transformed fit takes its data along";
}

TEST_F(Program_register, a_piece_is_found_in_the_whole_and_not_among_facets) {
  run_well(Arguments{"mesh", "-o", "whole.off", "--resolution", "90", "--function", formula} + box + transform);
  const Arguments piece = {"--function", formula, "--resolution", "24",   "--box", "0",
                           "1.8",        "-1.8",  "1.8",          "-1.8", "1.8"};
  const Json found = registered(piece, image);
  EXPECT_LT(error_of(found), 1e-11);
  EXPECT_GT(found["inliers"][0], 0.9);
  EXPECT_LT(found["inliers"][1], 0.7);
  EXPECT_FALSE(registered(piece, {"--distance-to", "whole.off", "--resolution", "40"})["found"])
      << "facets have no affine curvature";
}

TEST_F(Program_register, all_maps_are_listed_when_asked) {
  const Arguments symmetric =
      Arguments{"--function", "x^4+y^4+z^4-1+.3*x^2*y-.2*x^2*z+.25*y^3+.3*y*z+.15*z^3-.2*y*z^2", "--resolution", "24"} +
      box;
  const Json found = registered(symmetric, symmetric + transform, {"--number-of-maps", "5"});
  ASSERT_EQ(found["maps"].size(), 2U);
  EXPECT_EQ(found["maps"][0]["matrix"], found["matrix"]);
  EXPECT_LT(double(found["maps"][0]["determinant"]) * double(found["maps"][1]["determinant"]), 0);
  for (const Json& each : found["maps"])
    for (const char* field : {"matrix", "translation", "determinant", "log10_false_alarms", "inliers", "rms"})
      EXPECT_TRUE(each.contains(field)) << field;
  EXPECT_LT(found["next_best_rms"], 1e-9);
}

TEST_F(Program_register_long, kinds_and_reflections_are_obeyed) {
  const Arguments mirror = {"--transform", "-1", "0", "0", "0", "1", "0", "0", "0", "1"};
  const Json mirrored = registered(surface, surface + mirror, {"--kind", "rigid"});
  EXPECT_NEAR(mirrored["determinant"], -1, 1e-12);
  EXPECT_EQ(registered(surface, surface + mirror, {"--no-reflections"})["found"], false);
  EXPECT_EQ(registered(surface, image, {"--kind", "similarity"})["found"], false);
  EXPECT_EQ(registered(surface, image, {"--kind", "equiaffine"})["found"], false);
}

TEST_F(Program_register, where_there_is_no_map_it_says_what_to_try) {
  const auto outcome = [&](const Arguments& source, const Arguments& target, const Arguments& options = {}) {
    const std::string text =
        run_well(Arguments{"register"} + source + Arguments{"to"} + target + Arguments{"-o", "map.json"} + options);
    return text.substr(0, text.find('\n'));
  };
  const Arguments plane = Arguments{"--function", "x+2*y-z", "--resolution", "12"} + box;
  EXPECT_EQ(outcome(plane, plane),
            "no map found: the surfaces have no unique frames that agree; try --kind similarity, whose frames need "
            "fewer derivatives and also exist on quadrics, or surfaces with a larger overlap");
  const std::string narrow = outcome(surface, image, {"--kind", "rigid", "--no-reflections", "--html", "page.html"});
  EXPECT_TRUE(narrow.starts_with("no map found: ")) << narrow;
  EXPECT_TRUE(
      narrow.ends_with("; try --kind similarity, which allows other sizes, or --kind affine, which allows all maps, "
                       "or leaving out --no-reflections, or surfaces with a larger overlap"))
      << narrow;
  for (const char* text : {"no map found", "--kind affine, which allows all maps", "1 source, not moved (dark violet)"})
    EXPECT_NE(file("page.html").find(text), std::string::npos) << text;
  write_file(folder_ / "three.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n");
  EXPECT_NE(outcome({"three.csv"}, {"three.csv"}).find(", or the same --scale R on both sides"), std::string::npos);
  EXPECT_NE(
      outcome({"three.csv", "--scale", "2"}, {"three.csv", "--scale", "2"}).find(", or a larger --scale, the same"),
      std::string::npos);
}

TEST_F(Program_register, only_the_identity_says_what_may_find_more) {
  EXPECT_EQ(run_well(Arguments{"symmetries"} + surface + Arguments{"-o", "m.json", "--kind", "rigid"}),
            "1 symmetry, the identity; try --kind affine, which allows all maps\nwrote m.json\n");
}

TEST_F(Program_register, pages_say_how_good_the_map_is_and_which_color_is_which_surface) {
  registered(surface, image, {"--html", "page.html"});
  for (const char* text : {"Determinant", "1.06", "equally good maps by chance: 10^-", "Overlap", "% of the source",
                           "Rms distance", "0 target (pale yellow), 1 moved source (orange)"})
    EXPECT_NE(file("page.html").find(text), std::string::npos) << text;
  registered(surface, image, {"--html", "page.html", "--color", "distance"});
  EXPECT_NE(file("page.html").find("--color surface to distinguish the two"), std::string::npos);
  run_well(Arguments{"symmetries"} + surface + Arguments{"-o", "m.json", "--html", "page.html"});
  for (const char* text : {"Order", "positive for 1, negative for 0"})
    EXPECT_NE(file("page.html").find(text), std::string::npos) << text;
}

TEST_F(Program_register, identical_surfaces_have_the_identity) {
  const Json found = registered(surface, surface);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      EXPECT_NEAR(found["matrix"][row][column], row == column ? 1 : 0, 1e-12);
}

TEST_F(Program_register, a_quadric_has_one_map_of_many_with_generators) {
  const Arguments ellipsoid = Arguments{"--function", "x^2+2*y^2+3*z^2=1", "--resolution", "24"} + box;
  const Json found = registered(ellipsoid, ellipsoid + transform);
  EXPECT_EQ(found["found"], true);
  EXPECT_EQ(found["slippage"]["dimension"], 3);
  ASSERT_EQ(found["slippage"]["generators"].size(), 3U);
  EXPECT_EQ(found["slippage"]["generators"][0]["matrix"].size(), 3U);
  EXPECT_EQ(found["slippage"]["generators"][0]["translation"].size(), 3U);
  EXPECT_NE(run(Arguments{"register"} + ellipsoid + Arguments{"to"} + ellipsoid + Arguments{"-o", "m.json"})
                .out.find("slides over itself with 3 degrees of freedom"),
            std::string::npos);
}

TEST_F(Program_register, boxes_have_no_curvature_and_are_found_by_their_triangles) {
  const std::string faces = "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  write_file(folder_ / "box.off", "OFF\n8 6 0\n0 0 0\n3 0 0\n3 2 0\n0 2 0\n0 0 1\n3 0 1\n3 2 1\n0 2 1\n" + faces);
  write_file(folder_ / "other.off", "OFF\n8 6 0\n0 0 0\n3 0 0\n3 2 0\n0 2 0\n0 0 1\n3 0 1\n3 2 1.4\n0 2 1\n" + faces);
  const Arguments turn = {"--transform", "0", "-1", "0", "1", "0", "0", "0", "0", "1", "5", "6", "7"};
  const Json found =
      registered({"box.off"}, Arguments{"box.off"} + turn,
                 {"--kind", "rigid", "--moved", "moved.ply", "--html", "page.html", "--all", "9"});
  ASSERT_EQ(found["found"], true);
  EXPECT_EQ(found["matched_by"], "triangles");
  EXPECT_EQ(found["maps"].size(), 8U);
  EXPECT_LT(found["rms"], 1e-12);
  EXPECT_EQ(found["inliers"], (Json{1., 1.}));
  for (const double distance : column(mesh("moved.ply"), "distance")) EXPECT_LT(distance, 1e-12);
  EXPECT_EQ(registered({"box.off"}, {"other.off"}, {"--kind", "rigid"})["found"], false);
  const Json frames = registered(surface, image);
  EXPECT_EQ(frames["matched_by"], "frames");
  EXPECT_TRUE(frames["contradictions"].is_null());
  EXPECT_EQ(found["contradictions"], (Json{0, 0}));
  EXPECT_LT(double(found["rms"]), 1e-9 * double(found["size"]));
}

TEST_F(Program_register, how_equal_surfaces_are_to_be_is_up_to_the_user) {
  const std::string faces = "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n4 4 5 6 7\n";
  write_file(folder_ / "box.off", "OFF\n8 6 0\n0 0 0\n3 0 0\n3 2 0\n0 2 0\n0 0 1\n3 0 1\n3 2 1\n0 2 1\n" + faces);
  write_file(folder_ / "higher.off",
             "OFF\n8 6 0\n0 0 0\n3 0 0\n3 2 0\n0 2 0\n0 0 1.01\n3 0 1.01\n3 2 1.01\n0 2 1.01\n" + faces);
  EXPECT_EQ(registered({"box.off"}, {"higher.off"}, {"--kind", "rigid"})["found"], false);
  const std::string text =
      run_well({"register", "box.off", "to", "higher.off", "-o", "map.json", "--kind", "rigid", "--tolerance", "0.01"});
  EXPECT_NE(text.find(" % of the size\n"), std::string::npos) << text;
  const Json found = Json::parse(file("map.json"));
  EXPECT_GT(double(found["rms"]), 1e-4 * double(found["size"]));
  EXPECT_LT(double(found["rms"]), 1e-2 * double(found["size"]));
}

TEST_F(Program_register_long, a_search_of_all_rotations_says_how_far_it_went) {
  const Arguments long_one = Arguments{"--function", "x^4+2*y^4+4*z^4+.3*x*y*z=1", "--kind", "rigid"} + box;
  EXPECT_TRUE(symmetries(long_one)["complete_to"].is_null());
  const std::string text = run_well(Arguments{"symmetries"} + long_one + Arguments{"-o", "maps.json", "--complete"});
  EXPECT_NE(text.find("the search covers all rotations that move the surface onto itself to within "),
            std::string::npos)
      << text;
  EXPECT_GT(Json::parse(file("maps.json"))["complete_to"], .01);
}

TEST_F(Program_register, planes_and_three_points_are_no_error_and_have_no_map) {
  const Arguments plane = Arguments{"--function", "x+2*y-z", "--resolution", "12"} + box;
  EXPECT_EQ(registered(plane, plane)["found"], false);
  run_well(Arguments{"mesh", "-o", "plane.off"} + plane);
  EXPECT_EQ(registered({"plane.off"}, {"plane.off"})["found"], false);
  std::filesystem::remove(folder_ / "plane.off");
  write_file(folder_ / "one.csv", "x,y,z\n1,2,3\n");
  EXPECT_EQ(registered({"one.csv"}, plane)["found"], false);
  std::filesystem::remove(folder_ / "one.csv");
  write_file(folder_ / "three.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n");
  for (const auto& [source, target] : {std::pair<Arguments, Arguments>({"three.csv"}, surface),
                                       {surface, {"three.csv"}},
                                       {{"three.csv"}, {"three.csv"}}}) {
    const Json found = registered(source, target, {"--html", "page.html", "--moved", "moved.ply"});
    EXPECT_EQ(found["found"], false);
    EXPECT_FALSE(found.contains("matrix"));
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"map.json", "page.html", "three.csv"})) << "nothing is moved";
}

TEST_F(Program_register, the_moved_source_lies_on_the_target) {
  run_well(Arguments{"mesh", "-o", "a.ply", "--attributes", "mean_curvature"} + surface);
  registered({"a.ply", "--resolution", "20"}, image,
             {"--moved", "moved.ply", "--html", "page.html", "--color", "surface"});
  const Mesh given = mesh("a.ply"), moved = mesh("moved.ply");
  EXPECT_EQ(moved.mesh.triangles, given.mesh.triangles);
  ASSERT_EQ(moved.mesh.points.size(), given.mesh.points.size());
  for (std::size_t i = 0; i < given.mesh.points.size(); ++i)
    EXPECT_NEAR(moved.mesh.points[i].x(), 2 * given.mesh.points[i].x() + given.mesh.points[i].y() + 1, 1e-3);
  for (const double distance : column(moved, "distance")) EXPECT_LT(distance, 1e-3);
  const std::string page = file("page.html");
  for (const char* text : {"distance", "surface", "log10 of false alarms"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_TRUE(page.find("the fit to 'a.ply'") != std::string::npos ||
              page.find("the fit to &#39;a.ply&#39;") != std::string::npos);
}

TEST_F(Program_register, any_number_of_threads_gives_the_same_bytes) {
  for (const std::string threads : {"1", "3"})
    registered(surface, image, {"--threads", threads, "--moved", threads + ".ply"});
  EXPECT_EQ(file("1.ply"), file("3.ply"));
}

TEST_F(Program_register, options_of_both_stand_on_either_side_and_a_value_may_be_the_word_to) {
  run_well(Arguments{"register", "-o", "to", "--kind", "affine"} + surface + Arguments{"to"} + image);
  EXPECT_EQ(Json::parse(file("to"))["found"], true);
  expect_error(Arguments{"register", "-o", "a.json"} + surface + Arguments{"to"} + image + Arguments{"-o", "b.json"},
               {"--output", "more than once"});
}

TEST_F(Program_register, what_cannot_be_used_is_refused) {
  run_well(Arguments{"mesh", "-o", "a.ply", "--attributes", "none"} + surface);
  expect_error({"register", "a.ply", "b.ply", "-o", "m.json"},
               {"unexpected word 'b.ply'", "'equiaffine register a.ply to b.ply -o MAP.json'"});
  expect_error({"symmetries", "a.ply", "to", "b.ply", "-o", "m.json"},
               {"unexpected word 'to'", "takes one surface", "equiaffine register a.ply to OTHER"});
  expect_error({"symmetries", "a.ply", "b.ply", "-o", "m.json"}, {"'equiaffine register a.ply to b.ply -o MAP.json'"});
  expect_error({"register", "--points", "a.ply", "to", "b.ply"}, {"'--points'", "--fit FILE"});
  expect_error({"register", "a.ply", "-o", "m.json"}, {"the word 'to'", "missing", "SOURCE to SOURCE"});
  expect_error({"register", "to", "a.ply", "-o", "m.json"}, {"the source is missing", "side of the word 'to'"});
  expect_error({"register", "a.ply", "to", "a.ply"}, {"--output", "missing"});
  expect_error({"register", "a.ply", "to", "a.ply", "-o", "a.ply"}, {"overwrite"});
  expect_error({"register", "a.ply", "to", "a.ply", "-o", "m.json", "--moved", "a.ply"}, {"overwrite"});
  expect_error({"register", "a.ply", "to", "a.ply", "-o", "m.ply"}, {"m.ply", ".json"});
  expect_error({"register", "a.ply", "to", "a.ply", "-o", "m.json", "--moved", "m.txt"}, {"m.txt", "extension"});
  expect_error({"register", "a.ply", "to", "a.ply", "-o", "m.json", "--kind", "afine"}, {"--kind", "afine", "affine"});
  expect_error({"register", "a.ply", "to", "a.ply", "-o", "m.json", "--min-overlap", "5"},
               {"--min-overlap", "'5'", "between 0 and 1"});
  expect_error({"register", "a.ply", "to", "a.ply", "-o", "m.json", "--number-of-maps", "0"},
               {"--number-of-maps", "'0'"});
  expect_error({"register", "a.ply", "to", "a.foo", "-o", "m.json"}, {"a.foo", "extension"});
  expect_error({"register", "a.ply", "to", "--volume", "a.ply", "b.ply", "-o", "m.json"}, {"both given"});
  expect_error({"register", "no.ply", "to", "a.ply", "-o", "m.json"}, {"no.ply", "no such file"});
  expect_error({"register", "-", "to", "-", "-o", "m.json"}, {"both sources", "standard input"});
  expect_error({"register", "a.ply", "to", "a.ply", "-o", "m.json", "--color", "distance"}, {"--color", "--html"});
  expect_error(Arguments{"register", "--function", "x^2+9=0"} + box + Arguments{"to", "a.ply", "-o", "m.json"},
               {"no surface"});
  write_file(folder_ / "none.csv", "x,y,z\n");
  expect_error({"register", "none.csv", "to", "a.ply", "-o", "m.json"}, {"none.csv", "no points"});
  expect_error({"symmetries", "none.csv", "-o", "m.json"}, {"none.csv", "no points"});
  expect_error({"symmetries", "a.ply", "-o", "m.json", "--tolerance", "2"}, {"--tolerance", "'2'"});
  expect_error({"symmetries", "a.ply", "-o", "m.json", "--kind", "afine"}, {"--kind", "afine", "affine"});
  expect_error({"symmetries", "-o", "m.json"}, {"the source is missing", "file"});
  expect_error({"symmetries", "a.ply", "--box", "5", "6", "5", "6", "5", "6", "-o", "m.json"},
               {"no part of the fit to 'a.ply' is in the box"});
  write_file(folder_ / "three.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n");
  expect_error({"symmetries", "three.csv", "-o", "m.json"}, {"cannot find symmetries", "three.csv", "more points"});
}

TEST_F(Program_register, symmetries_of_a_formula_are_a_group) {
  const Arguments sextic = Arguments{"--function", "x^6+1.5*y^6+.7*z^6+.8*x^2*y^2=1"} + box;
  for (const Arguments& map_of_it : {Arguments{}, transform}) {
    const Json found = symmetries(sextic + map_of_it);
    EXPECT_EQ(found["order"], 16);
    ASSERT_EQ(found["maps"].size(), 16U);
    for (const char* field : {"matrix", "translation", "rms"}) EXPECT_TRUE(found["maps"][0].contains(field));
    EXPECT_EQ(found["continuous"]["dimension"], 0);
    EXPECT_EQ(found["continuous"]["generators"], Json::array());
  }
  EXPECT_EQ(symmetries(surface)["order"], 1);
}

TEST_F(Program_register_long, symmetries_are_of_the_kind_that_is_asked_for) {
  const Arguments resolution = {"--resolution", "32"}, rigid = {"--kind", "rigid"}, proper = {"--no-reflections"};
  const Arguments ellipsoid = Arguments{"--function", "x^2+2*y^2+3*z^2-1"} + box + resolution,
                  cube = Arguments{"--function", "x^4+y^4+z^4-1"} + box + resolution,
                  torus = Arguments{"--function", "(x^2+y^2+z^2+.84)^2=4*(x^2+y^2)"} + box + resolution;
  EXPECT_EQ(symmetries(ellipsoid)["continuous"]["dimension"], 3);
  EXPECT_EQ(symmetries(ellipsoid + Arguments{"--kind", "equiaffine"})["continuous"]["dimension"], 3);
  EXPECT_EQ(symmetries(ellipsoid + rigid)["order"], 8);
  EXPECT_EQ(symmetries(ellipsoid + rigid + proper)["order"], 4);
  EXPECT_EQ(symmetries(ellipsoid + Arguments{"--kind", "similarity"})["order"], 8);
  EXPECT_EQ(symmetries(cube + rigid)["order"], 48);
  EXPECT_EQ(symmetries(cube + proper)["order"], 24);
  EXPECT_EQ(symmetries(torus + rigid)["continuous"]["dimension"], 1);
  run_well(Arguments{"sample", "-o", "s.vti"} + ellipsoid);
  run_well(Arguments{"mesh", "-o", "s.ply", "--attributes", "none"} + ellipsoid);
  for (const char* file : {"s.vti", "s.ply"}) EXPECT_EQ(symmetries(Arguments{file} + rigid)["order"], 8) << file;
}

TEST_F(Program_register, a_rigid_map_of_quadrics_has_frames_that_pages_show) {
  const Arguments ellipsoid = Arguments{"--function", "x^2+2*y^2+3*z^2=1", "--resolution", "24"} + box;
  const Arguments turn = {"--transform", "0", "-1", "0", "1", "0", "0", "0", "0", "1"};
  const Json found = registered(ellipsoid, ellipsoid + turn, {"--kind", "rigid", "--html", "page.html"});
  EXPECT_EQ(found["found"], true);
  EXPECT_LT(found["rms"], 1e-12);
  EXPECT_EQ(found["slippage"]["dimension"], 0);
  EXPECT_NE(file("page.html").find("2 frame of the target (magenta), 3 frame of the source"), std::string::npos);
}

TEST_F(Program_register, continuous_symmetries_have_generators_and_no_order) {
  const Json found = symmetries(
      Arguments{"--function", "(x^2+y^2+z^2+.84)^2=4*(x^2+y^2)", "--resolution", "24", "--html", "torus.html"} + box +
      transform);
  EXPECT_TRUE(found["order"].is_null());
  EXPECT_EQ(found["continuous"]["dimension"], 1);
  EXPECT_EQ(found["continuous"]["generators"].size(), 1U);
  EXPECT_EQ(found["maps"].size(), 1U);
  EXPECT_NE(file("torus.html").find("generator1_x"), std::string::npos);
}

TEST_F(Program_register_long, symmetries_of_samples_and_vertices_are_found_within_their_accuracy) {
  const Arguments quartic = Arguments{"--function", "x^4+y^4/2+z^4+.5*x*y*z+x^2+y^2+z^2=1"} + box;
  run_well(Arguments{"sample", "-o", "s.vti", "--resolution", "60"} + quartic);
  run_well(Arguments{"mesh", "-o", "s.ply", "--resolution", "40", "--attributes", "none"} + quartic);
  for (const Arguments& source : {quartic, {"s.vti"}, {"s.ply"}}) EXPECT_EQ(symmetries(source)["order"], 8);
}

TEST_F(Program_register, a_noisy_mesh_is_found_in_itself_at_a_scale_that_is_tried) {
  run_well(Arguments{"mesh", "--function",
                     "x^4+y^4+z^4-1+.31*x^3-.22*x^2*y+.13*x^2*z+.27*x*y^2-.35*x*y*z+.03*sin(25*x)", "--resolution",
                     "40", "-o", "a.off"} +
           box);
  const Json found = registered({"a.off"}, {"a.off"}, {"--kind", "rigid"});
  ASSERT_EQ(found["found"], true);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      EXPECT_NEAR(found["matrix"][row][column], row == column ? 1 : 0, 1e-3);
}

/// A box with sides 2, 1.4 and 0.8, less its last face if it is open.
std::string box_mesh(bool is_open) {
  std::string text = std::string("OFF\n8 ") + (is_open ? "5" : "6") + " 0\n";
  for (const char* z : {"0", ".8"})
    for (const char* xy : {"0 0 ", "2 0 ", "2 1.4 ", "0 1.4 "}) text.append(xy).append(z).append("\n");
  text += "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  return is_open ? text : text + "4 4 5 6 7\n";
}

TEST_F(Program_register, a_mesh_with_flat_faces_has_its_symmetries_with_planes_and_axes) {
  write_file(folder_ / "box.off", box_mesh(false));
  const std::string out =
      run_well({"symmetries", "box.off", "--kind", "rigid", "-o", "maps.json", "--html", "page.html"});
  EXPECT_EQ(out, "8 symmetries, 4 of them reverse orientation\nwrote maps.json\nwrote page.html\n");
  const Json found = Json::parse(file("maps.json"));
  EXPECT_EQ(found["source"], "the mesh 'box.off'");
  EXPECT_EQ(found["verdict"], "exact");
  EXPECT_TRUE(found["undecided"].is_null());
  ASSERT_EQ(found["levels"].size(), 1U);
  EXPECT_EQ(found["levels"][0]["order"], 8);
  EXPECT_LT(found["levels"][0]["rms"], 1e-12);
  for (const char* text : {"8 exactly", "1 planes of reflection (magenta)", "2 axes of rotation (dark violet)"})
    EXPECT_NE(file("page.html").find(text), std::string::npos) << text;
  EXPECT_EQ(symmetries({"box.off"})["order"], 48) << "it is an affine cube";
  EXPECT_EQ(symmetries({"--distance-to", "box.off", "--kind", "rigid", "--no-reflections"})["order"], 4);
  const Arguments sheared = Arguments{"--fit", "box.off"} + transform;
  EXPECT_EQ(symmetries(sheared)["order"], 48);
  EXPECT_EQ(symmetries(sheared + Arguments{"--kind", "rigid"})["order"], 2);
}

TEST_F(Program_register, what_is_not_known_of_symmetries_is_undecided_with_a_reason) {
  write_file(folder_ / "triangle.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string out = run_well({"symmetries", "triangle.off", "--kind", "rigid", "-o", "maps.json"});
  EXPECT_TRUE(out.starts_with("undecided: ")) << out;
  const Json found = Json::parse(file("maps.json"));
  EXPECT_TRUE(found["order"].is_null());
  EXPECT_EQ(found["verdict"], "undecided");
  EXPECT_FALSE(std::string(found["undecided"]).empty());
}

TEST_F(Program_register, rigid_symmetries_are_sought_where_affine_ones_cannot_be) {
  write_file(folder_ / "open.off", box_mesh(true));
  const std::string out = run_well({"symmetries", "open.off", "-o", "maps.json"});
  EXPECT_TRUE(out.starts_with("only rigid symmetries, since affine ones need a mesh that bounds a solid")) << out;
  const Json found = Json::parse(file("maps.json"));
  EXPECT_EQ(found["kind"], "rigid");
  EXPECT_EQ(found["order"], 4);
  EXPECT_EQ(symmetries({"open.off", "--kind", "rigid"})["order"], 4);
}

TEST_F(Program_register, symmetries_of_a_piece_say_that_the_surface_goes_on) {
  const std::string out = run_well({"symmetries", "--function", "cos(x)+cos(y)+cos(z)", "--box", "-3.2", "3.2", "-3.2",
                                    "3.2", "-3.2", "3.2", "--kind", "rigid", "-o", "maps.json"});
  EXPECT_TRUE(out.starts_with("48 symmetries, 24 of them reverse orientation\n")) << out;
  EXPECT_NE(out.find("the surface continues outside the box"), std::string::npos) << out;
  EXPECT_EQ(Json::parse(file("maps.json"))["order_in_box"], 48);
}

/// A prism over a regular polygon, its upper one turned by a part of the angle of a side, or its mirror image.
std::string prism_mesh(int sides, double part = 0, bool is_mirrored = false) {
  std::ostringstream points, faces, top, bottom;
  points.precision(17);
  const double unit = 2 * std::acos(-1.) / sides;
  for (const double z : {0., 1.})
    for (int k = 0; k < sides; ++k)
      points << std::cos(unit * (k + z * part)) << ' ' << (is_mirrored ? -1 : 1) * std::sin(unit * (k + z * part))
             << ' ' << z << '\n';
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    faces << "3 " << k << ' ' << next << ' ' << sides + k << "\n3 " << next << ' ' << sides + next << ' ' << sides + k
          << '\n';
    top << ' ' << sides + k;
    bottom << ' ' << sides - 1 - k;
  }
  faces << sides << top.str() << '\n' << sides << bottom.str() << '\n';
  return "OFF\n" + std::to_string(2 * sides) + ' ' + std::to_string(2 * sides + 2) + " 0\n" + points.str() +
         faces.str();
}

TEST_F(Program_register_long, solids_with_other_numbers_of_sides_are_not_equal) {
  write_file(folder_ / "17.off", prism_mesh(17));
  write_file(folder_ / "18.off", prism_mesh(18));
  write_file(folder_ / "left.off", prism_mesh(17, .3));
  write_file(folder_ / "right.off", prism_mesh(17, .3, true));
  const Arguments rigid = {"--kind", "rigid"};
  EXPECT_EQ(registered({"17.off"}, {"18.off"}, rigid)["found"], false);
  EXPECT_EQ(registered({"left.off"}, {"right.off"}, rigid + Arguments{"--no-reflection"})["found"], false);
  const Json mirrored = registered({"left.off"}, {"right.off"}, rigid);
  ASSERT_EQ(mirrored["found"], true);
  EXPECT_EQ(mirrored["equally_good"], 33) << "it has 34 symmetries";
}

TEST_F(Program_register_long, contact_along_a_curve_is_no_overlap) {
  const Arguments nodes = {"--box", "-2", "2", "-2", "2", "-2", "2", "--resolution", "31"};
  EXPECT_EQ(registered(Arguments{"--function", "x^2+2*y^2+3*z^2=1"} + nodes,
                       Arguments{"--function", "x^2+2*y^2+3.01*z^2=1"} + nodes, {"--kind", "rigid"})["found"],
            false);
}

} // namespace register_test
