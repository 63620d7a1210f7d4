// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INPUT_ERROR_H
#define EQUIAFFINE_BASE_INPUT_ERROR_H

#include <equiaffine/base/internal/printable.h>

#include <stdexcept>
#include <string>
#include <utility>

// A program catches what the shared library throws.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// The exception for a text or a file that cannot be used.
/// `what()` is one line that says what is wrong, where, and what to do about it. What it quotes of the text or file is
/// `printable`.
/// `excerpt()` is empty or shows the place: the offending text and, below it, a caret.
class Input_error : public std::runtime_error {
public:
  /// Makes an error of two texts.
  explicit Input_error(const std::string& what, std::string excerpt = {})
      : std::runtime_error(printable(what)), excerpt_(std::move(excerpt)) {}

  const std::string& excerpt() const { return excerpt_; } ///< the place in the text, or nothing

private:
  std::string excerpt_;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
