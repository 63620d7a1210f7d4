// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_FAIL_TO_READ_H
#define EQUIAFFINE_IO_INTERNAL_FAIL_TO_READ_H

#include <equiaffine/base/Input_error.h>

#include <cstddef>
#include <string>

namespace equiaffine::internal {

/// Throws the error of a file that cannot be read: what is wrong with it and what the user can do. The middle of a long
/// reason, which quotes the file, is left out.
[[noreturn]] inline void fail_to_read(const std::string& name, std::string reason, const std::string& advice) {
  constexpr std::size_t longest = 300, begin = 200, end = 60;
  if (reason.size() > longest) reason.replace(begin, reason.size() - begin - end, " ... ");
  throw Input_error("cannot read '" + name + "': " + reason + "; " + advice);
}

} // namespace equiaffine::internal

#endif
