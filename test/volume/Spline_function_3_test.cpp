// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/error_field.h"
#include "support/same_bits.h"
#include "volume/spline_samples.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace Spline_function_3_test {

using namespace spline_samples;

TEST(Spline_function_3, derivatives_scale_exactly_with_the_shortest_and_longest_steps) {
  const Volume_3 volume = random_volume(unit_lattice(12, 12, 12));
  const Jet_3 expected = Spline_function_3(volume).taylor(Point_3(5.25, 6.5, 5.75));
  for (const int exponent : {-232, 232}) { // the powers of two next to 1e-70 and 1e70
    const double step = std::ldexp(1, exponent);
    const Lattice_3 lattice({12, 12, 12}, Point_3(0, 0, 0),
                            {Vector_3(step, 0, 0), Vector_3(0, step, 0), Vector_3(0, 0, step)});
    const Jet_3 jet =
        Spline_function_3(Volume_3{lattice, volume.values}).taylor(Point_3(5.25 * step, 6.5 * step, 5.75 * step));
    for (std::size_t n = 0; n < Jet_3::size; ++n) {
      const auto& m = equiaffine::internal::monomials[n];
      EXPECT_EQ(std::ldexp(jet.coefficients()[n], exponent * (m.i + m.j + m.k)), expected.coefficients()[n]) << n;
    }
  }
}

TEST(Spline_function_3, the_expansion_is_that_of_the_value) {
  // Rough data have large fifth derivatives; the remainder of order 5 is seen as the slope of |value - expansion|.
  for (const int degree : {7, 9}) {
    const Lattice_3 lattice = skew_lattice(12, 13, 14);
    const Spline_function_3 spline(random_volume(lattice), {.spline_degree = degree});
    for (const Point_3& p : {lattice.point(5.5, 6.25, 7), lattice.point(1.2, 11.1, 6.4), lattice.point(9.9, 3, 0.7)}) {
      const Jet_3 jet = spline.taylor(p);
      const auto remainder = [&](double h) {
        const Vector_3 d(0.6 * h, -0.5 * h, 0.7 * h);
        double sum = 0;
        for (std::size_t n = 0; n < 35; ++n) {
          const auto [i, j, k] = equiaffine::internal::monomials[n];
          sum += jet.coefficients()[n] * std::pow(d.x(), i) * std::pow(d.y(), j) * std::pow(d.z(), k);
        }
        return std::abs(spline.value(p + d) - sum);
      };
      EXPECT_NEAR(std::log2(remainder(1.0 / 128) / remainder(1.0 / 256)), 5, 0.5) << degree << ' ' << p;
    }
  }
}

TEST(Spline_function_3, the_whole_lattice_and_nothing_else_is_inside) {
  // The lattice is far from the origin, so that rounding puts border points on either side.
  const Lattice_3 lattice({8, 9, 10}, Point_3(1000.1, -2000.2, 3000.3),
                          {Vector_3(0.3, 0.4, 0), Vector_3(-0.4, 0.3, 0.1), Vector_3(0, 0.1, 0.3)});
  const Spline_function_3 spline(random_volume(lattice));
  for (const Point_3& p : points_of(lattice)) EXPECT_TRUE(all_finite(spline.taylor(p))) << p;
  for (const double out : {-1e-6, 1e-6})
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, 3> u = {3, 4, 5};
      u[std::size_t(axis)] = out < 0 ? out : double(lattice.size()[std::size_t(axis)] - 1) + out;
      EXPECT_TRUE(all_nan(spline.taylor(lattice.point(u[0], u[1], u[2]))));
      EXPECT_TRUE(std::isnan(spline.value(lattice.point(u[0], u[1], u[2]))));
    }
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(all_nan(spline.taylor(Point_3(nan, 0, 0))));
  EXPECT_TRUE(all_nan(spline.taylor(Point_3(infinity, 0, 0))));
}

TEST(Spline_function_3, an_axis_with_no_more_nodes_than_the_degree_leaves_everything_outside) {
  for (const auto& [degree, nodes] : {std::array<std::size_t, 2>{5, 5}, {7, 7}, {7, 2}}) {
    const Lattice_3 lattice = unit_lattice(12, nodes, 12);
    const Spline_function_3 spline(random_volume(lattice), {.spline_degree = int(degree)});
    EXPECT_TRUE(all_nan(spline.taylor(Point_3(5, 0.5, 5))));
    EXPECT_EQ(spline.bounds(CGAL::Bbox_3(5, 0.5, 5, 6, 0.6, 6)), equiaffine::Interval::whole());
  }
  EXPECT_TRUE(all_nan(Spline_function_3(random_volume(unit_lattice(2, 2, 2))).taylor(Point_3(0.5, 0.5, 0.5))));
}

