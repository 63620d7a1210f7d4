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

// A program and the shared library that it uses must have the same variable of each thread.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// Looks at long computations of the library in the thread that makes it, for as long as it lives, and may end them.
///
/// \code{.cpp}
/// const equiaffine::Progress_observer observer([&](equiaffine::Progress_observer::Stage stage) {
///   std::cerr << stage.done << " of " << stage.total << '\r';
///   if (is_cancelled) throw Cancelled();
/// });
/// const auto structures = equiaffine::fitted_structures<CGAL::Parallel_tag>(mesh);
/// \endcode
///
/// A computation is made of stages, most of them short: loops over vertices, layers of a grid, or candidates for a map.
/// The function is called in the observing thread, at most once in `interval`, while that thread works on a stage. If
/// it throws, the work of all threads on the computation ends within one step of each, and the exception leaves the
/// function of the library that was called. Results do not depend on an observer. What CGAL computes for the library,
/// as most of a Delaunay mesh, is seen where it asks the library for points.
///
/// The function may call the library, which is not observed then. An observer is destroyed in the thread that made it.
/// One observer in a thread hides those made before it until it is destroyed, in the reverse order of making.
/// A step costs some 30 ns more while it is observed, and nothing otherwise.
class Progress_observer {
  // The observer for which a thread works, and whether the thread has made it.
  struct Of_thread {
    Progress_observer* observer = nullptr;
    bool is_owner = false;
  };
  static Of_thread& of_thread() {
    static thread_local Of_thread observer;
    return observer;
  }

  // A thread that helps throws this; the owner throws the exception of the function instead.
  struct Ended {};

public:
  /// How far the current stage is. Stages count from 1; the number is 0 before the first of them.
  struct Stage {
    std::size_t number; ///< of the stage
    std::size_t done;   ///< steps of it, by all threads
    std::size_t total;  ///< steps that it has
  };
  using Function = std::function<void(const Stage&)>; ///< what looks
  using Clock = std::chrono::steady_clock;            ///< what measures intervals

  /// Calls `function` from now on.
  explicit Progress_observer(Function function, Clock::duration interval = std::chrono::milliseconds(50))
      : function_(std::move(function)), interval_(std::min<Clock::duration>(interval, std::chrono::hours(1 << 16))),
        next_(Clock::now() + interval_), hidden_(std::exchange(of_thread(), {this, true})) {}
  ~Progress_observer() { of_thread() = hidden_; }
  Progress_observer(const Progress_observer&) = delete;
  Progress_observer& operator=(const Progress_observer&) = delete;

  /// A loop of which the observer of this thread, if there is one, sees how far it is. The outermost loop is a stage;
  /// loops within it, also those in other threads, only end when the work ends.
  class Loop {
  public:
    /// Begins a loop of `size` steps.
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

    /// Calls f(i) for every i in [begin, end), in the thread that began the loop or in any other.
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

    /// Calls `run_parts()`, which runs parts of the loop in threads and throws what one of them throws. If the observer
    /// has ended the work, that is its exception, whichever thread saw the end first.
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
    // While it lives, this thread works for the observer.
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

  /// Lets the observer of this thread, if there is one, look. Loops that are not the library's may call it.
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
