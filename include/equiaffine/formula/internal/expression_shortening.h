// SPDX-License-Identifier: GPL-3.0-or-later
// Shortens a tape for a box, as Keeter does (Massively parallel rendering of complex closed-form implicit surfaces,
// 2020, section 3.2): where intervals decide which operand min, max or abs returns, the others are not needed.
#ifndef EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_SHORTENING_H
#define EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_SHORTENING_H

#include <equiaffine/formula/internal/expression_tape_builder.h>
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

inline bool is_choice(const Instruction& i) {
  return i.opcode == Opcode::MIN || i.opcode == Opcode::MAX || i.opcode == Opcode::ABS;
}

/// What is known of an operand on a box: the node that computes it, the interval of its values, and whether it has a
/// value everywhere. The interval says nothing of the points where the operand is NaN.
struct Operand_on_box {
  std::uint32_t node = 0;
  Interval values;
  bool is_total = false;
};

/// Whether an instruction has a finite value on all of a box if its operands have one.
inline bool is_total(const Instruction& i, const Interval& a, const Interval& b, const Interval& result) {
  if (!std::isfinite(result.lower()) || !std::isfinite(result.upper())) return false;
  switch (i.opcode) {
  case Opcode::SQRT: return a.lower() >= 0;
  case Opcode::LOG:
  case Opcode::POWER_CONSTANT:
  case Opcode::POWER: return a.lower() > 0;
  case Opcode::ASIN:
  case Opcode::ACOS: return a.lower() >= -1 && a.upper() <= 1;
  case Opcode::DIVIDE: return !b.contains(0);
  case Opcode::DIVIDE_CONSTANT: return !a.contains(0);
  case Opcode::DIVIDE_BY_CONSTANT: return i.constant != 0;
  default: return true;
  }
}

/// Returns the interval of an instruction. A whole power is a product of many factors in double, whose rounding the
/// interval of the power does not follow.
inline Interval values_on_box(const Instruction& i, const Interval& a, const Interval& b) {
  Interval result;
  execute<1>(i, &a, &b, &result, 1);
  if (i.opcode != Opcode::INTEGER_POWER) return result;
  using Limits = std::numeric_limits<double>;
  const double largest = std::max(std::abs(result.lower()), std::abs(result.upper()));
  const double rounding = i.constant * (Limits::epsilon() * largest + Limits::min());
  const double least = result.lower() < 0 ? -Limits::infinity() : 0; // rounding does not change a sign
  return Interval(std::max(result.lower() - rounding, least), result.upper() + rounding);
}

/// Returns the operand that a choice returns at every point of the box, if it is always the same. The operand that it
/// does not return must have a value everywhere, as min and max are NaN where one of them is.
inline std::optional<std::uint32_t> decided(const Instruction& i, const Operand_on_box& a, const Operand_on_box& b) {
  if (i.opcode == Opcode::ABS) return a.values.lower() > 0 ? std::optional(a.node) : std::nullopt;
  const bool is_a_less = a.values.upper() < b.values.lower(), is_b_less = b.values.upper() < a.values.lower();
  if (!is_a_less && !is_b_less) return std::nullopt;
  const bool returns_a = is_a_less == (i.opcode == Opcode::MIN);
  if (!(returns_a ? b : a).is_total) return std::nullopt;
  return (returns_a ? a : b).node;
}

/// Returns a shorter tape whose results have the same bits at the points of the box with the given sides, computed in
/// double, if there is one.
inline std::optional<Tape> shortened(const Tape& tape, const std::array<Interval, number_of_variables>& sides) {
  std::vector<Operand_on_box> operands(number_of_variables + tape.number_of_slots);
  std::vector<Instruction> nodes(number_of_variables, Instruction{Opcode::VARIABLE, 0, 0, 0, 0});
  for (std::uint32_t v = 0; v < number_of_variables; ++v) operands[v] = {v, sides[v], true};
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

#endif
