// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_CHILD_PROCESS_H
#define EQUIAFFINE_PROGRAM_SYSTEM_CHILD_PROCESS_H

#include <functional>
#include <stdexcept>
#include <string>

namespace equiaffine {

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
