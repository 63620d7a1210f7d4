// SPDX-License-Identifier: GPL-3.0-or-later
// Expression_3, a function of x, y, z given as text at run time, and the error of a name that it does not know.
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

// A program catches what the shared library throws.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// The error of an expression with a name that is neither a variable nor among the constants. Who has a value for it,
/// or a slider, can parse the text again with that constant.
class Unknown_name_error : public Input_error {
public:
  /// Makes an error of two texts, as Input_error, and the name.
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

/// A function of x, y, z given as text at run time, callable on any number type.
///
///     const Expression_3 f("(x^2 + y^2 + z^2 + R^2 - r^2)^2 = 4*R^2*(x^2 + y^2)", {{"R", 2.0}, {"r", 0.5}});
///     const double value = f(2.5, 0.0, 0.0);                                       // 0: a point of the torus
///     using Jet = Jet_3<double>;
///     const Jet taylor = f(Jet::variable(0, 2.5), Jet::variable(1, 0.0), Jet::variable(2, 0.0));
///
/// Grammar (white space is free; `[]` optional, `{}` repeated, quotes around characters):
///
///     equation = sum ["=" sum]                          lhs = rhs is the function lhs - rhs
///     sum      = product {("+" | "-") product}
///     product  = factor {("*" | "/") factor}
///     factor   = {"+" | "-"} power                      -x^2 is -(x^2)
///     power    = primary ["^" factor]                   2^3^2 is 2^(3^2), 2^-1 is 1/2
///     primary  = number | name | function "(" sum {"," sum} ")" | "(" sum ")"
///
/// Numbers are written as 2, .5 or 1e-3, whatever the locale. Names are x, y, z, pi, e and those of `constants`.
/// Functions of one argument: sqrt cbrt exp log (natural) sin cos tan asin acos atan sinh cosh tanh abs erf floor sign;
/// of two: atan2(y, x) hypot pow fmod; of two or more: min max. Angles are in radians. Nesting is limited to 1000
/// levels.
///
/// Numbers, constants and what is computed from them alone are rounded to double for every number type, so that all
/// types evaluate the same function. For double, operators and functions are those of the language and of `<cmath>`,
/// except that exp, sin and cos are the library's own, that an integer exponent (up to 2^30 in
/// magnitude) means repeated multiplication and `^0.5` means sqrt, and that min and max are NaN when an argument is.
/// Domain errors (log(-1), 0/0) give what T gives: NaN for double.
///
/// A number type T is regular, constructible from double and has + - * / and unary -; the functions above are found by
/// argument-dependent lookup. Those with substitutes: hypot, min, max and sign (`<` and `!=` decide), pow
/// (exp(b * log(a)), and products for integer exponents). T may have no erf, floor and fmod, and an expression that
/// needs them throws std::domain_error then. Used where they exist: square(T), pow(T, double), pow(T, int), and the
/// four operators with a double on either side.
///
/// Equal subexpressions are evaluated once. Evaluation costs one instruction per remaining operation. It takes no
/// memory on the heap if T is trivially default constructible and 32 slots for intermediate results are enough. Calls
/// from several threads are safe. The library has what parses the text, so that a program links to it.
class Expression_3 {
public:
  /// Parses n characters in O(n log n). Throws Input_error, with the column in what() and a caret under it in
  /// excerpt(), for a text outside the grammar and for a constant subexpression that is not finite: an
  /// Unknown_name_error for a name that is neither a variable nor among `constants`; also Input_error for an entry
  /// of `constants` that is not finite or whose name is not an identifier or has a meaning already.
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

  /// Sets out[i] to the value at (x[i], y[i], z[i]), bit for bit that of the single call. The spans have equal sizes;
  /// `out` may be one of the others but must not overlap them otherwise.
  template <class T>
  void operator()(std::span<const T> x, std::span<const T> y, std::span<const T> z, std::span<T> out) const {
    CGAL_precondition(x.size() == out.size() && y.size() == out.size() && z.size() == out.size());
    const auto store = [&](auto& slots, std::size_t first, std::size_t count) {
      std::copy_n(slots.result(), count, &out[first]);
    };
    internal::expression::run_in_blocks<internal::expression::block_size<T>>(tape_, x, y, z, store);
  }

  /// The Taylor polynomial at (x, y, z), for a floating-point type or a Pack. It is that of the call on jets but for
  /// rounding, computed by a tape of its own that leaves out what the structure of the expression makes zero: what does
  /// not depend on x, y, z has no derivatives, whatever its value, where jets can have NaN, as of sqrt(x-x).
  template <internal::expression::Ordered T>
  Jet_3<T> taylor(const T& x, const T& y, const T& z) const {
    Jet_3<T> jet;
    expand_in_blocks<1>(std::span(&x, 1), std::span(&y, 1), std::span(&z, 1), std::span(&jet, 1));
    return jet;
  }

  /// Sets out[i] to the Taylor polynomial at (x[i], y[i], z[i]), bit for bit that of the single call. The spans have
  /// equal sizes.
  template <internal::expression::Ordered T>
  void taylor(std::span<const T> x, std::span<const T> y, std::span<const T> z, std::span<Jet_3<T>> out) const {
    CGAL_precondition(x.size() == out.size() && y.size() == out.size() && z.size() == out.size());
    expand_in_blocks<internal::expression::block_size<T>>(x, y, z, out);
  }

  /// Returns the expression without the operands of min, max and abs that are not chosen anywhere in a box, if there
  /// are some and the expression is so long that this saves time. In the box it has the same values and expansions of
  /// order 1 in double, bit for bit; those of taylor() agree to rounding where both exist.
  std::optional<Expression_3> restricted(const Interval& x, const Interval& y, const Interval& z) const {
    constexpr std::size_t worth_it = 24; // a shorter tape takes less time than it takes to shorten it
    if (!has_choices_ || tape_.instructions.size() < worth_it) return std::nullopt;
    auto tape = internal::expression::shorten_tape(tape_, {x, y, z});
    return tape ? std::optional(Expression_3(text_, *std::move(tape))) : std::nullopt;
  }

  /// The text that the constructor parsed.
  const std::string& text() const { return *text_; }

  /// The number of operations per evaluation, after sharing equal subexpressions and folding constants; 0 for a lone
  /// variable.
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

  std::shared_ptr<const std::string> text_; ///< is shared by copies
  internal::expression::Tape tape_;
  bool has_choices_;
  /// Copies are equal and share it.
  std::shared_ptr<internal::expression::Lazy_taylor_tape> taylor_ =
      std::make_shared<internal::expression::Lazy_taylor_tape>();
};

} // namespace equiaffine

#endif
