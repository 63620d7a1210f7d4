// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PARABOLIC_CURVES_H
#define EQUIAFFINE_PARABOLIC_CURVES_H

#include <equiaffine/concepts.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/Parabolic_curves_3.h>
#include <equiaffine/surface/internal/Parabolic_curve_finder_3.h>
#include <equiaffine/surface/internal/shared/parabolic_function.h>

#include <CGAL/tags.h>

namespace equiaffine {

/// Finds the parabolic curves of the zero set of f. The polylines have a point for every edge of `mesh` at whose ends
/// K_e has different signs, and end where they cross. `mesh` is the mesh that a sampler made of the zero set. Its
/// resolution decides which curves are found, but does not affect the accuracy of their points, which lie on f = 0 and
/// K_e = 0 up to rounding. Curves where K_e touches zero without a change of sign are not found. CGAL::Sequential_tag
/// and CGAL::Parallel_tag give the same curves, bit for bit.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
Parabolic_curves_3<Kernel_of<Traits>> parabolic_curves(const Indexed_triangle_mesh_3<Kernel_of<Traits>>& mesh,
                                                       const Traits& traits) {
  return internal::Parabolic_curve_finder_3<ConcurrencyTag, Traits>(mesh, traits).find();
}

} // namespace equiaffine

#endif
