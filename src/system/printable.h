// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SYSTEM_PRINTABLE_H
#define EQUIAFFINE_SRC_SYSTEM_PRINTABLE_H

#include <string>
#include <string_view>

namespace equiaffine {

/// The text as it may go to a terminal, in one line. Line breaks become spaces. Bytes of control characters, of
/// characters that change the direction of writing, and bytes that are not UTF-8 become `\x` and two digits.
std::string printable(std::string_view text);

} // namespace equiaffine

#endif
