// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_PROGRESS_OBSERVER_H
#define EQUIAFFINE_BASE_PROGRESS_OBSERVER_H

#include <equiaffine/base/internal/compiler.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <utility>

// A program and the shared library must share each thread's variable.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// Reports the progress of long computations of the current thread, and can cancel them.
///
/// \code{.cpp}
/// const equiaffine::Progress_observer observer([&](equiaffine::Progress_observer::Stage stage) {
///   std::cerr << stage.done << " of " << stage.total << '\r';
///   if (is_cancelled) throw Cancelled();
/// });
/// const auto structures = equiaffine::fitted_structures<CGAL::Parallel_tag>(mesh);
/// \endcode
///
/// A computation consists of stages, most of them short: loops over vertices, layers of a grid, or candidates for a
/// map. While the observing thread works on a stage, it calls the function at most once per `interval`. If the function
/// throws, all threads stop after their current step, and the exception leaves the library function that was called.
/// Results do not depend on an observer. Work inside CGAL, such as most of Delaunay meshing, is observed only when it
/// calls back into the library.
///
/// The function may call the library; those calls are not observed. Destroy an observer in the thread that created it.
/// If a thread has several observers, only the newest is active; destroy them in reverse order. An observer adds about
/// 30 ns to each step; without one there is no cost.
class Progress_observer {
  // The observer that a thread works for, and whether this thread created it.
  struct Of_thread {
    Progress_observer* observer = nullptr;
    bool is_owner = false;
  };
  static Of_thread& of_thread() {
    static thread_local Of_thread observer;
    return observer;
  }

  // Thrown in helper threads; the owner throws the exception of the function instead.
  struct Ended {};

public:
  /// Progress of the current stage.
  struct Stage {
    std::size_t number; ///< counted from 1; 0 before the first stage
    std::size_t done;   ///< completed steps, of all threads
    std::size_t total;  ///< steps of the stage
  };
  using Function = std::function<void(const Stage&)>; ///< receives the progress
  using Clock = std::chrono::steady_clock;            ///< measures the intervals

  /// Calls `function` at most once per `interval`.
  explicit Progress_observer(Function function, Clock::duration interval = std::chrono::milliseconds(50))
      : function_(std::move(function)), interval_(std::min<Clock::duration>(interval, std::chrono::hours(1 << 16))),
        next_(Clock::now() + interval_), hidden_(std::exchange(of_thread(), {this, true})) {}
  ~Progress_observer() { of_thread() = hidden_; }
  Progress_observer(const Progress_observer&) = delete;
  Progress_observer& operator=(const Progress_observer&) = delete;

  /// A loop whose progress is reported to the observer of this thread, if any. The outermost loop is a stage. Nested
  /// loops, including those in other threads, are not reported but can be canceled.
  class Loop {
  public:
    /// Starts a loop of `size` steps.
    explicit Loop(std::size_t size) : observer_(of_thread().observer) {
      if (!observer_ || !of_thread().is_owner || observer_->is_in_stage_) return;
      is_stage_ = observer_->is_in_stage_ = true;
      ++observer_->stage_;
      observer_->done_ = 0;
      observer_->total_ = size;
    }
    ~Loop() {
      if (is_stage_) observer_->is_in_stage_ = false;
    }
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;

    /// Calls f(i) for every i in [begin, end). May be called from any thread.
    template <class F>
    void run(std::size_t begin, std::size_t end, F& f) const {
      if (!observer_) {
        for (std::size_t i = begin; i < end; ++i) f(i);
        return;
      }
      const Work work(observer_);
      for (std::size_t i = begin; i < end; ++i) {
        observer_->pass(work.is_of_owner);
        f(i);
        if (is_stage_) observer_->done_.fetch_add(1, std::memory_order_relaxed);
      }
    }

    /// Calls `run_parts()`, which runs parts of the loop in threads and rethrows their exceptions. If the observer
    /// cancelled the work, its exception is thrown, whichever thread noticed first.
    template <class Run_parts>
    void run_in_threads(const Run_parts& run_parts) const {
      try {
        run_parts();
      } catch (const Ended&) {
        if (!of_thread().is_owner) throw;
        std::rethrow_exception(observer_->error_);
      }
    }

  private:
    // Marks this thread as working for the observer during its lifetime.
    struct Work {
      explicit Work(Progress_observer* observer)
          : before(of_thread()), is_of_owner(before.observer == observer && before.is_owner) {
        of_thread() = {observer, is_of_owner};
      }
      ~Work() { of_thread() = before; }
      Work(const Work&) = delete;
      Work& operator=(const Work&) = delete;

      const Of_thread before;
      const bool is_of_owner;
    };

    Progress_observer* const observer_;
    bool is_stage_ = false;
  };

  /// Reports to the observer of this thread, if any. Call it in loops that are not the library's.
  static void step() {
    if (const auto [observer, is_owner] = of_thread(); observer) observer->pass(is_owner);
  }

private:
  void pass(bool is_owner) {
    if (is_ended_.load(std::memory_order_relaxed)) {
      if (is_owner) std::rethrow_exception(error_);
      throw Ended();
    }
    if (!is_owner || Clock::now() < next_) return;
    const Of_thread self = std::exchange(of_thread(), {}); // the function may use the library itself
    try {
      function_({stage_, done_.load(std::memory_order_relaxed), total_});
      of_thread() = self;
    } catch (...) {
      of_thread() = self;
      error_ = std::current_exception();
      is_ended_.store(true, std::memory_order_relaxed);
      throw;
    }
    next_ = Clock::now() + interval_;
  }

  const Function function_;
  const Clock::duration interval_;
  Clock::time_point next_;
  const Of_thread hidden_;
  std::size_t stage_ = 0, total_ = 0;
  bool is_in_stage_ = false;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> is_ended_ = false;
  std::exception_ptr error_;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
