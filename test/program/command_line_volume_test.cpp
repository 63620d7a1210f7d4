// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line_fixture.h"
#include "support/run_program.h"
#include "volume/volume_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace command_line_volume_test {

using namespace equiaffine::test;
using namespace command_line_fixture;

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
  const Json stats = stats_of({"--volume", "v.nrrd", "--level", "1.5", "--attributes", "none"});
  EXPECT_EQ(stats["vertices"], 6);
  EXPECT_EQ(stats["status"]["outside"], 6);
  EXPECT_EQ(stats["euler_characteristic"], 1);
  EXPECT_TRUE(stats["max_distance_to_surface"].is_null());
  const Result result = run({"mesh", "--volume", "v.nrrd", "--level", "1.5", "-o", "out.ply"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.error, "equiaffine: warning: 6 of 6 vertices are outside and have no attributes: a spline of degree "
                          "7 needs 8 nodes along each axis, and one axis has 2; give more nodes\n");
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

} // namespace command_line_volume_test
