// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/file_memory.h"

#include "system/front_end.h"
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <system_error>
#include <unistd.h>
#ifdef __linux__
#include <linux/magic.h>
#endif

namespace equiaffine {

namespace fs = std::filesystem;

namespace {

struct Ranges {
  std::mutex mutex;
  std::map<const void*, std::size_t> size_of;
};

/// Never destroyed, since a thread may use them until the process ends.
Ranges*& ranges() {
  static Ranges* ranges = new Ranges;
  return ranges;
}

/// Disables huge pages, which would be read faster than they can be released.
void disable_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t size) {
#ifdef __linux__
  ::madvise(memory, size, MADV_NOHUGEPAGE);
#endif
}

} // namespace

void add_reclaimable_memory(const void* first, std::size_t size) {
  const std::lock_guard guard(ranges()->mutex);
  ranges()->size_of[first] = size;
}

void remove_reclaimable_memory(const void* first) {
  const std::lock_guard guard(ranges()->mutex);
  ranges()->size_of.erase(first);
}

void release_reclaimable_memory() {
  const std::lock_guard guard(ranges()->mutex);
  for (const auto& [first, size] : ranges()->size_of) {
    void* const memory = const_cast<void*>(first);
    ::madvise(memory, size, MADV_DONTNEED);
    disable_huge_pages(memory, size);
  }
}

void forget_reclaimable_memory() { ranges() = new Ranges; }

Mapped_file::Mapped_file(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor == -1) return;
  struct stat status = {};
  const bool has_bytes = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
  const std::size_t size = has_bytes ? std::size_t(status.st_size) : 0;
  void* const place = has_bytes ? ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0) : MAP_FAILED;
  ::close(descriptor);
  if (place != MAP_FAILED) {
    data_ = static_cast<const std::byte*>(place);
    size_ = size;
    add_reclaimable_memory(data_, size_);
  } else if (has_bytes) {
    read_.resize(size);
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(read_.data()), std::streamsize(size))) return;
    data_ = read_.data();
    size_ = size;
  }
}

Mapped_file::~Mapped_file() {
  if (!data_ || !read_.empty()) return;
  remove_reclaimable_memory(data_);
  ::munmap(const_cast<std::byte*>(data_), size_);
}

namespace {

constexpr std::size_t unit = std::size_t(1) << 16; ///< sizes are multiples of this, and so of a page
constexpr std::size_t most_addresses = std::size_t(1) << 43;

/// A reserved range of the address space; the memory at an offset is mapped to the same offset in the file.
struct Scratch {
  fs::path folder;
  std::size_t most_spare;
  std::byte* first; ///< of the part of the address space
  int file;         ///< its descriptor
  std::size_t end;  ///< nothing was ever allocated beyond
  std::mutex mutex = {};
  std::map<std::size_t, std::size_t> size_at = {};            ///< of allocated blocks, by offset
  std::multimap<std::size_t, std::size_t> spare_of_size = {}; ///< the offsets of freed blocks that are kept
  std::size_t spare = 0;
  std::size_t used = 0; ///< allocated bytes
  double most_used = std::numeric_limits<double>::infinity();
  int error = 0; ///< of an allocation that failed for lack of room, or 0
};

std::atomic<Scratch*> scratch = nullptr; ///< never destroyed, since memory is freed until the process ends

[[noreturn]] void fail_to_open(const fs::path& folder, const std::string& reason, const std::string& advice) {
  throw Input_error(option_text("memory") + ": cannot keep data in a file in the folder '" + folder.string() +
                    "': " + reason + "; " + advice);
}

int open_nameless_file_in(const fs::path& folder) {
#ifdef O_TMPFILE
  if (const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR); file != -1)
    return file;
#endif
  std::string name = (folder / ".equiaffine-scratch-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file == -1) fail_to_open(folder, std::generic_category().message(errno), "choose another folder for the output");
  ::unlink(name.c_str());
  return file;
}

/// Whether the file is itself in memory, so that it saves none.
bool is_in_memory([[maybe_unused]] int file) {
#ifdef __linux__
  struct statfs facts;
  return ::fstatfs(file, &facts) == 0 && (facts.f_type == TMPFS_MAGIC || facts.f_type == RAMFS_MAGIC);
#else
  return false;
#endif
}

/// Allocates space in the file, so that a full disk is an error here, not a signal at the first write. Returns the
/// error number, or 0.
int make_room(const Scratch& s, std::size_t place, std::size_t size) {
  int error = EOPNOTSUPP;
#ifdef __linux__
  do error = ::fallocate(s.file, 0, off_t(place), off_t(size)) == 0 ? 0 : errno;
  while (error == EINTR);
#endif
  return error == EOPNOTSUPP || error == ENOSYS ? ::posix_fallocate(s.file, off_t(place), off_t(size)) : error;
}

/// Reserves a range of the address space again.
void reserve_addresses(const Scratch& s, std::size_t place, std::size_t size) {
  ::mmap(s.first + place, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0);
}

/// Returns the space to the file system.
void release(const Scratch& s, std::size_t place, std::size_t size) {
  remove_reclaimable_memory(s.first + place);
  reserve_addresses(s, place, size);
#ifdef __linux__
  ::fallocate(s.file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, off_t(place), off_t(size));
#endif
}

void release_spare(Scratch& s) {
  for (const auto& [size, place] : s.spare_of_size) release(s, place, size);
  s.spare_of_size.clear();
  s.spare = 0;
}

/// Allocates memory at the end, and moves the end. Returns the error number, or 0.
int allocate_at_end(Scratch& s, std::size_t size) {
  if (s.end + size > most_addresses) return ENOMEM;
  if (const int error = make_room(s, s.end, size); error != 0) return error;
  std::byte* const memory = s.first + s.end;
  if (::mmap(memory, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, s.file, off_t(s.end)) == MAP_FAILED)
    return errno;
  ::madvise(memory, size, MADV_RANDOM); // reading ahead would displace other pages
  add_reclaimable_memory(memory, size);
  s.size_at[s.end] = size;
  s.end += size;
  return 0;
}

} // namespace

