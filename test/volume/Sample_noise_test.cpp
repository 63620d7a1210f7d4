// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/sample_volume.h"
#include "volume/nodes_to_measure.h"
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace Sample_noise_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Volume = Volume_3<Kernel>;

double ellipsoid(double x, double y, double z) { return std::exp(x * x + y * y / 0.7 + z * z / 0.5 - 1) - 1; }

Volume sample(std::size_t n, double deviation) {
  const Lattice_3<Kernel> lattice({n, n, n}, CGAL::Bbox_3(-1.25, -1.1, -1, 1.25, 1.1, 1));
  return sample_volume(lattice, ellipsoid, deviation);
}

TEST(Sample_noise, the_deviation_of_white_noise_is_found) {
  for (const double deviation : {1e-8, 1e-5, 1e-2}) {
    EXPECT_NEAR(estimate_noise(sample(64, deviation), 0.).deviation / deviation, 1, 0.05);
    EXPECT_NEAR(estimate_noise(sample(64, deviation)).deviation / deviation, 1, 0.05);
  }
}

TEST(Sample_noise, smooth_samples_have_next_to_none) {
  EXPECT_LT(estimate_noise(sample(128, 0), 0.).deviation, 1e-14);
  EXPECT_EQ(estimate_noise(sample(64, 0)).quantum, 0);
}

TEST(Sample_noise, other_kernels_of_doubles_have_the_same) {
  using Other = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Volume volume = sample(64, 1e-4);
  const Volume_3<Other> other = {Lattice_3<Other>(volume.lattice), volume.values};
  const Sample_noise noise = estimate_noise(volume, 0.);
  EXPECT_EQ(estimate_noise(other, 0.).deviation, noise.deviation);
  EXPECT_GT(choose_smoothing(volume, noise, {.level = 0.}), 0);
  EXPECT_EQ(choose_smoothing(other, noise, {.level = 0.}), choose_smoothing(volume, noise, {.level = 0.}));
}

TEST(Sample_noise, floats_and_integers_have_that_of_their_rounding) {
  Volume volume = sample(64, 0);
  for (double& value : volume.values) value = double(float(value));
  const Sample_noise of_floats = estimate_noise(volume, 0.);
  EXPECT_GT(of_floats.quantum, 0);
  EXPECT_GT(of_floats.deviation, 1e-10);
  EXPECT_LT(of_floats.deviation, 6e-8);
  for (double& value : volume.values) value = std::round(100 * value);
  const Sample_noise of_integers = estimate_noise(volume, 0.);
  EXPECT_EQ(of_integers.quantum, 1);
  EXPECT_NEAR(of_integers.deviation, 1 / std::sqrt(12.0), 0.05);
  for (double& value : volume.values) value = 3;
  EXPECT_EQ(estimate_noise(volume, 3.).deviation, 1 / std::sqrt(12.0)) << "nothing is seen, and yet it is rounded";
}

TEST(Sample_noise, nodes_without_a_value_do_not_matter_and_small_volumes_say_nothing) {
  Volume volume = sample(40, 1e-5);
  for (std::size_t n = 0; n < volume.values.size(); n += 997)
    volume.values[n] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(estimate_noise(volume).deviation, 1e-5, 2e-6);
  EXPECT_EQ(estimate_noise(sample(12, 1e-5)).deviation, 0);
}

TEST(Sample_noise, the_chosen_scale_has_nearly_the_least_error_of_fourth_derivatives) {
  const auto exact = sample(64, 0);
  const Spline_function_3<Kernel> reference(exact, {.spline_degree = 9});
  for (const double deviation : {0.0, 1e-7, 1e-4}) {
    const Volume volume = sample(64, deviation);
    const Sample_noise noise = estimate_noise(volume, 0.);
    const auto error = [&](double scale) {
      const Spline_function_3<Kernel> spline(volume, {.smoothing = scale});
      std::vector<double> errors;
      for (int n = 0; n < 400; ++n) {
        const double u = std::acos(1 - 2 * (n + 0.5) / 400), v = 2.4 * n; // about the surface
        const Kernel::Point_3 p(std::sin(u) * std::cos(v), std::sqrt(0.7) * std::sin(u) * std::sin(v),
                                std::sqrt(0.5) * std::cos(u));
        errors.push_back(std::abs(spline.taylor(p).derivative(4, 0, 0) - reference.taylor(p).derivative(4, 0, 0)));
      }
      std::nth_element(errors.begin(), errors.begin() + 200, errors.end());
      return errors[200];
    };
    double least = std::numeric_limits<double>::infinity();
    for (const double scale : {0.0, 2.0, 3.0, 4.0, 6.0}) least = std::min(least, error(scale));
    const double chosen = choose_smoothing(volume, noise, {.level = 0.});
    if (deviation == 0) EXPECT_EQ(chosen, 0);
    else EXPECT_LE(error(chosen), 5 * least) << "scale " << chosen << " for noise " << deviation;
  }
}

