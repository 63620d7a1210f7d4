// SPDX-License-Identifier: GPL-3.0-or-later
// Calls the library from Python without the GIL, with progress, signals and warnings.
#ifndef EQUIAFFINE_BINDINGS_PYTHON_OBSERVED_H
#define EQUIAFFINE_BINDINGS_PYTHON_OBSERVED_H

#include "system/progress.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <pybind11/pybind11.h>
#include <sstream>
#include <string>
#include <thread>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/task_arena.h>
#endif

namespace equiaffine::python {

namespace py = pybind11;

/// Whether the interpreter is shutting down. It then terminates threads that acquire the GIL, and unwinds their stacks
/// through functions that are not prepared for it.
inline std::atomic<bool> is_interpreter_ending = false;

/// Blocks the calling thread, a daemon thread, until the process exits if the interpreter is shutting down.
inline void wait_for_the_end() {
  while (is_interpreter_ending) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Releases the GIL while it exists.
class Without_lock {
public:
  Without_lock() : state_(PyEval_SaveThread()) {}
  ~Without_lock() {
    wait_for_the_end();
    PyEval_RestoreThread(state_);
  }
  Without_lock(const Without_lock&) = delete;
  Without_lock& operator=(const Without_lock&) = delete;

private:
  PyThreadState* const state_;
};

/// Returns `compute()`, computed with at most this number of threads. Concurrent calls can have other limits.
template <class Compute>
auto with_threads([[maybe_unused]] std::optional<std::size_t> threads, const Compute& compute) {
#ifdef CGAL_LINKED_WITH_TBB
  const int available = tbb::this_task_arena::max_concurrency();
  if (threads && *threads < std::size_t(available)) return tbb::task_arena(int(*threads)).execute(compute);
#endif
  return compute();
}

/// Calls `compute(progress)` without the GIL, then the function that it returns with the GIL. Calls
/// `progress_function(stage, done, total)`. A signal such as Ctrl-C, or an exception of `progress_function`, ends the
/// computation. Warnings of the program become Python warnings at the place where the function of the module was
/// called.
template <class Compute>
auto observed(const py::object& progress_function, std::optional<std::size_t> threads, const Compute& compute) {
  if (!progress_function.is_none() && !PyCallable_Check(progress_function.ptr()))
    throw Input_error("progress: give a function of three numbers, not " +
                      std::string(py::repr(progress_function)));
  std::ostringstream lines;
  const auto finish = [&] {
    const Without_lock without_lock;
    const Progress_observer observer([&](const Progress_observer::Stage& stage) {
      wait_for_the_end();
      const py::gil_scoped_acquire lock;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress_function.is_none()) progress_function(stage.number, stage.done, stage.total);
    });
    Progress progress(lines, false, std::chrono::hours(1 << 16));
    return with_threads(threads, [&] { return compute(progress); });
  }();
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const std::string mark = "warning: ";
  std::istringstream stream(lines.str());
  for (std::string line; std::getline(stream, line);)
    if (const std::size_t place = line.find(mark); place != std::string::npos)
      if (PyErr_WarnEx(PyExc_UserWarning, line.c_str() + place + mark.size(), 2) != 0) throw py::error_already_set();
  return finish();
}

} // namespace equiaffine::python

#endif
