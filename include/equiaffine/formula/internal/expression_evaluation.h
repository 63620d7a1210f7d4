// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates the tape of an expression for blocks of points, with operations and functions of any number type.
#ifndef EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_EVALUATION_H
#define EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_EVALUATION_H

#include <equiaffine/formula/internal/expression_tape.h>
#include <equiaffine/number/internal/elementary_functions.h>
#include <equiaffine/number/select.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace equiaffine::internal::expression {

// Operations of a T and a double. They use the mixed operators of T if these exist and return T: scaling a Taylor
// polynomial is many times cheaper than multiplying two. For built-in types the double is converted first, since a
// mixed operator would promote a float to double.
template <class T>
T plus_constant(const T& a, double c) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { a + c } -> std::same_as<T>;
                })
    return a + c;
  else return a + T(c);
}

template <class T>
T constant_minus(double c, const T& a) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { c - a } -> std::same_as<T>;
                })
    return c - a;
  else return T(c) - a;
}

template <class T>
T times_constant(const T& a, double c) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { a* c } -> std::same_as<T>;
                })
    return a * c;
  else return a * T(c);
}

template <class T>
T over_constant(const T& a, double c) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { a / c } -> std::same_as<T>;
                })
    return a / c;
  else return a / T(c);
}

template <class T>
T constant_over(double c, const T& a) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { c / a } -> std::same_as<T>;
                })
    return c / a;
  else return T(c) / a;
}

// Functions with a substitute for types that lack them.
template <class T>
T squared(const T& a) {
  if constexpr (requires {
                  { square(a) } -> std::convertible_to<T>;
                })
    return square(a);
  else return a * a;
}

/// HasOwnPower is whether T has its own pow(T, Exponent). Overload resolution prefers it to the catch-all `pow` below,
/// and prefers the catch-all to functions that would convert the exponent, such as pow(T, int) for 1.5.
namespace own_power {

struct Absent {};

template <class Base, class Exponent>
Absent pow(const Base&, const Exponent&);

template <class T, class Exponent>
concept HasOwnPower = !std::is_arithmetic_v<T> && requires(const T& a, const Exponent& b) {
  { pow(a, b) } -> std::convertible_to<T>;
};

} // namespace own_power

template <class T>
T real_power(const T& a, const T& b) {
  if constexpr (std::is_arithmetic_v<T>) return std::pow(a, b);
  else if constexpr (own_power::HasOwnPower<T, T>) return pow(a, b);
  else return exp(T(b * log(a)));
}

template <class T>
T constant_power(const T& a, double c) {
  if constexpr (own_power::HasOwnPower<T, double>) return pow(a, c);
  else return real_power(a, T(c));
}

/// The smaller argument, or NaN if either is NaN, unlike std::min and std::fmin. A `min` of T has precedence.
template <class T>
T minimum(const T& a, const T& b) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { min(a, b) } -> std::convertible_to<T>;
                })
    return min(a, b);
  else return a < b || a != a ? a : b;
}

/// The larger argument, with NaN as in minimum().
template <class T>
T maximum(const T& a, const T& b) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { max(a, b) } -> std::convertible_to<T>;
                })
    return max(a, b);
  else return a > b || a != a ? a : b;
}

/// The angle of (x, y). NaN at the origin, where the C library has a conventional value but no derivative exists.
template <class T>
T angle(const T& y, const T& x) {
  using std::atan2;
  const T result = atan2(y, x);
  if constexpr (is_built_in<T>) return select(y == T(0) && x == T(0), T(std::numeric_limits<T>::quiet_NaN()), result);
  else return result;
}

template <class T>
T hypotenuse(const T& a, const T& b) {
  if constexpr (std::is_arithmetic_v<T>) return std::hypot(a, b);
  else if constexpr (requires {
                       { hypot(a, b) } -> std::convertible_to<T>;
                     })
    return hypot(a, b);
  else return sqrt(T(squared(a) + squared(b)));
}

/// The sign, computed by `<` for types without their own `sign`.
template <class T>
T signum(const T& a) {
  if constexpr (requires {
                  { sign(a) } -> std::convertible_to<T>;
                })
    return sign(a);
  else return T(0) < a ? T(1) : a < T(0) ? T(-1) : a;
}

/// Throws std::domain_error: this function has no substitute by arithmetic.
[[noreturn]] inline void fail_without(const char* function) {
  throw std::domain_error(std::string("the number type of this evaluation has no function ") + function +
                          ": define one that argument-dependent lookup can find");
}

template <class T>
T error_function(const T& a) {
  using std::erf;
  if constexpr (own_functions::HasErf<T>) return erf(a);
  else fail_without("erf(T)");
}

template <class T>
T whole_part(const T& a) {
  using std::floor;
  if constexpr (own_functions::HasFloor<T>) return floor(a);
  else fail_without("floor(T)");
}

template <class T>
T remainder_of(const T& a, const T& b) {
  using std::fmod;
  if constexpr (own_functions::HasFmod<T>) return fmod(a, b);
  else fail_without("fmod(T, T)");
}

