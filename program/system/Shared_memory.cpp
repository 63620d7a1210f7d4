// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/Shared_memory.h"

#include <equiaffine/base/Input_error.h>

#include <cerrno>
#include <cstdio>
#include <new>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace equiaffine {

namespace {

/// Opens a file that has no name, in memory where the system has such files.
int open_nameless_file() {
#ifdef __linux__
  return ::memfd_create("equiaffine", MFD_CLOEXEC);
#else
  std::FILE* const file = std::tmpfile();
  if (!file) return -1;
  const int descriptor = ::dup(::fileno(file));
  std::fclose(file);
  return descriptor;
#endif
}

} // namespace

Shared_memory::Shared_memory() : descriptor_(open_nameless_file()) {
  if (descriptor_ == -1) throw std::bad_alloc();
}

Shared_memory::~Shared_memory() {
  if (data_) ::munmap(data_, size_);
  ::close(descriptor_);
}

std::byte* Shared_memory::allocate(std::size_t size) {
  if (::ftruncate(descriptor_, off_t(size)) != 0) {
    if (errno == EFBIG)
      throw Input_error("the limit of the size of files is below " + std::to_string(size) +
                        " bytes, which have to pass from one process to another; raise it with ulimit -f");
    throw std::bad_alloc();
  }
  map(size);
  return data_;
}

const std::byte* Shared_memory::data() {
  struct stat status = {};
  if (!data_ && ::fstat(descriptor_, &status) == 0 && status.st_size > 0) map(std::size_t(status.st_size));
  return data_;
}

void Shared_memory::map(std::size_t size) {
  if (data_) ::munmap(data_, size_);
  data_ = nullptr;
  void* const place = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (place == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<std::byte*>(place);
  size_ = size;
}

} // namespace equiaffine
