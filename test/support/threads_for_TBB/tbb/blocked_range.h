// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_TEST_SUPPORT_TBB_BLOCKED_RANGE_H
#define EQUIAFFINE_TEST_SUPPORT_TBB_BLOCKED_RANGE_H

namespace tbb {

/// What parallel_for.h needs of TBB's class of this name.
template <class Index>
class blocked_range {
public:
  blocked_range(Index begin, Index end, Index grain = 1) : begin_(begin), end_(end), grain_(grain) {}

  Index begin() const { return begin_; }
  Index end() const { return end_; }
  Index grainsize() const { return grain_; }

private:
  Index begin_, end_, grain_;
};

} // namespace tbb

#endif