/// Sets result[i] = f(a[i], b[i]) for the first `count` points. The loop over a full block has a size known at compile
/// time, which compilers need to vectorize it at moderate optimization levels, and is unrolled, which halves its time
/// with GCC.
template <std::size_t Block, class T, class Function>
void for_each_point(const T* __restrict a, const T* __restrict b, T* __restrict result, std::size_t count, Function f) {
  if (Block == 1 || count == Block) {
#pragma GCC unroll 8
    for (std::size_t i = 0; i < Block; ++i) result[i] = f(a[i], b[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) result[i] = f(a[i], b[i]);
  }
}

/// Computes a^n for n >= 3, by pow(T, int) of T if it exists, otherwise by repeated squaring from the leading bit of n
/// down.
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

/// A number type with comparisons, or a pack of such numbers, as required by execute_choice().
template <class T>
concept Ordered = std::is_floating_point_v<T> || requires {
  typename T::Mask;
};

/// Executes the instructions that choose Taylor coefficients at kinks of abs, min and max and at jumps of fmod.
template <std::size_t Block, class T>
void execute_choice(const Instruction& instruction, const T* a, const T* b, T* result, std::size_t count) {
  const auto apply = [&](auto f) { for_each_point<Block>(a, b, result, count, f); };
  const T zero(0), one(1);
  switch (instruction.opcode) {
  case Opcode::ORDER: return apply([&](const T& u, const T& v) -> T { return branch_or_kink(u, v, one, -one, 1); });
  case Opcode::WHERE_POSITIVE:
    return apply([&](const T& u, const T& v) -> T { return branch_or_kink(u, zero, v, zero, 1); });
  case Opcode::WHERE_NEGATIVE:
    return apply([&](const T& u, const T& v) -> T { return branch_or_kink(u, zero, zero, v, 1); });
  case Opcode::REMAINDER_JUMP: return apply([](const T& u, const T& v) -> T { return jump_of_remainder(u, u, v); });
  default: return;
  }
}

/// Executes the instructions that take much longer than a function call.
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
  case Opcode::ERF: return apply([](const T& u, const T&) -> T { return error_function(u); });
  case Opcode::FLOOR: return apply([](const T& u, const T&) -> T { return whole_part(u); });
  case Opcode::SIGN: return apply([](const T& u, const T&) -> T { return signum(u); });
  case Opcode::FMOD: return apply([](const T& u, const T& v) -> T { return remainder_of(u, v); });
  default:
    if constexpr (Ordered<T>) execute_choice<Block>(instruction, a, b, result, count);
  }
}

/// Executes one instruction for `count` <= Block points. Inlined into the loop over the instructions, with all
/// arithmetic operations: they are most of a tape, and a call would take as long as the operation.
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

/// The number of points, or of packs of points, in a block. A slot takes 512 bytes, so that the slots of a typical tape
/// fit into the first-level cache. If T is as large as a Taylor polynomial, a block is one point.
template <class T>
inline constexpr std::size_t block_size = std::max<std::size_t>(1, 512 / sizeof(T));

/// Memory for the intermediate results of a tape: on the stack for up to 32 slots of a T that needs no constructor,
/// otherwise on the heap.
template <std::size_t Block, class T>
class Slots {
public:
  explicit Slots(const Tape& tape) : tape_(tape) {
    if (const std::size_t size = tape.number_of_slots * Block; size > stack_size) on_heap_.reset(new T[size]);
  }

  /// Runs the tape for `count` <= Block points.
  void run(const std::array<const T*, number_of_variables>& points, std::size_t count) {
    points_ = points;
    T* const slots = first();
    for (const Instruction& i : tape_.instructions)
      execute<Block>(i, operand(slots, i.a), operand(slots, i.b), slot(slots, i.result), count);
  }

  /// The values of result n after run(): in a slot or, if the result is a variable, in the points of that run.
  const T* result(std::size_t n = 0) { return operand(first(), tape_.results[n]); }

private:
  static constexpr std::size_t stack_size = std::is_trivially_default_constructible_v<T> ? 32 * Block : 0;

  T* first() { return on_heap_ ? on_heap_.get() : on_stack_.data(); }
  static T* slot(T* slots, std::uint32_t index) { return slots + (index - number_of_variables) * Block; }
  const T* operand(T* slots, std::uint32_t index) const {
    return index < number_of_variables ? points_[index] : slot(slots, index);
  }

  const Tape& tape_;
  std::array<const T*, number_of_variables> points_{};
  std::array<T, stack_size> on_stack_; ///< uninitialized, since T needs no constructor
  std::unique_ptr<T[]> on_heap_;
};

/// Runs the tape at all points, block by block. After each block it calls store(slots, first, count) for the points
/// with the indices `first` to `first + count - 1`.
template <std::size_t Block, class T, class Store>
void run_in_blocks(const Tape& tape, std::span<const T> x, std::span<const T> y, std::span<const T> z,
                   const Store& store) {
  Slots<Block, T> slots(tape);
  for (std::size_t first = 0; first < x.size(); first += Block) {
    const std::size_t count = std::min(Block, x.size() - first);
    slots.run({&x[first], &y[first], &z[first]}, count);
    store(slots, first, count);
  }
}

} // namespace equiaffine::internal::expression

#endif
