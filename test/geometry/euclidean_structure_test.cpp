// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/contraction.h"
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/expand.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/number/Pack.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace euclidean_structure_test {

using namespace equiaffine;

template <class Function>
Euclidean_structure_3<double> euclidean(const Function& f, double x, double y, double z) {
  return local_structure(expand<4, double>(f, x, y, z), {x, y, z}).euclidean;
}

const auto sphere = [](const auto& x, const auto& y, const auto& z) { return x * x + y * y + z * z; };
const auto cylinder = [](const auto& x, const auto& y, const auto&) { return x * x + y * y; };
const auto saddle = [](const auto& x, const auto& y, const auto& z) { return z - x * y; };
const auto plane = [](const auto& x, const auto& y, const auto& z) { return x - 2.0 * y + 0.5 * z; };

TEST(Shape_index, goes_from_a_sphere_with_outward_normals_to_one_with_inward_normals) {
  const auto index = [](const auto& f, double x, double y, double z) {
    const auto s = euclidean(f, x, y, z);
    return shape_index(s.k1, s.k2);
  };
  EXPECT_EQ(index(sphere, 1, 2, -2), -1);
  EXPECT_NEAR(index(cylinder, 3, 4, 1), -0.5, 1e-15);
  EXPECT_NEAR(index(saddle, 0, 0, 0), 0, 1e-15);
  EXPECT_EQ(index([](const auto& x, const auto& y, const auto& z) { return -sphere(x, y, z); }, 1, 2, -2), 1);
  EXPECT_TRUE(std::isnan(index(plane, 1, 2, 3)));
  EXPECT_NEAR(shape_index(3., 1.), 2 / std::acos(-1.) * std::atan2(4., 2.), 1e-15);
}

TEST(Shape_index, does_not_exist_where_the_curvatures_do_not) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(shape_index(nan, nan)));
}

TEST(Curvedness, is_one_over_the_radius_on_a_sphere_and_overflows_only_with_the_curvatures) {
  const auto of = [](const auto& f, double x, double y, double z) {
    const auto s = euclidean(f, x, y, z);
    return curvedness(s.k1, s.k2);
  };
  EXPECT_NEAR(of(sphere, 1, 2, -2), 1. / 3, 1e-16);
  EXPECT_NEAR(of(cylinder, 3, 4, 1), std::sqrt(0.5) / 5, 1e-16);
  EXPECT_NEAR(of(saddle, 0, 0, 0), 1, 1e-15);
  EXPECT_EQ(of(plane, 1, 2, 3), 0);
  EXPECT_NEAR(curvedness(1e308, -1.5e308) / std::sqrt(1.625), 1e308, 1e293);
  EXPECT_EQ(curvedness(-3e-300, -3e-300), 3e-300);
}

TEST(Shape_index_and_curvedness, of_a_lane_have_the_bits_of_those_of_a_number) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  using Lanes = Pack<double>;
  for (int n = 1; n < 200; ++n) {
    const auto k2 = [&](std::size_t i) { return std::sin(n + double(i)); };
    const auto k1 = [&](std::size_t i) { return k2(i) + (n + int(i)) % 3 * 0.7; };
    const Lanes indices = shape_index(Lanes::generate(k1), Lanes::generate(k2));
    const Lanes sizes = curvedness(Lanes::generate(k1), Lanes::generate(k2));
    for (std::size_t i = 0; i < Lanes::size; ++i) {
      EXPECT_EQ(indices[i], shape_index(k1(i), k2(i)));
      EXPECT_EQ(sizes[i], curvedness(k1(i), k2(i)));
    }
  }
}

} // namespace euclidean_structure_test
