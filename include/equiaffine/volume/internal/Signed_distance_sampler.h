// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SIGNED_DISTANCE_SAMPLER_H
#define EQUIAFFINE_VOLUME_INTERNAL_SIGNED_DISTANCE_SAMPLER_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/volume/Lattice_3.h>
#include <equiaffine/volume/internal/check_bounds_volume.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Cartesian_converter.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_utils.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// The kernel in which distances are computed. They are rounded in every kernel of floating-point numbers, and this one
/// is faster.
using Distance_kernel = CGAL::Simple_cartesian<double>;

#if CGAL_VERSION_NR >= 1060000000
template <class Kernel, class Iterator>
using Triangle_tree_traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Iterator>>;
#else
template <class Kernel, class Iterator>
using Triangle_tree_traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator>>;
#endif

/// Measures signed distances at the nodes of a lattice, row by row. The nearest point of one node bounds the search at
/// the next. If the surface separates two neighbors, their distances to it add up to at most the step between them:
/// only then is the side determined anew.
class Signed_distance_sampler {
public:
  explicit Signed_distance_sampler(const Distance_mesh& mesh)
      : triangles_(copy_triangles(mesh)), distance_tree_(triangles_.begin(), triangles_.end()),
        side_tree_(faces(mesh).first, faces(mesh).second, mesh), side_((side_tree_.build(), side_tree_)) {
    distance_tree_.build(); // otherwise the first query builds it, and several threads may be first
    distance_tree_.accelerate_distance_queries();
  }

  /// Calls `store(i, distance)` for the nodes point(0) .. point(count - 1) of a row, {x, y, z} each, which lie `step`
  /// apart. Nodes farther than `band` from the surface get NaN. Where a distance exceeds the band by n steps, the next
  /// n nodes lie outside it, too, and on the same side, so that nothing is measured there.
  template <class Node, class Store>
  void sample_row(std::size_t count, double step, double band, const Node& point, const Store& store) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double reach = 1.01 * step; // rounding of the distances is less than a hundredth of a step
    Distance_kernel::Point_3 nearest;
    double last_distance = 0;
    CGAL::Bounded_side side = CGAL::ON_BOUNDARY;
    for (std::size_t i = 0; i < count; ++i) {
      const auto [x, y, z] = point(i);
      const Distance_kernel::Point_3 p(x, y, z);
      nearest = i == 0 ? distance_tree_.closest_point(p) : distance_tree_.closest_point(p, nearest);
      const double distance = std::sqrt(CGAL::squared_distance(p, nearest));
      if (side == CGAL::ON_BOUNDARY || distance + last_distance <= reach) side = side_(Side_kernel::Point_3(x, y, z));
      last_distance = distance;
      if (distance > band) {
        const double skipped = std::min((distance - band) / reach, double(count - 1 - i));
        for (const std::size_t last = i + std::size_t(skipped); i < last; ++i) store(i, nan);
        last_distance -= skipped * step;
        store(i, nan);
      } else store(i, side == CGAL::ON_BOUNDARY ? 0 : side == CGAL::ON_BOUNDED_SIDE ? -distance : distance);
    }
  }

private:
  using Triangles = std::vector<Distance_kernel::Triangle_3>;
  using Distance_tree = CGAL::AABB_tree<Triangle_tree_traits<Distance_kernel, Triangles::const_iterator>>;
  using Side = CGAL::Side_of_triangle_mesh<Distance_mesh, Side_kernel>;

  /// The triangles of the mesh in the kernel of the distances.
  static Triangles copy_triangles(const Distance_mesh& mesh) {
    const CGAL::Cartesian_converter<Side_kernel, Distance_kernel> convert;
    Triangles triangles;
    triangles.reserve(mesh.number_of_faces());
    for (const auto f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      triangles.emplace_back(convert(mesh.point(mesh.source(h))), convert(mesh.point(mesh.target(h))),
                             convert(mesh.point(mesh.target(mesh.next(h)))));
    }
    return triangles;
  }

  Triangles triangles_;
  Distance_tree distance_tree_;
  Side::AABB_tree side_tree_;
  Side side_;
};

/// The signed distances at all nodes of a lattice, in the order of `Volume_3::values`.
template <class ConcurrencyTag, class Kernel, class Progress>
std::vector<typename Kernel::FT> signed_distances(const Signed_distance_sampler& sampler,
                                                  const Lattice_3<Kernel>& lattice, const Progress& on_progress,
                                                  double band) {
  using FT = typename Kernel::FT;
  const auto [nx, ny, nz] = lattice.size();
  const double step = std::sqrt(CGAL::to_double(lattice.steps()[0].squared_length()));
  std::vector<FT> distances(lattice.number_of_nodes());
  parallel_for<ConcurrencyTag>(0, ny * nz, [&, nx = nx, ny = ny](std::size_t row) {
    const std::size_t j = row % ny, k = row / ny;
    const auto node = [&](std::size_t i) {
      const auto p = lattice.point(FT(i), FT(j), FT(k));
      return std::array<double, 3>{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
    };
    sampler.sample_row(nx, step, band, node, [&](std::size_t i, double d) { distances[row * nx + i] = FT(d); });
    on_progress(nx);
  });
  return distances;
}

} // namespace equiaffine::internal

#endif
