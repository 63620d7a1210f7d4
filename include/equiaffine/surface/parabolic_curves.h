// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_PARABOLIC_CURVES_H
#define EQUIAFFINE_SURFACE_PARABOLIC_CURVES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/points_of_range.h>
#include <equiaffine/mesh/internal/triangles_of.h>
#include <equiaffine/surface/Parabolic_curves_3.h>
#include <equiaffine/surface/internal/Parabolic_curve_finder_3.h>

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

/// The same for a mesh of CGAL of any kernel whose coordinates are doubles. Faces are cut into triangles.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, ImplicitFunctionTraits_3 Traits,
          internal::Parameter_chain... Parameters>
Parabolic_curves_3<Kernel_of<Traits>> parabolic_curves(const Graph& mesh, const Traits& traits,
                                                       const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_parameters<Joined, internal::Vertex_point_tag, internal::Geom_traits_tag, internal::Verbose_tag>();
  static_assert(check_coordinates<Point_of_vertices<const Graph, Joined>>());
  return parabolic_curves<ConcurrencyTag>(
      internal::triangle_mesh_of<Kernel_of<Traits>>(mesh, internal::joined_parameters(given...)), traits);
}

} // namespace equiaffine

#endif
