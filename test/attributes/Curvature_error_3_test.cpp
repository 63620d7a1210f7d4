// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/sample_volume.h"
#include <equiaffine/attributes/Curvature_error_3.h>
#include <equiaffine/volume/Sample_noise.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Curvature_error_3_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Volume = Volume_3<Kernel>;
using Point_3 = Kernel::Point_3;

// The level sets are ellipsoids with semiaxes 1, 0.9, 0.8 times r: K = r^-3 / 0.72, H = -sqrt(K).
double radius(const Point_3& p) { return std::sqrt(p.x() * p.x() + p.y() * p.y() / 0.81 + p.z() * p.z() / 0.64); }

Volume sample(std::size_t n, double deviation) {
  const Lattice_3<Kernel> lattice({n, n, n}, CGAL::Bbox_3(-1.3, -1.2, -1.1, 1.3, 1.2, 1.1));
  const auto f = [](double x, double y, double z) {
    const double r = radius(Point_3(x, y, z));
    return std::exp(r * r - 1) - 1;
  };
  return sample_volume(lattice, f, deviation);
}

// How many of the errors the estimates cover, and the median of estimate / error, for K and for H.
struct Quality {
  double covered, median_ratio;
};

std::array<Quality, 2> quality(const Volume& volume, int degree, double smoothing,
                               Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION) {
  const Sampled_function_traits_3<Kernel> function(smooth_volume(volume, smoothing),
                                                   {.spline_scheme = scheme, .spline_degree = degree});
  const Curvature_error_3<Kernel> estimate(function, volume, smoothing, estimate_noise(volume, 0.).deviation);
  std::array<std::vector<double>, 2> ratios;
  for (int n = 0; n < 1000; ++n) {
    const double u = std::acos(1 - 2 * (n + 0.5) / 1000), v = 2.4 * n;
    const Point_3 p(std::sin(u) * std::cos(v), 0.9 * std::sin(u) * std::sin(v), 0.8 * std::cos(u));
    const double k = std::pow(radius(p), -3) / 0.72;
    const auto s = affine_invariants(Monge_chart_3<double>(function.taylor(p)));
    const auto error = estimate(p);
    ratios[0].push_back(error.affine_gaussian_curvature / std::abs(s.gaussian_curvature - k));
    ratios[1].push_back(error.affine_mean_curvature / std::abs(s.mean_curvature + std::sqrt(k)));
  }
  std::array<Quality, 2> result;
  for (std::size_t c = 0; c < 2; ++c) {
    std::sort(ratios[c].begin(), ratios[c].end());
    const auto covered = std::count_if(ratios[c].begin(), ratios[c].end(), [](double r) { return r >= 1; });
    result[c] = {double(covered) / 1000, ratios[c][500]};
  }
  return result;
}

void expect_good(const std::array<Quality, 2>& qualities) {
  for (const auto& [covered, ratio] : qualities) {
    EXPECT_GE(covered, 0.9);
    EXPECT_GE(ratio, 1);
    EXPECT_LE(ratio, 10);
  }
}

TEST(Curvature_error_3, errors_of_clean_samples_are_covered_and_not_exaggerated) {
  expect_good(quality(sample(48, 0), 7, 0));
  expect_good(quality(sample(48, 0), 5, 0));
  expect_good(quality(sample(48, 0), 5, 0, Spline_scheme::CONVOLUTION));
}

TEST(Curvature_error_3, errors_of_noisy_samples_are_covered_and_not_exaggerated) {
  expect_good(quality(sample(64, 1e-7), 7, 0));
  expect_good(quality(sample(64, 1e-6), 7, 2));
  expect_good(quality(sample(64, 1e-5), 7, 3));
}

TEST(Curvature_error_3, errors_of_too_much_smoothing_are_covered_and_not_exaggerated) {
  expect_good(quality(sample(64, 1e-12), 7, 4));
}

TEST(Curvature_error_3, there_is_none_where_there_is_no_curvature) {
  const Volume volume = sample(20, 0);
  const Sampled_function_traits_3<Kernel> function(volume);
  const Curvature_error_3<Kernel> estimate(function, volume, 0, 0);
  EXPECT_TRUE(std::isnan(estimate(Point_3(5, 0, 0)).affine_gaussian_curvature));
  EXPECT_TRUE(std::isnan(estimate(Point_3(std::nan(""), 0, 0)).affine_mean_curvature));
  EXPECT_TRUE(std::isfinite(estimate(Point_3(0.9, 0.1, 0.2)).affine_mean_curvature));
  Volume plane =
      sample_volume(volume.lattice, [](double x, double y, double z) { return 0.3 * x - 0.7 * y + 1.1 * z; });
  for (double& value : plane.values) value = double(float(value));
  const Curvature_error_3<Kernel> of_plane(Sampled_function_traits_3<Kernel>(plane), plane, 0, 0);
  EXPECT_TRUE(std::isnan(of_plane(Point_3(0.1, 0.2, 0.3)).affine_gaussian_curvature));
}

} // namespace Curvature_error_3_test
