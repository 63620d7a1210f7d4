// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/spline_samples.h"
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/volume/Spline_function_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace Spline_function_3_bounds_test {

using namespace spline_samples;

TEST(Spline_function_3, bounds_enclose_the_values_in_a_box) {
  for (const Lattice_3& lattice : {unit_lattice(10, 11, 12), skew_lattice(20, 20, 20)}) {
    const Spline_function_3 spline(random_volume(lattice));
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(0.3, 0.7), unit(0, 1);
    for (int n = 0; n < 200; ++n) {
      CGAL::Bbox_3 box;
      for (int corner = 0; corner < 2; ++corner) {
        std::array<double, 3> u;
        for (std::size_t a = 0; a < 3; ++a) u[a] = coordinate(random) * double(lattice.size()[a] - 1);
        box += lattice.point(u[0], u[1], u[2]).bbox();
      }
      const auto bounds = spline.bounds(box);
      for (int m = 0; m < 20; ++m) {
        const Point_3 p(box.xmin() + unit(random) * box.x_span(), box.ymin() + unit(random) * box.y_span(),
                        box.zmin() + unit(random) * box.z_span());
        const double value = spline.value(p);
        if (std::isnan(value)) EXPECT_EQ(bounds, equiaffine::Interval::whole());
        else EXPECT_TRUE(bounds.contains(value)) << p;
      }
    }
  }
}

TEST(Spline_function_3, bounds_are_tight_where_the_coefficients_are_and_the_whole_line_outside) {
  Volume_3 volume = sample(unit_lattice(20, 20, 20), [](double x, double, double) { return x < 10 ? 3.0 : -5.0; });
  const Spline_function_3 spline(volume, {.spline_scheme = Spline_scheme::CONVOLUTION, .spline_degree = 7});
  const auto constant = spline.bounds(CGAL::Bbox_3(1, 1, 1, 2, 2, 2));
  EXPECT_TRUE(constant.contains(3));
  EXPECT_LT(constant.upper() - constant.lower(), 1e-12);
  const auto jump = spline.bounds(CGAL::Bbox_3(1, 1, 1, 12, 2, 2));
  EXPECT_NEAR(jump.lower(), -5, 1e-11); // rounding moves points by up to 1e-13, at a slope of up to 8
  EXPECT_NEAR(jump.upper(), 3, 1e-11);
  EXPECT_EQ(spline.bounds(CGAL::Bbox_3(1, 1, 1, 2, 2, 19.5)), equiaffine::Interval::whole());
  EXPECT_NE(spline.bounds(volume.lattice.bbox()), equiaffine::Interval::whole());
  volume.values[volume.lattice.index(10, 10, 10)] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Spline_function_3(volume).bounds(CGAL::Bbox_3(8, 8, 8, 9, 9, 9)), equiaffine::Interval::whole());
}

// Boxes whose sides are a given fraction of the lattice's: every fourth at its beginning, every fourth at its end.
CGAL::Bbox_3 random_box(const Lattice_3& lattice, double side, int n, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::array<double, 3> u, v;
  for (std::size_t a = 0; a < 3; ++a) {
    const double last = double(lattice.size()[a] - 1), length = side * unit(random);
    u[a] = n % 4 == 0 ? 0 : n % 4 == 1 ? (1 - length) * last : (1 - length) * unit(random) * last;
    v[a] = std::min(u[a] + length * last, last);
  }
  const CGAL::Bbox_3 box = lattice.point(u[0], u[1], u[2]).bbox();
  return side > 0 ? box + lattice.point(v[0], v[1], v[2]).bbox() : box;
}

