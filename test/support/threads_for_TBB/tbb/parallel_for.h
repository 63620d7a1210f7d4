// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces TBB in test/long/thread-sanitizer. The sanitizer does not see the synchronization of a TBB that was compiled
// without it, and would report false races. Here threads start and end with each call, which the sanitizer understands,
// and are not synchronized otherwise. Each thread, including the caller, gets a fixed part of the work. The first
// exception is rethrown after all threads have ended.
#ifndef EQUIAFFINE_TEST_SUPPORT_TBB_PARALLEL_FOR_H
#define EQUIAFFINE_TEST_SUPPORT_TBB_PARALLEL_FOR_H

#include <tbb/blocked_range.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb {

template <class Index, class Body>
void parallel_for(const blocked_range<Index>& range, const Body& body) {
  constexpr Index number_of_threads = 4;
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&](Index first) {
    const Index grain = range.grainsize();
    try {
      for (Index begin = range.begin() + first * grain; begin < range.end(); begin += number_of_threads * grain)
        body(blocked_range<Index>(begin, std::min<Index>(begin + grain, range.end())));
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!error) error = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (Index n = 1; n < number_of_threads; ++n) threads.emplace_back(work, n);
    work(0);
  }
  if (error) std::rethrow_exception(error);
}

} // namespace tbb

#endif
