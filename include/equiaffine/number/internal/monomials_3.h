// SPDX-License-Identifier: GPL-3.0-or-later
// The monomials x^i y^j z^k of total degree <= 5 in graded lexicographic order (1; x y z; xx xy xz yy yz zz; ...), sets
// of them as bit masks, and the products needed for a truncated multiplication of two such sets.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_MONOMIALS_3_H
#define EQUIAFFINE_NUMBER_INTERNAL_MONOMIALS_3_H

#include <equiaffine/base/internal/compiler.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace equiaffine::internal {

inline constexpr int default_order = 4; // for the affine structure
inline constexpr int maximal_order = 5; // for its gradient

constexpr int number_of_monomials(int order) { return (order + 1) * (order + 2) * (order + 3) / 6; }

struct Monomial_3 {
  std::int8_t i, j, k;
  constexpr int degree() const { return i + j + k; }
};

inline constexpr auto monomials = [] {
  std::array<Monomial_3, std::size_t(number_of_monomials(maximal_order))> table{};
  std::size_t n = 0;
  for (int degree = 0; degree <= maximal_order; ++degree)
    for (int i = degree; i >= 0; --i)
      for (int j = degree - i; j >= 0; --j) table[n++] = {std::int8_t(i), std::int8_t(j), std::int8_t(degree - i - j)};
  return table;
}();

// A table, because a search would run at run time if (i, j, k) is not constant.
inline constexpr auto monomial_indices = [] {
  std::array<std::array<std::array<std::int8_t, maximal_order + 1>, maximal_order + 1>, maximal_order + 1> table{};
  for (std::size_t n = 0; n < monomials.size(); ++n)
    table[std::size_t(monomials[n].i)][std::size_t(monomials[n].j)][std::size_t(monomials[n].k)] = std::int8_t(n);
  return table;
}();

constexpr int monomial_index(int i, int j, int k) {
  return monomial_indices[std::size_t(i)][std::size_t(j)][std::size_t(k)];
}

using Monomial_set = std::uint64_t;

constexpr Monomial_set all_monomials(int order) { return (Monomial_set(1) << number_of_monomials(order)) - 1; }

constexpr Monomial_set monomials_of_degree(int degree) {
  return degree == 0 ? Monomial_set(1) : all_monomials(degree) & ~all_monomials(degree - 1);
}

/// The members of a set with the given degree; empty if the degree exceeds the order.
constexpr Monomial_set members_of_degree(Monomial_set set, int degree, int order) {
  return degree <= order ? set & monomials_of_degree(degree) : 0;
}

constexpr bool contains(Monomial_set set, int n) { return (set >> n & 1) != 0; }

/// Position of monomial n in a set that contains it.
constexpr int rank(Monomial_set set, int n) { return std::popcount(set & ((Monomial_set(1) << n) - 1)); }

/// The member of a set at the given position; the inverse of rank().
constexpr int member(Monomial_set set, std::size_t position) {
  for (; position > 0; --position) set &= set - 1;
  return std::countr_zero(set);
}

/// The number of the product of two monomials, or -1 if its degree exceeds the maximal order.
constexpr int product_of_monomials(int a, int b) {
  const Monomial_3 p = monomials[std::size_t(a)], q = monomials[std::size_t(b)];
  return p.degree() + q.degree() > maximal_order ? -1 : monomial_index(p.i + q.i, p.j + q.j, p.k + q.k);
}

/// The monomial whose product with `divisor` is `target`, or -1.
constexpr int quotient_of_monomials(int target, int divisor) {
  const Monomial_3 p = monomials[std::size_t(target)], q = monomials[std::size_t(divisor)];
  return p.i < q.i || p.j < q.j || p.k < q.k ? -1 : monomial_index(p.i - q.i, p.j - q.j, p.k - q.k);
}

/// The products of degree <= order of a member of a and a member of b.
constexpr Monomial_set product_of_sets(Monomial_set a, Monomial_set b, int order) {
  Monomial_set product = 0;
  for (int p = 0; p < number_of_monomials(order); ++p)
    for (int q = 0; contains(a, p) && q < number_of_monomials(order); ++q)
      if (contains(b, q) && product_of_monomials(p, q) >= 0) product |= Monomial_set(1) << product_of_monomials(p, q);
  return product & all_monomials(order);
}

/// The monomials that can occur in a smooth function of a jet with the given support.
constexpr Monomial_set closure(Monomial_set set, int order) {
  Monomial_set powers = 1;
  for (int n = 0; n < order; ++n) powers |= product_of_sets(powers, set, order);
  return powers;
}

/// The pairs (a, b) of members of A and B, as positions within their sets, whose product is monomial `Target`.
template <Monomial_set A, Monomial_set B, int Target>
struct Factor_pairs {
  struct Pair {
    std::size_t first, second;
  };

  template <class Visitor>
  static constexpr void visit(Visitor visitor) {
    for (int a = 0; a <= Target; ++a)
      if (const int b = quotient_of_monomials(Target, a); contains(A, a) && b >= 0 && contains(B, b))
        visitor(Pair{std::size_t(rank(A, a)), std::size_t(rank(B, b))});
  }

  static constexpr std::size_t size = [] {
    std::size_t n = 0;
    visit([&](const Pair&) { ++n; });
    return n;
  }();

  static constexpr auto pairs = [] {
    std::array<Pair, size> list{};
    std::size_t n = 0;
    visit([&](const Pair& pair) { list[n++] = pair; });
    return list;
  }();
};

} // namespace equiaffine::internal

#endif
