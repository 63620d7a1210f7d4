// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_MAPPED_FILE_H
#define EQUIAFFINE_PROGRAM_SYSTEM_MAPPED_FILE_H

#include <cstddef>
#include <string>
#include <vector>

namespace equiaffine {

/// The bytes of a file, which the system reads when they are first looked at, and may forget; where a file system cannot do
/// that, they are read at once. A file that is cut short meanwhile ends the process by SIGBUS.
class Mapped_file {
public:
  /// Throws `std::bad_alloc` for a file that is read and does not fit into memory.
  explicit Mapped_file(const std::string& path);
  ~Mapped_file();
  Mapped_file(const Mapped_file&) = delete;
  Mapped_file& operator=(const Mapped_file&) = delete;

  const std::byte* data() const { return data_; } ///< null if the file has no bytes or cannot be read
  std::size_t size() const { return size_; }      ///< 0 if the file has no bytes or cannot be read

private:
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  std::vector<std::byte> read_; // empty if the file is mapped
};

} // namespace equiaffine

#endif
