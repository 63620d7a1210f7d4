// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_INTERSECT_SEGMENTS_H
#define EQUIAFFINE_FUNCTION_INTERNAL_INTERSECT_SEGMENTS_H

#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Runs all searches to their ends. Each iteration expands f at the points of all active searches in one call.
template <class Traits, class Kernel>
void finish_together(const Batch_function_traits_3<Traits>& traits,
                     std::span<Newton_search_3<Kernel>* const> searches) {
  std::vector<Newton_search_3<Kernel>*> active(searches.begin(), searches.end());
  std::vector<typename Kernel::Point_3> points(searches.size());
  std::vector<Jet_3<typename Kernel::FT, 1>> jets(searches.size());
  while (!active.empty()) {
    const std::size_t count = active.size();
    for (std::size_t n = 0; n < count; ++n) points[n] = active[n]->point();
    traits.first_orders(std::span<const typename Kernel::Point_3>(points).first(count), std::span(jets).first(count));
    for (std::size_t n = 0; n < count; ++n) active[n]->advance(traits, jets[n]);
    std::erase_if(active, [](const auto* search) { return search->has_ended(); });
  }
}

/// A box around the segments of searches, enlarged by the rounding of points on them.
template <class Kernel>
CGAL::Bbox_3 box_around(std::span<Newton_search_3<Kernel>* const> searches) {
  CGAL::Bbox_3 box;
  for (const auto* search : searches) {
    const auto& bracket = search->bracket();
    box += bracket.a.bbox() + (bracket.a + bracket.direction).bbox();
  }
  double magnitude = 0;
  for (int c = 0; c < 3; ++c) magnitude = std::max({magnitude, -box.min(c), box.max(c)});
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * magnitude;
  return {box.xmin() - rounding, box.ymin() - rounding, box.zmin() - rounding,
          box.xmax() + rounding, box.ymax() + rounding, box.zmax() + rounding};
}

/// Runs all searches to their ends, and changes their order. If there is a cheaper function for the box of the
/// segments, it replaces f, and the searches are divided along the longest side of the box.
template <class Traits, class Kernel>
void finish_in_parts(const Batch_function_traits_3<Traits>& traits, std::span<Newton_search_3<Kernel>*> searches) {
  constexpr std::size_t smallest_part = 8;
  if constexpr (RestrictableImplicitFunctionTraits_3<Traits>)
    if (searches.size() > smallest_part) {
      const CGAL::Bbox_3 box = box_around<Kernel>(searches);
      if (auto restricted = traits.restricted(box)) {
        const auto length = [&](int c) { return box.max(c) - box.min(c); };
        const int axis = std::max({0, 1, 2}, [&](int c, int d) { return length(c) < length(d); });
        const std::size_t half = searches.size() / 2;
        std::nth_element(searches.begin(), searches.begin() + std::ptrdiff_t(half), searches.end(),
                         [&](const auto* p, const auto* q) { return p->point()[axis] < q->point()[axis]; });
        const Batch_function_traits_3<Traits> part(*std::move(restricted));
        finish_in_parts(part, searches.first(half));
        return finish_in_parts(part, searches.subspan(half));
      }
    }
  finish_together<Traits, Kernel>(traits, searches);
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Equivalent to intersect_segment() for each segment, bit for bit unless the compiler contracts products and sums. A
/// segment has `ends` and the `values` there.
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
      internal::classify_failure(traits, search.bracket(), search.is_doubtful(), results.back());
    }
  } else {
    for (const auto& [ends, values] : segments)
      results.push_back(intersect_segment(traits, ends[0], ends[1], values[0], values[1]));
  }
  return results;
}

} // namespace equiaffine

#endif
