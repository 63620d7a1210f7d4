// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/same_bits.h"
#include "support/sample_volume.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/smooth_volume.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace Spline_function_3_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;
using Vector_3 = Kernel::Vector_3;
using Lattice_3 = equiaffine::Lattice_3<Kernel>;
using Volume_3 = equiaffine::Volume_3<Kernel>;
using Spline_function_3 = equiaffine::Spline_function_3<Kernel>;
using Jet_3 = equiaffine::Jet_3<double>;
using equiaffine::Spline_scheme;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <class Function>
Volume_3 sample(const Lattice_3& lattice, const Function& f) {
  return sample_volume(lattice, f);
}

template <class Function>
Jet_3 jet_of(const Function& f, const Point_3& p) {
  return f(Jet_3::variable(0, p.x()), Jet_3::variable(1, p.y()), Jet_3::variable(2, p.z()));
}

Volume_3 random_volume(const Lattice_3& lattice) {
  std::mt19937 random(1);
  return sample(lattice, [&](double, double, double) { return double(random()) / double(random.max()) - 0.5; });
}

Lattice_3 unit_lattice(std::size_t nx, std::size_t ny, std::size_t nz) {
  return Lattice_3({nx, ny, nz}, Point_3(0, 0, 0), {Vector_3(1, 0, 0), Vector_3(0, 1, 0), Vector_3(0, 0, 1)});
}

// A lattice that is anisotropic, rotated, a little sheared, left-handed, and away from the origin.
Lattice_3 skew_lattice(std::size_t nx, std::size_t ny, std::size_t nz) {
  return Lattice_3({nx, ny, nz}, Point_3(-2, 1, 3),
                   {Vector_3(0.3, 0.4, 0), Vector_3(0.8, -0.6, 0.1), Vector_3(0, 0.2, 1.2)});
}

// Points all over the lattice: corners, points of faces and edges, and of outer and inner cells.
std::vector<Point_3> points_of(const Lattice_3& lattice) {
  const auto coordinates = [](std::size_t n) {
    const double last = double(n - 1);
    return std::array{0.0, 0.07, 1.6, 0.43 * last, last - 0.8, last};
  };
  std::vector<Point_3> points;
  for (const double u : coordinates(lattice.size()[0]))
    for (const double v : coordinates(lattice.size()[1]))
      for (const double w : coordinates(lattice.size()[2])) points.push_back(lattice.point(u, v, w));
  return points;
}

// An upper bound of the sum of |d c / d f_j| over the samples f_j of a line, weighted by |d-th Taylor coefficients| of
// the B-splines: how much a relative error of the samples and of the weights can grow in one direction.
template <int Degree>
double amplification(int d, Spline_scheme scheme) {
  constexpr std::size_t nodes = 40, coefficients = nodes + 2 * (Degree / 2);
  std::vector<double> unit(nodes * nodes), weights(coefficients * nodes);
  for (std::size_t i = 0; i < nodes; ++i) unit[i * (nodes + 1)] = 1;
  equiaffine::internal::with_line_filter<double, Degree>(
      scheme, equiaffine::internal::greatest_border_degree,
      [&](const auto& filter) { filter.apply(unit.data(), nodes, nodes, weights.data(), nodes); });
  double greatest = 0;
  for (std::size_t cell = 0; cell < nodes - 1; ++cell)
    for (double t = 0; t <= 1; t += 0.125) {
      const equiaffine::internal::Bspline_taylor<Degree, 4, double> b(t);
      double sum = 0;
      for (std::size_t r = 0; r <= Degree; ++r)
        for (std::size_t j = 0; j < nodes; ++j) sum += std::abs(b.rows[d][r] * weights[(cell + r) * nodes + j]);
      greatest = std::max(greatest, sum);
    }
  return greatest;
}

