// SPDX-License-Identifier: GPL-3.0-or-later
// Signals, child processes, and memory shared with them.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_PROCESS_H
#define EQUIAFFINE_PROGRAM_SYSTEM_PROCESS_H

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace equiaffine {

/// Installs handlers for all signals that end the process and were not ignored: they also remove the temporary folders.
/// A request to end (SIGINT, SIGTERM, SIGQUIT and others) exits with the status 128 + its number. A crash (SIGSEGV,
/// SIGABRT and others) prints a line that asks for a report, and ends with its signal. SIGPIPE and SIGXFSZ become
/// errors of writing. Call this before starting threads.
void clean_up_at_signals();

/// Restores the default effect of every signal, for a child process.
void forget_signals();

/// Memory that a process shares with children that it starts afterwards: a child writes, its parent reads. Only written
/// pages use memory. Every member throws `std::bad_alloc` if the system has no memory left.
class Shared_memory {
public:
  Shared_memory();
  ~Shared_memory();
  Shared_memory(const Shared_memory&) = delete;
  Shared_memory& operator=(const Shared_memory&) = delete;

  /// Allocates zeroed bytes. Throws `Input_error` if they exceed the limit of file sizes, to which they are subject.
  std::byte* allocate(std::size_t size);

  /// The bytes that this process or a child allocated; null if there are none.
  const std::byte* data();

private:
  void map(std::size_t size);

  int descriptor_;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Limits of a child process.
struct Child_limits {
  double seconds; ///< of processor time; twice as many of elapsed time
  double memory;  ///< bytes in addition to the parent's, up to the memory of this computer; as many of scratch memory
};

/// Thrown if a child process that reads a file ends without an answer. what() is a predicate, such as "crashed
/// (Segmentation fault)".
class Child_failure : public std::runtime_error {
public:
  explicit Child_failure(const std::string& what,
                         const std::string& advice = "the file may be damaged: get the complete file again")
      : std::runtime_error(what), advice_(advice) {}

  const std::string& advice() const { return advice_; }

private:
  std::string advice_;
};

/// Runs `task` in a child process and waits for its end. The child has a copy of its parent's memory; only changes of
/// `Shared_memory` come back. Its output is discarded. Rethrows `Input_error` and `std::bad_alloc` of the task; lack of
/// room for scratch memory is an `Input_error`.
/// \throws Child_failure if the child crashed, exceeded its limits, or threw another exception
void run_in_child(const std::function<void()>& task, const Child_limits& limits);

/// In a child process, allows `bytes` more memory than it has, up to the memory of this computer; a larger limit set
/// before stays. Has no effect in other processes.
void allow_memory(double bytes);

} // namespace equiaffine

#endif
