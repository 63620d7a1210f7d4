// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_NAME_OF_FILE_H
#define EQUIAFFINE_PROGRAM_SYSTEM_NAME_OF_FILE_H

#include <filesystem>
#include <string>

namespace equiaffine {

/// The name of a file or folder without the folders above it, which are nobody else's business. It is what files that
/// are passed on, such as pages and statistics, call a source.
inline std::string name_of_file(const std::filesystem::path& path) {
  const std::filesystem::path normal = path.lexically_normal();
  const std::filesystem::path last = normal.has_filename() ? normal.filename() : normal.parent_path().filename();
  return last.empty() ? path.string() : last.string();
}

} // namespace equiaffine

#endif
