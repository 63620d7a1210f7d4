// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/Temporary_folder.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace equiaffine {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = ".equiaffine-temporary-", pattern = "XXXXXX";

/// The temporary folders that exist. It is never destroyed, because a signal may come at any time.
struct Existing_folders {
  std::mutex mutex;
  std::set<fs::path> paths;
};

Existing_folders& existing_folders() {
  static auto& folders = *new Existing_folders;
  return folders;
}

/// Opens a folder and locks it; -1 if somebody else has locked it or it cannot be opened.
int lock(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor == -1 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

/// Whether the open folder has the owner and the permissions of those that we make.
bool is_ours(int descriptor) {
  struct stat facts;
  return ::fstat(descriptor, &facts) == 0 && facts.st_uid == ::geteuid() && (facts.st_mode & 07777) == S_IRWXU;
}

void remove_if_nobody_uses(const fs::path& folder) {
  constexpr auto time_until_locked = std::chrono::minutes(1); // after its creation a folder is not locked yet
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

} // namespace equiaffine
