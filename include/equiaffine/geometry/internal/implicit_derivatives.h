// SPDX-License-Identifier: GPL-3.0-or-later
// The partial derivatives of the graph z = g(x, y) of a level set, written out in those of f: g_x = -f_x / f_z, and
// D_x = d/dx + g_x d/dz applied again and again (Andrade, Lewiner 2012, equation (1)).
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_IMPLICIT_DERIVATIVES_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_IMPLICIT_DERIVATIVES_H

#include <equiaffine/number/internal/monomials_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The derivative of g of order i in x and j in y, i + j >= 1: a sum of products of derivatives of f, each product
/// divided by a power of f_z.
class Implicit_derivative {
public:
  Implicit_derivative() = default;

  Implicit_derivative(int i, int j) {
    Sum sum;
    add(sum, {i > 0 ? monomial_index(1, 0, 0) : monomial_index(0, 1, 0)}, 1, -1); // g_x or g_y
    for (int n = 1; n < i + j; ++n) sum = derivative(sum, n < i ? 0 : 1);
    for (const auto& [product, factor] : sum) {
      Term term{double(factor), product.second, product.first.size(), {}};
      std::copy(product.first.begin(), product.first.end(), term.factors.begin());
      terms_.push_back(term);
    }
  }

  /// The value for the partial derivatives `f` in the order of the monomials, and the powers of 1 / f_z.
  template <class FT>
  FT operator()(const std::array<FT, Jet_3<FT>::size>& f, const std::array<FT, 8>& powers) const {
    FT sum(0);
    for (const Term& t : terms_) {
      FT product = FT(t.factor) * powers[std::size_t(t.exponent)];
      for (std::size_t n = 0; n < t.number_of_factors; ++n) product = product * f[t.factors[n]];
      sum = sum + product;
    }
    return sum;
  }

private:
  struct Term {
    double factor;
    int exponent; // of 1 / f_z
    std::size_t number_of_factors;
    std::array<std::size_t, 7> factors; // monomials
  };
  std::vector<Term> terms_;

  // The sum while it is built maps the factors of a product, ascending, and the exponent of 1 / f_z to the coefficient.
  using Factors = std::vector<int>;
  using Sum = std::map<std::pair<Factors, int>, int>;

  static int raised(int monomial, int axis) {
    const Monomial_3 m = monomials[std::size_t(monomial)];
    return monomial_index(m.i + (axis == 0), m.j + (axis == 1), m.k + (axis == 2));
  }

  static void add(Sum& sum, Factors factors, int exponent, int factor) {
    std::sort(factors.begin(), factors.end());
    sum[{std::move(factors), exponent}] += factor;
  }

  /// Adds D_axis of f_n, which is f_(n + axis) - f_axis f_(n + z) / f_z, times the other factors.
  static void add_derivative(Sum& sum, int n, Factors others, int axis, int exponent, int factor) {
    others.push_back(raised(n, axis));
    add(sum, others, exponent, factor);
    others.back() = raised(n, 2);
    others.push_back(raised(0, axis));
    add(sum, std::move(others), exponent + 1, -factor);
  }

  static Sum derivative(const Sum& sum, int axis) {
    Sum result;
    for (const auto& [product, factor] : sum) {
      const auto& [factors, exponent] = product;
      for (std::size_t n = 0; n < factors.size(); ++n) {
        Factors others = factors;
        others.erase(others.begin() + std::ptrdiff_t(n));
        add_derivative(result, factors[n], std::move(others), axis, exponent, factor);
      }
      add_derivative(result, raised(0, 2), factors, axis, exponent + 1, -exponent * factor);
    }
    std::erase_if(result, [](const auto& term) { return term.second == 0; });
    return result;
  }
};

} // namespace equiaffine::internal

#endif
