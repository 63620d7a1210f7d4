// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_INTERSECT_SEGMENTS_H
#define EQUIAFFINE_FUNCTION_INTERNAL_INTERSECT_SEGMENTS_H

#include <equiaffine/function/Batch_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/internal/searches_together.h>

#include <span>
#include <vector>

namespace equiaffine {

/// Does what intersect_segment() does on each segment, with the same bits unless the compiler contracts products and
/// sums. A segment has `ends` and the `values` there.
template <class Traits, class Segment>
std::vector<Surface_point_3<Kernel_of<Traits>>> intersect_segments(const Batch_function_traits_3<Traits>& traits,
                                                                   std::span<const Segment> segments) {
  using Search = internal::Newton_search_3<Kernel_of<Traits>>;
  std::vector<Surface_point_3<Kernel_of<Traits>>> results;
  results.reserve(segments.size());
  if constexpr (FirstOrderImplicitFunctionTraits_3<Traits> && !HasIntersectSegment<Traits>) {
    std::vector<Search> searches;
    searches.reserve(segments.size());
    for (const auto& [ends, values] : segments)
      searches.emplace_back(internal::Bracket_3<Kernel_of<Traits>>(ends[0], ends[1], values[0], values[1]));
    std::vector<Search*> pointers;
    for (Search& search : searches) pointers.push_back(&search);
    internal::finish_in_parts(traits, std::span(pointers));
    for (const auto& search : searches) {
      results.push_back(search.result());
      internal::explain(traits, search.bracket(), search.is_doubtful(), results.back());
    }
  } else {
    for (const auto& [ends, values] : segments)
      results.push_back(intersect_segment(traits, ends[0], ends[1], values[0], values[1]));
  }
  return results;
}

} // namespace equiaffine

#endif
