// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace smooth_volume_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Volume_3 = equiaffine::Volume_3<Kernel>;
using Lattice_3 = equiaffine::Lattice_3<Kernel>;
using equiaffine::smooth_volume;

template <class Function>
Volume_3 sample(const Lattice_3::Size& size, const Function& f) {
  Volume_3 volume{Lattice_3(size, CGAL::Bbox_3(0, 0, 0, 1, 1, 1)), {}};
  for (std::size_t k = 0; k < size[2]; ++k)
    for (std::size_t j = 0; j < size[1]; ++j)
      for (std::size_t i = 0; i < size[0]; ++i)
        volume.values.push_back(
            f(double(i) / double(size[0] - 1), double(j) / double(size[1] - 1), double(k) / double(size[2] - 1)));
  return volume;
}

double greatest_difference(const Volume_3& a, const Volume_3& b) {
  double greatest = 0;
  for (std::size_t n = 0; n < a.values.size(); ++n) greatest = std::max(greatest, std::abs(a.values[n] - b.values[n]));
  return greatest;
}

Volume_3 white_noise(const Lattice_3::Size& size) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  return sample(size, [&](double, double, double) { return normal(random); });
}

TEST(Smooth_volume, polynomials_of_degree_seven_stay_to_the_border) {
  const auto f = [](double x, double y, double z) {
    return std::pow(x - 0.3, 7) - 2 * std::pow(y, 7) * (1 - std::pow(z, 7)) + x * y;
  };
  const Volume_3 volume = sample({30, 41, 23}, f);
  for (const double scale : {1.5, 2.3, 6.0})
    EXPECT_LE(greatest_difference(smooth_volume(volume, scale), volume), 1e-12);
}

TEST(Smooth_volume, the_error_has_order_eight_to_the_border) {
  const auto f = [](double x, double y, double z) { return std::sin(3 * x + 1) * std::cos(2 * y - z); };
  const auto error = [&](std::size_t n) {
    const Volume_3 volume = sample({n + 1, n + 1, n + 1}, f);
    return greatest_difference(smooth_volume(volume, 2.), volume);
  };
  EXPECT_NEAR(std::log2(error(24) / error(48)), 8, 0.5);
}

TEST(Smooth_volume, a_scale_of_one_or_less_changes_nothing) {
  const Volume_3 noise = white_noise({9, 8, 10});
  for (const double scale : {0.0, 0.5, 1.0}) EXPECT_EQ(smooth_volume(noise, scale).values, noise.values);
}

TEST(Smooth_volume, white_noise_falls_as_the_power_three_halves_of_the_scale) {
  const Volume_3 noise = white_noise({120, 120, 120});
  const auto deviation = [&](double scale) { // of inner nodes
    const Volume_3 smooth = smooth_volume(noise, scale);
    double sum = 0;
    for (std::size_t k = 40; k < 80; ++k)
      for (std::size_t j = 40; j < 80; ++j)
        for (std::size_t i = 40; i < 80; ++i) sum += smooth(i, j, k) * smooth(i, j, k);
    return std::sqrt(sum / 64000);
  };
  const double two = deviation(2), four = deviation(4);
  EXPECT_LT(two, 0.6);
  EXPECT_NEAR(std::log2(two / four), 1.5, 0.3);
}

TEST(Smooth_volume, nodes_near_one_without_a_value_have_none) {
  Volume_3 volume = sample({40, 40, 40}, [](double x, double y, double z) { return x + y * z; });
  volume.values[volume.lattice.index(20, 20, 20)] = std::numeric_limits<double>::quiet_NaN();
  const Volume_3 smooth = smooth_volume(volume, 2.); // the window has 6 nodes on each side
  EXPECT_TRUE(std::isnan(smooth(14, 20, 26)));
  EXPECT_FALSE(std::isnan(smooth(13, 20, 20)));
  EXPECT_FALSE(std::isnan(smooth(20, 27, 20)));
}

TEST(Smooth_volume, short_axes_have_the_window_they_can_have) {
  const Volume_3 noise = white_noise({2, 3, 30});
  const Volume_3 smooth = smooth_volume(noise, 3.);
  for (const double value : smooth.values) EXPECT_TRUE(std::isfinite(value));
}

#ifdef CGAL_LINKED_WITH_TBB
TEST(Smooth_volume, the_result_does_not_depend_on_threads) {
  const Volume_3 noise = white_noise({31, 22, 43});
  EXPECT_EQ(smooth_volume<CGAL::Sequential_tag>(noise, 2.5).values,
            smooth_volume<CGAL::Parallel_if_available_tag>(noise, 2.5).values);
}
#endif

} // namespace smooth_volume_test
