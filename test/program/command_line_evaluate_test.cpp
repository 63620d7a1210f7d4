// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line_fixture.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace command_line_evaluate_test {

using namespace equiaffine::test;
using namespace command_line_fixture;

// The sphere of radius 1: all estimators agree where f_z is large; where it is small, z alone loses digits; and on the
// equator the paper's formulas along z have no value, as the status says.
TEST_F(Program_command_line, the_estimators_of_the_paper_can_be_chosen) {
  const auto row = [&](const std::string& estimator, const std::string& point) {
    return rows(
               run_well({"evaluate", "--function", "x^2+y^2+z^2", "--estimator", estimator, "--points", "-", "-o", "-"},
                        "x,y,z\n" + point + "\n"))
        .at(0);
  };
  for (const char* estimator : {"compact", "transformation", "direct", "direct-z"}) {
    auto attributes = row(estimator, "0.48,0.36,0.8");
    EXPECT_NEAR(std::stod(attributes["affine_gaussian_curvature"]), 1, rounding) << estimator;
    EXPECT_NEAR(std::stod(attributes["affine_mean_curvature"]), -1, rounding) << estimator;
    EXPECT_NEAR(std::stod(attributes["affine_normal_x"]), 0.48, rounding) << estimator;
    EXPECT_EQ(attributes["status"], "regular") << estimator;
  }
  const std::string near_equator = "0.6,0.79999999,0.0001264911";
  EXPECT_NEAR(std::stod(row("direct", near_equator)["affine_gaussian_curvature"]), 1, 1e-7);
  EXPECT_NE(row("direct", near_equator), row("direct-z", near_equator));
  EXPECT_EQ(row("direct", "0.6,0.8,0")["status"], "regular");
  EXPECT_EQ(row("direct-z", "0.6,0.8,0")["status"], "outside");
  EXPECT_EQ(row("direct-z", "0.6,0.8,0")["affine_gaussian_curvature"], "nan");

  // Norms of gradients are those of every estimator.
  const auto quartic = [&](const std::string& estimator) {
    const std::string names = "affine_gaussian_curvature,affine_gaussian_curvature_gradient,affine_mean_curvature";
    return rows(run_well({"evaluate", "--function", "x^4 + y^4 + z^4", "--attributes", names, "--estimator", estimator,
                          "--points", "-", "-o", "-"},
                         "x,y,z\n0.5,0.6,0.7\n"))
        .at(0);
  };
  auto expected = quartic("compact"), direct = quartic("direct-z");
  for (const char* name : {"affine_gaussian_curvature", "affine_mean_curvature"})
    EXPECT_NEAR(std::stod(direct[name]) / std::stod(expected[name]), 1, rounding) << name;
  EXPECT_EQ(direct["affine_gaussian_curvature_gradient"], expected["affine_gaussian_curvature_gradient"]);

  const auto mesh = [&](const Arguments& choice) {
    run_well(Arguments{"mesh", "-o", "s.csv", "--resolution", "5"} + sphere + choice);
    return file("s.csv");
  };
  EXPECT_EQ(mesh({"--estimator", "compact"}), mesh({}));
  EXPECT_NE(mesh({"--estimator", "transformation"}), mesh({}));
}

TEST_F(Program_command_line, evaluate_keeps_rows_columns_and_order) {
  const std::string out =
      run_well({"evaluate", "--function", "x^2 + y^2 + z^2", "--attributes", "k1", "--points", "-", "-o", "-"},
               "name,z,y,x,k1\nfar,0,0,-4,old\n\"a, b\",1,0,0,old\norigin,0,0,0,old\nfar,0,0,-4,old\n");
  EXPECT_EQ(out, "name,z,y,x,k1,status\nfar,0,0,-4,-0.25,regular\n\"a, b\",1,0,0,-1,regular\n"
                 "origin,0,0,0,nan,singular\nfar,0,0,-4,-0.25,regular\n");
}

