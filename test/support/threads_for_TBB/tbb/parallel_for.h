// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for TBB where test/long/thread-sanitizer compiles: the sanitizer does not see how a TBB that was compiled
// without it hands work to its threads, and would report every use of data from before as a race. Here threads begin
// and end with the call, which the sanitizer understands, nothing else orders what they do, and each has its share of
// the work however busy the machine is, the calling one, too. The first exception is thrown when all have ended.
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
