// SPDX-License-Identifier: GPL-3.0-or-later
// Memory whose contents lie in a file, so that its pages can be given back at any time: files that are mapped, and
// scratch memory in a file without a name.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_FILE_MEMORY_H
#define EQUIAFFINE_PROGRAM_SYSTEM_FILE_MEMORY_H

#include <cstddef>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

namespace equiaffine {

/// Says that the contents of a range of whole pages lie in a file: the process can give the pages back at any time, and
/// the system brings them again when they are looked at.
void add_reclaimable_memory(const void* first, std::size_t size);

/// Says that the range that begins there is no longer one of them, before it is unmapped.
void remove_reclaimable_memory(const void* first);

/// Gives back the pages of all these ranges, which loses nothing.
void give_back_reclaimable_memory();

/// Begins without any range, in a child process, whose parent had them.
void forget_reclaimable_memory();

/// The bytes of a file, which the system reads when they are first looked at, and may forget; where a file system
/// cannot do that, they are read at once. A file that is cut short meanwhile ends the process by SIGBUS.
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

/// From now on there is scratch memory, in a file without a name in that folder. Throws `Input_error` where the folder
/// cannot have such a file, or is in memory itself. Freed memory of up to `spare` bytes is kept for what has the same
/// size.
void open_scratch_memory(const std::filesystem::path& folder, std::size_t spare);

/// A child process calls this first: it takes another file for what it allocates, and what it changes of its parent's
/// memory stays its own. It may allocate nothing until it is allowed. Throws like open_scratch_memory().
void reopen_scratch_memory();

/// Allows a child process so many bytes of scratch memory beside what it has, or what it was allowed if that is more.
void allow_scratch_memory(double bytes);

bool has_scratch_memory();

/// The bytes that the folder of the scratch memory has room for.
double room_for_scratch_memory();

/// The folder has no room for the scratch memory that was to be allocated.
class No_room_for_scratch_memory : public std::bad_alloc {};

/// Says, in a sentence to which other advice may be added, that there was no room for what was to be allocated; is
/// empty if there always was. It is also for those who do not know what others made of the exception.
std::string lack_of_room_for_scratch_memory();

/// Returns memory that need not be zero. Throws `No_room_for_scratch_memory`, or `std::bad_alloc` where that much is
/// not allowed.
void* allocate_scratch_memory(std::size_t size);

/// Whether it was allocated as scratch memory.
bool is_scratch_memory(const void* memory);

void free_scratch_memory(void* memory);

} // namespace equiaffine

#endif
