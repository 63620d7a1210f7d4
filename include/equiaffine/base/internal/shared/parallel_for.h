// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_SHARED_PARALLEL_FOR_H
#define EQUIAFFINE_BASE_INTERNAL_SHARED_PARALLEL_FOR_H

#include <CGAL/tags.h>

#include <cstddef>
#include <type_traits>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace equiaffine {

/// Calls f(i) for every i in [begin, end), in any order: on the threads of TBB for CGAL::Parallel_tag when CGAL is used
/// with TBB, else one after the other. Ranges of `grain` calls or fewer are not split between threads.
template <class ConcurrencyTag, class F>
void parallel_for(std::size_t begin, std::size_t end, F f, [[maybe_unused]] std::size_t grain = 1) {
#ifdef CGAL_LINKED_WITH_TBB
  if constexpr (std::is_convertible_v<ConcurrencyTag, CGAL::Parallel_tag>) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                      [&](const tbb::blocked_range<std::size_t>& r) {
                        for (std::size_t i = r.begin(); i != r.end(); ++i) f(i);
                      });
    return;
  }
#endif
  for (std::size_t i = begin; i < end; ++i) f(i);
}

} // namespace equiaffine

#endif