void open_scratch_memory(const fs::path& folder, std::size_t spare) {
  const int file = open_nameless_file_in(folder);
  if (is_in_memory(file)) {
    ::close(file);
    fail_to_open(folder, "it is itself in memory",
                 "choose a folder on a disk for the output, or, for standard output, set TMPDIR to one");
  }
  void* const first = ::mmap(nullptr, most_addresses, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (first == MAP_FAILED) {
    ::close(file);
    throw Input_error(option_text("memory") + ": the limit of the address space is too low; raise it with ulimit -v");
  }
  scratch = new Scratch{folder, spare, static_cast<std::byte*>(first), file, 0};
}

void reopen_scratch_memory() {
  const Scratch* const of_parent = scratch;
  if (!of_parent) return;
  if (of_parent->end > 0 && ::mmap(of_parent->first, of_parent->end, PROT_READ | PROT_WRITE,
                                   MAP_PRIVATE | MAP_NORESERVE | MAP_FIXED, of_parent->file, 0) == MAP_FAILED)
    throw std::bad_alloc();
  const int file = open_nameless_file_in(of_parent->folder);
  auto* const ours = new Scratch{of_parent->folder, of_parent->most_spare, of_parent->first, file, of_parent->end};
  ours->most_used = 0;
  scratch = ours;
}

std::string lack_of_room_for_scratch_memory() {
  Scratch* const s = scratch;
  if (!s) return {};
  const std::lock_guard guard(s->mutex);
  if (s->error == 0) return {};
  return option_text("memory") + ": the folder '" + s->folder.string() +
         "' has no room for data that do not fit into memory (" + std::generic_category().message(s->error) +
         "); free space there, or raise the limit of file sizes (ulimit -f)";
}

bool has_scratch_memory() { return scratch.load(std::memory_order_acquire) != nullptr; }

void allow_scratch_memory(double bytes) {
  Scratch* const s = scratch;
  if (!s) return;
  const std::lock_guard guard(s->mutex);
  s->most_used = std::max(s->most_used, double(s->used) + bytes);
}

double room_for_scratch_memory() {
  std::error_code error;
  const fs::space_info space = fs::space(scratch.load()->folder, error);
  return error ? std::numeric_limits<double>::infinity() : double(space.available);
}

void* allocate_scratch_memory(std::size_t size) {
  Scratch& s = *scratch;
  size = (size + unit - 1) / unit * unit;
  const std::lock_guard guard(s.mutex);
  if (double(s.used + size) > s.most_used) throw std::bad_alloc();
  if (const auto spare = s.spare_of_size.find(size); spare != s.spare_of_size.end()) {
    const std::size_t place = spare->second;
    s.spare_of_size.erase(spare);
    s.spare -= size;
    s.size_at[place] = size;
    s.used += size;
    return s.first + place;
  }
  int error = allocate_at_end(s, size);
  if (error != 0) {
    release_spare(s);
    error = allocate_at_end(s, size);
  }
  if (error != 0) {
    s.error = error;
    throw No_room_for_scratch_memory();
  }
  s.used += size;
  return s.first + s.end - size;
}

bool is_scratch_memory(const void* memory) {
  const Scratch* const s = scratch.load(std::memory_order_acquire);
  return s && memory >= s->first && memory < s->first + most_addresses;
}

void free_scratch_memory(void* memory) {
  Scratch& s = *scratch;
  const std::lock_guard guard(s.mutex);
  const auto place = std::size_t(static_cast<std::byte*>(memory) - s.first);
  const auto found = s.size_at.find(place);
  if (found == s.size_at.end()) return; // it belongs to the parent
  const std::size_t size = found->second;
  s.size_at.erase(found);
  s.used -= size;
  if (s.spare + size > s.most_spare) return release(s, place, size);
  s.spare_of_size.emplace(size, place);
  s.spare += size;
}

} // namespace equiaffine
