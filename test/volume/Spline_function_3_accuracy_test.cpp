// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/spline_samples.h"
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/volume/Spline_function_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace Spline_function_3_accuracy_test {

using namespace spline_samples;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <class Function>
Jet_3 jet_of(const Function& f, const Point_3& p) {
  return f(Jet_3::variable(0, p.x()), Jet_3::variable(1, p.y()), Jet_3::variable(2, p.z()));
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
  const Spline_function_3 spline(volume, {.spline_scheme = scheme, .spline_degree = Degree});
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
  const Spline_function_3 spline(sample(lattice, wave), {.spline_scheme = scheme, .spline_degree = degree});
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

TEST(Spline_function_3, quasi_interpolation_reproduces_polynomials_up_to_its_degree_and_to_the_border) {
  expect_reproduction<5>(unit_lattice(6, 7, 11), 1);
  expect_reproduction<7>(unit_lattice(8, 9, 13), 1);
  expect_reproduction<9>(unit_lattice(10, 11, 15), 1);
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
    const Spline_function_3 spline(volume, {.spline_scheme = Spline_scheme::INTERPOLATION, .spline_degree = degree});
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
  const Spline_function_3 paper(volume, {.spline_scheme = Spline_scheme::PAPER, .spline_degree = 5}),
      nodes(volume, {.spline_scheme = Spline_scheme::CONVOLUTION, .spline_degree = 5});
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
  const Spline_function_3 spline(volume, {.spline_scheme = Spline_scheme::CONVOLUTION, .spline_degree = 5});
  EXPECT_NEAR(spline.value(Point_3(7, 7, 7)), std::pow(66.0 / 120, 3), 8 * epsilon);
  EXPECT_NEAR(spline.value(Point_3(8, 5, 7)), 26.0 * 1 * 66 / (120 * 120 * 120), 8 * epsilon);
  EXPECT_EQ(spline.value(Point_3(10, 7, 7)), 0);
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

} // namespace Spline_function_3_accuracy_test
