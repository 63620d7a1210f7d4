// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_TEMPORARY_FOLDER_H
#define EQUIAFFINE_PROGRAM_SYSTEM_TEMPORARY_FOLDER_H

#include <filesystem>

namespace equiaffine {

/// A folder of its own name that is removed with this object, or by `remove_all_temporary_folders()`. A lock on it
/// tells other processes that it is in use. The constructor removes those in the same place that nobody uses, which a
/// process left that was killed; it throws `std::system_error` if the folder cannot be made.
class Temporary_folder {
public:
  explicit Temporary_folder(const std::filesystem::path& parent);
  ~Temporary_folder();
  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  int lock_ = -1;
};

/// Removes the temporary folders of this process, which is about to end: threads that make or remove one from now on
/// wait for that end.
void remove_all_temporary_folders();

} // namespace equiaffine

#endif
