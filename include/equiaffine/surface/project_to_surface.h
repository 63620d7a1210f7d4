// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_PROJECT_TO_SURFACE_H
#define EQUIAFFINE_SURFACE_PROJECT_TO_SURFACE_H

#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/distance_estimate.h>
#include <equiaffine/surface/internal/line_search.h>

namespace equiaffine {

/// Finds the zero of f nearest to p along the line through p in the direction of the gradient, at most
/// `maximal_distance` away. `jet` is the expansion of f at p, which does not count as an evaluation.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> project_to_surface(const Traits& traits, const typename Traits::Point_3& p,
                                                      const typename Traits::FT& maximal_distance,
                                                      const Jet_3<typename Traits::FT, 1>& jet) {
  return internal::search_along_gradient(traits, p, maximal_distance, jet);
}

/// Does the same, but computes the expansion at p, which counts as an evaluation.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> project_to_surface(const Traits& traits, const typename Traits::Point_3& p,
                                                      const typename Traits::FT& maximal_distance) {
  auto result = project_to_surface(traits, p, maximal_distance, first_order(traits, p));
  ++result.evaluations;
  return result;
}

} // namespace equiaffine

#endif