TEST_F(Program_command_line, evaluate_writes_the_whole_header_for_no_points) {
  const Arguments arguments = {"evaluate", "--function", "x", "--attributes", "k1", "--points", "-", "-o"};
  EXPECT_EQ(run_well(arguments + Arguments{"-"}, "name,x,y,z\n"), "name,x,y,z,k1,status\n");
  run_well(arguments + Arguments{"p.ply"}, "x,y,z\n");
  EXPECT_NE(file("p.ply").find("element vertex 0\nproperty double x\nproperty double y\nproperty double z\n"
                               "property double k1\nproperty uchar status\nelement face 0\n"),
            std::string::npos);
  EXPECT_EQ(run_well({"evaluate", "--function", "x", "--points", "p.ply", "--attributes", "none", "-o", "-"}),
            "x,y,z,k1,status\n");
}

TEST_F(Program_command_line, points_without_finite_coordinates_are_outside) {
  write_file(folder_ / "p.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
                                "property double z\nend_header\nnan 0 0\n0 inf 0\n0 0 -inf\n0.5 0.5 0.5\n");
  const Arguments choice = {"evaluate", "--points", "p.ply", "--attributes", "nx,k1", "-o", "-"};
  const Arguments transformation = {"--transform", "1", "1", "0", "0", "1", "0", "0", "0", "2"};
  const Arguments spline = {"--derivatives", "spline", "--resolution", "24"};
  for (const Arguments& way : {Arguments{}, transformation, spline, spline + transformation}) {
    const auto table = rows(run_well(choice + sphere + way));
    ASSERT_EQ(table.size(), 4U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(table[i].at("status"), "outside") << i;
      EXPECT_EQ(table[i].at("nx") + table[i].at("k1"), "nannan") << i;
    }
    EXPECT_EQ(table[3].at("status"), "regular");
  }
  const std::string cells = "x,y,z\nnan,0,0\n0,-nan,0\n0,0,-inf\n";
  for (const auto& row : rows(run_well(Arguments{"evaluate", "--points", "-", "-o", "-"} + sphere, cells))) {
    EXPECT_EQ(row.at("status"), "outside");
    EXPECT_EQ(row.at("k1"), "nan");
  }
}

TEST_F(Program_command_line, evaluate_writes_PLY_from_CSV_and_back) {
  write_file(folder_ / "p.csv", "x,y,z,weight\n1,2,3,7\n-1,.5,2,8\n");
  const Arguments choice = {"--attributes", "mean_curvature"};
  run_well(Arguments{"evaluate", "--points", "p.csv", "-o", "p.ply"} + ellipsoid + choice);
  EXPECT_NE(file("p.ply").find("property double weight\nproperty double mean_curvature\nproperty uchar status\n"),
            std::string::npos);
  run_well(Arguments{"evaluate", "--points", "p.ply", "-o", "again.csv"} + ellipsoid + choice);
  run_well(Arguments{"evaluate", "--points", "p.csv", "-o", "direct.csv"} + ellipsoid + choice);
  const auto again = rows(file("again.csv")), direct = rows(file("direct.csv"));
  ASSERT_EQ(again.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].at("mean_curvature"), direct[i].at("mean_curvature"));
    EXPECT_EQ(std::stod(again[i].at("weight")), std::stod(direct[i].at("weight")));
  }
}

TEST_F(Program_command_line, a_transform_may_have_a_translation) {
  const Arguments square = {"--function", "x^2 + y^2 + z^2"},
                  map = {"--transform", "1", "0", "0", "0", "1", "0", "0", "0", "2", "-.5", "-1e1", "-.25"};
  const auto at_origin = evaluate(square + Arguments(map.begin(), map.begin() + 10), ".5,1,1.5"),
             translated = evaluate(map + square, "0,-9,1.25");
  EXPECT_EQ(translated.at("status"), "regular");
  for (const char* name : {"gaussian_curvature", "affine_mean_curvature", "nx", "ny", "nz"})
    EXPECT_NEAR(std::stod(at_origin.at(name)), std::stod(translated.at(name)), 1e-13) << name;
}

TEST_F(Program_command_line, a_transform_changes_affine_curvatures_by_their_weights) {
  // |det A| = 6; the image of (0.5, 0.6, 0.4) is (1.6, 1.2, 1.2).
  const auto before = evaluate(ellipsoid, "0.5,0.6,0.4");
  const auto after =
      evaluate(ellipsoid + Arguments{"--transform", "2", "1", "0", "0", "-2", "6", "0", "0", "-1.5"}, "1.6,1.2,-.6");
  const auto ratio = [&](const std::string& name) { return std::stod(after.at(name)) / std::stod(before.at(name)); };
  EXPECT_NEAR(ratio("affine_gaussian_curvature") * 6, 1, rounding);
  EXPECT_NEAR(ratio("affine_mean_curvature") * std::sqrt(6), 1, rounding);
  EXPECT_EQ(after.at("status"), "regular");
}