TEST(Sample_noise, more_noise_needs_a_larger_scale) {
  double last = 0;
  for (const double deviation : {1e-9, 1e-6, 1e-3}) {
    const Volume volume = sample(64, deviation);
    const double scale = choose_smoothing(volume, estimate_noise(volume, 0.), {.level = 0.});
    EXPECT_GT(scale, last);
    last = scale;
  }
}

TEST(Sample_noise, details_of_a_few_voxels_are_not_smoothed_away) {
  // A wall two voxels thick, bent, in a little noise: no scale resolves fourth derivatives of it.
  const Lattice_3<Kernel> lattice({48, 48, 48}, CGAL::Bbox_3(0, 0, 0, 47, 47, 47));
  const auto wall = [](double x, double y, double z) {
    const double distance = std::sqrt((x - 23.5) * (x - 23.5) + (y - 23.5) * (y - 23.5) + (z - 20) * (z - 20)) - 15;
    return 4 * std::exp(-distance * distance / 2);
  };
  const double isovalue = 4 * std::exp(-0.5);
  const auto inside = [&](const Volume& v) {
    return std::count_if(v.values.begin(), v.values.end(), [&](double x) { return x > isovalue; });
  };
  for (const double deviation : {0.01, 0.1}) {
    const Volume volume = sample_volume(lattice, wall, deviation);
    const double scale = choose_smoothing(volume, estimate_noise(volume, isovalue), {.level = isovalue});
    const auto left = inside(smooth_volume(volume, scale));
    EXPECT_NEAR(double(left) / double(inside(volume)), 1, 0.05) << "scale " << scale << " for noise " << deviation;
  }
}

TEST(Sample_noise, noise_is_smoothed_away_though_that_moves_the_surface) {
  const Volume volume = sample(64, 0.1); // by more than a voxel in a fifth of the nodes
  EXPECT_GE(choose_smoothing(volume, estimate_noise(volume, 0.), {.level = 0.}), 6);
}

TEST(Sample_noise, a_scale_whose_windows_reach_beyond_a_mask_is_not_chosen) {
  Volume volume = sample(64, 0.01);
  const double smoothing_of_all = choose_smoothing(volume, estimate_noise(volume, 0.), {.level = 0.});
  EXPECT_GE(smoothing_of_all, 5);
  for (double& value : volume.values)
    if (value > 2) value = std::numeric_limits<double>::quiet_NaN(); // some 10 nodes from the surface
  const double smoothing = choose_smoothing(volume, estimate_noise(volume, 0.), {.level = 0.});
  EXPECT_LT(smoothing, smoothing_of_all);
  const Spline_function_3<Kernel> spline(volume, {.smoothing = smoothing});
  for (const double x : {-1., 1.}) EXPECT_TRUE(std::isfinite(spline.value(Kernel::Point_3(x, 0, 0))));
  for (double& value : volume.values)
    if (std::abs(value) > 0.05) value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(choose_smoothing(volume, Sample_noise{0.01, 0}, {.level = 0.}), 0) << "there is no spline at all";
}

TEST(Sample_noise, a_spline_without_a_smoothing_has_that_of_the_noise) {
  const Volume volume = sample(64, 1e-4);
  const Smoothing_decision decision = decide_smoothing(volume, {.smoothing = {}, .level = 0});
  EXPECT_TRUE(decision.is_chosen);
  EXPECT_EQ(decision.noise.deviation, estimate_noise(volume, 0.).deviation);
  EXPECT_EQ(decision.smoothing, choose_smoothing(volume, decision.noise, {.level = 0}));
  EXPECT_FALSE(decision.distinct_values);
  const Spline_function_3<Kernel> chosen(volume, {.smoothing = {}, .level = 0}),
      given(volume, {.smoothing = decision.smoothing});
  const Kernel::Point_3 p(0.7, 0.3, -0.2);
  EXPECT_EQ(chosen.taylor(p).coefficients(), given.taylor(p).coefficients());
  EXPECT_NE(chosen.value(p), Spline_function_3<Kernel>(volume).value(p));
}

TEST(Sample_noise, a_smoothing_that_is_given_stays_and_noise_is_measured_all_the_same) {
  const Volume volume = sample(64, 1e-4);
  const Smoothing_decision decision = decide_smoothing(volume, {.smoothing = 2, .level = 0});
  EXPECT_FALSE(decision.is_chosen);
  EXPECT_EQ(decision.smoothing, 2);
  EXPECT_EQ(decision.noise.deviation, estimate_noise(volume, 0.).deviation);
}

