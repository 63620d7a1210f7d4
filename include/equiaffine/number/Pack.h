// SPDX-License-Identifier: GPL-3.0-or-later
// Packs: several numbers in one vector register. Function templates use a pack like a single number.
#ifndef EQUIAFFINE_NUMBER_PACK_H
#define EQUIAFFINE_NUMBER_PACK_H

#include <equiaffine/number/internal/elementary_functions.h>
#include <equiaffine/number/internal/lanes.h>
#include <equiaffine/number/select.h>

#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <type_traits>
#include <utility>

namespace equiaffine {

/// Thrown if code branches on a condition that differs between the lanes of a pack. The caller must then compute the
/// points of the pack one by one.
struct Lanes_disagree : std::exception {
  /// The message of the exception.
  const char* what() const noexcept override { return "the lanes of a pack disagree"; }
};

/// A truth value per lane.
template <class T, class Lanes>
struct Pack_mask {
  using Mask = typename Lanes::Mask; ///< the vector of truth values
  Mask lanes;                        ///< one truth value per lane

  Pack_mask() = default;                           ///< leaves the lanes uninitialized
  Pack_mask(bool value) : lanes(value) {}          ///< the same value in all lanes
  Pack_mask(const Mask& values) : lanes(values) {} ///< one value per lane

  bool operator[](std::size_t lane) const { return lanes[lane]; } ///< the value of one lane

  /// The common value of all lanes, so that code with branches works for packs whose lanes agree.
  /// \throw Lanes_disagree if they differ
  explicit operator bool() const {
    if (Lanes::all(lanes)) return true;
    if (Lanes::any(lanes)) throw Lanes_disagree();
    return false;
  }

  /// @{
  /// The operator of bool in each lane; both operands are evaluated.
  [[gnu::always_inline]] friend Pack_mask operator!(const Pack_mask& a) { return !a.lanes; }
  [[gnu::always_inline]] friend Pack_mask operator&&(const Pack_mask& a, const Pack_mask& b) {
    return a.lanes && b.lanes;
  }
  [[gnu::always_inline]] friend Pack_mask operator||(const Pack_mask& a, const Pack_mask& b) {
    return a.lanes || b.lanes;
  }
  /// @}

  /// Whether the condition holds in any lane.
  friend bool any(const Pack_mask& condition) { return Lanes::any(condition.lanes); }
};

/// As many numbers as fit into a vector register under the compiler's flags, used like one number by Jet_3,
/// Monge_chart_3 and code that builds on these. Every operation is that of T in each lane. Functions are those of
/// `<cmath>`, except exp, sin and cos of doubles, which are the library's own. A lane is therefore bitwise equal to a
/// computation with T, unless the compiler contracts products and sums to fused operations (-ffp-contract; GCC does so
/// by default where the processor supports it). Then both agree up to rounding.
///
/// `Lanes` is the storage of the lanes: a vector type of the compiler if available, otherwise an array. Results are the
/// same.
template <class T, class Lanes> // default arguments: select.h
struct Pack {
  using Vector = typename Lanes::Vector;           ///< the vector of numbers
  using Mask = Pack_mask<T, Lanes>;                ///< the result of a comparison
  static constexpr std::size_t size = Lanes::size; ///< the number of lanes

  Vector lanes; ///< one number per lane

  Pack() = default; ///< leaves the lanes uninitialized, since zeroing them would slow down jets considerably
  /// The same number in all lanes.
  template <class Number>
  Pack(const Number& value) requires(std::is_arithmetic_v<Number>) : lanes(static_cast<T>(value)) {}
  Pack(const Vector& values) : lanes(values) {} ///< one number per lane

  /// Returns the pack whose lane i is f(i).
  template <class F>
  static Pack generate(F f) {
    return Lanes::generate(f);
  }

  /// Returns the pack whose lane i is f(a[i]).
  template <class F>
  [[gnu::noinline]] static Pack lane_by_lane(const Pack& a, F f) {
    return generate([&](std::size_t i) { return f(a[i]); });
  }

  T operator[](std::size_t lane) const { return lanes[lane]; } ///< the number in one lane

