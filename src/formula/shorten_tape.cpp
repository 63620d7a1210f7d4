// SPDX-License-Identifier: GPL-3.0-or-later
// Shortens a tape for a box (Keeter: Massively parallel rendering of complex closed-form implicit surfaces, 2020,
// section 3.2): if intervals determine which operand min, max or abs returns, the others are not needed.
#include "formula/Tape_builder.h"
#include <equiaffine/formula/internal/expression_evaluation.h>
#include <equiaffine/formula/internal/expression_tape.h>
#include <equiaffine/number/Interval.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal::expression {

namespace {

bool is_choice(const Instruction& i) {
  return i.opcode == Opcode::MIN || i.opcode == Opcode::MAX || i.opcode == Opcode::ABS;
}

/// Properties of an operand on a box: the node that computes it, the interval of its values, and whether it has a
/// moderate value everywhere. The interval does not cover points where the operand is undefined.
struct Operand_on_box {
  std::uint32_t node = 0;
  Interval values;
  bool is_total = false;
};

/// Whether no way to compute a function of these values overflows: jets use reciprocals for quotients, and squares for
/// lengths.
bool is_moderate(const Interval& values) { return values.lower() > -1e150 && values.upper() < 1e150; }

/// Whether an instruction has a moderate value on the whole box if its operands do.
bool is_total(const Instruction& i, const Interval& a, const Interval& b, const Interval& result) {
  if (!is_moderate(result)) return false;
  switch (i.opcode) {
  case Opcode::SQRT: return a.lower() >= 0;
  case Opcode::LOG:
  case Opcode::POWER_CONSTANT:
  case Opcode::POWER: return a.lower() > 1e-150;
  case Opcode::ASIN:
  case Opcode::ACOS: return a.lower() >= -1 && a.upper() <= 1;
  case Opcode::ATAN2: return !a.contains(0) || b.lower() > 0; // since atan2(-0, -1) is not atan2(0, -1)
  case Opcode::FMOD: return !b.contains(0);
  case Opcode::DIVIDE: return is_moderate(Interval(1.0) / b);
  case Opcode::DIVIDE_CONSTANT: return is_moderate(Interval(1.0) / a);
  case Opcode::DIVIDE_BY_CONSTANT: return std::abs(i.constant) > 1e-150;
  default: return true;
  }
}

/// Returns the maximal number of rounding errors beyond those in the interval of an instruction: an integer power is a
/// product of many factors, and jets compute some functions from others.
double further_roundings(const Instruction& i) {
  switch (i.opcode) {
  case Opcode::INTEGER_POWER: return i.constant;
  case Opcode::POWER:
  case Opcode::POWER_CONSTANT:
  case Opcode::HYPOT:
  case Opcode::DIVIDE:
  case Opcode::DIVIDE_CONSTANT:
  case Opcode::DIVIDE_BY_CONSTANT: return 8;
  default: return 0;
  }
}

/// Returns an interval that contains the values of an instruction, for numbers and for jets.
Interval values_on_box(const Instruction& i, const Interval& a, const Interval& b) {
  Interval result;
  execute<1>(i, &a, &b, &result, 1);
  using Limits = std::numeric_limits<double>;
  const double largest = std::max(std::abs(result.lower()), std::abs(result.upper()));
  const double roundings = further_roundings(i);
  if (roundings == 0) return result;
  const double rounding = roundings * (Limits::epsilon() * largest + Limits::min());
  const double least = result.lower() < 0 ? -Limits::infinity() : 0; // rounding does not change a sign
  return Interval(std::max(result.lower() - rounding, least), result.upper() + rounding);
}

/// Returns the operand that min, max or abs returns at every point of the box, if it is always the same. Both operands
/// must have moderate values everywhere: min and max are NaN where an operand is, and intervals do not represent signed
/// infinities.
std::optional<std::uint32_t> decided(const Instruction& i, const Operand_on_box& a, const Operand_on_box& b) {
  if (!a.is_total || !b.is_total) return std::nullopt;
  if (i.opcode == Opcode::ABS) return a.values.lower() > 0 ? std::optional(a.node) : std::nullopt;
  const bool is_a_less = a.values.upper() < b.values.lower(), is_b_less = b.values.upper() < a.values.lower();
  if (!is_a_less && !is_b_less) return std::nullopt;
  return is_a_less == (i.opcode == Opcode::MIN) ? a.node : b.node;
}

} // namespace

bool has_choices(const Tape& tape) {
  return std::any_of(tape.instructions.begin(), tape.instructions.end(), is_choice);
}

std::optional<Tape> shorten_tape(const Tape& tape, const std::array<Interval, number_of_variables>& sides) {
  std::vector<Operand_on_box> operands(number_of_variables + tape.number_of_slots);
  std::vector<Instruction> nodes(number_of_variables, Instruction{Opcode::VARIABLE, 0, 0, 0, 0});
  for (std::uint32_t v = 0; v < number_of_variables; ++v) operands[v] = {v, sides[v], is_moderate(sides[v])};
  bool is_shorter = false;
  for (const Instruction& i : tape.instructions) {
    const Operand_on_box &a = operands[i.a], &b = operands[i.b];
    Operand_on_box result;
    result.values = values_on_box(i, a.values, b.values);
    const bool has_operands = i.opcode != Opcode::CONSTANT;
    result.is_total = (!has_operands || (a.is_total && b.is_total)) && is_total(i, a.values, b.values, result.values);
    const auto operand = is_choice(i) ? decided(i, a, b) : std::nullopt;
    is_shorter |= operand.has_value();
    result.node = operand ? *operand : static_cast<std::uint32_t>(nodes.size());
    if (!operand) nodes.push_back({i.opcode, 0, has_operands ? a.node : 0, has_operands ? b.node : 0, i.constant});
    operands[i.result] = std::move(result);
  }
  if (!is_shorter) return std::nullopt;
  std::vector<std::uint32_t> roots;
  for (const std::uint32_t place : tape.results) roots.push_back(operands[place].node);
  return tape_of(nodes, roots);
}

} // namespace equiaffine::internal::expression
