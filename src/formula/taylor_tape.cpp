// SPDX-License-Identifier: GPL-3.0-or-later
// Builds a tape that computes the Taylor coefficients of an expression. The expression is evaluated once on jets of
// symbols, which omits coefficients that are zero by structure and shares equal ones, like compile-time sparsity for
// functions given as code.
#include "formula/Tape_builder.h"
#include <equiaffine/formula/internal/expression_evaluation.h>
#include <equiaffine/formula/internal/expression_tape.h>
#include <equiaffine/number/Jet_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal::expression {

/// A number type that computes with constants and records everything else as nodes of a builder. Zero and one act as in
/// exact arithmetic: 0 * a is 0 for any value of a. Not in an unnamed namespace: there GCC 12 merges functions of jets
/// with different supports if their code is equal, and then warns that they read out of bounds.
class Symbol {
public:
  using Node = Tape_builder::Node;

  Symbol() = default;
  Symbol(double value) : value_(value) {}
  Symbol(Tape_builder& builder, Node node) {
    if (const auto constant = builder.value(node)) {
      value_ = *constant;
    } else {
      builder_ = &builder;
      node_ = node;
    }
  }

  Node node(Tape_builder& builder) const { return builder_ ? node_ : builder.constant(value_); }

  /// Whether both are the same constant or the same node.
  friend bool operator==(const Symbol& a, const Symbol& b) {
    return a.builder_ == b.builder_ && (a.builder_ ? a.node_ == b.node_ : a.value_ == b.value_);
  }

  Symbol operator-() const { return builder_ ? Symbol(*builder_, builder_->negate(node_)) : Symbol(-value_); }
  friend Symbol operator+(const Symbol& a, const Symbol& b) {
    if (a.is_constant(0)) return b;
    if (b.is_constant(0)) return a;
    return combine(a, b, [](Tape_builder& builder, Node u, Node v) { return builder.add(u, v); });
  }
  friend Symbol operator-(const Symbol& a, const Symbol& b) {
    if (a.is_constant(0)) return -b;
    if (b.is_constant(0)) return a;
    return combine(a, b, [](Tape_builder& builder, Node u, Node v) { return builder.subtract(u, v); });
  }
  friend Symbol operator*(const Symbol& a, const Symbol& b) {
    if (a.is_constant(0) || b.is_constant(1)) return a;
    if (b.is_constant(0) || a.is_constant(1)) return b;
    if (a.is_constant(-1)) return -b;
    if (b.is_constant(-1)) return -a;
    return combine(a, b, [](Tape_builder& builder, Node u, Node v) { return builder.multiply(u, v); });
  }
  friend Symbol operator/(const Symbol& a, const Symbol& b) {
    if (a.is_constant(0) || b.is_constant(1)) return a;
    return combine(a, b, [](Tape_builder& builder, Node u, Node v) { return builder.divide(u, v); });
  }

#define EQUIAFFINE_SYMBOL_FUNCTION(name, opcode)                                                                       \
  friend Symbol name(const Symbol& a) { return apply(Opcode::opcode, a, a); }
  EQUIAFFINE_SYMBOL_FUNCTION(abs, ABS)
  EQUIAFFINE_SYMBOL_FUNCTION(sqrt, SQRT)
  EQUIAFFINE_SYMBOL_FUNCTION(cbrt, CBRT)
  EQUIAFFINE_SYMBOL_FUNCTION(exp, EXP)
  EQUIAFFINE_SYMBOL_FUNCTION(log, LOG)
  EQUIAFFINE_SYMBOL_FUNCTION(sin, SIN)
  EQUIAFFINE_SYMBOL_FUNCTION(cos, COS)
  EQUIAFFINE_SYMBOL_FUNCTION(tan, TAN)
  EQUIAFFINE_SYMBOL_FUNCTION(asin, ASIN)
  EQUIAFFINE_SYMBOL_FUNCTION(acos, ACOS)
  EQUIAFFINE_SYMBOL_FUNCTION(atan, ATAN)
  EQUIAFFINE_SYMBOL_FUNCTION(sinh, SINH)
  EQUIAFFINE_SYMBOL_FUNCTION(cosh, COSH)
  EQUIAFFINE_SYMBOL_FUNCTION(tanh, TANH)
#undef EQUIAFFINE_SYMBOL_FUNCTION
  friend Symbol atan2(const Symbol& a, const Symbol& b) { return apply(Opcode::ATAN2, a, b); }
  friend Symbol erf(const Symbol& a) { return apply(Opcode::ERF, a, a); }
  friend Symbol floor(const Symbol& a) { return apply(Opcode::FLOOR, a, a); }
  friend Symbol sign(const Symbol& a) { return apply(Opcode::SIGN, a, a); }
  friend Symbol fmod(const Symbol& a, const Symbol& b) { return apply(Opcode::FMOD, a, b); }
  friend Symbol jump_of_remainder(const Symbol& a, const Symbol&, const Symbol& r) {
    return apply(Opcode::REMAINDER_JUMP, a, r);
  }
  friend Symbol hypot(const Symbol& a, const Symbol& b) { return apply(Opcode::HYPOT, a, b); }
  friend Symbol pow(const Symbol& a, const Symbol& b) { return apply(Opcode::POWER, a, b); }