  /// @{
  /// The operation of T in each lane.
  [[gnu::always_inline]] Pack operator-() const { return -lanes; }
  Pack operator+() const { return *this; }
  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator-=(const Pack& b) { return *this = *this - b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }
  Pack& operator/=(const Pack& b) { return *this = *this / b; }

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) { return a.lanes + b.lanes; }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) { return a.lanes - b.lanes; }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) { return a.lanes * b.lanes; }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) { return a.lanes / b.lanes; }

  [[gnu::always_inline]] friend Mask operator<(const Pack& a, const Pack& b) { return a.lanes < b.lanes; }
  [[gnu::always_inline]] friend Mask operator>(const Pack& a, const Pack& b) { return a.lanes > b.lanes; }
  [[gnu::always_inline]] friend Mask operator<=(const Pack& a, const Pack& b) { return a.lanes <= b.lanes; }
  [[gnu::always_inline]] friend Mask operator>=(const Pack& a, const Pack& b) { return a.lanes >= b.lanes; }
  [[gnu::always_inline]] friend Mask operator==(const Pack& a, const Pack& b) { return a.lanes == b.lanes; }
  [[gnu::always_inline]] friend Mask operator!=(const Pack& a, const Pack& b) { return a.lanes != b.lanes; }

  [[gnu::always_inline]] friend Pack select(const Mask& condition, const Pack& yes, const Pack& no) {
    return Lanes::select(condition.lanes, yes.lanes, no.lanes);
  }

  [[gnu::always_inline]] friend Pack abs(const Pack& a) { return Lanes::abs(a.lanes); }
  [[gnu::always_inline]] friend Pack sqrt(const Pack& a) { return Lanes::sqrt(a.lanes); }
  /// @}
  /// @{
  /// The result is NaN if an argument is NaN.
  friend Pack min(const Pack& a, const Pack& b) { return select(a < b || a != a, a, b); }
  friend Pack max(const Pack& a, const Pack& b) { return select(a > b || a != a, a, b); }
  /// @}

#define EQUIAFFINE_PACK_FUNCTION(name)                                                                                 \
  /** Applies the function of `<cmath>` to each lane. */                                                               \
  friend Pack name(const Pack& a) {                                                                                    \
    return lane_by_lane(a, [](T u) { return std::name(u); });                                                          \
  }
  EQUIAFFINE_PACK_FUNCTION(cbrt)
  EQUIAFFINE_PACK_FUNCTION(log)
  EQUIAFFINE_PACK_FUNCTION(tan)
  EQUIAFFINE_PACK_FUNCTION(asin)
  EQUIAFFINE_PACK_FUNCTION(acos)
  EQUIAFFINE_PACK_FUNCTION(atan)
  EQUIAFFINE_PACK_FUNCTION(sinh)
  EQUIAFFINE_PACK_FUNCTION(cosh)
  EQUIAFFINE_PACK_FUNCTION(tanh)
#undef EQUIAFFINE_PACK_FUNCTION
#define EQUIAFFINE_PACK_FUNCTION(name)                                                                                 \
  /** Applies the function of `<cmath>` to each lane. */                                                               \
  friend Pack name(const Pack& a, const Pack& b) {                                                                     \
    return generate([&](std::size_t i) { return std::name(a[i], b[i]); });                                             \
  }
  EQUIAFFINE_PACK_FUNCTION(pow)
  EQUIAFFINE_PACK_FUNCTION(atan2)
  EQUIAFFINE_PACK_FUNCTION(hypot)
#undef EQUIAFFINE_PACK_FUNCTION

  /// @{
  /// Applies the library's own function to each lane for doubles, and that of `<cmath>` for other types.
  [[gnu::always_inline]] friend Pack exp(const Pack& a) {
    if constexpr (std::is_same_v<T, double>)
      if (const Mask in_range = abs(a) <= Pack(internal::exponential_range); Lanes::all(in_range.lanes))
        return internal::exponential_in_range(a);
    return lane_by_lane(a, [](T u) { return internal::exp_value(u); });
  }
  [[gnu::always_inline]] friend std::pair<Pack, Pack> sine_and_cosine(const Pack& a) {
    if constexpr (std::is_same_v<T, double>)
      if (const Mask in_range = abs(a) <= Pack(internal::circular_range); Lanes::all(in_range.lanes))
        return internal::sine_and_cosine_in_range(a);
    return {lane_by_lane(a, [](T u) { return internal::sine_and_cosine(u).first; }),
            lane_by_lane(a, [](T u) { return internal::sine_and_cosine(u).second; })};
  }
  friend Pack sin(const Pack& a) { return sine_and_cosine(a).first; }
  friend Pack cos(const Pack& a) { return sine_and_cosine(a).second; }
  /// @}

  /// 2^(k / 128) (1 + p) for small p and integers k, given as k + 1.5 2^52. Used by exp().
  [[gnu::always_inline]] friend Pack scaled_exponential(const Pack& k, const Pack& p) {
    return Lanes::scaled_exponential(k.lanes, p.lanes);
  }

  /// a^n, bitwise equal to that of T.
  friend Pack natural_power(const Pack& a, unsigned n) {
    return generate([&](std::size_t i) { return internal::natural_power(a[i], n); });
  }

  /// branch_or_kink() of select.h in each lane.
  friend Pack branch_or_kink(const Pack& u, const Pack& v, const Pack& a, const Pack& b, int degree) {
    const Pack at_kink = degree == 0 ? select(u == v, a, u + v) : Pack(std::numeric_limits<T>::quiet_NaN());
    return select(u > v, a, select(v > u, b, at_kink));
  }
};

} // namespace equiaffine

/// The limits of a pack are those of T.
/// \cond
template <class T, class Lanes>
struct std::numeric_limits<equiaffine::Pack<T, Lanes>> : std::numeric_limits<T> {};
/// \endcond

#endif
