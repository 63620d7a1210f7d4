// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_GRAPHS_WRITE_WHOLE_FILE_H
#define EQUIAFFINE_IO_INTERNAL_GRAPHS_WRITE_WHOLE_FILE_H

#include <equiaffine/Input_error.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <random>
#include <string>
#include <system_error>

namespace equiaffine::internal {

/// Calls `write(stream)` for a file beside the path, which then takes its place, so that the path has the whole file or
/// what was there before. \throw Input_error if it cannot be written
template <class Write>
void write_whole_file(const std::string& path, const Write& write) {
  const std::string temporary = path + "." + std::to_string(std::random_device()()) + ".part";
  const auto fail = [&](const std::string& advice) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw Input_error("cannot write '" + path + "': " + advice);
  };
  std::ofstream stream(temporary, std::ios::binary);
  if (!stream) fail("name a file in a folder that exists and may be written to");
  write(static_cast<std::ostream&>(stream));
  stream.close();
  if (!stream) fail("the disk is full or out of order");
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) fail(error.message());
}

} // namespace equiaffine::internal

#endif
