// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_TAPE_H
#define EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_TAPE_H

#include <equiaffine/number/Interval.h>

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The instruction list of an `Expression_3`.
namespace equiaffine::internal::expression {

enum class Opcode : std::uint8_t {
  VARIABLE, // only in a Tape_builder
  CONSTANT,
  ADD_CONSTANT,
  SUBTRACT_FROM_CONSTANT,
  MULTIPLY_CONSTANT,
  DIVIDE_BY_CONSTANT,
  DIVIDE_CONSTANT,
  ADD,
  SUBTRACT,
  MULTIPLY,
  DIVIDE,
  NEGATE,
  SQUARE,
  INTEGER_POWER,
  POWER_CONSTANT,
  POWER,
  SQRT,
  CBRT,
  EXP,
  LOG,
  SIN,
  COS,
  TAN,
  ASIN,
  ACOS,
  ATAN,
  ATAN2,
  SINH,
  COSH,
  TANH,
  ABS,
  MIN,
  MAX,
  HYPOT,
  ERF,
  FLOOR,
  SIGN,
  FMOD,
  // Only in tapes of Taylor coefficients:
  ORDER,          // 1 if a > b, -1 if a < b, otherwise NaN
  WHERE_POSITIVE, // b if a > 0, 0 if a < 0, otherwise NaN
  WHERE_NEGATIVE, // b if a < 0, 0 if a > 0, otherwise NaN
  REMAINDER_JUMP  // NaN if fmod with first argument a and value b jumps, otherwise 0
};

/// The operation result = opcode(a, b, constant). Operands 0, 1, 2 are x, y, z; operand 3 + s is slot s. A unary
/// instruction has a == b; `constant` also holds integer exponents. The result is never the slot of an operand, so that
/// loops over blocks of points may assume that reads and writes do not overlap.
struct Instruction {
  Opcode opcode;
  std::uint32_t result, a, b;
  double constant;
};

inline constexpr std::uint32_t number_of_variables = 3;

struct Tape {
  std::vector<Instruction> instructions;
  std::vector<std::uint32_t> results; ///< the operands that contain the results at the end
  std::uint32_t number_of_slots = 0;
};

// Defined in the compiled library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Implements the constructor of Expression_3.
Tape parse_expression(std::string_view text, const std::map<std::string, double>& constants);

/// Whether the tape contains min, max or abs.
bool has_choices(const Tape& tape);

/// Returns a shorter tape, if there is one, with bitwise equal results at the points of the given box, for double and
/// for jets of order 1.
std::optional<Tape> shorten_tape(const Tape& tape, const std::array<Interval, number_of_variables>& sides);

/// The tape that computes the Taylor coefficients of total order 4, in the order of the monomials.
Tape taylor_tape(const Tape& tape);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

/// The tape of the Taylor coefficients, built on first use, since most expressions never need it.
class Lazy_taylor_tape {
public:
  const Tape& get(const Tape& values) {
    std::call_once(is_made_, [&] { tape_ = taylor_tape(values); });
    return tape_;
  }

private:
  std::once_flag is_made_;
  Tape tape_;
};

} // namespace equiaffine::internal::expression

#endif
