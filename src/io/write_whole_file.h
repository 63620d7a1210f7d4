// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_IO_WRITE_WHOLE_FILE_H
#define EQUIAFFINE_SRC_IO_WRITE_WHOLE_FILE_H

#include <equiaffine/base/Input_error.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <random>
#include <string>
#include <system_error>

namespace equiaffine::internal {

/// A file that takes the place of another one when it is complete, and is removed otherwise. It hands on the permissions
/// of that one, and a link stays a link.
class Whole_file {
public:
  explicit Whole_file(const std::string& path) : path_(path), target_(std::filesystem::weakly_canonical(path, error_)) {
    if (error_) target_ = path;
    temporary_ = target_.parent_path() / (".equiaffine-" + std::to_string(std::random_device()()) + ".part");
    stream_.open(temporary_, std::ios::binary);
    if (!stream_) fail("name a file in a folder that exists and may be written to");
  }
  Whole_file(const Whole_file&) = delete;
  Whole_file& operator=(const Whole_file&) = delete;
  ~Whole_file() { std::filesystem::remove(temporary_, error_); }

  std::ostream& stream() { return stream_; }

  void commit() {
    stream_.close();
    if (!stream_) fail("the disk is full or out of order");
    const auto replaced = std::filesystem::status(target_, error_);
    if (std::filesystem::is_regular_file(replaced))
      std::filesystem::permissions(temporary_, replaced.permissions(), error_);
    std::filesystem::rename(temporary_, target_, error_);
    if (error_) fail(error_.message());
  }

private:
  [[noreturn]] void fail(const std::string& advice) const {
    throw Input_error("cannot write '" + path_ + "': " + advice);
  }

  std::string path_;
  std::error_code error_;
  std::filesystem::path target_, temporary_;
  std::ofstream stream_;
};

/// Calls `write(stream)` for a file that takes the place of the path when it is complete. \throw Input_error if it cannot
/// be written
template <class Write>
void write_whole_file(const std::string& path, const Write& write) {
  Whole_file file(path);
  write(file.stream());
  file.commit();
}

} // namespace equiaffine::internal

#endif
