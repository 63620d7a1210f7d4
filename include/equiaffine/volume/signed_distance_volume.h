// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SIGNED_DISTANCE_VOLUME_H
#define EQUIAFFINE_VOLUME_SIGNED_DISTANCE_VOLUME_H

#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/internal/signed_distances.h>

#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/tags.h>

#include <cstddef>
#include <limits>

namespace equiaffine {

/// Computes the distance to a closed triangle mesh at every node of a lattice. It is negative inside, positive outside,
/// and 0 on the surface. A point is inside if an odd number of the mesh's components encloses it, whatever their
/// orientations, so that a shell within a shell is a cavity.
///
/// Signs are exact for the given coordinates, distances correct to a few units in the last place of the coordinates:
/// a distance is the least of those that CGAL computes to the triangles. The result does not depend on the number of
/// threads. `on_progress(n)` is called after every n nodes, from any thread. Nodes farther than `band` from the surface
/// have no value (NaN), which saves most of the time if they are many; by default every node has one.
///
/// Neighboring nodes share the search for what is nearest. It takes time about linear in the nodes if triangles are
/// about as large as steps or larger, and memory linear in triangles and nodes.
///
/// \throws Input_error if the mesh has no faces, faces other than triangles, coordinates that are not finite or beyond
/// 1e15, holes, self-intersections, or triangles that are degenerate or whose squared area is no normal number.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class Kernel, class Progress>
Volume_3<Kernel> signed_distance_volume(const TriangleMesh& mesh, const Lattice_3<Kernel>& lattice,
                                        const Progress& on_progress,
                                        double band = std::numeric_limits<double>::infinity()) {
  internal::Distance_mesh copy;
  CGAL::copy_face_graph(mesh, copy);
  internal::check_bounds_volume(copy);
  return {lattice, internal::signed_distances<ConcurrencyTag>(copy, lattice, on_progress, band)};
}

/// Does the same without reports of progress, and with a value at every node.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class Kernel>
Volume_3<Kernel> signed_distance_volume(const TriangleMesh& mesh, const Lattice_3<Kernel>& lattice) {
  return signed_distance_volume<ConcurrencyTag>(mesh, lattice, [](std::size_t) {});
}

} // namespace equiaffine

#endif
