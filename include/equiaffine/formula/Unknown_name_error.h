// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FORMULA_UNKNOWN_NAME_ERROR_H
#define EQUIAFFINE_FORMULA_UNKNOWN_NAME_ERROR_H

#include <equiaffine/base/Input_error.h>

#include <string>
#include <utility>

// A program catches what the shared library throws.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// The error of an expression with a name that is neither a variable nor among the constants. Who has a value for it, or
/// a slider, can parse the text again with that constant.
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

#endif