TEST_F(Program_command_line, orientation_against_the_gradient_changes_signs) {
  const auto along = evaluate(ellipsoid, "0.5,0.6,0.4"),
             against = evaluate(ellipsoid + Arguments{"--orientation", "against"}, "0.5,0.6,0.4");
  for (const std::string name :
       {"nx", "mean_curvature", "affine_mean_curvature", "conormal_x", "affine_normal_y", "metric_xx"})
    EXPECT_DOUBLE_EQ(std::stod(against.at(name)), -std::stod(along.at(name))) << name;
  for (const std::string name : {"gaussian_curvature", "affine_gaussian_curvature"})
    EXPECT_DOUBLE_EQ(std::stod(against.at(name)), std::stod(along.at(name))) << name;
}

TEST_F(Program_command_line, the_signature_is_computed_on_request_alone) {
  const std::string names = "affine_gaussian_curvature,affine_mean_curvature,pick_invariant";
  const std::string header = "x,y,z," + names + ",affine_gaussian_curvature_gradient,affine_mean_curvature_gradient," +
                             "pick_invariant_gradient,status";
  const Arguments evaluate = {"evaluate", "--function", "x*y*z + x^3", "--points", "-", "-o", "-", "--attributes"};
  const std::string signature = run_well(evaluate + Arguments{"signature"}, "x,y,z\n1,2,3\n");
  EXPECT_EQ(signature.substr(0, signature.find('\n')), header);
  const auto row = rows(signature).at(0);
  for (const char* name : {"affine_gaussian_curvature", "affine_mean_curvature", "pick_invariant"})
    EXPECT_GT(std::stod(row.at(std::string(name) + "_gradient")), 0) << name;
  const std::string one = run_well(evaluate + Arguments{"pick_invariant_gradient"}, "x,y,z\n1,2,3\n");
  EXPECT_EQ(rows(one).at(0).at("pick_invariant_gradient"), row.at("pick_invariant_gradient"));
  EXPECT_EQ(run_well(evaluate + Arguments{"all"}, "x,y,z\n").find("gradient"), std::string::npos);
  EXPECT_EQ(run_well(evaluate + Arguments{"quadric_defect"}, "x,y,z\n"), "x,y,z,quadric_defect,status\n");
}

TEST_F(Program_command_line, areas_come_with_a_mesh_and_are_refused_without_one) {
  const Arguments areas = {"--attributes", "vertex_area,affine_area"};
  run_well(Arguments{"mesh", "-o", "s.ply", "--resolution", "16", "--attributes", "none"} + sphere);
  run_well(Arguments{"mesh", "-o", "s.csv", "--resolution", "16"} + sphere + areas);
  double area = 0, affine_area = 0;
  for (const auto& row : rows(file("s.csv"))) {
    area += std::stod(row.at("vertex_area"));
    affine_area += std::stod(row.at("affine_area"));
  }
  EXPECT_NEAR(area / (4 * std::numbers::pi), 1, 0.02);
  EXPECT_NEAR(affine_area / area, 1, 1e-9) << "of a sphere of radius 1";
  const Arguments evaluate = Arguments{"evaluate", "-o", "-", "--function", "x^2+y^2+z^2-1"} + areas;
  const auto of_mesh = rows(run_well(evaluate + Arguments{"--points", "s.ply"}));
  EXPECT_EQ(of_mesh.at(3).at("vertex_area"), rows(file("s.csv")).at(3).at("vertex_area"));
  EXPECT_NE(run(evaluate + Arguments{"--points", "-"}, "x,y,z\n1,2,3\n").error.find("'vertex_area'"),
            std::string::npos);
  run_well(Arguments{"annotate", "s.ply", "-o", "annotated.csv"} + areas);
  EXPECT_EQ(rows(file("annotated.csv")).at(3).at("vertex_area"), of_mesh.at(3).at("vertex_area"));
}

} // namespace command_line_evaluate_test
