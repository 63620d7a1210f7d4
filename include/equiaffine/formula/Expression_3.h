// SPDX-License-Identifier: GPL-3.0-or-later
// Expression_3, a function of x, y, z given as text at run time, and the exception for unknown names in it.
#ifndef EQUIAFFINE_FORMULA_EXPRESSION_3_H
#define EQUIAFFINE_FORMULA_EXPRESSION_3_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/formula/internal/expression_evaluation.h>
#include <equiaffine/formula/internal/expression_tape.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

// Programs must be able to catch what the shared library throws.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// Thrown if an expression contains a name that is neither a variable nor one of the constants. To recover, parse the
/// text again with a value for this name.
class Unknown_name_error : public Input_error {
public:
  /// Creates an error from its message, excerpt and name.
  Unknown_name_error(const std::string& what, std::string excerpt, std::string name)
      : Input_error(what, std::move(excerpt)), name_(std::move(name)) {}

  const std::string& name() const { return name_; } ///< the unknown name

private:
  std::string name_;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine {

/// A function of x, y, z given as text at run time. It can be called with any number type.
///
///     const Expression_3 f("(x^2 + y^2 + z^2 + R^2 - r^2)^2 = 4*R^2*(x^2 + y^2)", {{"R", 2.0}, {"r", 0.5}});
///     const double value = f(2.5, 0.0, 0.0);                                       // 0: a point of the torus
///     using Jet = Jet_3<double>;
///     const Jet taylor = f(Jet::variable(0, 2.5), Jet::variable(1, 0.0), Jet::variable(2, 0.0));
///
/// Grammar (white space is ignored; `[]` optional, `{}` repeated, quotes around characters):
///
///     equation = sum ["=" sum]                          lhs = rhs is the function lhs - rhs
///     sum      = product {("+" | "-") product}
///     product  = factor {("*" | "/") factor}
///     factor   = {"+" | "-"} power                      -x^2 is -(x^2)
///     power    = primary ["^" factor]                   2^3^2 is 2^(3^2), 2^-1 is 1/2
///     primary  = number | name | function "(" sum {"," sum} ")" | "(" sum ")"
///
/// Numbers are written as 2, .5 or 1e-3, independent of the locale. Names are x, y, z, pi, e and those of `constants`.
/// Functions of one argument: sqrt cbrt exp log (natural) sin cos tan asin acos atan sinh cosh tanh abs erf floor sign;
/// of two: atan2(y, x) hypot pow fmod; of two or more: min max. Angles are in radians. Nesting is limited to 1000
/// levels.
///
/// Numbers, constants and constant subexpressions are rounded to double, so that all number types evaluate the same
/// function. For double, operators are those of C++ and functions are those of `<cmath>`, with these exceptions: exp,
/// sin and cos are the library's own; integer exponents (magnitude up to 2^30) mean repeated multiplication, and `^0.5`
/// means sqrt; min and max are NaN if an argument is NaN. Domain errors (log(-1), 0/0) give what T gives: NaN for
/// double.
///
/// A number type T must be regular, constructible from double, and have + - * / and unary -. The functions above are
/// found by argument-dependent lookup. Without its own, T uses substitutes for hypot, min, max and sign (by `<` and
/// `!=`) and for pow (exp(b * log(a)), and products for integer exponents). Without erf, floor or fmod, expressions
/// that need them throw std::domain_error. Used if they exist: square(T), pow(T, double), pow(T, int), and the four
/// operators with a double on either side.
///
/// Equal subexpressions are evaluated once. Evaluation costs one instruction per remaining operation. It does not
/// allocate memory if T is trivially default constructible and 32 slots are enough for intermediate results. Calls are
/// thread-safe. The parser is in the compiled library; link to it.
class Expression_3 {
public:
  /// Parses n characters in O(n log n). \throw Input_error for a text outside the grammar or a constant subexpression
  /// that is not finite, with the column in what() and a caret below it in excerpt(). \throw Unknown_name_error, which
  /// is an Input_error, for a name that is neither a variable nor among `constants`. \throw Input_error if a value in
  /// `constants` is not finite, or its name is not an identifier or is reserved
  explicit Expression_3(std::string_view text, const std::map<std::string, double>& constants = {})
      : Expression_3(std::make_shared<const std::string>(text),
                     internal::expression::parse_expression(text, constants)) {}

  /// The value at (x, y, z).
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    internal::expression::Slots<1, T> slots(tape_);
    slots.run({&x, &y, &z}, 1);
    return *slots.result();
  }

  /// Sets out[i] to the value at (x[i], y[i], z[i]), bit for bit equal to a single call. The spans have equal sizes;
  /// `out` may be the same span as another, but must not overlap it partially.
  template <class T>
  void operator()(std::span<const T> x, std::span<const T> y, std::span<const T> z, std::span<T> out) const {
    CGAL_precondition(x.size() == out.size() && y.size() == out.size() && z.size() == out.size());
    const auto store = [&](auto& slots, std::size_t first, std::size_t count) {
      std::copy_n(slots.result(), count, &out[first]);
    };
    internal::expression::run_in_blocks<internal::expression::block_size<T>>(tape_, x, y, z, store);
  }

  /// The Taylor polynomial at (x, y, z), for a floating-point type or a Pack. Equals a call with jets up to rounding.
  /// It is computed by a separate tape that omits what is zero by the structure of the expression: subexpressions that
  /// do not depend on x, y, z have no derivatives, whatever their value. Jets can yield NaN there, for example for
  /// sqrt(x-x).
  template <internal::expression::Ordered T>
  Jet_3<T> taylor(const T& x, const T& y, const T& z) const {
    Jet_3<T> jet;
    expand_in_blocks<1>(std::span(&x, 1), std::span(&y, 1), std::span(&z, 1), std::span(&jet, 1));
    return jet;
  }

  /// Sets out[i] to the Taylor polynomial at (x[i], y[i], z[i]), bit for bit equal to a single call. The spans have
  /// equal sizes.
  template <internal::expression::Ordered T>
  void taylor(std::span<const T> x, std::span<const T> y, std::span<const T> z, std::span<Jet_3<T>> out) const {
    CGAL_precondition(x.size() == out.size() && y.size() == out.size() && z.size() == out.size());
    expand_in_blocks<internal::expression::block_size<T>>(x, y, z, out);
  }

  /// Returns the expression without the operands of min, max and abs that are never chosen in a box, if there are any
  /// and the expression is long enough for this to save time. In the box it has the same values and expansions of order
  /// 1 in double, bit for bit; results of taylor() agree up to rounding where both exist.
  std::optional<Expression_3> restricted(const Interval& x, const Interval& y, const Interval& z) const {
    constexpr std::size_t worth_it = 24; // evaluating a shorter tape is faster than shortening it
    if (!has_choices_ || tape_.instructions.size() < worth_it) return std::nullopt;
    auto tape = internal::expression::shorten_tape(tape_, {x, y, z});
    return tape ? std::optional(Expression_3(text_, *std::move(tape))) : std::nullopt;
  }

  /// The text that the constructor parsed.
  const std::string& text() const { return *text_; }

  /// The number of operations per evaluation, after sharing equal subexpressions and folding constants; 0 if the
  /// expression is a variable.
  std::size_t number_of_instructions() const { return tape_.instructions.size(); }

private:
  Expression_3(std::shared_ptr<const std::string> text, internal::expression::Tape tape)
      : text_(std::move(text)), tape_(std::move(tape)), has_choices_(internal::expression::has_choices(tape_)) {}

  template <std::size_t Block, class T>
  void expand_in_blocks(std::span<const T> x, std::span<const T> y, std::span<const T> z,
                        std::span<Jet_3<T>> out) const {
    const auto store = [&](auto& slots, std::size_t first, std::size_t count) {
      for (std::size_t n = 0; n < Jet_3<T>::size; ++n) {
        const T* const coefficients = slots.result(n);
        for (std::size_t i = 0; i < count; ++i) out[first + i].coefficients()[n] = coefficients[i];
      }
    };
    internal::expression::run_in_blocks<Block>(taylor_->get(tape_), x, y, z, store);
  }

  std::shared_ptr<const std::string> text_; ///< shared by copies
  internal::expression::Tape tape_;
  bool has_choices_;
  /// Shared by copies.
  std::shared_ptr<internal::expression::Lazy_taylor_tape> taylor_ =
      std::make_shared<internal::expression::Lazy_taylor_tape>();
};

} // namespace equiaffine

#endif