TEST(Spline_function_3, points_whose_samples_include_one_without_a_value_are_outside) {
  // For degree 7 the filter takes a sample to 3 coefficients on each side, and a coefficient reaches 4 cells.
  for (const double missing : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Volume_3 volume = random_volume(unit_lattice(30, 30, 30));
    volume.values[volume.lattice.index(15, 15, 15)] = missing;
    const Spline_function_3 spline(volume);
    for (const Point_3& p : {Point_3(15, 15, 15), Point_3(8.01, 15, 15), Point_3(21.99, 21.99, 21.99)}) {
      EXPECT_TRUE(all_nan(spline.taylor(p))) << p;
      EXPECT_TRUE(std::isnan(spline.value(p))) << p;
    }
    for (const Point_3& p : {Point_3(7.99, 15, 15), Point_3(15, 22.01, 15), Point_3(15, 15, 7.99)}) {
      EXPECT_TRUE(all_finite(spline.taylor(p))) << p;
      EXPECT_TRUE(std::isfinite(spline.value(p))) << p;
    }
  }
}

TEST(Spline_function_3, options_are_named_and_smoothing_is_that_of_smooth_volume) {
  const Volume_3 volume = random_volume(skew_lattice(22, 23, 24));
  const Point_3 p = volume.lattice.point(10.3, 10.4, 11.5); // far from the border, whose degree the samples elect
  const Spline_function_3 smooth(volume, {.smoothing = 2, .spline_degree = 5});
  const Spline_function_3 expected(equiaffine::smooth_volume(volume, 2.), {.spline_degree = 5});
  EXPECT_EQ(smooth.degree(), 5);
  EXPECT_EQ(smooth.scheme(), Spline_function_3(volume).scheme());
  EXPECT_EQ(smooth.taylor(p).coefficients(), expected.taylor(p).coefficients());
  EXPECT_NE(smooth.value(p), Spline_function_3(volume, {.spline_degree = 5}).value(p));
}

TEST(Spline_function_3, arguments_without_a_result_are_refused_in_every_build) {
  Volume_3 volume = random_volume(skew_lattice(12, 13, 14));
  for (const int degree : {-1, 0, 6, 11})
    EXPECT_EQ(error_field([&] { Spline_function_3(volume, {.spline_degree = degree}); }), "spline_degree");
  for (const double scale : {-1., double(INFINITY), double(NAN)}) {
    EXPECT_EQ(error_field([&] { Spline_function_3(volume, {.smoothing = scale}); }), "smoothing") << scale;
    EXPECT_THROW(equiaffine::smooth_volume(volume, scale), std::invalid_argument) << scale;
  }
  for (const double step : {0.99e-70, 1e-200, 1.01e70, 1e200}) {
    const Lattice_3 lattice({8, 8, 8}, Point_3(0, 0, 0), {Vector_3(1, 0, 0), Vector_3(0, step, 0), Vector_3(0, 0, 1)});
    EXPECT_THROW(Spline_function_3(random_volume(lattice)), std::invalid_argument) << step;
  }
  volume.values.pop_back();
  EXPECT_THROW(Spline_function_3{volume}, std::invalid_argument);
  EXPECT_THROW(equiaffine::smooth_volume(volume, 2.), std::invalid_argument);
}