// A bound of the rounding of each coefficient: `operations` roundings, each amplified as above along x, y and z, and
// mapped to space by a matrix whose rows have absolute sums <= `row_sum`.
template <int Degree>
std::array<double, 5> rounding_bounds(double greatest_sample, double row_sum,
                                      Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION) {
  constexpr int operations = 3 * (2 * (Degree + 1) + 3 * Degree);
  std::array<double, 5> amplifications;
  for (int d = 0; d < 5; ++d) amplifications[std::size_t(d)] = amplification<Degree>(d, scheme);
  std::array<double, 5> bounds{};
  for (int n = 0; n < 35; ++n) {
    const auto m = equiaffine::internal::monomials[std::size_t(n)];
    bounds[std::size_t(m.degree())] += operations * epsilon * greatest_sample * amplifications[std::size_t(m.i)] *
                                       amplifications[std::size_t(m.j)] * amplifications[std::size_t(m.k)] *
                                       std::pow(row_sum, m.degree());
  }
  return bounds;
}

// A polynomial of degree n in every direction, with all its derivatives of comparable size on the lattices above.
template <int Degree>
struct Polynomial {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T form = 0.1 * x - 0.07 * y + 0.12 * z;
    T power = form + 0.3;
    for (int n = 1; n < Degree; ++n) power = power * (form + 0.3);
    return power + 0.1 * x * y * z * z - 0.2 * x * x * y + 0.5 * z - 1.0;
  }
};

template <int Degree>
void expect_reproduction(const Lattice_3& lattice, double row_sum,
                         Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION) {
  const Polynomial<Degree> f;
  const Volume_3 volume = sample(lattice, f);
  double greatest = 0;
  for (const double value : volume.values) greatest = std::max(greatest, std::abs(value));
  const auto bounds = rounding_bounds<Degree>(greatest, row_sum, scheme);
  const Spline_function_3 spline(volume, {.degree = Degree, .scheme = scheme});
  for (const Point_3& p : points_of(lattice)) {
    const Jet_3 expected = jet_of(f, p), computed = spline.taylor(p);
    for (std::size_t n = 0; n < 35; ++n)
      ASSERT_NEAR(computed.coefficients()[n], expected.coefficients()[n],
                  bounds[std::size_t(equiaffine::internal::monomials[n].degree())])
          << "degree " << Degree << ", coefficient " << n << ", point " << p;
  }
}

// A function that is no polynomial and differs along every direction.
constexpr auto wave = [](const auto& x, const auto& y, const auto& z) {
  return sin(1.1 * x + 0.4) * exp(0.5 * y - 0.3 * z) + cos(0.8 * z - 0.6 * y + 0.2 * x);
};

struct Greatest_errors {
  double value, fourth_derivative;
};

Greatest_errors errors_of_wave(std::size_t cells, int degree, Spline_scheme scheme) {
  const Lattice_3 lattice({cells + 1, cells + 1, cells + 1}, CGAL::Bbox_3(-1, -1.5, -2, 2, 2, 1.5));
  const Spline_function_3 spline(sample(lattice, wave), {.degree = degree, .scheme = scheme});
  Greatest_errors errors{};
  // The points are the same on every lattice: in a corner, on faces and edges, in the middle.
  for (const Point_3& p : points_of(Lattice_3({5, 5, 5}, lattice.bbox()))) {
    const Jet_3 expected = jet_of(wave, p), computed = spline.taylor(p);
    errors.value = std::max(errors.value, std::abs(computed.value() - expected.value()));
    for (const auto& [i, j, k] : {std::array{4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2, 1, 1}})
      errors.fourth_derivative =
          std::max(errors.fourth_derivative, std::abs(computed.derivative(i, j, k) - expected.derivative(i, j, k)));
  }
  return errors;
}

