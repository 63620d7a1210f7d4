// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_CHECK_ARGUMENT_H
#define EQUIAFFINE_BASE_INTERNAL_CHECK_ARGUMENT_H

#include <equiaffine/base/internal/check_flags.h>

#include <stdexcept>

namespace equiaffine {

/// Throws std::invalid_argument unless an argument is valid, in every build: for sizes, boxes and lengths that the
/// caller may have from a user. `sentence` says what is wrong and what to do.
inline void check_argument(bool is_valid, const char* sentence) {
  if (!is_valid) throw std::invalid_argument(sentence);
}

} // namespace equiaffine

#endif