TEST(Spline_function_3, first_order_bounds_enclose_values_and_gradients_in_a_box) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.2, 1.2);
  for (const auto scheme : {Spline_scheme::CONVOLUTION, Spline_scheme::QUASI_INTERPOLATION,
                            Spline_scheme::INTERPOLATION, Spline_scheme::PAPER})
    for (const int degree : {5, 7, 9})
      for (const Lattice_3& lattice : {unit_lattice(17, 12, 13), skew_lattice(41, 12, 50)}) {
        const Spline_function_3 spline(random_volume(lattice), {.spline_scheme = scheme, .spline_degree = degree});
        std::size_t bounded = 0;
        for (const double side : {1.0, 0.5, 0.1, 0.01, 1e-4, 0.0})
          for (int n = 0; n < 40; ++n) {
            const CGAL::Bbox_3 box = random_box(lattice, side, n, random);
            const auto bounds = spline.first_order_bounds(box);
            const auto value_bounds = spline.bounds(box);
            bounded += std::isfinite(bounds.coefficients()[1].upper());
            for (int m = 0; m < 40; ++m) {
              const auto at = [&](int axis) { // sides, edges and corners too
                return box.min(axis) + std::clamp(unit(random), 0.0, 1.0) * (box.max(axis) - box.min(axis));
              };
              const Point_3 p(at(0), at(1), at(2));
              const auto jet = spline.taylor<1>(p);
              if (std::isnan(jet.value())) {
                for (std::size_t c = 1; c < 4; ++c)
                  ASSERT_EQ(bounds.coefficients()[c], equiaffine::Interval::whole()) << box;
                continue;
              }
              ASSERT_TRUE(value_bounds.contains(jet.value())) << degree << ' ' << box << ' ' << p;
              for (std::size_t c = 0; c < 4; ++c)
                ASSERT_TRUE(bounds.coefficients()[c].contains(jet.coefficients()[c]))
                    << degree << ' ' << box << ' ' << p << ' ' << c;
            }
          }
        EXPECT_GT(bounded, 80u) << "and they are not the whole line in too many boxes";
      }
}

TEST(Spline_function_3, first_order_bounds_are_hardly_wider_than_the_ranges_at_the_border_of_noise_too) {
  for (const int degree : {5, 7, 9}) {
    const Spline_function_3 spline(random_volume(unit_lattice(20, 21, 22)), {.spline_degree = degree});
    for (const Point_3& corner : {Point_3(0, 9.7, 8), Point_3(18.5, 0.2, 8), Point_3(7.6, 8, 9)})
      for (const double side : {0.5, 0.05}) {
        const Point_3 end = corner + side * Vector_3(1, 1, 1);
        const auto bounds = spline.first_order_bounds(corner.bbox() + end.bbox());
        std::array<double, 4> least, greatest;
        least.fill(std::numeric_limits<double>::infinity());
        greatest.fill(-std::numeric_limits<double>::infinity());
        constexpr int parts = 12;
        for (int n = 0; n < (parts + 1) * (parts + 1) * (parts + 1); ++n) {
          const Vector_3 offset(n % (parts + 1), n / (parts + 1) % (parts + 1), n / (parts + 1) / (parts + 1));
          const auto jet = spline.taylor<1>(corner + side / parts * offset);
          for (std::size_t c = 0; c < 4; ++c) {
            least[c] = std::min(least[c], jet.coefficients()[c]);
            greatest[c] = std::max(greatest[c], jet.coefficients()[c]);
          }
        }
        for (std::size_t c = 0; c < 4; ++c) {
          const auto& b = bounds.coefficients()[c];
          EXPECT_LT(b.upper() - b.lower(), 1.25 * (greatest[c] - least[c])) << degree << ' ' << corner << ' ' << side;
        }
      }
  }
}