// The slope of the error at all points, borders included, when the spacing is halved. The order is an asymptotic
// statement: a third of an order is left to the terms of higher order.
void expect_orders(int degree, Spline_scheme scheme, std::size_t cells, double value, double fourth_derivative) {
  const Greatest_errors coarse = errors_of_wave(cells, degree, scheme);
  const Greatest_errors fine = errors_of_wave(2 * cells, degree, scheme);
  EXPECT_GT(std::log2(coarse.value / fine.value), value - 1.0 / 3) << coarse.value << ' ' << fine.value;
  EXPECT_GT(std::log2(coarse.fourth_derivative / fine.fourth_derivative), fourth_derivative - 1.0 / 3)
      << coarse.fourth_derivative << ' ' << fine.fourth_derivative;
}

bool all_nan(const Jet_3& jet) {
  return std::all_of(jet.coefficients().begin(), jet.coefficients().end(), [](double c) { return std::isnan(c); });
}

bool all_finite(const Jet_3& jet) {
  return std::all_of(jet.coefficients().begin(), jet.coefficients().end(), [](double c) { return std::isfinite(c); });
}

TEST(Spline_function_3, quasi_interpolation_reproduces_polynomials_up_to_its_degree_and_to_the_border) {
  expect_reproduction<5>(unit_lattice(6, 7, 11), 1);
  expect_reproduction<7>(unit_lattice(8, 9, 13), 1);
  expect_reproduction<9>(unit_lattice(10, 11, 15), 1);
}

