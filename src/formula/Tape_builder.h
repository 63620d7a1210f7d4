// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the tape of an expression: shares equal subexpressions, drops unused nodes, and assigns slots.
#ifndef EQUIAFFINE_SRC_FORMULA_TAPE_BUILDER_H
#define EQUIAFFINE_SRC_FORMULA_TAPE_BUILDER_H

#include <equiaffine/base/internal/compiler.h>
#include <equiaffine/formula/internal/expression_evaluation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace equiaffine::internal::expression {

/// Allocates slots for intermediate results. The slot that was returned last is reused first.
class Slot_pool {
public:
  std::uint32_t take() {
    if (free_.empty()) return number_of_variables + number_of_slots_++;
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    return slot;
  }

  void give_back(std::uint32_t slot) { free_.push_back(slot); }

  std::uint32_t number_of_slots() const { return number_of_slots_; }

private:
  std::vector<std::uint32_t> free_;
  std::uint32_t number_of_slots_ = 0;
};

using Node = std::uint32_t; ///< nodes 0, 1, 2 are x, y, z; operands precede their users

/// The last readers of an unused node, and of a root.
inline constexpr Node no_reader = std::numeric_limits<Node>::max(), end_of_tape = no_reader - 1;

/// Returns the last node that reads each node: end_of_tape for a root, and no_reader for a node that no root depends
/// on.
inline std::vector<Node> last_readers(std::span<const Instruction> nodes, std::span<const Node> roots) {
  std::vector<Node> last_reader(nodes.size(), no_reader);
  for (const Node root : roots) last_reader[root] = end_of_tape;
  for (Node n = static_cast<Node>(nodes.size()) - 1; n >= number_of_variables; --n)
    if (last_reader[n] != no_reader && nodes[n].opcode != Opcode::CONSTANT)
      for (const Node operand : {nodes[n].a, nodes[n].b})
        if (last_reader[operand] == no_reader) last_reader[operand] = n;
  return last_reader;
}

/// Returns the tape that computes `roots`. The operands of `nodes` are nodes. Unused nodes are omitted, and the slot of
/// a node is reused after the last instruction that reads it.
inline Tape tape_of(std::span<const Instruction> nodes, std::span<const Node> roots) {
  const std::vector<Node> last_reader = last_readers(nodes, roots);
  std::vector<std::uint32_t> place(nodes.size()); // the operand that contains the value of a node
  for (std::uint32_t v = 0; v < number_of_variables; ++v) place[v] = v;
  Slot_pool slots;
  Tape tape;
  for (Node n = number_of_variables; n < nodes.size(); ++n) {
    if (last_reader[n] == no_reader) continue;
    Instruction i = nodes[n];
    i.result = place[n] = slots.take(); // before give_back(), since it must differ from the operands
    if (i.opcode != Opcode::CONSTANT) {
      const auto is_done = [&](Node operand) { return operand >= number_of_variables && last_reader[operand] == n; };
      if (is_done(i.a)) slots.give_back(place[i.a]);
      if (i.b != i.a && is_done(i.b)) slots.give_back(place[i.b]);
      i.a = place[i.a];
      i.b = place[i.b];
    }
    tape.instructions.push_back(i);
  }
  tape.number_of_slots = slots.number_of_slots();
  for (const Node root : roots) tape.results.push_back(place[root]);
  return tape;
}

/// Builds a tape bottom-up. Equal subexpressions become one node, and constant subexpressions one number. Only
/// identities that hold bit for bit in IEEE arithmetic are applied (up to the sign of a NaN), so that results are those
/// of the text.
class Tape_builder {
public:
  using Node = expression::Node;

  Tape_builder() : nodes_(number_of_variables, Instruction{Opcode::VARIABLE, 0, 0, 0, 0}) {}

  Node constant(double value) { return intern({Opcode::CONSTANT, 0, 0, 0, value}); }

  std::optional<double> value(Node a) const {
    return nodes_[a].opcode == Opcode::CONSTANT ? std::optional(nodes_[a].constant) : std::nullopt;
  }

  Node add(Node a, Node b) {
    if (value(a)) std::swap(a, b);
    return value(b) ? add_constant(a, *value(b)) : commutative(Opcode::ADD, a, b);
  }

