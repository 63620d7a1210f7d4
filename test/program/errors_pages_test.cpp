// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "program/errors_fixture.h"
#include "support/run_program.h"
#include "system/process.h"
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace errors_pages_test {

using namespace equiaffine::test;
using namespace errors_fixture;

TEST_F(Program_errors, a_page_shows_what_the_mesh_has) {
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "in.ply"} + box);
  before_ = names();
  expect_error({"view", "in.ply", "-o", "o.html", "--color", "affine_k1"},
               {"--color", "'affine_k1'", "mean_curvature"});
  expect_error({"view", "in.ply", "-o", "o.html", "--up", "w"}, {"--up", "'w'", "x or y or z or auto"});
  for (const char* option : {"--color", "--up"})
    expect_error(mesh_of("x") + box + Arguments{option, "x"}, {option, "--html", "--png"});
  expect_error(mesh_of("x") + box + Arguments{"--colors", "linear"}, {"--colors", "--html", "--png"});
  expect_error({"view", "in.ply", "-o", "o.html", "--colors", "red"}, {"--colors", "'red'", "equalized"});
  expect_error({"view", "in.ply"}, {"the output is missing", "-o PAGE.html", "--png"});
}

TEST_F(Program_errors, colors_come_from_a_page_or_a_mesh) {
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "in.ply"} + box);
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "few.ply", "--attributes", "k1"} + box);
  write_file(folder_ / "other.html", "<html></html>");
  before_ = names();
  const Arguments view = {"view", "in.ply", "-o", "o.html", "--color", "mean_curvature", "--range-of"};
  expect_error(view + Arguments{"other.html"}, {"--range-of", "'other.html'", "no color scales", "page"});
  expect_error(view + Arguments{"none.html"}, {"--range-of", "'none.html'"});
  expect_error(view + Arguments{"in.off"}, {"--range-of", "'in.off'", ".html", ".ply"});
  expect_error(view + Arguments{"few.ply"}, {"--range-of", "'few.ply'", "'mean_curvature'", "--color"});
  expect_error(view + Arguments{"in.ply", "--range", "1", "2"}, {"--range-of", "--range", "leave one"});
  expect_error(view + Arguments{"o.html"}, {"'o.html'", "would overwrite"});
}

#ifdef EQUIAFFINE_WITH_VTK
TEST_F(Program_errors, too_little_memory_for_a_picture_has_an_advice_that_view_can_follow) {
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "in.ply", "--attributes", "normal"} + box);
  const Arguments view = {"view", folder_ / "in.ply", "--png", folder_ / "p.png", "--size", "10000", "10000"};
  const auto task = [&] {
    std::ostringstream out, error;
    equiaffine::run(view, {out, error});
    throw equiaffine::Input_error("", error.str());
  };
  try {
    equiaffine::run_in_child(task, {60, 1e8}); // the bytes of the picture alone are 3e8
    FAIL() << "it fits";
  } catch (const equiaffine::Input_error& error) {
    EXPECT_EQ(error.excerpt(),
              "equiaffine: error: not enough memory; use a smaller --size, or a mesh with fewer triangles\n");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "p.png"));
}
#endif

TEST_F(Program_errors, a_picture_has_a_size_a_range_and_vectors_that_exist) {
  const Arguments picture = mesh_of("x") + box;
  for (const char* option : {"--size", "--range"})
    expect_error(picture + Arguments{option, "200", "300"}, {option, "--png"});
  expect_error(picture + Arguments{"--arrows", "normal"}, {"--arrows", "--png"});
#ifdef EQUIAFFINE_WITH_VTK
  const Arguments png = picture + Arguments{"--png", "p.png"};
  expect_error(png + Arguments{"--size", "200", "99"}, {"--size", "'99'", "such as 100"});
  expect_error(png + Arguments{"--size", "20000", "200"}, {"--size", "'20000'", "10000"});
  expect_error(png + Arguments{"--range", "2", "2"}, {"--range", "'2'", "smaller number first"});
  expect_error(png + Arguments{"--arrows", "metric"}, {"--arrows", "'metric'", "affine_normal"});
  expect_error(picture + Arguments{"--png", "p.jpg"}, {"'p.jpg'", ".png"});
  run_well(Arguments{"mesh", "--function", "x", "--resolution", "3", "-o", "in.ply", "--attributes", "normal"} + box);
  before_ = names();
  expect_error({"view", "in.ply", "--png", "p.png", "--arrows", "conormal"}, {"--arrows", "'conormal'", "conormal_x"});
  expect_error({"view", "in.ply", "-o", "same", "--png", "same"}, {"two outputs", "'same'"});
#else
  expect_error(picture + Arguments{"--png", "p.png"}, {"'p.png'", "without VTK", "--html"});
#endif
}

} // namespace errors_pages_test
