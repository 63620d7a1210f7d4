// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_CERTIFIED_SEEDING_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_CERTIFIED_SEEDING_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/delaunay/internal/Certified_seeding_3.h>
#include <equiaffine/delaunay/internal/Seeding_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/Clip_domain_3.h>

#include <cmath>
#include <vector>

namespace equiaffine {

/// Finds points on every component of the zero set of f in a domain, so dense that a Delaunay mesh can begin with them.
/// `size(p)` bounds the circumradius of facets near p, and is at most `largest_size`. \throw std::invalid_argument unless
/// `largest_size` is positive and finite
///
/// The box of the domain is subdivided into an octree until every cell either has no surface or has gradients that
/// pairwise form acute angles. By a theorem of Plantinga and Vegter (Isotopic approximation of implicit curves and
/// surfaces, 2004) a component of the surface cannot lie in such cells without a change of sign between corners of the
/// octree. Cells at the border of the box must satisfy the same within its faces and edges. The cells with surface are
/// then subdivided to the local facet size and packed with points, which keep their clearance from `vertices`. The
/// points are the same on every run.
template <ImplicitFunctionTraits_3 Traits, class Sizing>
Seeding_3<typename Traits::Point_3>
certified_seeding(const Traits& traits, const Clip_domain_3& domain, const Sizing& size, double largest_size,
                  const std::vector<Fixed_vertex_3<typename Traits::Point_3>>& vertices = {}) {
  check_argument(largest_size > 0 && std::isfinite(largest_size),
                 "the largest size of facets is not a positive length: choose one");
  return internal::Certified_seeding_3<Traits, Sizing>(traits, domain, size, largest_size)(vertices);
}

} // namespace equiaffine

#endif
