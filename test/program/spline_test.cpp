// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/run_program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace spline_test {

using namespace equiaffine::test;
using Json = nlohmann::json;

// The level sets are ellipsoids and f is not a polynomial: K = 1 / 0.72, H = -sqrt(K), J = 0.
const Arguments ellipsoid = {"--function", "exp(x^2 + y^2/0.81 + z^2/0.64 - 1) - 1",
                             "--box",      "-1.3",
                             "1.3",        "-1.2",
                             "1.2",        "-1.1",
                             "1.1",        "--derivatives",
                             "spline"};
const double gaussian = 1 / 0.72;

using Table = std::map<std::string, std::vector<double>>;

/// Columns of numbers by the names of the header; words are NaN.
Table columns(const std::string& text) {
  const auto cells = [](const std::string& line) {
    Arguments parts;
    std::istringstream stream(line);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
  };
  Table table;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const Arguments header = cells(line);
  while (std::getline(lines, line)) {
    const Arguments row = cells(line);
    for (std::size_t c = 0; c < header.size(); ++c) {
      char* end = nullptr;
      const double number = std::strtod(row.at(c).c_str(), &end);
      table[header[c]].push_back(end == row[c].c_str() ? NAN : number);
    }
  }
  return table;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

class Program_spline : public Program_test {
protected:
  Table mesh(const Arguments& arguments) {
    run_well(Arguments{"mesh", "-o", "out.csv", "--stats", "stats.json"} + arguments);
    return columns(file("out.csv"));
  }
  Json spline() const { return Json::parse(file("stats.json"))["spline"]; }

  /// The error of K over the vertices.
  double median_error(const Arguments& arguments) {
    std::vector<double> errors;
    auto vertices = mesh(arguments);
    for (const double k : vertices["affine_gaussian_curvature"]) errors.push_back(std::abs(k - gaussian));
    return median(errors);
  }

  void expect_error(const Arguments& arguments, const Arguments& words) {
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 2);
    for (const std::string& word : words) EXPECT_NE(result.error.find(word), std::string::npos) << result.error;
    EXPECT_EQ(names(), Arguments{});
  }
};

TEST_F(Program_spline, degrees_and_schemes_can_be_chosen_and_are_in_the_statistics) {
  const Arguments grid = {"--resolution", "40"};
  const double usual = median_error(ellipsoid + grid);
  EXPECT_EQ(spline()["degree"], 7);
  EXPECT_EQ(spline()["scheme"], "quasi-interpolation");
  EXPECT_EQ(spline()["smoothing"], 0);
  EXPECT_LT(spline()["noise"], 1e-6);
  EXPECT_EQ(spline()["quantum"], 0);
  EXPECT_LT(usual, 1e-3);
  EXPECT_GT(median_error(ellipsoid + grid + Arguments{"--spline-degree", "5"}), 10 * usual);
  EXPECT_LT(median_error(ellipsoid + grid + Arguments{"--spline-degree", "9"}), usual / 3);
  EXPECT_EQ(spline()["degree"], 9);
  EXPECT_LT(median_error(ellipsoid + grid + Arguments{"--spline-scheme", "interpolation"}), 10 * usual);
  EXPECT_EQ(spline()["scheme"], "interpolation");
  EXPECT_GT(median_error(ellipsoid + grid + Arguments{"--spline-scheme", "convolution"}), 10 * usual);
  EXPECT_EQ(spline()["scheme"], "convolution");
  EXPECT_GT(median_error(ellipsoid + grid + Arguments{"--spline-scheme", "paper", "--vertices", "linear"}), 10 * usual);
  EXPECT_EQ(spline()["scheme"], "paper");
  EXPECT_EQ(spline()["degree"], 5);
}

TEST_F(Program_spline, points_are_evaluated_with_the_same_options) {
  const auto error = [&](const Arguments& arguments) {
    const Table table = columns(run_well(Arguments{"evaluate", "--points", "-", "-o", "-"} + ellipsoid + arguments,
                                         "x,y,z\n1,0,0\n0.6,0,0.64\n0,0.72,0.48\n"));
    EXPECT_EQ(table.at("affine_gaussian_curvature").size(), 3U);
    return std::abs(table.at("affine_gaussian_curvature")[1] - gaussian);
  };
  EXPECT_LT(error({}), 1e-4);
  EXPECT_LT(error({"--spline-degree", "9"}), 1e-5);
  EXPECT_GT(error({"--spline-scheme", "paper"}), 1e-4);
}

