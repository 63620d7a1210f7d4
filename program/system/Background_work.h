// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_BACKGROUND_WORK_H
#define EQUIAFFINE_PROGRAM_SYSTEM_BACKGROUND_WORK_H

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/task_group.h>
#endif

#include <utility>

namespace equiaffine {

/// Work that one of the threads that TBB may use does while this thread goes on. Where there are no others, it is done at
/// once or by wait().
class Background_work {
public:
  Background_work() = default;
  Background_work(const Background_work&) = delete;
  Background_work& operator=(const Background_work&) = delete;
  ~Background_work() {
    try {
      wait();
    } catch (...) { // there is an exception already, or nobody has waited for the result
    }
  }

  /// Starts f().
  template <class F>
  void start(F f) {
#ifdef CGAL_LINKED_WITH_TBB
    tasks_.run(std::move(f));
#else
    f();
#endif
  }

  /// Waits for all work that was started, and throws the exception that ended it, if one did.
  void wait() {
#ifdef CGAL_LINKED_WITH_TBB
    tasks_.wait();
#endif
  }

private:
#ifdef CGAL_LINKED_WITH_TBB
  tbb::task_group tasks_;
#endif
};

} // namespace equiaffine

#endif
