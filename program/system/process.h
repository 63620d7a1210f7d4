// SPDX-License-Identifier: GPL-3.0-or-later
// The signals of this process, its child processes, and memory shared with them.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_PROCESS_H
#define EQUIAFFINE_PROGRAM_SYSTEM_PROCESS_H

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace equiaffine {

/// From now on, every signal that ends the process and can be caught also removes the temporary folders, unless it was
/// ignored before. A signal that asks it to end (SIGINT, SIGTERM, SIGQUIT and the like) gives the exit status 128 + its
/// number. A crash (SIGSEGV, SIGABRT and the like) prints one line that asks for a report and ends as crashes do.
/// A reader of the output that goes away and a limit of file sizes become errors of writing. Call it before there are
/// threads.
void clean_up_at_signals();

/// Gives every signal its default effect again, for a child process.
void forget_signals();

/// Bytes that a process shares with the children that it makes afterwards: what a child writes, its parent reads.
/// Memory is taken only for what is written. Every member throws `std::bad_alloc` if the system has none left.
class Shared_memory {
public:
  Shared_memory();
  ~Shared_memory();
  Shared_memory(const Shared_memory&) = delete;
  Shared_memory& operator=(const Shared_memory&) = delete;

  /// Makes room for this many bytes, which are zero at first, and returns the first of them. Throws `Input_error` where
  /// the limit of the size of files forbids that, since the system takes these bytes for a file.
  std::byte* allocate(std::size_t size);

  /// The bytes that this process or a child of it made room for; null if there are none.
  const std::byte* data();

private:
  void map(std::size_t size);

  int descriptor_;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// What a child process may use before it is ended.
struct Child_limits {
  double seconds; ///< of processor time; the child may sleep as long again
  double memory;  ///< bytes beside what its parent has, at most those that this computer has; as many in scratch memory
};

/// A child process that read a file ended without an answer. what() continues a sentence: "crashed (Segmentation
/// fault)".
class Child_failure : public std::runtime_error {
public:
  explicit Child_failure(const std::string& what,
                         const std::string& advice = "the file is probably damaged, get the complete file again")
      : std::runtime_error(what), advice_(advice) {}

  const std::string& advice() const { return advice_; }

private:
  std::string advice_;
};

/// Runs `task` in a child process and waits for its end. The child has a copy of everything that its parent has, and
/// nothing of what it changes comes back but `Shared_memory`. What it prints is lost. Where the task throws
/// `Input_error` or `std::bad_alloc`, so does this function; a full disk with its scratch memory is an `Input_error`.
/// \throws Child_failure if the child crashed, exceeded its limits, or threw another exception
void run_in_child(const std::function<void()>& task, const Child_limits& limits);

/// In a child process, allows this many bytes from now on beside what it has, or what it was allowed if that is more;
/// elsewhere nothing is limited. It is never more than this computer has.
void allow_memory(double bytes);

} // namespace equiaffine

#endif