TEST(Spline_function_3, first_order_bounds_know_no_gradient_but_the_other_values_where_points_have_no_value) {
  Volume_3 volume = sample(unit_lattice(60, 60, 60), [](double x, double, double) { return x; });
  const auto bounds_on = [](const Spline_function_3& spline, const CGAL::Bbox_3& box) {
    const auto bounds = spline.first_order_bounds(box).coefficients();
    const auto known = std::count_if(bounds.begin() + 1, bounds.end(),
                                     [](const auto& b) { return b != equiaffine::Interval::whole(); });
    EXPECT_TRUE(known == 0 || known == 3);
    return std::pair(bounds[0], known == 3);
  };
  const auto expect = [](const std::pair<equiaffine::Interval, bool>& bounds, double lower, double upper, bool known) {
    EXPECT_TRUE(bounds.first.contains(lower) && bounds.first.contains(upper));
    EXPECT_GE(bounds.first.lower(), std::min(lower, std::numeric_limits<double>::max()) - 1e-3);
    EXPECT_LE(bounds.first.upper(), upper + 1e-3);
    EXPECT_EQ(bounds.second, known);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  const Spline_function_3 complete(volume);
  expect(bounds_on(complete, CGAL::Bbox_3(0, 20, 20, 0.5, 20.5, 20.5)), 0, 0.5, true);
  expect(bounds_on(complete, CGAL::Bbox_3(-1, 20, 20, 0.5, 20.5, 20.5)), 0, 0.5, false);
  expect(bounds_on(complete, CGAL::Bbox_3(58.5, 20, 59.5, 62, 20.5, 60)), infinity, infinity, false);
  expect(bounds_on(complete, CGAL::Bbox_3(-10, -10, -10, -1, -1, -1)), infinity, infinity, false);
  volume.values[volume.lattice.index(30, 30, 30)] = std::numeric_limits<double>::quiet_NaN();
  const Spline_function_3 masked(volume);
  const auto inside = bounds_on(masked, CGAL::Bbox_3(30, 30, 30, 30.1, 30.1, 30.1));
  EXPECT_FALSE(inside.second);
  EXPECT_FALSE(bounds_on(masked, CGAL::Bbox_3(23.5, 30, 30, 23.6, 30.1, 30.1)).second);
  EXPECT_TRUE(bounds_on(masked, CGAL::Bbox_3(22.5, 30, 30, 22.6, 30.1, 30.1)).second);
  EXPECT_FALSE(bounds_on(masked, volume.lattice.bbox()).second) << "a box of many cells";
  EXPECT_TRUE(bounds_on(masked, volume.lattice.bbox()).first.contains(59));
  EXPECT_TRUE(bounds_on(masked, CGAL::Bbox_3(0, 0, 0, 59, 59, 10)).second);
  expect(bounds_on(masked, CGAL::Bbox_3(28.1, 30.1, 30.1, 28.2, 30.2, 30.2)), infinity, infinity, false);
}

TEST(Spline_function_3, bounds_of_boxes_of_many_cells_are_nearly_those_of_their_coefficients) {
  const Lattice_3 lattice = unit_lattice(70, 65, 90);
  const Spline_function_3 spline(sample(lattice, [](double x, double y, double z) { return 2 * x - 3 * y + 0.5 * z; }));
  const auto bounds = spline.first_order_bounds(CGAL::Bbox_3(15, 16, 17, 50, 48, 70)).coefficients();
  const double excess = 3 + 1e-9; // cells on each side, to the center of the last B-spline that counts
  EXPECT_LE(bounds[0].lower(), 2 * 15 - 3 * 48 + 0.5 * 17);
  EXPECT_GE(bounds[0].upper(), 2 * 50 - 3 * 16 + 0.5 * 70);
  EXPECT_GE(bounds[0].lower(), 2 * (15 - excess) - 3 * (48 + excess) + 0.5 * (17 - excess));
  EXPECT_LE(bounds[0].upper(), 2 * (50 + excess) - 3 * (16 - excess) + 0.5 * (70 + excess));
  for (const auto& [c, slope] : {std::pair{1, 2.0}, {2, -3.0}, {3, 0.5}}) {
    EXPECT_NEAR(bounds[std::size_t(c)].lower(), slope, 1e-9 * bounds[0].upper());
    EXPECT_NEAR(bounds[std::size_t(c)].upper(), slope, 1e-9 * bounds[0].upper());
  }
}

} // namespace Spline_function_3_bounds_test
