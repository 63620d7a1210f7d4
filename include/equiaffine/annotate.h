// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the local structure of level sets into property maps of a CGAL::Surface_mesh, which it also makes of the mesh of
// a sampler.
#ifndef EQUIAFFINE_ANNOTATE_H
#define EQUIAFFINE_ANNOTATE_H

#include <equiaffine/attributes.h>
#include <equiaffine/attributes/internal/Property_maps.h>
#include <equiaffine/attributes/internal/surface_mesh_of.h>
#include <equiaffine/base/internal/shared/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/surface/Isosurface_3.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/tags.h>

#include <cstddef>

namespace equiaffine {

/// Makes a CGAL::Surface_mesh, with the property map `v:status` (Point_status), from the mesh of a sampler. It has all
/// triangles, in the same order. Vertex i is point i; where the mesh is not a manifold, as a Delaunay mesh of x y z = 0
/// is along the axes, copies of vertices follow, which have the same point and status, so that the parts of the surface
/// that meet there come apart. `surface.points` and `surface.triangles` are the mesh in which they are joined, and can be
/// given to CGAL's functions for polygon soups.
template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> to_surface_mesh(const Isosurface_3<Kernel>& surface) {
  return internal::surface_mesh_of(surface);
}

/// Fills property maps of the vertices of `mesh` with the local structure of the level sets of f through them:
/// `v:status` (Point_status), `v:normal`, `v:conormal`, `v:affine_normal`, `v:direction1`, `v:direction2` (Vector_3),
/// and one of FT for every other attribute of attribute_table.h but the norms of gradients: `v:k1`, `v:metric_xx`,
/// `v:quadric_defect` and so on. A vertex whose `v:status` is UNCONVERGED before the call keeps that status, unless it
/// is OUTSIDE. CGAL::Sequential_tag and CGAL::Parallel_tag give the same numbers. Named parameter: `estimator`.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          class Parameters = internal::No_parameters>
void annotate(CGAL::Surface_mesh<typename Traits::Point_3>& mesh, const Traits& traits,
              const Parameters& parameters = {}) {
  internal::check_parameters<Parameters, internal::Estimator_tag>();
  using Mesh = CGAL::Surface_mesh<typename Traits::Point_3>;
  using Vertex_index = typename Mesh::Vertex_index;
  internal::Property_maps<Mesh> maps(mesh);
  parallel_for<ConcurrencyTag>(
      0, mesh.num_vertices() + mesh.number_of_removed_vertices(),
      [&](std::size_t i) {
        const Vertex_index v{static_cast<typename Vertex_index::size_type>(i)};
        if (!mesh.is_removed(v)) maps.set(v, local_structure_at(traits, mesh.point(v), maps.status(v), parameters));
      },
      256);
}

} // namespace equiaffine

#endif
