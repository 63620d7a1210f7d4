// SPDX-License-Identifier: GPL-3.0-or-later
// Memory backed by files, whose pages can be released at any time: mapped files, and scratch memory in an unnamed file.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_FILE_MEMORY_H
#define EQUIAFFINE_PROGRAM_SYSTEM_FILE_MEMORY_H

#include <cstddef>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

namespace equiaffine {

/// Registers a range of whole pages backed by a file: the process can release them at any time, and the system reads
/// them again on access.
void add_reclaimable_memory(const void* first, std::size_t size);

/// Unregisters a range before it is unmapped.
void remove_reclaimable_memory(const void* first);

/// Releases the pages of all registered ranges. No data are lost.
void release_reclaimable_memory();

/// Forgets the ranges of the parent, in a child process.
void forget_reclaimable_memory();

/// The bytes of a file, memory-mapped, or read at once if the file system does not support that. Truncating the file
/// meanwhile ends the process with SIGBUS.
class Mapped_file {
public:
  /// Throws `std::bad_alloc` if the file is read and does not fit into memory.
  explicit Mapped_file(const std::string& path);
  ~Mapped_file();
  Mapped_file(const Mapped_file&) = delete;
  Mapped_file& operator=(const Mapped_file&) = delete;

  const std::byte* data() const { return data_; } ///< null if the file is empty or cannot be read
  std::size_t size() const { return size_; }      ///< 0 if the file is empty or cannot be read

private:
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  std::vector<std::byte> read_; // empty if the file is mapped
};

/// Opens scratch memory in an unnamed file in the folder. Throws `Input_error` if the folder does not support such a
/// file, or is itself in memory. Up to `spare` bytes of freed memory are kept for allocations of the same size.
void open_scratch_memory(const std::filesystem::path& folder, std::size_t spare);

/// To be called first by a child process: uses a new file for its allocations, and keeps its changes of the parent's
/// memory private. Allocations fail until allow_scratch_memory(). Throws like open_scratch_memory().
void reopen_scratch_memory();

/// Allows a child process `bytes` more scratch memory than it has; a larger limit set before stays.
void allow_scratch_memory(double bytes);

bool has_scratch_memory();

/// The free bytes in the folder of the scratch memory.
double room_for_scratch_memory();

/// Thrown if the folder has no room for an allocation of scratch memory.
class No_room_for_scratch_memory : public std::bad_alloc {};

/// An error message, to which advice may be appended, if an allocation failed for lack of room; otherwise empty. Use it
/// where a library has replaced the exception by its own.
std::string lack_of_room_for_scratch_memory();

/// Returns uninitialized memory. Throws `No_room_for_scratch_memory`, or `std::bad_alloc` if the limit is exceeded.
void* allocate_scratch_memory(std::size_t size);

/// Whether the memory was allocated as scratch memory.
bool is_scratch_memory(const void* memory);

void free_scratch_memory(void* memory);

} // namespace equiaffine

#endif
