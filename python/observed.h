// SPDX-License-Identifier: GPL-3.0-or-later
// Calls of the library from Python: without the lock of the interpreter, with progress, signals and warnings.
#ifndef EQUIAFFINE_PYTHON_OBSERVED_H
#define EQUIAFFINE_PYTHON_OBSERVED_H

#include "system/limit_threads.h"
#include "system/progress.h"
#include <equiaffine/Progress_observer.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <pybind11/pybind11.h>
#include <sstream>
#include <string>

namespace equiaffine::python {

namespace py = pybind11;

/// Calls `compute(progress)` without the lock, and what it returns with it. A signal, as of Ctrl-C, ends the computation,
/// as does an exception of the `progress` function, which is called with the number of a stage, the steps that are done,
/// and all of them. Warnings of the program become those of Python.
template <class Compute>
auto observed(const py::object& progress_function, std::optional<std::size_t> threads, const Compute& compute) {
  std::ostringstream warnings;
  const auto finish = [&] {
    const py::gil_scoped_release without_lock;
    const auto limit = threads ? limit_threads(*threads) : nullptr;
    const Progress_observer observer([&](const Progress_observer::Stage& stage) {
      const py::gil_scoped_acquire lock;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress_function.is_none()) progress_function(stage.number, stage.done, stage.total);
    });
    Progress progress(warnings, false, std::chrono::hours(1));
    return compute(progress);
  }();
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  std::istringstream lines(warnings.str());
  for (std::string line; std::getline(lines, line);) {
    const std::string mark = "warning: ";
    const std::size_t place = line.find(mark);
    const std::string text = place == std::string::npos ? line : line.substr(place + mark.size());
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 2) != 0) throw py::error_already_set();
  }
  return finish();
}

} // namespace equiaffine::python

#endif