TEST(Sample_noise, a_smoothing_that_is_chosen_leaves_the_voxels_of_a_mask_on_their_sides) {
  Volume rod{Lattice_3<Kernel>({40, 40, 60}, CGAL::Bbox_3(0, 0, 0, 39, 39, 59)), std::vector<double>(96000, 0)};
  std::vector<Kernel::Point_3> inside;
  for (std::size_t k = 10; k < 50; ++k)
    for (std::size_t j = 18; j < 22; ++j)
      for (std::size_t i = 18; i < 22; ++i) {
        rod.values[rod.lattice.index(i, j, k)] = 1;
        inside.push_back(rod.lattice.point(double(i), double(j), double(k)));
      }
  const Smoothing_decision decision = decide_smoothing(rod, {.smoothing = {}, .level = 0.5});
  EXPECT_EQ(decision.distinct_values, std::size_t(2));
  EXPECT_LE(decision.smoothing, choose_smoothing(rod, decision.noise, {.level = 0.5}));
  const Spline_function_3<Kernel> spline(rod, {.smoothing = decision.smoothing});
  const auto kept = std::count_if(inside.begin(), inside.end(), [&](const auto& p) { return spline.value(p) > 0.5; });
  EXPECT_GE(10 * kept, 9 * std::ptrdiff_t(inside.size()));
}

TEST(Sample_noise, nodes_beside_the_level_set_are_those_with_a_neighbor_on_the_other_side) {
  const Lattice_3<Kernel> lattice({131, 17, 18}, CGAL::Bbox_3(-1.25, -1.1, -1, 1.25, 1.1, 1));
  Volume volume = sample_volume(lattice, ellipsoid, 0.3);
  for (std::size_t n = 0; n < volume.values.size(); n += 97)
    volume.values[n] = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t n = 0; n < volume.values.size(); n += 89) volume.values[n] = std::numeric_limits<double>::infinity();
  const double level = 0.1;
  const auto is_below = [&](std::size_t i, std::size_t j, std::size_t k) { return volume(i, j, k) < level; };
  for (const std::size_t margin : {std::size_t(1), std::size_t(6)}) {
    std::vector<std::array<std::size_t, 3>> nodes;
    for (std::size_t k = margin; k + margin < 18; ++k)
      for (std::size_t j = margin; j + margin < 17; ++j)
        for (std::size_t i = margin; i + margin < 131; ++i)
          if (std::isfinite(volume(i, j, k)) &&
              (is_below(i + 1, j, k) != is_below(i, j, k) || is_below(i, j + 1, k) != is_below(i, j, k) ||
               is_below(i, j, k + 1) != is_below(i, j, k)))
            nodes.push_back({i, j, k});
    const auto whole = Volume_parts_3<Kernel>::of(Volume_view_3<Kernel>::of(volume));
    const auto chosen = [&](const Volume_parts_3<Kernel>& parts, std::size_t most) {
      std::vector<std::array<std::size_t, 3>> all;
      for (const auto& part : internal::nodes_to_measure(runs_in_threads<CGAL::Parallel_if_available_tag>(), parts,
                                                         std::optional(level), margin, most))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    };
    EXPECT_EQ(chosen(whole, 1000000), nodes);
    // A tenth is chosen at random, the same nodes whatever the cuts.
    auto some = chosen(whole, nodes.size() / 10);
    EXPECT_NEAR(double(some.size()), double(nodes.size()) / 10, 3 * std::sqrt(double(nodes.size()) / 10));
    EXPECT_TRUE(std::includes(nodes.begin(), nodes.end(), some.begin(), some.end(), [](const auto& p, const auto& q) {
      return std::array{p[2], p[1], p[0]} < std::array{q[2], q[1], q[0]};
    }));
    Volume_parts_3<Kernel> parts{lattice, {}};
    const auto view = Volume_view_3<Kernel>::of(volume);
    for (const auto& [first, end] : {std::array<std::size_t, 2>{0, 3}, {3, 64}, {64, 130}}) {
      parts.parts.push_back({view, {{first, 0, 0}, {end, 5, 17}}});
      parts.parts.push_back({view, {{first, 5, 0}, {end, 16, 17}}});
    }
    auto of_parts = chosen(parts, nodes.size() / 10);
    std::sort(some.begin(), some.end());
    std::sort(of_parts.begin(), of_parts.end());
    EXPECT_EQ(of_parts, some);
  }
}

} // namespace Sample_noise_test
