// SPDX-License-Identifier: GPL-3.0-or-later
// `mesh --fit FILE --method remesh`: meshes that stay whole.
#include "support/written_meshes.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace {

using namespace equiaffine::test;
using Json = nlohmann::json;

class Program_remesh : public Written_meshes_test {
protected:
  void SetUp() override {
    Written_meshes_test::SetUp();
    run_well({"mesh", "-o", "torus.off", "--function", "(sqrt(x^2+y^2)-1)^2+z^2-.16", "--box", "-1.5", "1.5", "-1.5",
              "1.5", "-.5", ".5", "--resolution", "40", "--attributes", "none"});
  }

  Json statistics_of_remesh(const Arguments& options) {
    const Result result = run(
        Arguments{"mesh", "--fit", "torus.off", "--method", "remesh", "-o", "out.ply", "--stats", "s.json"} + options);
    EXPECT_EQ(result.status, 0) << result.error;
    return Json::parse(file("s.json"));
  }
};

TEST_F(Program_remesh, a_closed_mesh_stays_closed_and_says_what_became_of_its_vertices) {
  const Json statistics = statistics_of_remesh({"--edge-length", ".1"});
  EXPECT_EQ(statistics["euler_characteristic"], 0);
  EXPECT_EQ(statistics["boundary_edges"], 0);
  const Json& remesh = statistics["remesh"];
  EXPECT_EQ(remesh["edge_length"], .1);
  EXPECT_EQ(remesh["crossings"], 0);
  EXPECT_LT(remesh["distance_from_data"]["on_fit"], .02);
  const Mesh out = mesh("out.ply");
  const std::vector<double> outcomes = column(out, "fit_outcome");
  const auto on_fit = std::count(outcomes.begin(), outcomes.end(), 0.);
  EXPECT_EQ(remesh["vertices"]["on_fit"], on_fit);
  EXPECT_GT(double(on_fit), .95 * double(outcomes.size()));
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i] != 0) continue;
    const auto& p = out.mesh.points[i];
    EXPECT_NEAR(std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()), .4, 2e-3);
  }
}

TEST_F(Program_remesh, a_transformation_moves_the_remesh) {
  statistics_of_remesh({"--attributes", "none"});
  const Mesh plain = mesh("out.ply");
  const Json statistics =
      statistics_of_remesh({"--transform", "2", "0", "0", "0", "2", "0", "0", "0", "-2", "1", "0", "0"});
  EXPECT_EQ(statistics["boundary_edges"], 0);
  EXPECT_LT(statistics["max_distance_to_surface"], 1e-9);
  const Mesh moved = mesh("out.ply");
  ASSERT_EQ(moved.mesh.points.size(), plain.mesh.points.size());
  for (std::size_t i = 0; i < moved.mesh.points.size(); ++i)
    EXPECT_NEAR(moved.mesh.points[i].x(), 2 * plain.mesh.points[i].x() + 1, 1e-12);
}

TEST_F(Program_remesh, what_has_no_faces_or_no_fit_is_refused) {
  expect_error({"mesh", "-o", "out.ply", "--function", "x^2+y^2+z^2=1", "--box", "-2", "2", "-2", "2", "-2", "2",
                "--method", "remesh"},
               {"--method", "remesh", "--fit FILE"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--resolution", "20"},
               {"--resolution", "no grid"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--isovalue", ".1"},
               {"--isovalue", "remesh"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--resolution", "20", "--edge-length", ".1"},
               {"--edge-length", "add --method remesh"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--edge-length", "-1"},
               {"--edge-length", "-1"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--edge-length", "1e-9"},
               {"a remesh of the data", "10^8 triangles"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--feature-angle", "200"},
               {"--feature-angle", "'200'"});
  run_well({"mesh", "-o", "points.csv", "--fit", "torus.off", "--resolution", "30", "--attributes", "none"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "points.csv", "--method", "remesh"},
               {"points.csv", "points without faces", "marching-cubes"});
}

} // namespace
