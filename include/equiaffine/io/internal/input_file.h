// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_INPUT_FILE_H
#define EQUIAFFINE_IO_INTERNAL_INPUT_FILE_H

#include <equiaffine/base/Input_error.h>

#include <fstream>
#include <istream>
#include <string>
#include <string_view>

// The library defines these functions.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// Whether a path ends with an extension such as ".ply". The extension is given in lower case; the path may have it in
/// lower or upper case.
bool has_extension(std::string_view path, std::string_view extension);

/// Opens a file that is not empty for reading bytes.
/// \throws Input_error that says why there is nothing to read: no such file, a folder, a device, a pipe to which
/// nothing writes, no permission, an empty file
std::ifstream open_input(const std::string& path);

namespace internal {

/// Throws the error of a file that cannot be read: what is wrong with it and what the user can do. The middle of a long
/// reason, which quotes the file, is left out.
[[noreturn]] void fail_to_read(const std::string& name, std::string reason, const std::string& advice);

/// The rest of a stream.
/// \throw std::bad_alloc if it would take more than half of the memory of the computer
std::string read_all(std::istream& stream);

} // namespace internal

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
