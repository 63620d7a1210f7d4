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

/// The instruction list behind `Expression_3`.
namespace equiaffine::internal::expression {

enum class Opcode : std::uint8_t {
  VARIABLE, // occurs in a Tape_builder only
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
  // The following ones occur in tapes of Taylor coefficients only.
  ORDER,          // 1 where a > b, -1 where a < b, else NaN
  WHERE_POSITIVE, // b where a > 0, 0 where a < 0, else NaN
  WHERE_NEGATIVE, // b where a < 0, 0 where a > 0, else NaN
  REMAINDER_JUMP  // NaN where fmod jumps, whose first argument is a and whose value is b, else 0
};

/// The instruction computes result = opcode(a, b, constant). Operands 0, 1, 2 are x, y, z; operand 3 + s is slot s. A
/// unary instruction has a == b; `constant` also holds an integer exponent. The result is never the slot of an operand,
/// so that loops over blocks of points may assume that reads and writes do not overlap.
struct Instruction {
  Opcode opcode;
  std::uint32_t result, a, b;
  double constant;
};

inline constexpr std::uint32_t number_of_variables = 3;

struct Tape {
  std::vector<Instruction> instructions;
  std::vector<std::uint32_t> results; ///< the operands that hold the results after the last instruction
  std::uint32_t number_of_slots = 0;
};

// The library defines these functions, which make tapes.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Parses a text as the constructor of Expression_3 does.
Tape parse_expression(std::string_view text, const std::map<std::string, double>& constants);

/// Whether there is an instruction that chooses an operand: min, max or abs.
bool has_choices(const Tape& tape);

/// Returns a shorter tape, if there is one, whose results in double have the same bits at the points of the box with
/// the given sides, as numbers and as jets of order 1.
std::optional<Tape> shorten_tape(const Tape& tape, const std::array<Interval, number_of_variables>& sides);

/// The tape whose results are the Taylor coefficients of total order 4, in the order of the monomials.
Tape taylor_tape(const Tape& tape);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

/// The tape of the Taylor coefficients, which is made when it is needed first: most expressions never need it.
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
