// SPDX-License-Identifier: GPL-3.0-or-later
#include "formula/Tape_builder.h"
#include "formula/expression_words.h"
#include <equiaffine/base/internal/from_chars.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/internal/expression_tape.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace equiaffine::internal::expression {

namespace {

/// Parses the grammar in Expression_3.h by recursive descent, with one function per rule.
class Parser {
public:
  using Constants = std::map<std::string, double>;

  Parser(std::string_view text, const Constants& constants) : text_(text), constants_(constants) {}

  Tape parse() {
    if (peek() == '\0' && at_end())
      fail(0, "nothing to evaluate", "write a function of x, y, z such as x^2 + y^2 + z^2 - 1");
    Node root = sum();
    if (peek() == '=') {
      equation_sign_ = position_++;
      root = builder_.subtract(root, sum());
      check_finite(root, "=", equation_sign_);
    }
    if (peek() != '\0' || !at_end()) fail_after_operand();
    return builder_.tape({&root, 1});
  }

private:
  using Node = Tape_builder::Node;
  static constexpr std::size_t NONE = std::string_view::npos;

  Node sum() {
    Node left = product();
    for (char sign = peek(); sign == '+' || sign == '-'; sign = peek()) {
      const std::size_t column = position_++;
      const Node right = product();
      left = sign == '+' ? builder_.add(left, right) : builder_.subtract(left, right);
      check_finite(left, text_.substr(column, 1), column);
    }
    return left;
  }

  Node product() {
    Node left = factor();
    for (char sign = peek(); sign == '*' || sign == '/'; sign = peek()) {
      const std::size_t column = position_++;
      if (text_.substr(column, 2) == "**") fail(column, "unknown operator '**'", "use ^ for powers");
      const Node right = factor();
      left = sign == '*' ? builder_.multiply(left, right) : builder_.divide(left, right);
      check_finite(left, text_.substr(column, 1), column);
    }
    return left;
  }

  /// Every nesting of parentheses, arguments and exponents calls this, so it limits the depth of the stack.
  Node factor() {
    bool is_negative = false;
    for (char sign = peek(); sign == '+' || sign == '-'; sign = peek()) {
      is_negative ^= sign == '-';
      ++position_;
    }
    if (++depth_ > maximal_depth)
      fail(position_, "too deep nesting", concatenated({"use at most ", std::to_string(maximal_depth), " levels"}));
    const Node result = power();
    --depth_;
    return is_negative ? builder_.negate(result) : result;
  }

  Node power() {
    const Node base = primary();
    if (peek() != '^') return base;
    const std::size_t column = position_++;
    const Node result = builder_.power(base, factor());
    check_finite(result, "^", column);
    return result;
  }

  Node primary() {
    const char c = peek();
    if (is_digit(c) || c == '.') return number();
    if (is_letter(c)) return name();
    if (c != '(') fail_before_operand();
    const std::size_t opening = position_++;
    const Node result = sum();
    close(opening);
    return result;
  }

  Node number() {
    double value = 0;
    const char* const first = text_.data() + position_;
    const auto [last, error] = from_chars(first, text_.data() + text_.size(), value);
    if (error == std::errc::invalid_argument)
      fail(position_, "decimal point without digits", "write a number such as 0.5");
    token_ = text_.substr(position_, static_cast<std::size_t>(last - first));
    if (error == std::errc::result_out_of_range)
      fail(position_, concatenated({"number ", in_quotes(token_), " out of range"}),
           "use a magnitude from 1e-307 to 1e308");
    position_ += token_.size();
    return builder_.constant(value);
  }

  Node name() {
    const std::size_t start = position_;
    while (!at_end() && (is_letter(text_[position_]) || is_digit(text_[position_]))) ++position_;
    token_ = text_.substr(start, position_ - start);
    if (const Function* const function = find_function(token_)) return call(*function, start);
    for (Node axis = 0; axis < number_of_variables; ++axis)
      if (token_ == variables[axis]) return axis;
    for (const auto& [known, value] : known_constants)
      if (token_ == known) return builder_.constant(value);
    const auto found = constants_.find(std::string(token_));
    if (found == constants_.end()) fail_unknown(start);
    return builder_.constant(found->second);
  }

  /// A call of the function whose name starts at `start`. The first two arguments are combined, then the result with
  /// each further argument.
  Node call(const Function& function, std::size_t start) {
    const std::string name = in_quotes(function.name);
    if (peek() != '(')
      fail(start, concatenated({"function ", name, " without arguments"}),
           concatenated({"write ", function.name, "(...)"}));
    const std::vector<Node> arguments = argument_list();
    if (arguments.size() < function.minimal_arguments || arguments.size() > function.maximal_arguments)
      fail(start, concatenated({"wrong number of arguments of ", name}),
           concatenated({"it takes ", arity(function), ", not ", std::to_string(arguments.size())}));
    Node result = builder_.function(function.opcode, arguments[0], arguments[arguments.size() > 1 ? 1 : 0]);
    for (std::size_t i = 2; i < arguments.size(); ++i)
      result = builder_.function(function.opcode, result, arguments[i]);
    check_finite(result, function.name, start);
    return result;
  }

