// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SIGNED_DISTANCE_VOLUME_H
#define EQUIAFFINE_VOLUME_SIGNED_DISTANCE_VOLUME_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/internal/Signed_distance_sampler.h>
#include <equiaffine/volume/internal/check_bounds_solid.h>

#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/number_utils.h>
#include <CGAL/tags.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine {

/// The distance to a closed triangle mesh at every node of a lattice: negative inside, positive outside, 0 on the
/// surface. Inside is what an odd number of its surfaces encloses, whatever their orientations, so that a shell within
/// a shell is a cavity.
///
/// Signs are exact for the given coordinates, distances correct to a few units in the last place of the coordinates.
/// The result does not depend on the number of threads. `on_progress(n)` is called after every n nodes, from any
/// thread. Nodes farther than `band` from the surface have no value (NaN), which saves most of the time if they are
/// many; by default there are none.
///
/// \throws Input_error if the mesh has no faces, faces other than triangles, coordinates that are not finite, holes,
/// degenerate triangles or self-intersections.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class Kernel, class Progress>
Volume_3<Kernel> signed_distance_volume(const TriangleMesh& mesh, const Lattice_3<Kernel>& lattice,
                                        const Progress& on_progress,
                                        double band = std::numeric_limits<double>::infinity()) {
  internal::Distance_mesh copy;
  CGAL::copy_face_graph(mesh, copy);
  internal::check_bounds_solid(copy);
  const internal::Signed_distance_sampler sampler(copy);

  using FT = typename Kernel::FT;
  const auto [nx, ny, nz] = lattice.size();
  const double step = std::sqrt(CGAL::to_double(lattice.steps()[0].squared_length()));
  Volume_3<Kernel> volume{lattice, std::vector<FT>(lattice.number_of_nodes())};
  internal::parallel_for<ConcurrencyTag>(0, ny * nz, [&, nx = nx, ny = ny](std::size_t row) {
    const std::size_t j = row % ny, k = row / ny;
    const auto node = [&](std::size_t i) {
      const auto p = lattice.point(FT(i), FT(j), FT(k));
      return std::array<double, 3>{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
    };
    sampler.sample_row(nx, step, band, node, [&](std::size_t i, double d) { volume.values[row * nx + i] = FT(d); });
    on_progress(nx);
  });
  return volume;
}

template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh, class Kernel>
Volume_3<Kernel> signed_distance_volume(const TriangleMesh& mesh, const Lattice_3<Kernel>& lattice) {
  return signed_distance_volume<ConcurrencyTag>(mesh, lattice, [](std::size_t) {});
}

} // namespace equiaffine

#endif
