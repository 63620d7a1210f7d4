// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_EVALUATION_H
#define EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_EVALUATION_H

#include <equiaffine/formula/internal/expression_arithmetic.h>
#include <equiaffine/formula/internal/expression_tape.h>
#include <equiaffine/number/elementary_functions.h>
#include <equiaffine/number/nonsmooth.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

/// The evaluation of a tape, for blocks of points.
namespace equiaffine::internal::expression {

/// f of the first `count` elements. A full block has a trip count known at compile time, which is what compilers need
/// to vectorise at moderate optimisation levels; unrolled, GCC's loops take half the time.
template <std::size_t Block, class T, class Function>
void for_each_point(const T* __restrict a, const T* __restrict b, T* __restrict result, std::size_t count, Function f) {
  if (Block == 1 || count == Block) {
#pragma GCC unroll 8
    for (std::size_t i = 0; i < Block; ++i) result[i] = f(a[i], b[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) result[i] = f(a[i], b[i]);
  }
}

/// a^n for n >= 3, by repeated squaring from the leading bit of n downwards unless T has its own pow(T, int).
template <std::size_t Block, class T>
void integer_power(const T* a, T* result, std::size_t count, unsigned n) {
  const auto apply = [&](const T* u, auto f) { for_each_point<Block>(u, u, result, count, f); };
  if constexpr (own_power::HasOwnPower<T, int>) {
    apply(a, [n](const T& u, const T&) -> T { return pow(u, static_cast<int>(n)); });
  } else if (n == 3) {
    apply(a, [](const T& u, const T&) -> T { return squared(u) * u; });
  } else if (n == 4) {
    apply(a, [](const T& u, const T&) -> T { return squared(squared(u)); });
  } else {
    std::copy_n(a, count, result);
    for (unsigned bit = std::bit_floor(n) / 2; bit != 0; bit /= 2) {
      for (std::size_t i = 0; i < count; ++i) result[i] = squared(result[i]);
      if (n & bit)
        for (std::size_t i = 0; i < count; ++i) result[i] = result[i] * a[i];
    }
  }
}

/// A number type, or a pack of numbers, with the order that choices need.
template <class T>
concept Ordered = std::is_floating_point_v<T> || requires {
  typename T::Mask;
};

/// The choices of Taylor coefficients at kinks.
template <std::size_t Block, class T>
void execute_choice(const Instruction& instruction, const T* a, const T* b, T* result, std::size_t count) {
  using internal::branch_or_kink;
  const auto apply = [&](auto f) { for_each_point<Block>(a, b, result, count, f); };
  const T zero(0), one(1);
  switch (instruction.opcode) {
  case Opcode::ORDER: return apply([&](const T& u, const T& v) -> T { return branch_or_kink(u, v, one, -one, 1); });
  case Opcode::WHERE_POSITIVE:
    return apply([&](const T& u, const T& v) -> T { return branch_or_kink(u, zero, v, zero, 1); });
  case Opcode::WHERE_NEGATIVE:
    return apply([&](const T& u, const T& v) -> T { return branch_or_kink(u, zero, zero, v, 1); });
  default: return;
  }
}

template <std::size_t Block, class T>
[[gnu::noinline]] void execute_function(const Instruction& instruction, const T* a, const T* b, T* result,
                                        std::size_t count) {
  using std::abs, std::acos, std::asin, std::atan, std::cbrt, std::cosh, std::log, std::sinh, std::sqrt, std::tan,
      std::tanh;
  const double c = instruction.constant;
  const auto apply = [&](auto f) { for_each_point<Block>(a, b, result, count, f); };
  switch (instruction.opcode) {
  case Opcode::INTEGER_POWER: return integer_power<Block>(a, result, count, static_cast<unsigned>(c));
  case Opcode::POWER_CONSTANT: return apply([c](const T& u, const T&) -> T { return constant_power(u, c); });
  case Opcode::POWER: return apply([](const T& u, const T& v) -> T { return real_power(u, v); });
  case Opcode::SQRT: return apply([](const T& u, const T&) -> T { return sqrt(u); });
  case Opcode::CBRT: return apply([](const T& u, const T&) -> T { return cbrt(u); });
  case Opcode::EXP: return apply([](const T& u, const T&) -> T { return exp_value(u); });
  case Opcode::LOG: return apply([](const T& u, const T&) -> T { return log(u); });
  case Opcode::SIN: return apply([](const T& u, const T&) -> T { return sine_and_cosine(u).first; });
  case Opcode::COS: return apply([](const T& u, const T&) -> T { return sine_and_cosine(u).second; });
  case Opcode::TAN: return apply([](const T& u, const T&) -> T { return tan(u); });
  case Opcode::ASIN: return apply([](const T& u, const T&) -> T { return asin(u); });
  case Opcode::ACOS: return apply([](const T& u, const T&) -> T { return acos(u); });
  case Opcode::ATAN: return apply([](const T& u, const T&) -> T { return atan(u); });
  case Opcode::ATAN2: return apply([](const T& u, const T& v) -> T { return angle(u, v); });
  case Opcode::SINH: return apply([](const T& u, const T&) -> T { return sinh(u); });
  case Opcode::COSH: return apply([](const T& u, const T&) -> T { return cosh(u); });
  case Opcode::TANH: return apply([](const T& u, const T&) -> T { return tanh(u); });
  case Opcode::ABS: return apply([](const T& u, const T&) -> T { return abs(u); });
  case Opcode::MIN: return apply([](const T& u, const T& v) -> T { return minimum(u, v); });
  case Opcode::MAX: return apply([](const T& u, const T& v) -> T { return maximum(u, v); });
  case Opcode::HYPOT: return apply([](const T& u, const T& v) -> T { return hypotenuse(u, v); });
  default:
    if constexpr (Ordered<T>) execute_choice<Block>(instruction, a, b, result, count);
  }
}

/// Executes one instruction for `count` <= Block points. Arithmetic, which is most of a tape, stays within the loop
/// over the instructions: a call for each costs as much as what it computes.
template <std::size_t Block, class T>
[[gnu::always_inline]] inline void execute(const Instruction& instruction, const T* a, const T* b, T* result,
                                           std::size_t count) {
  const double c = instruction.constant;
  const auto apply = [&](auto f) { for_each_point<Block>(a, b, result, count, f); };
  switch (instruction.opcode) {
  case Opcode::CONSTANT: return apply([c](const T&, const T&) -> T { return T(c); });
  case Opcode::ADD_CONSTANT: return apply([c](const T& u, const T&) -> T { return plus_constant(u, c); });
  case Opcode::SUBTRACT_FROM_CONSTANT: return apply([c](const T& u, const T&) -> T { return constant_minus(c, u); });
  case Opcode::MULTIPLY_CONSTANT: return apply([c](const T& u, const T&) -> T { return times_constant(u, c); });
  case Opcode::DIVIDE_BY_CONSTANT: return apply([c](const T& u, const T&) -> T { return over_constant(u, c); });
  case Opcode::DIVIDE_CONSTANT: return apply([c](const T& u, const T&) -> T { return constant_over(c, u); });
  case Opcode::ADD: return apply([](const T& u, const T& v) -> T { return u + v; });
  case Opcode::SUBTRACT: return apply([](const T& u, const T& v) -> T { return u - v; });
  case Opcode::MULTIPLY: return apply([](const T& u, const T& v) -> T { return u * v; });
  case Opcode::DIVIDE: return apply([](const T& u, const T& v) -> T { return u / v; });
  case Opcode::NEGATE: return apply([](const T& u, const T&) -> T { return -u; });
  case Opcode::SQUARE: return apply([](const T& u, const T&) -> T { return squared(u); });
  default: return execute_function<Block>(instruction, a, b, result, count);
  }
}

/// Points, or packs of points, per block: half a kilobyte per slot keeps a typical tape in the first-level cache; a
/// type as large as a Taylor polynomial is taken one at a time.
template <class T>
inline constexpr std::size_t block_size = std::max<std::size_t>(1, 512 / sizeof(T));

/// Working memory of an evaluation: uninitialised when T is, and on the stack for up to 32 slots of a trivial T.
template <std::size_t Block, class T>
class Slots {
public:
  explicit Slots(const Tape& tape) : tape_(tape) {
    if (const std::size_t size = tape.number_of_slots * Block; size > capacity) large_.reset(new T[size]);
  }

  /// Runs the tape for `count` <= Block points.
  void run(const std::array<const T*, number_of_variables>& points, std::size_t count) {
    points_ = points;
    T* const slots = first();
    for (const Instruction& i : tape_.instructions)
      execute<Block>(i, operand(slots, i.a), operand(slots, i.b), slot(slots, i.result), count);
  }

  /// Result n of the last run, in the slots or in its `points`.
  const T* result(std::size_t n = 0) { return operand(first(), tape_.results[n]); }

private:
  static constexpr std::size_t capacity = std::is_trivially_default_constructible_v<T> ? 32 * Block : 0;

  T* first() { return large_ ? large_.get() : small_.data(); }
  static T* slot(T* slots, std::uint32_t index) { return slots + (index - number_of_variables) * Block; }
  const T* operand(T* slots, std::uint32_t index) const {
    return index < number_of_variables ? points_[index] : slot(slots, index);
  }

  const Tape& tape_;
  std::array<const T*, number_of_variables> points_{};
  std::array<T, capacity> small_;
  std::unique_ptr<T[]> large_;
};

} // namespace equiaffine::internal::expression

#endif
