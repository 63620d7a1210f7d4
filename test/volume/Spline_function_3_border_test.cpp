// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/sample_volume.h"
#include "volume/spline_samples.h"
#include <equiaffine/volume/Spline_function_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Spline_function_3_border_test {

using namespace spline_samples;

TEST(Spline_function_3, quasi_interpolation_errs_at_the_border_as_inside_to_one_more_degree) {
  for (const int degree : {5, 7}) {
    const auto power = [=](double x, double, double) { return std::pow((x - 10) / 4, degree + 1); };
    const Spline_function_3 spline(sample(unit_lattice(21, 10, 10), power), {.spline_degree = degree});
    for (const double t : {0.2, 0.6, 1.0}) { // that error has the period of the lattice
      const auto error = [&](double x) { return spline.value(Point_3(x, 5, 5)) - power(x, 5, 5); };
      EXPECT_GT(std::abs(error(10 + t)), 1e-8);
      EXPECT_NEAR(error(t), error(10 + t), 1e-4 * std::abs(error(10 + t))) << degree << ' ' << t;
      EXPECT_NEAR(error(19 + t), error(10 + t), 1e-4 * std::abs(error(10 + t))) << degree << ' ' << t;
    }
  }
}

TEST(Spline_function_3,
     smooth_samples_are_extended_by_two_more_degrees_noise_and_edges_are_not_and_steps_by_constants) {
  const Lattice_3 lattice = unit_lattice(30, 31, 32);
  const auto smooth = [](double x, double y, double z) { return std::sin(x / 4) + std::cos(y / 5 + z / 4); };
  const auto ball = [](double x, double y, double z) { return double(std::hypot(x - 20, y - 20, z - 20) < 19); };
  const auto edge = [&](double x, double y, double z) { return ball(x, y, z) + std::sin(x + 2 * y + 3 * z); };
  for (const int degree : {5, 7, 9}) {
    const auto border_degree = [&](const Volume_3& volume, Spline_scheme scheme) {
      return Spline_function_3(volume, {.spline_scheme = scheme, .spline_degree = degree}).border_degree();
    };
    constexpr auto scheme = Spline_scheme::QUASI_INTERPOLATION;
    EXPECT_EQ(border_degree(sample(lattice, smooth), scheme), std::min(degree + 2, 9));
    EXPECT_EQ(border_degree(sample_volume(lattice, smooth, 1e-3), scheme), degree);
    EXPECT_EQ(border_degree(sample(lattice, edge), scheme), degree);
    EXPECT_EQ(border_degree(sample(lattice, ball), scheme), 0) << "steps go on as constants";
    EXPECT_EQ(border_degree(sample(lattice, smooth), Spline_scheme::CONVOLUTION), degree);
  }
  auto masked = sample(lattice, smooth);
  for (std::size_t n = 0; n < masked.values.size(); n += 97)
    masked.values[n] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Spline_function_3(masked).border_degree(), 9) << "lines without a number have no vote";
}

TEST(Spline_function_3, a_mask_beside_the_border_has_the_spline_that_it_has_far_from_it) {
  for (const int degree : {5, 7, 9})
    for (const std::size_t gap : {1, 2, 3}) {
      const auto block_in = [](std::size_t margin) {
        const auto inside = [=](double x) { return x >= double(margin) && x < double(margin) + 12; };
        const std::size_t n = 12 + 2 * margin;
        return sample(unit_lattice(n, n, n),
                      [=](double x, double y, double z) { return double(inside(x) && inside(y) && inside(z)); });
      };
      for (const double smoothing : {0., 1.5, 2.}) {
        const equiaffine::Volume_options parameters = {.smoothing = smoothing, .spline_degree = degree};
        const Spline_function_3 near(block_in(gap), parameters), far(block_in(20), parameters);
        // Smoothed steps reach beyond the border, where they go on as constants.
        const double tolerance = smoothing > 0 ? 0.04 : 1e-14;
        for (const double x : {0., .3, .5, .7, 1., 4.2})
          for (const double y : {.1, .5, 7.3})
            EXPECT_NEAR(near.value(Point_3(double(gap) - 1 + x, double(gap) - 1 + y, double(gap) + 5)),
                        far.value(Point_3(19 + x, 19 + y, 25)), tolerance);
      }
    }
}

TEST(Spline_function_3, lines_that_end_at_zero_do_not_vote_by_their_rounding_errors) {
  const Lattice_3 lattice = unit_lattice(12, 40, 12);
  // Along x the samples are linear, and zero up to rounding at the end of most lines, which are more than those along
  // y.
  const auto f = [](double x, double y, double) { return (x - 11) / 7 * std::sin(y / 4) + 1e-16 * std::cos(y); };
  EXPECT_EQ(Spline_function_3(sample(lattice, f), {.spline_degree = 7}).border_degree(), 9);
}

} // namespace Spline_function_3_border_test
