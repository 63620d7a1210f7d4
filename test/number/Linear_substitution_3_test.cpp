// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/number/internal/Linear_substitution_3.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace Linear_substitution_3_test {

template <int Order>
using Jet = equiaffine::Jet_3<double, Order>;
using Substitution = equiaffine::Linear_substitution_3<double, 5>;
using Matrix = Substitution::Matrix;

// Every coefficient differs from zero and the matrices hold small integers: all results are exact.
template <int Order>
Jet<Order> polynomial() {
  Jet<Order> g;
  for (std::size_t n = 0; n < g.size; ++n) g.coefficients()[n] = double(n * n % 17) - 7.5;
  return g;
}

/// The same polynomial in the images of the variables: sum of c_ijk u^i v^j w^k by Horner's rule in jets.
template <int Order>
Jet<Order> substituted(const Jet<Order>& g, const Matrix& l) {
  std::array<Jet<Order>, 3> u;
  for (std::size_t row = 0; row < 3; ++row) {
    u[row] = Jet<Order>(0);
    for (int axis = 0; axis < 3; ++axis) u[row] += l[row][std::size_t(axis)] * Jet<Order>::variable(axis, 0.0);
  }
  Jet<Order> in_x(0);
  for (int i = Order; i >= 0; --i) {
    Jet<Order> in_y(0);
    for (int j = Order - i; j >= 0; --j) {
      Jet<Order> in_z(0);
      for (int k = Order - i - j; k >= 0; --k) in_z = in_z * u[2] + g.coefficient(i, j, k);
      in_y = in_y * u[1] + in_z;
    }
    in_x = in_x * u[0] + in_y;
  }
  return in_x;
}

template <int Order>
void expect_substitution(const Matrix& l) {
  const Jet<Order> g = polynomial<Order>();
  EXPECT_EQ(Substitution(l)(g).coefficients(), substituted(g, l).coefficients()) << "order " << Order;
}

constexpr Matrix general = {{{1, 2, -3}, {4, -5, 6}, {-7, 8, 2}}};
constexpr Matrix diagonal = {{{2, 0, 0}, {0, -3, 0}, {0, 0, 5}}};

TEST(Linear_substitution_3, a_general_map_is_substituted_exactly_at_every_order) {
  expect_substitution<5>(general);
  expect_substitution<4>(general);
  expect_substitution<3>(general);
  expect_substitution<2>(general);
  expect_substitution<1>(general);
}

TEST(Linear_substitution_3, a_diagonal_map_is_substituted_exactly) {
  expect_substitution<5>(diagonal);
  expect_substitution<4>(diagonal);
  expect_substitution<2>(diagonal);
}

TEST(Linear_substitution_3, a_single_entry_off_the_diagonal_counts) {
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      Matrix l = diagonal;
      l[row][column] += 7;
      expect_substitution<4>(l);
    }
}

TEST(Linear_substitution_3, the_identity_changes_nothing) {
  const Jet<4> g = polynomial<4>();
  EXPECT_EQ(Substitution({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}})(g).coefficients(), g.coefficients());
}

TEST(Linear_substitution_3, a_singular_map_leaves_the_directions_of_its_image) {
  const Jet<4> f = Substitution({{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}})(polynomial<4>());
  EXPECT_EQ(f.coefficient(4, 0, 0), polynomial<4>().coefficient(4, 0, 0));
  EXPECT_EQ(f.coefficient(0, 1, 0), 0);
  EXPECT_EQ(f.coefficient(3, 0, 1), 0);
}

TEST(Linear_substitution_3, one_map_after_another_is_their_product) {
  const Matrix& a = general;
  const Matrix b = {{{0, 1, 2}, {3, 0, -1}, {1, 1, 1}}};
  Matrix ab{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) ab[i][j] += a[i][k] * b[k][j];
  const Jet<4> g = polynomial<4>();
  EXPECT_EQ(Substitution(b)(Substitution(a)(g)).coefficients(), Substitution(ab)(g).coefficients());
}

} // namespace Linear_substitution_3_test
