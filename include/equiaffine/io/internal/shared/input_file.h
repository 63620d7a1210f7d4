// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_SHARED_INPUT_FILE_H
#define EQUIAFFINE_IO_INTERNAL_SHARED_INPUT_FILE_H

#include <equiaffine/io/internal/shared/fail_to_read.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace equiaffine {

/// Whether a path ends with an extension such as ".ply". The extension is given in lower case; the path may have it in
/// lower or upper case.
inline bool has_extension(std::string_view path, std::string_view extension) {
  return path.size() >= extension.size() &&
         std::equal(extension.begin(), extension.end(), path.end() - std::ptrdiff_t(extension.size()),
                    [](char a, unsigned char b) { return a == char(std::tolower(b)); });
}

/// Opens a file that is not empty for reading bytes.
/// \throws Input_error that says why there is nothing to read: no such file, a folder, no permission, an empty file
inline std::ifstream open_input(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    internal::fail_to_read(path, "there is no such file", "check the path");
  if (std::filesystem::is_directory(status)) internal::fail_to_read(path, "it is a folder", "name a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) internal::fail_to_read(path, "permission denied", "make it readable");
  if (file.peek() == std::ifstream::traits_type::eof()) internal::fail_to_read(path, "it is empty", "check the path");
  return file;
}

} // namespace equiaffine

#endif