TEST_F(Program_spline, smoothing_is_chosen_from_the_noise) {
  const Arguments noisy = {"--resolution", "64"};
  run_well(Arguments{"sample", "--type", "float", "-o", "volume.nrrd", "--resolution", "64"} +
           Arguments(ellipsoid.begin(), ellipsoid.end() - 2));
  const Arguments volume = {"--volume", "volume.nrrd"};
  const double rough = median_error(volume);
  EXPECT_GT(spline()["quantum"], 0);
  EXPECT_GT(spline()["noise"], 1e-10);
  EXPECT_EQ(spline()["smoothing"], 0);
  EXPECT_LT(median_error(volume + Arguments{"--smoothing", "auto"}), rough / 3);
  EXPECT_GT(spline()["smoothing"], 1);
  EXPECT_LT(median_error(volume + Arguments{"--smoothing", "2.5"}), rough / 3);
  EXPECT_EQ(spline()["smoothing"], 2.5);
  mesh(ellipsoid + noisy + Arguments{"--smoothing", "auto"});
  EXPECT_EQ(spline()["smoothing"], 0) << "what has no noise is left as it is";
  const Result result = run(Arguments{"mesh"} + ellipsoid + Arguments{"--smoothing", "auto", "-o", "out.ply"});
  EXPECT_NE(result.out.find(", which needs no smoothing\n"), std::string::npos) << result.out;
}

TEST_F(Program_spline, smoothing_does_not_erase_a_thin_mask_or_is_named_as_the_cause) {
  std::string bytes; // a slab of 24 x 24 x 2 voxels
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) bytes += char(k >= 20 && k < 22 && std::min(i, j) >= 8 && std::max(i, j) < 32);
  write_file(folder_ / "slab.raw", bytes);
  const Arguments slab = {"--volume", "slab.raw", "--type", "uint8", "--dims", "40", "40", "40", "--level", ".5"};
  const Table table = mesh(slab + Arguments{"--smoothing", "auto"});
  const auto& z = table.at("z");
  EXPECT_LT(*std::min_element(z.begin(), z.end()), 20);
  EXPECT_GT(*std::max_element(z.begin(), z.end()), 21);
  const auto& x = table.at("x");
  EXPECT_LT(*std::min_element(x.begin(), x.end()), 9);
  EXPECT_GT(*std::max_element(x.begin(), x.end()), 30);
  const Result erased = run(Arguments{"mesh", "-o", "out.ply", "--smoothing", "6"} + slab);
  EXPECT_EQ(erased.status, 2);
  EXPECT_NE(erased.error.find("a smaller --smoothing"), std::string::npos) << erased.error;
}

TEST_F(Program_spline, errors_are_estimated_on_request_and_transformed_with_the_surface) {
  const Arguments attributes = {"--attributes",
                                "affine_gaussian_curvature_error,affine_mean_curvature,affine_mean_curvature_error"};
  const Table table = mesh(ellipsoid + attributes);
  EXPECT_EQ(table.count("affine_gaussian_curvature"), 0U);
  const auto& errors = table.at("affine_mean_curvature_error");
  std::size_t covered = 0;
  for (std::size_t v = 0; v < errors.size(); ++v)
    covered += std::abs(table.at("affine_mean_curvature")[v] + std::sqrt(gaussian)) <= errors[v];
  EXPECT_GE(double(covered), 0.9 * double(errors.size()));
  EXPECT_LT(median(errors), 1e-3);
  const Table image =
      mesh(ellipsoid + attributes + Arguments{"--transform", "2", "0", "0", "0", "2", "0", "0", "0", "1"});
  ASSERT_EQ(image.at("affine_mean_curvature_error").size(), errors.size());
  for (std::size_t v = 0; v < errors.size(); v += 101) {
    EXPECT_NEAR(image.at("affine_mean_curvature_error")[v], errors[v] / 2, 1e-8);
    EXPECT_NEAR(image.at("affine_gaussian_curvature_error")[v], table.at("affine_gaussian_curvature_error")[v] / 4,
                1e-8);
  }
}

