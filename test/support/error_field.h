// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_ERROR_FIELD_H
#define EQUIAFFINE_TEST_SUPPORT_ERROR_FIELD_H

#include <equiaffine/base/Input_error.h>

#include <string>

/// The field of the Input_error that f() throws.
template <class F>
std::string error_field(const F& f) {
  try {
    f();
  } catch (const equiaffine::Input_error& error) {
    return error.field();
  }
  return "no error";
}

#endif
