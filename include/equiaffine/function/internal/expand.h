// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_EXPAND_H
#define EQUIAFFINE_FUNCTION_INTERNAL_EXPAND_H

#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/Pack.h>

#include <concepts>
#include <optional>
#include <span>

namespace equiaffine::internal {

/// The jet of the coordinate along an axis. Its type holds two coefficients only, the value and the derivative along
/// the axis, so that the compiler knows that all others are zero.
template <class FT, int Order, int Axis>
auto sparse_variable(const FT& value) {
  constexpr Monomial_set constant = 1, coordinate = Monomial_set(2) << Axis;
  Jet_3<FT, Order, (constant | coordinate)> jet(value);
  jet.template at<1 + Axis>() = FT(1);
  return jet;
}

template <class Function, class X, class Y, class Z>
concept CallableWith = requires(const Function& f, const X& x, const Y& y, const Z& z) {
  f(x, y, z);
};

// A sanitizer adds checks to every operation: inlined into one function, they would take too long to compile.
#ifdef __SANITIZE_ADDRESS__
#define EQUIAFFINE_FLATTEN
#else
#define EQUIAFFINE_FLATTEN [[gnu::flatten]]
#endif

/// Calls f(x, y, z) with everything inlined. A jet that is passed to a function goes through memory, which costs more
/// than the arithmetic on it.
template <class Result, class Function, class X, class Y, class Z>
EQUIAFFINE_FLATTEN Result inlined_call(const Function& f, const X& x, const Y& y, const Z& z) {
  return f(x, y, z);
}

#undef EQUIAFFINE_FLATTEN

/// A function that may be a cheaper one, of the same type, on a box.
template <class Function>
concept HasRestriction = requires(const Function& f, const Interval& x) {
  { f.restricted(x, x, x) } -> std::same_as<std::optional<Function>>;
};

/// A function that computes its Taylor polynomials itself, for numbers and for spans of packs.
template <class Function, class FT>
concept HasTaylor = requires(const Function& f, const FT& x, std::span<const Pack<FT>> packs,
                             std::span<Jet_3<Pack<FT>>> jets) {
  { f.taylor(x, x, x) } -> std::same_as<Jet_3<FT>>;
  f.taylor(packs, packs, packs, jets);
};

} // namespace equiaffine::internal

#endif