TEST(Spline_function_3, a_part_has_the_bits_of_the_whole_in_its_cells_and_elsewhere) {
  const Lattice_3 lattice = skew_lattice(23, 12, 40); // one axis is all border
  Volume_3 volume = random_volume(lattice);
  volume.values[lattice.index(15, 6, 30)] = std::numeric_limits<double>::infinity();
  for (const int degree : {5, 7, 9})
    for (const auto scheme : {Spline_scheme::CONVOLUTION, Spline_scheme::QUASI_INTERPOLATION,
                              Spline_scheme::INTERPOLATION, Spline_scheme::PAPER}) {
      const Spline_function_3 whole(volume, {.spline_scheme = scheme, .spline_degree = degree});
      const auto points = points_of(lattice);
      std::vector<Jet_3> jets;
      for (const Point_3& p : points) jets.push_back(whole.taylor(p));
      const Spline_function_3 unevaluated(volume, {.spline_scheme = scheme, .spline_degree = degree});
      for (const equiaffine::Cell_block& cells : {equiaffine::Cell_block{{0, 0, 0}, {1, 2, 3}},
                                                  {{3, 4, 5}, {10, 11, 12}},
                                                  {{12, 3, 25}, {22, 11, 39}},
                                                  {{0, 0, 0}, {22, 11, 39}}}) {
        const Spline_function_3 part = unevaluated.restricted_to_cells(cells),
                                of_part = part.restricted_to_cells(cells);
        for (std::size_t n = 0; n < points.size(); ++n) {
          EXPECT_TRUE(same_bits(part.taylor(points[n]), jets[n])) << degree << ' ' << int(scheme) << ' ' << points[n];
          EXPECT_TRUE(same_bits(of_part.taylor(points[n]), jets[n]));
        }
        const CGAL::Bbox_3 box = lattice.point(4.2, 5, 6).bbox() + lattice.point(5, 5.5, 7).bbox();
        EXPECT_EQ(part.bounds(box), whole.bounds(box)) << "those of the whole, which are computed now";
      }
    }
}

TEST(Spline_function_3, a_part_has_the_bits_of_the_whole_where_borders_meet_and_smooth_samples_go_on_beyond_them) {
  for (const std::size_t nodes : {8, 9, 10, 30}) { // the first ones have fewer than the greater border degree asks for
    const Lattice_3 lattice = skew_lattice(nodes, 30, 31);
    const Volume_3 volume = sample(lattice, [](double x, double y, double z) { return std::exp(0.1 * (x - y + z)); });
    const Spline_function_3 whole(volume), unevaluated(volume);
    EXPECT_EQ(whole.border_degree(), 9);
    const auto points = points_of(lattice);
    std::vector<Jet_3> jets;
    for (const Point_3& p : points) jets.push_back(whole.taylor(p));
    const std::size_t last = nodes - 1;
    for (const equiaffine::Cell_block& cells : {equiaffine::Cell_block{{0, 0, 0}, {1, 1, 1}},
                                                {{last - 1, 28, 29}, {last, 29, 30}},
                                                {{0, 12, 3}, {last, 20, 9}},
                                                {{2, 5, 20}, {last - 2, 27, 30}}}) {
      const Spline_function_3 part = unevaluated.restricted_to_cells(cells);
      for (std::size_t n = 0; n < points.size(); ++n)
        EXPECT_TRUE(same_bits(part.taylor(points[n]), jets[n])) << nodes << ' ' << points[n];
    }
  }
}

TEST(Spline_function_3, samples_of_any_type_are_converted_exactly) {
  const Lattice_3 lattice = skew_lattice(12, 13, 14);
  Volume_3 volume = random_volume(lattice);
  std::vector<float> samples;
  for (double& x : volume.values) samples.push_back(float(x)), x = double(samples.back());
  const Spline_function_3 of_doubles(volume), of_floats(equiaffine::Volume_view_3<Kernel>(lattice, samples.data()));
  for (const Point_3& p : points_of(lattice)) EXPECT_TRUE(same_bits(of_floats.taylor(p), of_doubles.taylor(p)));
}

TEST(Spline_function_3, the_first_evaluations_may_come_from_many_threads) {
  const Lattice_3 lattice = skew_lattice(40, 41, 42);
  const Volume_3 volume = random_volume(lattice);
  const auto points = points_of(lattice);
  const Spline_function_3 alone(volume, {}, CGAL::Sequential_tag()), together(volume);
  std::vector<double> values(points.size());
  equiaffine::parallel_for<CGAL::Parallel_if_available_tag>(
      0, points.size(), [&](std::size_t n) { values[n] = together.value(points[n]); });
  for (std::size_t n = 0; n < points.size(); ++n) EXPECT_TRUE(same_bits(values[n], alone.value(points[n])));
}

#ifdef CGAL_LINKED_WITH_TBB
TEST(Spline_function_3, the_coefficients_do_not_depend_on_threads) {
  const Lattice_3 lattice = skew_lattice(21, 33, 18);
  const Volume_3 volume = random_volume(lattice);
  const Spline_function_3 one(volume, {}, CGAL::Sequential_tag());
  const Spline_function_3 many(volume, {}, CGAL::Parallel_if_available_tag());
  for (const Point_3& p : points_of(lattice)) EXPECT_EQ(one.taylor(p).coefficients(), many.taylor(p).coefficients());
}
#endif

} // namespace Spline_function_3_test
