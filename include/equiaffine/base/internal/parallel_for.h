// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_PARALLEL_FOR_H
#define EQUIAFFINE_BASE_INTERNAL_PARALLEL_FOR_H

#include <equiaffine/base/Progress_observer.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <type_traits>
#include <utility>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace equiaffine {

/// Whether a CGAL tag requests threads. As in CGAL, fails to compile if TBB is missing for CGAL::Parallel_tag.
template <class ConcurrencyTag>
constexpr bool runs_in_threads() {
  constexpr bool result = std::is_convertible_v<ConcurrencyTag, CGAL::Parallel_tag>;
#ifndef CGAL_LINKED_WITH_TBB
  static_assert(!result, "CGAL::Parallel_tag needs TBB, but CGAL_LINKED_WITH_TBB is not defined: link to CGAL's target "
                         "CGAL::TBB_support, or use CGAL::Parallel_if_available_tag");
#endif
  return result;
}

/// Calls f(i) for every i in [begin, end), in any order: on TBB's threads for CGAL::Parallel_tag, otherwise
/// sequentially. Ranges of at most `grain` calls are not split between threads. A Progress_observer of the calling
/// thread observes the loop.
template <class ConcurrencyTag, class F>
void parallel_for(std::size_t begin, std::size_t end, F f, [[maybe_unused]] std::size_t grain = 1) {
  const Progress_observer::Loop loop(begin < end ? end - begin : 0);
  if constexpr (runs_in_threads<ConcurrencyTag>()) {
#ifdef CGAL_LINKED_WITH_TBB
    loop.run_in_threads([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                        [&](const tbb::blocked_range<std::size_t>& r) { loop.run(r.begin(), r.end(), f); });
    });
#endif
  } else {
    loop.run(begin, end, f);
  }
}

/// The same, with threads if `in_threads`.
template <class F>
void parallel_for([[maybe_unused]] bool in_threads, std::size_t begin, std::size_t end, F f, std::size_t grain = 1) {
#ifdef CGAL_LINKED_WITH_TBB
  if (in_threads) return parallel_for<CGAL::Parallel_tag>(begin, end, std::move(f), grain);
#endif
  parallel_for<CGAL::Sequential_tag>(begin, end, std::move(f), grain);
}

/// Returns f(). Its loops with CGAL::Parallel_if_available_tag use threads only if `in_threads`.
template <class F>
auto on_threads_if([[maybe_unused]] bool in_threads, const F& f) {
#ifdef CGAL_LINKED_WITH_TBB
  if (!in_threads) return tbb::task_arena(1).execute(f);
#endif
  return f();
}

/// Calls f(). Keeps the calling thread from stealing work of other loops while a loop of f waits: that work might need
/// the result of f.
template <class ConcurrencyTag, class F>
void isolated(const F& f) {
  if constexpr (runs_in_threads<ConcurrencyTag>()) {
#ifdef CGAL_LINKED_WITH_TBB
    tbb::this_task_arena::isolate(f);
#endif
  } else {
    f();
  }
}

} // namespace equiaffine

#endif
