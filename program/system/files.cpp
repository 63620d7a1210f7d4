// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/files.h"

#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace equiaffine {

namespace fs = std::filesystem;

File_format file_format(const std::string& path) {
  using enum File_format;
  constexpr std::array<std::pair<std::string_view, File_format>, 11> formats = {{{".ply", PLY},
                                                                                 {".off", OFF},
                                                                                 {".obj", OBJ},
                                                                                 {".stl", STL},
                                                                                 {".vtp", VTP},
                                                                                 {".csv", CSV},
                                                                                 {".xyz", XYZ},
                                                                                 {".html", HTML},
                                                                                 {".htm", HTML},
                                                                                 {".png", PNG},
                                                                                 {".json", JSON}}};
  if (!fs::path(path).has_extension()) return UNNAMED;
  for (const auto& [extension, format] : formats)
    if (has_extension(path, extension)) return format;
  return OTHER;
}

namespace {

constexpr std::string_view prefix = ".equiaffine-temporary-", pattern = "XXXXXX";

/// The existing temporary folders. Never destroyed, because a signal may come at any time.
struct Existing_folders {
  std::mutex mutex;
  std::set<fs::path> paths;
};

Existing_folders& existing_folders() {
  static auto& folders = *new Existing_folders;
  return folders;
}

/// Opens a folder and locks it; -1 if another process has locked it or it cannot be opened.
int lock(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor == -1 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

/// Whether the open folder has the owner and the permissions of our temporary folders.
bool is_ours(int descriptor) {
  struct stat facts;
  return ::fstat(descriptor, &facts) == 0 && facts.st_uid == ::geteuid() && (facts.st_mode & 07777) == S_IRWXU;
}

void remove_if_nobody_uses(const fs::path& folder) {
  constexpr auto time_until_locked = std::chrono::minutes(1); // a new folder is not locked immediately
  std::error_code error;
  const auto time = fs::last_write_time(folder, error);
  if (error || fs::file_time_type::clock::now() - time < time_until_locked) return;
  const int descriptor = lock(folder);
  if (descriptor == -1) return;
  if (is_ours(descriptor)) fs::remove_all(folder, error);
  ::close(descriptor);
}

void remove_abandoned_folders(const fs::path& parent) {
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(prefix) && name.size() == prefix.size() + pattern.size()) remove_if_nobody_uses(entry->path());
  }
}

} // namespace

Temporary_folder::Temporary_folder(const fs::path& parent) {
  remove_abandoned_folders(parent);
  Existing_folders& existing = existing_folders();
  const std::lock_guard guard(existing.mutex);
  std::string name = (parent / std::string(prefix).append(pattern)).string();
  if (!::mkdtemp(name.data())) throw std::system_error(errno, std::generic_category());
  path_ = name;
  lock_ = lock(path_);
  existing.paths.insert(path_);
}

Temporary_folder::~Temporary_folder() {
  Existing_folders& existing = existing_folders();
  const std::lock_guard guard(existing.mutex);
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  existing.paths.erase(path_);
  if (lock_ != -1) ::close(lock_);
}

void remove_all_temporary_folders() {
  Existing_folders& existing = existing_folders();
  existing.mutex.lock();
  std::error_code ignored;
  for (const fs::path& path : existing.paths) fs::remove_all(path, ignored);
}

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason, const std::string& advice) {
  throw Input_error("cannot write " + (path == "-" ? "standard output" : "'" + path + "'") + ": " + reason + "; " +
                    advice);
}

std::string message(int error_number) { return std::generic_category().message(error_number); }

} // namespace

Output_file::Output_file(const std::string& path) : path_(path), target_(path), has_to_be_copied_(path == "-") {
  if (path.empty()) throw Input_error("cannot write the output: its name is empty; name a file");
  std::error_code error;
  if (!is_standard_output()) {
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) fail(path, "it is a folder", "name a file");
    if (fs::exists(status)) {
      if (::access(path.c_str(), W_OK) != 0) fail(path, message(errno), "choose another file");
      has_to_be_copied_ = !fs::is_regular_file(status);
      target_ = fs::canonical(path);
    } else if (!target_.has_filename()) fail(path, "it names a folder", "name a file");
  }
  const fs::path parent = has_to_be_copied_           ? fs::temp_directory_path()
                          : target_.has_parent_path() ? target_.parent_path()
                                                      : fs::path(".");
  if (!fs::is_directory(parent, error))
    fail(path, "the folder '" + parent.string() + "' does not exist", "create it or choose another one");
  try {
    folder_ = std::make_unique<Temporary_folder>(parent);
  } catch (const std::system_error& e) {
    fail(path, "cannot create a file in '" + parent.string() + "' (" + message(e.code().value()) + ")",
         "choose another folder");
  }
}

fs::path Output_file::temporary_path() const {
  return folder_->path() / (is_standard_output() ? fs::path("standard_output") : target_.filename());
}

std::ostream& Output_file::stream() {
  if (!stream_.is_open()) {
    stream_.open(temporary_path(), std::ios::binary);
    if (!stream_) fail(path_, message(errno), "choose another file");
  }
  return stream_;
}

void Output_file::close() {
  if (!stream_.is_open()) return;
  stream_.close();
  if (!stream_) fail(path_, "not everything could be stored", "free space on the disk or choose another one");
}

void Output_file::commit() {
  close();
  if (has_to_be_copied_) copy_to_target();
  else rename_to_target();
  folder_.reset();
}

void Output_file::copy_to_target() {
  std::ifstream source(temporary_path(), std::ios::binary);
  std::ofstream device;
  if (!is_standard_output()) device.open(target_, std::ios::binary);
  std::ostream& sink = is_standard_output() ? std::cout : device;
  if (source.peek() != std::ifstream::traits_type::eof()) sink << source.rdbuf();
  sink.flush();
  if (!sink) fail(path_, "it does not accept all data", "check the receiving program or device");
}

void Output_file::rename_to_target() {
  std::error_code error;
  const auto replace = [&error](const fs::path& from, const fs::path& to) {
    if (const fs::file_status old = fs::status(to, error); fs::exists(old))
      fs::permissions(from, old.permissions(), error);
    fs::rename(from, to, error);
    return !error;
  };
  bool is_replaced = true;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_->path()))
    if (entry.path() != temporary_path())
      is_replaced = is_replaced && replace(entry.path(), target_.parent_path() / entry.path().filename());
  if (!is_replaced || !replace(temporary_path(), target_)) fail(path_, error.message(), "choose another file");
}

void commit_all(std::span<Output_file> files) {
  for (Output_file& file : files) file.close();
  for (const bool copied : {true, false})
    for (Output_file& file : files)
      if (file.has_to_be_copied() == copied) file.commit();
}

bool use_standard_output(std::span<const Output_file> files) {
  return std::any_of(files.begin(), files.end(), [](const Output_file& file) { return file.is_standard_output(); });
}

void report_written(std::ostream& out, std::span<const Output_file> files) {
  for (const Output_file& file : files) out << "wrote " << printable(file.path()) << '\n';
}

} // namespace equiaffine