  /// The arguments in the parentheses at the current position.
  std::vector<Node> argument_list() {
    const std::size_t opening = position_++;
    std::vector<Node> arguments;
    if (peek() != ')') {
      arguments.push_back(sum());
      while (peek() == ',') {
        ++position_;
        arguments.push_back(sum());
      }
    }
    close(opening);
    return arguments;
  }

  /// Reads the ')' that matches the '(' at `opening`.
  void close(std::size_t opening) {
    const char c = peek();
    if (c == '\0' && at_end()) fail(opening, "unclosed '('", "add ')'");
    if (c != ')') fail_after_operand();
    token_ = ")";
    ++position_;
  }

  /// Reports the operation at `column` if its result is a constant that is not finite.
  void check_finite(Node node, std::string_view operation, std::size_t column) const {
    if (const auto value = builder_.value(node); value && !std::isfinite(*value))
      fail(column, concatenated({"non-finite result of ", in_quotes(operation)}), "check its constant operands");
  }

  [[noreturn]] void fail(std::size_t position, std::string_view problem, std::string_view advice) const {
    throw_error_at(text_, position, problem, advice);
  }

  [[noreturn]] void fail_unknown(std::size_t start) {
    const std::string name = in_quotes(token_);
    const std::string near = near_name(token_, constants_);
    const std::string question = near.empty() ? "" : concatenated({"did you mean ", in_quotes(near), "? Otherwise "});
    if (peek() == '(')
      fail(start, concatenated({"unknown function ", name}), concatenated({question, "use one of ", function_names()}));
    throw Unknown_name_error(sentence_at(start, concatenated({"unknown name ", name}),
                                         concatenated({question, "define it as a constant, or use x, y, z"})),
                             excerpt_at(text_, start), std::string(token_));
  }

  [[noreturn]] void fail_before_operand() {
    const char c = peek();
    if (c == '=' && equation_sign_ != NONE) fail(position_, "second '='", "write one equation, lhs = rhs");
    if (at_end()) fail(position_, "unexpected end", "a number, a name or '(' is missing");
    if (std::string_view("*/^,=)").find(c) != NONE)
      fail(position_, concatenated({"unexpected ", character(c)}), "a number, a name or '(' is missing before it");
    fail_character();
  }

  [[noreturn]] void fail_after_operand() {
    const char c = peek();
    if (is_digit(c) || c == '.' || is_letter(c) || c == '(') fail_missing_operator();
    if (c == ')') fail(position_, "unmatched ')'", "remove it or add '('");
    if (c == ',')
      fail(position_, "unexpected ','", "use ',' only between arguments of a function, and '.' in decimal numbers");
    if (c == '=' && equation_sign_ != NONE) fail(position_, "second '='", "write one equation, lhs = rhs");
    if (c == '=') fail(position_, "'=' inside parentheses", "use '=' only between the sides of an equation");
    fail_character();
  }

  [[noreturn]] void fail_missing_operator() {
    std::size_t end = position_ + 1;
    while (end < text_.size() && text_[position_] != '(' &&
           (is_letter(text_[end]) || is_digit(text_[end]) || text_[end] == '.'))
      ++end;
    const std::string_view next = text_.substr(position_, end - position_);
    const std::string left = token_ == ")" ? "(...)" : shortened(token_);
    const std::string right = next == "(" ? "(...)" : shortened(next);
    fail(position_, concatenated({"missing operator between ", in_quotes(token_), " and ", in_quotes(next)}),
         concatenated({"for a product write ", left, "*", right}));
  }

  [[noreturn]] void fail_character() const {
    for (const auto& [sign, spelling] : foreign_signs)
      if (text_.substr(position_, sign.size()) == sign)
        fail(position_, concatenated({"unexpected '", sign, "'"}), concatenated({"write ", spelling}));
    fail(position_, concatenated({"unexpected ", character(text_[position_])}),
         "use names, numbers, ( ) , = and + - * / ^ only");
  }

  bool at_end() const { return position_ == text_.size(); }

  /// Skips white space and returns the next character, or '\0' at the end.
  char peek() {
    while (!at_end() && is_space(text_[position_])) ++position_;
    return at_end() ? '\0' : text_[position_];
  }

  static constexpr int maximal_depth = 1000;

  std::string_view text_;
  const Constants& constants_;
  Tape_builder builder_;
  std::size_t position_ = 0;
  std::size_t equation_sign_ = NONE;
  std::string_view token_; ///< the last number, name or closing parenthesis
  int depth_ = 0;
};

} // namespace

Tape parse_expression(std::string_view text, const std::map<std::string, double>& constants) {
  check_constants(constants);
  return Parser(text, constants).parse();
}

} // namespace equiaffine::internal::expression
