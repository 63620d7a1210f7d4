// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_SCRATCH_FILE_H
#define EQUIAFFINE_TEST_SUPPORT_SCRATCH_FILE_H

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace equiaffine::test {

/// A file in a temporary folder, which is removed with this object.
class Scratch_file {
public:
  explicit Scratch_file(const std::string& name) {
    std::string folder = (std::filesystem::temp_directory_path() / "equiaffine-test-XXXXXX").string();
    if (!::mkdtemp(folder.data())) std::abort();
    path_ = std::filesystem::path(folder) / name;
  }
  ~Scratch_file() { std::filesystem::remove_all(path_.parent_path()); }
  Scratch_file(const Scratch_file&) = delete;
  Scratch_file& operator=(const Scratch_file&) = delete;

  /// Replaces the content and returns the path.
  std::string write(std::string_view bytes) const {
    std::ofstream(path_, std::ios::binary) << bytes;
    return path_.string();
  }

private:
  std::filesystem::path path_;
};

} // namespace equiaffine::test

#endif
