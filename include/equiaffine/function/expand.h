// SPDX-License-Identifier: GPL-3.0-or-later
// The Taylor expansion of a functor f(x, y, z) by automatic differentiation, at one or many points.
#ifndef EQUIAFFINE_FUNCTION_EXPAND_H
#define EQUIAFFINE_FUNCTION_EXPAND_H

#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/Pack.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>

namespace equiaffine::internal {

/// The jet of a coordinate. Its type has only two coefficients, the value and the derivative along the axis, so that
/// all others are zero at compile time.
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

// With a sanitizer every operation has checks; inlined into one function, they would take too long to compile.
#ifdef __SANITIZE_ADDRESS__
#define EQUIAFFINE_FLATTEN
#else
#define EQUIAFFINE_FLATTEN [[gnu::flatten]]
#endif

/// Calls f(x, y, z) with everything inlined. Passing a jet to a function costs more than the arithmetic on it, since it
/// goes through memory.
template <class Result, class Function, class X, class Y, class Z>
EQUIAFFINE_FLATTEN Result inlined_call(const Function& f, const X& x, const Y& y, const Z& z) {
  return f(x, y, z);
}

#undef EQUIAFFINE_FLATTEN

/// A function that may have a cheaper version, of the same type, on a box.
template <class Function>
concept HasRestriction = requires(const Function& f, const Interval& x) {
  { f.restricted(x, x, x) } -> std::same_as<std::optional<Function>>;
};

/// A function that computes its Taylor polynomials itself, for numbers and spans of packs.
template <class Function, class FT>
concept HasTaylor = requires(const Function& f, const FT& x, std::span<const Pack<FT>> packs,
                             std::span<Jet_3<Pack<FT>>> jets) {
  { f.taylor(x, x, x) } -> std::same_as<Jet_3<FT>>;
  f.taylor(packs, packs, packs, jets);
};

} // namespace equiaffine::internal

namespace equiaffine {

/// The Taylor expansion of a functor f at (x, y, z), by automatic differentiation: a polynomial of total order 1 to 5
/// in the offsets from x, y and z. The functor is a template of one argument type or, which is faster, of three. It
/// must call functions as `using std::sin; sin(x)`. If FT is a Pack, each lane is a point of its own; f may then throw
/// Lanes_disagree.
template <int Order, class FT, class Function>
Jet_3<FT, Order> expand(const Function& f, const FT& x, const FT& y, const FT& z) {
  const auto sx = internal::sparse_variable<FT, Order, 0>(x);
  const auto sy = internal::sparse_variable<FT, Order, 1>(y);
  const auto sz = internal::sparse_variable<FT, Order, 2>(z);
  using Jet = Jet_3<FT, Order>;
  if constexpr (internal::CallableWith<Function, decltype(sx), decltype(sy), decltype(sz)>) {
    if constexpr (is_built_in<FT>) return internal::inlined_call<Jet>(f, sx, sy, sz);
    else return f(sx, sy, sz);
  } else {
    static_assert(internal::CallableWith<Function, Jet, Jet, Jet>,
                  "the function does not accept jets: write it as a template of the type of its arguments, and call "
                  "functions as `using std::sin; sin(x)`");
    return f(Jet(sx), Jet(sy), Jet(sz));
  }
}

} // namespace equiaffine

namespace equiaffine::internal {

/// A functor that can be called with spans of coordinates and a span for the values.
template <class Function, class FT>
concept TakesSpans = requires(const Function& f, std::span<const FT> coordinates, std::span<FT> values) {
  f(coordinates, coordinates, coordinates, values);
};

/// Sets values[i] to f(points[i]).
template <class FT, class Function, class Point_3>
void values_at(const Function& f, std::span<const Point_3> points, std::span<FT> values) {
  if constexpr (TakesSpans<Function, FT>) {
    constexpr std::size_t block = 64;
    std::array<FT, block> x, y, z;
    for (std::size_t first = 0; first < points.size(); first += block) {
      const std::size_t count = std::min(block, points.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        const Point_3& p = points[first + i];
        x[i] = p.x(), y[i] = p.y(), z[i] = p.z();
      }
      const auto used = [&](const std::array<FT, block>& numbers) { return std::span(numbers).first(count); };
      f(used(x), used(y), used(z), values.subspan(first, count));
    }
  } else {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = f(points[i].x(), points[i].y(), points[i].z());
  }
}

/// Sets jets[i] to the expansion of f at points[i], computed in packs.
/// \throw Lanes_disagree if f branches differently in the lanes of a pack
template <int Order, class FT, class Function, class Point_3>
void expand_points(const Function& f, std::span<const Point_3> points, std::span<Jet_3<FT, Order>> jets) {
  using Lanes = Pack<FT>;
  for (std::size_t first = 0; first < points.size(); first += Lanes::size) {
    const std::size_t last = std::min(first + Lanes::size, points.size()) - 1;
    const auto lanes_of = [&](int axis) {
      return Lanes::generate([&](std::size_t i) { return points[std::min(first + i, last)][axis]; });
    };
    const auto pack = expand<Order, Lanes>(f, lanes_of(0), lanes_of(1), lanes_of(2));
    for (std::size_t i = first; i <= last; ++i)
      for (std::size_t n = 0; n < pack.size; ++n) jets[i].coefficients()[n] = pack.coefficients()[n][i - first];
  }
}

} // namespace equiaffine::internal

#endif
