// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_INPUT_FILE_H
#define EQUIAFFINE_IO_INTERNAL_INPUT_FILE_H

#include <equiaffine/base/Input_error.h>

#include <fstream>
#include <istream>
#include <string>
#include <string_view>

// These functions are compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// Whether a path ends with an extension such as ".ply", in lower or upper case. `extension` must be in lower case.
bool has_extension(std::string_view path, std::string_view extension);

/// Opens a nonempty file for reading bytes.
/// \throws Input_error with the reason if there is nothing to read: no such file, a folder, a device, a pipe without
/// a writer, no permission, an empty file
std::ifstream open_input(const std::string& path);

namespace internal {

/// Throws the error for an unreadable file: what is wrong with it and what the user can do. A long reason, which
/// quotes the file, is shortened in the middle.
[[noreturn]] void fail_to_read(const std::string& name, std::string reason, const std::string& advice);

/// The rest of a stream.
/// \throw std::bad_alloc if it takes more than half of the physical memory
std::string read_all(std::istream& stream);

} // namespace internal

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
