// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/Mapped_file.h"

#include "system/reclaimable_memory.h"

#include <fcntl.h>
#include <fstream>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace equiaffine {

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

} // namespace equiaffine