TEST_F(Program_spline, a_cylinder_given_as_samples_is_parabolic) {
  run_well({"mesh", "--function", "x^2 + y^2 = 1", "--box", "-1.5", "1.5", "-1.5", "1.5", "-1", "1", "--resolution",
            "30", "--derivatives", "spline", "-o", "out.ply", "--stats", "stats.json"});
  const Json stats = Json::parse(file("stats.json"));
  EXPECT_EQ(stats["status"]["parabolic"], stats["vertices"]);
}

TEST_F(Program_spline, a_plane_stored_as_floats_is_nowhere_regular_smoothed_or_not) {
  run_well({"sample", "--function", "0.3*x + 0.5*y + 0.7*z - 0.1", "--box", "-1", "1", "-1", "1", "-1", "1",
            "--resolution", "40", "--type", "float", "-o", "plane.nrrd"});
  for (const char* smoothing : {"0", "auto"}) {
    run_well({"mesh", "--volume", "plane.nrrd", "--smoothing", smoothing, "-o", "out.ply", "--stats", "stats.json"});
    const Json stats = Json::parse(file("stats.json"));
    EXPECT_GT(stats["status"]["parabolic"], 1000) << smoothing;
    EXPECT_EQ(stats["status"]["regular"], 0) << smoothing;
  }
}

TEST_F(Program_spline, options_without_effect_are_refused) {
  const Arguments formula = Arguments(ellipsoid.begin(), ellipsoid.end() - 2) + Arguments{"-o", "out.ply"};
  for (const auto& [option, value] :
       {std::array{"--spline-degree", "9"}, {"--spline-scheme", "convolution"}, {"--smoothing", "2"}})
    expect_error(Arguments{"mesh"} + formula + Arguments{option, value}, {option, "--derivatives spline"});
  expect_error(Arguments{"mesh", "--attributes", "affine_mean_curvature_error"} + formula,
               {"--attributes", "--derivatives spline"});
  const Arguments spline = Arguments{"mesh", "-o", "out.ply"} + ellipsoid;
  expect_error(spline + Arguments{"--spline-degree", "6"}, {"--spline-degree", "'6'", "5 or 7 or 9"});
  expect_error(spline + Arguments{"--smoothing", "-1"}, {"--smoothing", "'-1'", "auto"});
  expect_error(spline + Arguments{"--smoothing", "much"}, {"--smoothing", "'much'"});
  expect_error(spline + Arguments{"--spline-scheme", "paper"}, {"--spline-scheme", "--vertices linear"});
  expect_error(spline + Arguments{"--spline-scheme", "paper", "--method", "delaunay"}, {"--spline-scheme", "linear"});
  expect_error(spline + Arguments{"--spline-scheme", "paper", "--spline-degree", "7"}, {"--spline-degree", "degree 5"});
}

