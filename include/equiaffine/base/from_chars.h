// SPDX-License-Identifier: GPL-3.0-or-later
// internal::from_chars(first, last, value) is std::from_chars. It reads floating-point numbers with standard libraries,
// too, whose own function reads integers only.
#ifndef EQUIAFFINE_BASE_FROM_CHARS_H
#define EQUIAFFINE_BASE_FROM_CHARS_H

#include <equiaffine/base/internal/from_chars.h> // IWYU pragma: export

#endif
