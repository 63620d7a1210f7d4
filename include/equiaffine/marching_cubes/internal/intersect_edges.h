// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_INTERSECT_EDGES_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_INTERSECT_EDGES_H

#include <equiaffine/function/internal/intersect_segments.h>
#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/surface/project_to_surface.h>

#include <cmath>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// Finds a zero of a spline on an edge at whose ends the samples have different signs. The spline need not have these
/// signs: without a change of its own sign, a zero is looked for nearby.
template <class Traits>
Surface_point_3<Kernel_of<Traits>> intersect_edge_of_samples(const Traits& traits,
                                                             const typename Lattice_function<Traits>::Edge& edge) {
  using FT = typename Traits::FT;
  using std::sqrt;
  const auto& [a, b] = edge.ends;
  const FT fa = traits.value(a), fb = traits.value(b);
  auto result = is_sign_change(fa, fb)
                    ? intersect_segment(traits, a, b, fa, fb)
                    : project_to_surface(traits, edge.linear_intersection(), FT(sqrt((b - a).squared_length())));
  result.evaluations += 2;
  return result;
}

/// Finds a zero of f on each edge of a lattice.
template <class Traits>
std::vector<Surface_point_3<Kernel_of<Traits>>>
intersect_edges(const Batch_function_traits_3<Traits>& traits,
                std::span<const typename Lattice_function<Traits>::Edge> edges) {
  if constexpr (Lattice_function<Traits>::has_samples) {
    std::vector<Surface_point_3<Kernel_of<Traits>>> results;
    results.reserve(edges.size());
    for (const auto& edge : edges) results.push_back(intersect_edge_of_samples<Traits>(traits, edge));
    return results;
  } else {
    return intersect_segments(traits, edges);
  }
}

} // namespace equiaffine::internal

#endif
