// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_LIMIT_THREADS_H
#define EQUIAFFINE_PROGRAM_SYSTEM_LIMIT_THREADS_H

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <cstddef>
#include <memory>

namespace equiaffine {

#ifdef CGAL_LINKED_WITH_TBB
/// No more threads than these compute while what it returns lives.
inline auto limit_threads(std::size_t threads) {
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}
#else
inline std::unique_ptr<int> limit_threads(std::size_t) { return nullptr; } // without TBB there is one thread
#endif

} // namespace equiaffine

#endif
