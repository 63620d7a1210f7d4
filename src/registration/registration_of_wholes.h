// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_REGISTRATION_OF_WHOLES_H
#define EQUIAFFINE_SRC_REGISTRATION_REGISTRATION_OF_WHOLES_H

#include "registration/Centered_surface_3.h"
#include "registration/Shape_matches.h"
#include "registration/register_wholes.h"
#include <equiaffine/registration/internal/searches.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace equiaffine::internal {

/// The number of maps beside the first that move as much of the surfaces onto each other, as near.
inline std::size_t equally_good(const Shape_matches& found) {
  constexpr double part = 0.98, factor = 3, rounding = 1e-9;
  const auto least_inliers = [](const Shape_match& m) { return std::min(m.inliers[0], m.inliers[1]); };
  const auto greatest_inliers = [](const Shape_match& m) { return std::max(m.inliers[0], m.inliers[1]); };
  const Shape_match& best = found.maps.front();
  return std::size_t(std::count_if(found.maps.begin() + 1, found.maps.end(), [&](const Shape_match& m) {
    return m.rms <= factor * best.rms + rounding * found.size && least_inliers(m) >= part * least_inliers(best) &&
           greatest_inliers(m) >= part * greatest_inliers(best);
  }));
}

/// Converts what was found to the types of CGAL. One map stands for all of a continuous family.
inline Surface_registration_3<Kernel_of_searches> to_CGAL(Shape_matches found, const Registration_request& request) {
  Surface_registration_3<Kernel_of_searches> result;
  const bool slips = found.slippage.dimension() > 0;
  for (std::size_t n = 0; n < std::min(slips ? 1 : request.number_of_maps, found.maps.size()); ++n) {
    const Shape_match& m = found.maps[n];
    result.maps.push_back({m.map.to_CGAL<Kernel_of_searches::Aff_transformation_3>(),
                           m.log10_false_alarms,
                           m.inliers,
                           m.rms,
                           {},
                           m.contradictions});
  }
  if (!slips && found.maps.size() > 1) {
    result.next_best_rms = found.maps[1].rms;
    result.equally_good = equally_good(found);
  }
  result.hypotheses = found.hypotheses;
  result.size = found.size;
  result.reason = std::move(found.reason);
  result.slippage = std::move(found.slippage);
  return result;
}

/// The maps between whole surfaces.
inline Surface_registration_3<Kernel_of_searches> registration_of_wholes(bool in_threads,
                                                                         const Centered_surface_3& source,
                                                                         const Centered_surface_3& target,
                                                                         const Registration_request& request) {
  return to_CGAL(register_wholes(in_threads, source, target, request), request);
}

} // namespace equiaffine::internal

#endif