TEST(Spline_function_3, quasi_interpolation_errs_at_the_border_as_inside_to_one_more_degree) {
  for (const int degree : {5, 7}) {
    const auto power = [=](double x, double, double) { return std::pow((x - 10) / 4, degree + 1); };
    const Spline_function_3 spline(sample(unit_lattice(21, 10, 10), power), {.degree = degree});
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
      return Spline_function_3(volume, {.degree = degree, .scheme = scheme}).border_degree();
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
        const equiaffine::Spline_parameters parameters = {.degree = degree, .smoothing = smoothing};
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
  // Along x the samples are linear, and zero up to rounding at the end of most lines, which are more than those along y.
  const auto f = [](double x, double y, double) { return (x - 11) / 7 * std::sin(y / 4) + 1e-16 * std::cos(y); };
  EXPECT_EQ(Spline_function_3(sample(lattice, f), {.degree = 7}).border_degree(), 9);
}

TEST(Spline_function_3, derivatives_are_those_in_space_for_a_rotated_anisotropic_left_handed_lattice) {
  ASSERT_LT(skew_lattice(8, 8, 8).determinant(), 0);
  const auto inverse = skew_lattice(8, 8, 8).transformation().inverse();
  double row_sum = 0;
  for (int row = 0; row < 3; ++row)
    row_sum =
        std::max(row_sum, std::abs(inverse.m(row, 0)) + std::abs(inverse.m(row, 1)) + std::abs(inverse.m(row, 2)));
  expect_reproduction<5>(skew_lattice(11, 6, 7), row_sum);
  expect_reproduction<7>(skew_lattice(13, 8, 9), row_sum);
  expect_reproduction<9>(skew_lattice(15, 10, 11), row_sum);
}

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

TEST(Spline_function_3, quasi_interpolation_has_order_degree_plus_one_and_minus_three_for_fourth_derivatives) {
  expect_orders(5, Spline_scheme::QUASI_INTERPOLATION, 32, 6, 2);
  expect_orders(7, Spline_scheme::QUASI_INTERPOLATION, 24, 8, 4);
  expect_orders(9, Spline_scheme::QUASI_INTERPOLATION, 12, 10, 6);
}

TEST(Spline_function_3, interpolation_reproduces_polynomials_up_to_its_degree_and_to_the_border) {
  expect_reproduction<5>(unit_lattice(6, 7, 11), 1, Spline_scheme::INTERPOLATION);
  expect_reproduction<7>(unit_lattice(8, 9, 13), 1, Spline_scheme::INTERPOLATION);
  expect_reproduction<9>(unit_lattice(10, 11, 15), 1, Spline_scheme::INTERPOLATION);
}

TEST(Spline_function_3, interpolation_has_order_degree_plus_one_and_minus_three_for_fourth_derivatives) {
  expect_orders(5, Spline_scheme::INTERPOLATION, 32, 6, 2);
  expect_orders(7, Spline_scheme::INTERPOLATION, 24, 8, 4);
  expect_orders(9, Spline_scheme::INTERPOLATION, 12, 10, 6);
}

TEST(Spline_function_3, interpolation_has_the_samples_as_values_at_the_nodes) {
  const Lattice_3 lattice = skew_lattice(12, 15, 13);
  const Volume_3 volume = random_volume(lattice);
  const auto expect_samples = [&](int degree, double bound) {
    const Spline_function_3 spline(volume, {.degree = degree, .scheme = Spline_scheme::INTERPOLATION});
    for (std::size_t i = 0; i < 12; ++i)
      for (std::size_t j = 0; j < 15; ++j)
        for (std::size_t k = 0; k < 13; ++k)
          ASSERT_NEAR(spline.value(lattice.point(double(i), double(j), double(k))), volume(i, j, k), bound) << degree;
  };
  expect_samples(5, rounding_bounds<5>(0.5, 1, Spline_scheme::INTERPOLATION)[0]);
  expect_samples(7, rounding_bounds<7>(0.5, 1, Spline_scheme::INTERPOLATION)[0]);
  expect_samples(9, rounding_bounds<9>(0.5, 1, Spline_scheme::INTERPOLATION)[0]);
}

TEST(Spline_function_3, the_scheme_of_the_paper_interpolates_expansions_by_convolution_at_the_nodes) {
  const Lattice_3 lattice = skew_lattice(9, 10, 11);
  const Volume_3 volume = random_volume(lattice);
  const Spline_function_3 paper(volume, {.degree = 5, .scheme = Spline_scheme::PAPER}),
      nodes(volume, {.degree = 5, .scheme = Spline_scheme::CONVOLUTION});
  const auto bounds = rounding_bounds<5>(0.5, 4, Spline_scheme::CONVOLUTION);
  const auto expect_between = [&](const Point_3& p, const Point_3& q, double t) {
    const Jet_3 jet = paper.taylor(p + t * (q - p)), jet_p = nodes.taylor(p), jet_q = nodes.taylor(q);
    for (std::size_t n = 0; n < 35; ++n)
      EXPECT_NEAR(jet.coefficients()[n], (1 - t) * jet_p.coefficients()[n] + t * jet_q.coefficients()[n],
                  bounds[std::size_t(equiaffine::internal::monomials[n].degree())]);
  };
  expect_between(lattice.point(3, 4, 5), lattice.point(4, 4, 5), 0.3); // on edges of the grid
  expect_between(lattice.point(7, 0, 10), lattice.point(7, 1, 10), 0.6);
  expect_between(lattice.point(8, 9, 9), lattice.point(8, 9, 10), 1);
  const Point_3 middle = lattice.point(2.5, 3.5, 6.5);
  double sum = 0;
  for (unsigned corner = 0; corner < 8; ++corner)
    sum +=
        nodes.taylor(lattice.point(2 + (corner & 1), 3 + (corner >> 1 & 1), 6 + (corner >> 2))).derivative(2, 1, 1) / 8;
  EXPECT_NEAR(paper.taylor(middle).derivative(2, 1, 1), sum, 2 * bounds[4]);
}

TEST(Spline_function_3, convolution_has_order_two) {
  expect_orders(5, Spline_scheme::CONVOLUTION, 32, 2, 2);
  expect_orders(7, Spline_scheme::CONVOLUTION, 32, 2, 2);
  const double error = errors_of_wave(64, 7, Spline_scheme::CONVOLUTION).value;
  EXPECT_GT(error, 100 * errors_of_wave(64, 7, Spline_scheme::QUASI_INTERPOLATION).value);
}

TEST(Spline_function_3, convolution_takes_the_samples_as_coefficients) {
  // One sample 1 in the middle of zeros: the B-spline itself, of degree 5 with values 66, 26, 1 over 120 at integers.
  Volume_3 volume{unit_lattice(15, 15, 15), std::vector<double>(15 * 15 * 15)};
  volume.values[volume.lattice.index(7, 7, 7)] = 1;
  const Spline_function_3 spline(volume, {.degree = 5, .scheme = Spline_scheme::CONVOLUTION});
  EXPECT_NEAR(spline.value(Point_3(7, 7, 7)), std::pow(66.0 / 120, 3), 8 * epsilon);
  EXPECT_NEAR(spline.value(Point_3(8, 5, 7)), 26.0 * 1 * 66 / (120 * 120 * 120), 8 * epsilon);
  EXPECT_EQ(spline.value(Point_3(10, 7, 7)), 0);
}

TEST(Spline_function_3, the_expansion_is_that_of_the_value) {
  // Rough data have large fifth derivatives; the remainder of order 5 is seen as the slope of |value - expansion|.
  for (const int degree : {7, 9}) {
    const Lattice_3 lattice = skew_lattice(12, 13, 14);
    const Spline_function_3 spline(random_volume(lattice), {.degree = degree});
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

TEST(Spline_function_3, lower_orders_are_the_first_coefficients_of_the_expansion) {
  const Lattice_3 lattice = skew_lattice(10, 11, 12);
  const Spline_function_3 spline(random_volume(lattice));
  const auto bounds = rounding_bounds<7>(0.5, 4);
  for (const Point_3& p : points_of(lattice)) {
    const Jet_3 jet = spline.taylor(p);
    const auto gradient = spline.taylor<1>(p);
    EXPECT_NEAR(spline.value(p), jet.value(), bounds[0]);
    EXPECT_NEAR(gradient.value(), jet.value(), bounds[0]);
    for (std::size_t n = 1; n < 4; ++n) EXPECT_NEAR(gradient.coefficients()[n], jet.coefficients()[n], bounds[1]);
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
    const Spline_function_3 spline(random_volume(lattice), {.degree = int(degree)});
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
  const Spline_function_3 spline(volume, {.degree = 7, .scheme = Spline_scheme::CONVOLUTION});
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
        const Spline_function_3 spline(random_volume(lattice), {.degree = degree, .scheme = scheme});
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
    const Spline_function_3 spline(random_volume(unit_lattice(20, 21, 22)), {.degree = degree});
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

TEST(Spline_function_3, parameters_are_named_and_smoothing_is_that_of_smooth_volume) {
  const Volume_3 volume = random_volume(skew_lattice(22, 23, 24));
  const Point_3 p = volume.lattice.point(10.3, 10.4, 11.5); // far from the border, whose degree the samples elect
  const Spline_function_3 smooth(volume, {.degree = 5, .smoothing = 2});
  const Spline_function_3 expected(equiaffine::smooth_volume(volume, 2.), {.degree = 5});
  EXPECT_EQ(smooth.degree(), 5);
  EXPECT_EQ(smooth.scheme(), Spline_function_3(volume).scheme());
  EXPECT_EQ(smooth.taylor(p).coefficients(), expected.taylor(p).coefficients());
  EXPECT_NE(smooth.value(p), Spline_function_3(volume, {.degree = 5}).value(p));
}

TEST(Spline_function_3, arguments_without_a_result_are_refused_in_every_build) {
  Volume_3 volume = random_volume(skew_lattice(12, 13, 14));
  for (const int degree : {-1, 0, 6, 11})
    EXPECT_THROW(Spline_function_3(volume, {.degree = degree}), std::invalid_argument);
  for (const double scale : {-1., double(INFINITY), double(NAN)}) {
    EXPECT_THROW(Spline_function_3(volume, {.smoothing = scale}), std::invalid_argument) << scale;
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
      const Spline_function_3 whole(volume, {.degree = degree, .scheme = scheme});
      const auto points = points_of(lattice);
      std::vector<Jet_3> jets;
      for (const Point_3& p : points) jets.push_back(whole.taylor(p));
      const Spline_function_3 unevaluated(volume, {.degree = degree, .scheme = scheme});
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
