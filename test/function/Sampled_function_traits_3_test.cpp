// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/Sampled_function_traits_3.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace Sampled_function_traits_3_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Lattice_3 = equiaffine::Lattice_3<Kernel>;
using Volume_3 = equiaffine::Volume_3<Kernel>;
using Traits = equiaffine::Sampled_function_traits_3<Kernel>;

Volume_3 random_volume(std::size_t nodes) {
  const Lattice_3 lattice({nodes, nodes + 1, nodes + 2}, Point_3(1, 2, 3),
                          {Vector_3(0, 0.5, 0), Vector_3(0.25, 0, 0.1), Vector_3(0, 0, 2)});
  Volume_3 volume{lattice, std::vector<double>(lattice.number_of_nodes())};
  std::mt19937 random(3);
  for (double& value : volume.values) value = double(random()) / double(random.max());
  return volume;
}

const Point_3 inner_point = random_volume(9).lattice.point(3.3, 4.4, 5.5);

TEST(Sampled_function_traits_3, the_samples_and_the_lattice_are_those_of_the_volume) {
  const Volume_3 volume = random_volume(9);
  const Traits traits(volume);
  EXPECT_EQ(traits.sample(3, 1, 2), volume(3, 1, 2));
  EXPECT_EQ(traits.lattice().size(), volume.lattice.size());
  EXPECT_EQ(traits.lattice().point(1, 2, 3), volume.lattice.point(1, 2, 3));
  EXPECT_EQ(traits.bbox(), volume.lattice.bbox());
}

TEST(Sampled_function_traits_3, values_and_expansions_are_those_of_the_spline_of_the_given_degree_and_scheme) {
  const Volume_3 volume = random_volume(10);
  for (const int degree : {5, 7, 9})
    for (const auto scheme : {equiaffine::Spline_scheme::CONVOLUTION, equiaffine::Spline_scheme::QUASI_INTERPOLATION}) {
      const equiaffine::Spline_function_3<Kernel> spline(volume, {.spline_scheme = scheme, .spline_degree = degree});
      const Traits traits(volume, {.spline_scheme = scheme, .spline_degree = degree});
      EXPECT_EQ(traits.value(inner_point), spline.value(inner_point));
      EXPECT_EQ(traits.first_order(inner_point).coefficients(), spline.taylor<1>(inner_point).coefficients());
      EXPECT_EQ(traits.taylor(inner_point).coefficients(), spline.taylor(inner_point).coefficients());
      EXPECT_EQ(traits.bounds(inner_point.bbox()), spline.bounds(inner_point.bbox()));
      EXPECT_TRUE(traits.bounds(inner_point.bbox()).contains(traits.value(inner_point)));
    }
}

TEST(Sampled_function_traits_3, the_default_is_quasi_interpolation_of_degree_seven) {
  const Traits traits(random_volume(9));
  EXPECT_EQ(traits.spline().degree(), 7);
  EXPECT_EQ(traits.spline().scheme(), equiaffine::Spline_scheme::QUASI_INTERPOLATION);
}

TEST(Sampled_function_traits_3, samples_are_smoothed_by_a_scale) {
  const Volume_3 volume = random_volume(12);
  const Traits smooth(volume, {.smoothing = 2}, CGAL::Sequential_tag());
  const Traits expected(equiaffine::smooth_volume(volume, 2.));
  EXPECT_EQ(smooth.sample(5, 6, 7), expected.sample(5, 6, 7));
  EXPECT_NE(smooth.sample(5, 6, 7), volume(5, 6, 7));
  EXPECT_EQ(smooth.taylor(inner_point).coefficients(), expected.taylor(inner_point).coefficients());
}

TEST(Sampled_function_traits_3, copies_outlive_the_original_and_share_its_data) {
  auto original = std::make_unique<Traits>(random_volume(9));
  const double value = original->value(inner_point);
  const Traits copy = *original;
  EXPECT_EQ(&copy.spline(), &original->spline());
  original.reset();
  EXPECT_EQ(copy.value(inner_point), value);
  EXPECT_EQ(copy.sample(1, 1, 1), random_volume(9)(1, 1, 1));
}

TEST(Sampled_function_traits_3, a_grid_too_small_for_the_spline_still_has_its_samples) {
  const Volume_3 volume = random_volume(2);
  const Traits traits(volume);
  EXPECT_EQ(traits.sample(1, 1, 1), volume(1, 1, 1));
  EXPECT_TRUE(std::isnan(traits.value(volume.lattice.point(0.5, 0.5, 0.5))));
  EXPECT_TRUE(std::isnan(traits.taylor(volume.lattice.point(0.5, 0.5, 0.5)).value()));
}

} // namespace Sampled_function_traits_3_test
