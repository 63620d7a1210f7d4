// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line_fixture.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <string>

namespace command_line_page_test {

using namespace equiaffine::test;
using namespace command_line_fixture;

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

} // namespace command_line_page_test