TEST_F(Program_spline, a_volume_without_a_header_is_described_by_options) {
  // z - 1.25 on 3 x 2 x 4 nodes at (1, 2, 3) + (0.5 i, j, 0.25 k), as each type
  const auto write = [&](auto factor, const std::string& name) {
    std::string bytes;
    for (int k = 0; k < 4; ++k)
      for (int n = 0; n < 6; ++n) {
        const auto value = decltype(factor)(factor * decltype(factor)(k));
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
      }
    write_file(folder_ / name, bytes);
  };
  const Arguments layout = {"--dims", "3", "2", "4", "--spacing", "0.5", "1", "0.25", "--origin", "1", "2", "3"};
  const auto expect_plane = [&](const std::string& type, const std::string& isovalue) {
    run_well(Arguments{"mesh", "--volume", "v.raw", "--type", type, "--level", isovalue, "-o", "out.csv",
                       "--attributes", "none"} +
             layout);
    const Table table = columns(file("out.csv"));
    EXPECT_EQ(table.at("z").size(), 6U) << type;
    for (const double z : table.at("z")) EXPECT_NEAR(z, 3 + 0.25 * 1.5, 1e-6) << type;
    EXPECT_EQ(*std::max_element(table.at("x").begin(), table.at("x").end()), 2) << type;
    EXPECT_EQ(*std::max_element(table.at("y").begin(), table.at("y").end()), 3) << type;
  };
  write(std::uint8_t(60), "v.raw"), expect_plane("uint8", "90");
  write(std::int8_t(40), "v.raw"), expect_plane("int8", "60");
  write(std::uint16_t(20000), "v.raw"), expect_plane("uint16", "30000");
  write(std::int16_t(-10000), "v.raw"), expect_plane("int16", "-15000");
  write(std::uint32_t(1000000000), "v.raw"), expect_plane("uint32", "1.5e9");
  write(std::int32_t(-700000000), "v.raw"), expect_plane("int32", "-1.05e9");
  write(std::uint64_t(1) << 62, "v.raw"), expect_plane("uint64", "6917529027641081856");
  write(-(std::int64_t(1) << 60), "v.raw"), expect_plane("int64", "-1729382256910270464");
  write(0.1F, "v.raw"), expect_plane("float", "0.15");
  write(1e-200, "v.raw"), expect_plane("double", "1.5e-200");

  std::filesystem::remove(folder_ / "out.csv");
  const auto expect_refusal = [&](const Arguments& arguments, const Arguments& words) {
    const Result result = run(Arguments{"mesh", "-o", "out.ply"} + arguments);
    EXPECT_EQ(result.status, 2);
    for (const std::string& word : words) EXPECT_NE(result.error.find(word), std::string::npos) << result.error;
  };
  const Arguments raw = {"--volume", "v.raw"};
  expect_refusal(raw + layout, {"--type is missing"});
  expect_refusal(raw + Arguments{"--type", "float"}, {"--dims is missing"});
  expect_refusal(raw + Arguments{"--type", "float"} + layout, {"v.raw", "192 bytes", "96", "--dims or --type"});
  expect_refusal(raw + Arguments{"--type", "float16"} + layout, {"--type", "'float16'"});
  expect_refusal(Arguments{"--volume", "none.raw", "--type", "float"} + layout, {"none.raw", "no such file"});
  expect_refusal(Arguments{"--volume", "v.nrrd", "--dims", "3", "2", "4"}, {"--dims", "FILE.raw"});
}

TEST_F(Program_spline, distances_may_be_measured_in_a_narrow_band) {
  run_well({"mesh", "--function", "x^2 + y^2 + z^2 = 1", "--box", "-1.5", "1.5", "-1.5", "1.5", "-1.5", "1.5", "-o",
            "sphere.off", "--resolution", "20"});
  const Arguments source = {"--distance-to", "sphere.off", "--resolution", "60", "--attributes", "mean_curvature"};
  const Table whole = mesh(source), narrow = mesh(source + Arguments{"--narrow-band", "16"});
  for (const char* name : {"x", "y", "z", "mean_curvature"}) EXPECT_EQ(whole.at(name), narrow.at(name));
  const Result tight = run(Arguments{"mesh", "-o", "out.ply", "--narrow-band", "2"} + source);
  EXPECT_EQ(tight.status, 0);
  EXPECT_NE(tight.error.find("vertices are outside and have no attributes: distances are computed only within "
                             "--narrow-band 2;"),
            std::string::npos)
      << tight.error;
  const Result beyond = run(Arguments{"mesh", "-o", "no.ply", "--narrow-band", "2", "--level", ".3"} + source);
  EXPECT_EQ(beyond.status, 2);
  EXPECT_NE(beyond.error.find("within --narrow-band 2; choose a wider band, another --level or box"), std::string::npos)
      << beyond.error;
  const Result result = run(Arguments{"mesh", "-o", "out.ply", "--narrow-band", "0.5"} + source);
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.error.find("--narrow-band"), std::string::npos) << result.error;
}

TEST_F(Program_spline, a_constant_that_the_formula_does_not_have_is_reported) {
  const Arguments box = {"--box", "-1", "1", "-1", "1", "-1", "1", "-o", "out.ply"};
  expect_error(Arguments{"mesh", "--function", "a*x + y", "--constants", "a=1", "r=2"} + box,
               {"--constants r", "not contain 'r'"});
  expect_error(
      Arguments{"mesh", "--function", "0*a + y + exp(z)", "--constants", "a=1", "x1=2", "--derivatives", "spline"} +
          box,
      {"--constants x1", "not contain 'x1'"});
}

} // namespace spline_test
