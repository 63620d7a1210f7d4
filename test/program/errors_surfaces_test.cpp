// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/errors_fixture.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <string>

namespace errors_surfaces_test {

using namespace equiaffine::test;
using namespace errors_fixture;
using Program_errors_long = Program_errors;

TEST_F(Program_errors, criteria_of_a_Delaunay_mesh_can_be_satisfied) {
  const Arguments delaunay = mesh_of("x") + box + Arguments{"--method", "delaunay"};
  for (const char* option : {"--radius", "--distance"}) {
    for (const char* bad : {"0", "-1", "nan", "wide"})
      expect_error(delaunay + Arguments{option, bad}, {option, std::string("'").append(bad).append("'")});
    expect_error(delaunay + Arguments{option, "1e-14"}, {option, "1e-14", "GB of memory", "use larger values"});
  }
  for (const char* bad : {"30.1", "-1", "inf"}) expect_error(delaunay + Arguments{"--angle", bad}, {"--angle", bad});
  for (const char* side : {"1e50", "1e-50"}) {
    const std::string low = std::string("-") + side;
    expect_error(mesh_of("x") + Arguments{"--method", "delaunay", "--box", low, side, low, side, low, side},
                 {"diagonal", "choose another unit"});
  }
}

TEST_F(Program_errors, a_surface_without_triangles_is_told_from_none) {
  expect_error(
      mesh_of("y^2 + z^2 - 0.2") + Arguments{"--method", "delaunay", "--box", "0", "1000", "-.5", ".5", "-.5", ".5"},
      {"no part of the surface f = 0 was found in the box", "between -0.2 and 0.3; choose a smaller --radius"});
}

TEST_F(Program_errors, facets_that_coordinates_cannot_tell_apart_are_refused) {
  expect_error(mesh_of("x - 1e17") +
                   Arguments{"--method", "delaunay", "--box", "1e17", "100000000000000016", "-1", "1", "-1", "1"},
               {"a radius of 0.32", "too small for coordinates up to 1e+17", "choose a larger --radius"});
}

TEST_F(Program_errors, a_surface_outside_the_box_is_none) {
  const Arguments delaunay = {"--method", "delaunay"};
  expect_error(mesh_of("x^2 + y^2 + z^2 + 1") + box + delaunay,
               {"no surface f = 0 in the box", "between 1 and 13", "choose another --level or box"});
  expect_error(mesh_of("x^2 + y^2 + z^2 - 10") + box + delaunay + Arguments{"--clip", "ball", "--stats", "o.json"},
               {"no surface f = 0 in the ball", "between -10 and 2"});
  expect_error(mesh_of("log(-1 - x^2)") + box + delaunay, {"undefined", "choose another --level or box"});
  expect_error(mesh_of("x^2 + y^2 + z^2 + 1") + box, {"no surface f = 0", "between 1 and 13"});
  expect_error(mesh_of("x") + box + Arguments{"--level", "3", "--html", "o.html", "--stats", "o.json"},
               {"no surface f = 3"});
  expect_error(mesh_of("log(-1 - x^2)") + box, {"undefined"});
}

TEST_F(Program_errors_long, it_is_not_said_that_there_is_no_surface_where_none_was_found) {
  const Arguments found = {"no part of the surface f = 0 was found"};
  const Arguments unseen = mesh_of("log(1e-6-(x-1.31)^2-(y-.73)^2-(z-.1)^2)+14") + box;
  expect_error(unseen, found + Arguments{"is undefined", "a finer --resolution"});
  const Arguments delaunay = {"--method", "delaunay", "--radius", "0.3"};
  for (const Arguments& method : {Arguments{}, delaunay})
    for (const char* formula : {"(x^2+y^2+z^2-1)^2", "max(0,x^2+y^2+z^2-1)", "abs(x^2+y^2+z^2-1)", "(x+y-.3)^2+z^2"})
      expect_error(mesh_of(formula) + box + method,
                   found + Arguments{"f touches this value without crossing it", "choose another --level"});
  expect_error(mesh_of("0*x") + box, found + Arguments{"f has this value at all nodes of a grid"});
  expect_error(mesh_of("x^2+y^2+z^2+1e-9") + box, {"no surface f = 0 in the box"});
}

TEST_F(Program_errors, a_pole_is_no_surface) {
  const Arguments delaunay = {"--method", "delaunay", "--radius", "0.3"};
  const Arguments words = {"no part of the surface f = 0 was found in the box",
                           "only at poles or jumps; choose another --level or box"};
  for (const Arguments& method : {Arguments{}, delaunay}) expect_error(mesh_of("1/x") + box + method, words);
  expect_error(mesh_of("abs(x)/x*(1+y^2)") + box + delaunay, words);
}

} // namespace errors_surfaces_test