  friend Symbol natural_power(const Symbol& a, unsigned n) { return apply(Opcode::POWER, a, double(n)); }

  /// Chooses between the coefficients a and b by the order of u and v, like number/select.h for ordered numbers, but at
  /// run time. Not used for coefficient 0; see taylor_tape().
  friend Symbol branch_or_kink(const Symbol& u, const Symbol& v, const Symbol& a, const Symbol& b, int) {
    if (a.is_constant(0) && b.is_constant(0)) return a;
    const Symbol order = apply(Opcode::ORDER, u, v);
    if (b.is_constant(0)) return apply(Opcode::WHERE_POSITIVE, order, a);
    if (a.is_constant(0)) return apply(Opcode::WHERE_NEGATIVE, order, b);
    return apply(Opcode::WHERE_POSITIVE, order, a) + apply(Opcode::WHERE_NEGATIVE, order, b);
  }

private:
  bool is_constant(double constant) const { return !builder_ && value_ == constant; }

  /// The operation on the nodes of a and b. Two constants have no builder; a temporary one evaluates them.
  template <class Operation>
  static Symbol combine(const Symbol& a, const Symbol& b, Operation operation) {
    Tape_builder temporary;
    Tape_builder& builder = a.builder_ ? *a.builder_ : b.builder_ ? *b.builder_ : temporary;
    return {builder, operation(builder, a.node(builder), b.node(builder))};
  }

  static Symbol apply(Opcode opcode, const Symbol& a, const Symbol& b) {
    return combine(a, b, [&](Tape_builder& builder, Node u, Node v) { return builder.function(opcode, u, v); });
  }

  Tape_builder* builder_ = nullptr; ///< the builder that has the node; null for a constant
  Node node_ = 0;
  double value_ = 0;
};

Tape taylor_tape(const Tape& tape) {
  using Jet = Jet_3<Symbol>;
  Tape_builder builder;
  std::vector<Jet> jets(number_of_variables + tape.number_of_slots);
  for (std::uint32_t axis = 0; axis < number_of_variables; ++axis)
    jets[axis] = Jet::variable(int(axis), Symbol(builder, axis));
  for (const Instruction& i : tape.instructions) {
    execute<1>(i, &jets[i.a], &jets[i.b], &jets[i.result], 1);
    // The instruction itself computes coefficient 0, so that it equals the value of the expression bit for bit.
    const auto value = [&](std::uint32_t place) { return jets[place].value().node(builder); };
    jets[i.result].coefficients()[0] = Symbol(builder, builder.repeat(i, value(i.a), value(i.b)));
  }
  std::vector<Tape_builder::Node> roots;
  for (const Symbol& c : jets[tape.results.front()].coefficients()) roots.push_back(c.node(builder));
  return builder.tape(roots);
}

} // namespace equiaffine::internal::expression