  Node subtract(Node a, Node b) {
    if (value(b)) return add_constant(a, -*value(b));
    return value(a) ? node(Opcode::SUBTRACT_FROM_CONSTANT, b, b, *value(a)) : node(Opcode::SUBTRACT, a, b);
  }

  Node multiply(Node a, Node b) {
    if (a == b) return node(Opcode::SQUARE, a, a);
    if (value(a)) std::swap(a, b);
    return value(b) ? multiply_constant(a, *value(b)) : commutative(Opcode::MULTIPLY, a, b);
  }

  Node divide(Node a, Node b) {
    if (const auto c = value(b)) {
      int exponent = 0;
      const bool is_power_of_two = std::abs(std::frexp(*c, &exponent)) == 0.5 && std::isfinite(1 / *c);
      return is_power_of_two ? multiply_constant(a, 1 / *c) : node(Opcode::DIVIDE_BY_CONSTANT, a, a, *c);
    }
    return value(a) ? node(Opcode::DIVIDE_CONSTANT, b, b, *value(a)) : node(Opcode::DIVIDE, a, b);
  }

  Node negate(Node a) { return nodes_[a].opcode == Opcode::NEGATE ? nodes_[a].a : node(Opcode::NEGATE, a, a); }

  Node power(Node a, Node b) {
    if (const auto c = value(b)) {
      constexpr double largest_exponent = 1 << 30;
      if (std::abs(*c) <= largest_exponent && *c == std::trunc(*c)) return integer_power(a, static_cast<int>(*c));
      return *c == 0.5 ? node(Opcode::SQRT, a, a) : node(Opcode::POWER_CONSTANT, a, a, *c);
    }
    return value(a) == std::numbers::e ? node(Opcode::EXP, b, b) : node(Opcode::POWER, a, b);
  }

  /// The node of a function of two arguments, or of one (a == b).
  Node function(Opcode opcode, Node a, Node b) {
    if (a == b && (opcode == Opcode::MIN || opcode == Opcode::MAX)) return a;
    return opcode == Opcode::POWER ? power(a, b) : node(opcode, a, b);
  }

  /// The node of an instruction of another tape, with the operands `a` and `b`.
  Node repeat(const Instruction& i, Node a, Node b) {
    return i.opcode == Opcode::CONSTANT ? constant(i.constant) : node(i.opcode, a, b, i.constant);
  }

  Tape tape(std::span<const Node> roots) const { return tape_of(nodes_, roots); }

private:
  using Key = std::tuple<Opcode, Node, Node, std::uint64_t>;

  /// The node of an instruction, shared with earlier equal instructions.
  Node intern(const Instruction& i) {
    const Key key(i.opcode, i.a, i.b, bit_cast<std::uint64_t>(i.constant));
    const auto [position, is_new] = known_.try_emplace(key, static_cast<Node>(nodes_.size()));
    if (is_new) nodes_.push_back(i);
    return position->second;
  }

  /// The node of an instruction, or of its value if the operands are constants.
  Node node(Opcode opcode, Node a, Node b, double c = 0) {
    const Instruction instruction{opcode, 0, a, b, c};
    if (!value(a) || !value(b)) return intern(instruction);
    const double u = *value(a), v = *value(b);
    double result = 0;
    execute<1>(instruction, &u, &v, &result, 1);
    return constant(result);
  }

  /// Sorts the operands, so that a + b and b + a are one node.
  Node commutative(Opcode opcode, Node a, Node b) { return node(opcode, std::min(a, b), std::max(a, b)); }

  /// Only -0 is neutral in additions: for x = -0, x + 0 is +0.
  Node add_constant(Node a, double c) { return c == 0 && std::signbit(c) ? a : node(Opcode::ADD_CONSTANT, a, a, c); }

  Node multiply_constant(Node a, double c) { return c == 1 ? a : node(Opcode::MULTIPLY_CONSTANT, a, a, c); }

  Node integer_power(Node a, int n) {
    if (n < 0) return divide(constant(1), integer_power(a, -n));
    if (n == 0) return constant(1);
    if (n == 1) return a;
    if (n % 2 == 0 && nodes_[a].opcode == Opcode::ABS) a = nodes_[a].a; // smooth at 0, with the same value
    return n == 2 ? node(Opcode::SQUARE, a, a) : node(Opcode::INTEGER_POWER, a, a, n);
  }

  std::vector<Instruction> nodes_;
  std::map<Key, Node> known_;
};

} // namespace equiaffine::internal::expression

#endif
