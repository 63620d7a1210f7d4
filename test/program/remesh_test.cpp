// SPDX-License-Identifier: GPL-3.0-or-later
// `mesh --fit FILE --method remesh`: meshes that stay whole.
#include "support/tori.h"
#include "support/written_meshes.h"
#include <equiaffine/io/write_mesh.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace remesh_test {

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
using Program_remesh_long = Program_remesh;

TEST_F(Program_remesh, a_closed_mesh_stays_closed_and_says_what_became_of_its_vertices) {
  const Json statistics = statistics_of_remesh({"--edge-length", ".1"});
  EXPECT_EQ(statistics["euler_characteristic"], 0);
  EXPECT_EQ(statistics["boundary_edges"], 0);
  const Json& remesh = statistics["remesh"];
  EXPECT_EQ(remesh["edge_length"], .1);
  EXPECT_EQ(remesh["crossings"], 0);
  EXPECT_LT(remesh["distance_from_data"]["on_fit"], .02);
  EXPECT_LE(remesh["distance_from_data"]["on_fit"], remesh["distance_from_data"]["triangles"]);
  EXPECT_LT(remesh["distance_from_data"]["triangles"], .02);
  EXPECT_LT(remesh["distance_of_data"], .02);
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

TEST_F(Program_remesh_long, a_transformation_moves_the_remesh) {
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

TEST_F(Program_remesh_long, a_closed_mesh_stays_closed_although_two_of_its_points_coincide) {
  run_well({"mesh", "-o", "torus.ply", "--fit", "torus.off", "--attributes", "none"});
  Mesh torus = mesh("torus.ply");
  const auto& triangles = torus.mesh.triangles;
  std::set<std::uint32_t> around; // of vertex 0
  const auto is_near = [](const auto& t, std::uint32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); };
  for (const auto& t : triangles)
    if (is_near(t, 0)) around.insert(t.begin(), t.end());
  around.erase(0);
  const std::uint32_t a = *around.begin();
  for (const auto& t : triangles)
    if (is_near(t, a)) around.erase(t[0]), around.erase(t[1]), around.erase(t[2]);
  ASSERT_FALSE(around.empty());
  torus.mesh.points[*around.begin()] = torus.mesh.points[a]; // neighbors of a vertex, and not of each other
  std::ostringstream text;
  equiaffine::write_OFF(text, torus.mesh);
  write_file(folder_ / "torus.off", text.str());
  const Json statistics = statistics_of_remesh({"--attributes", "none"});
  EXPECT_EQ(statistics["boundary_edges"], 0);
  EXPECT_EQ(statistics["euler_characteristic"], 0);
}

TEST_F(Program_remesh_long, what_has_no_faces_or_no_fit_is_refused) {
  expect_error({"mesh", "-o", "out.ply", "--function", "x^2+y^2+z^2=1", "--box", "-2", "2", "-2", "2", "-2", "2",
                "--method", "remesh"},
               {"--method", "remesh", "--fit FILE"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--resolution", "20"},
               {"--resolution", "no grid"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--level", ".1"},
               {"--level", "remesh"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--resolution", "20", "--edge-length", ".1"},
               {"--edge-length", "add --method remesh"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--edge-length", "-1"},
               {"--edge-length", "-1"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--edge-length", "1e-9"},
               {"cannot remesh the data", "10^8 triangles"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "torus.off", "--method", "remesh", "--feature-angle", "200"},
               {"--feature-angle", "'200'"});
  run_well({"mesh", "-o", "points.csv", "--fit", "torus.off", "--resolution", "30", "--attributes", "none"});
  expect_error({"mesh", "-o", "out.ply", "--fit", "points.csv", "--method", "remesh"},
               {"points.csv", "no faces", "marching-cubes"});
}

TEST_F(Program_remesh_long, a_scale_that_is_too_large_for_the_shape_becomes_smaller) {
  write_file(folder_ / "tori.off", tori());
  const auto statistics = [&](const Arguments& options) {
    EXPECT_EQ(run(Arguments{"mesh", "--fit", "tori.off", "-o", "out.ply", "--stats", "s.json"} + options).status, 0);
    return Json::parse(file("s.json"));
  };
  const auto part_beside_fit = [](const Json& s) {
    const Json& vertices = s["remesh"]["vertices"];
    return 1 - vertices["on_fit"].get<double>() / s["vertices"].get<double>();
  };
  const Json free = statistics({}), large = statistics({"--scale", "1"});
  EXPECT_GT(part_beside_fit(large), .05);
  EXPECT_LT(part_beside_fit(free), 2. / 3 * part_beside_fit(large));
  EXPECT_LT(free["fit"]["scale"].get<double>(), .8);
}

} // namespace remesh_test
