// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SIGNED_DISTANCES_H
#define EQUIAFFINE_VOLUME_INTERNAL_SIGNED_DISTANCES_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Lattice_3.h>
#include <equiaffine/volume/internal/Lattice_distances.h>
#include <equiaffine/volume/internal/Triangle_tree.h>
#include <equiaffine/volume/internal/check_bounds_volume.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Cartesian_converter.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The triangles of a mesh in a tree, whose slack is for the nodes of a lattice.
template <class Kernel>
Triangle_tree make_triangle_tree(const Distance_mesh& mesh, const Lattice_3<Kernel>& lattice) {
  const CGAL::Cartesian_converter<Side_kernel, Distance_kernel> convert;
  std::vector<Distance_kernel::Triangle_3> triangles;
  triangles.reserve(mesh.number_of_faces());
  CGAL::Bbox_3 box = lattice.bbox();
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    triangles.emplace_back(convert(mesh.point(mesh.source(h))), convert(mesh.point(mesh.target(h))),
                           convert(mesh.point(mesh.target(mesh.next(h)))));
    box += triangles.back().bbox();
  }
  double largest = 0;
  for (int n = 0; n < 3; ++n) largest = std::max({largest, std::abs(box.min(n)), std::abs(box.max(n))});
  const double epsilon = std::max(CGAL::to_double(std::numeric_limits<typename Kernel::FT>::epsilon()),
                                  std::numeric_limits<double>::epsilon());
  // Some ten roundings of coordinates and of their differences lie between a node and its distance.
  return Triangle_tree(std::move(triangles), 32 * epsilon * largest);
}

/// Gives the distances of a row of nodes their signs: side(i) is the side of node i. If the surface separates two
/// neighbors, their distances to it add up to at most the step between them: only then is the side determined anew.
/// Where a distance is missing it is larger than the band.
template <class Iterator, class Side>
void sign_row(Iterator distances, std::size_t count, double step, double band, const Side& side) {
  const double reach = 1.01 * step; // rounding of the distances is less than a hundredth of a step
  double last_distance = 0;
  CGAL::Bounded_side s = CGAL::ON_BOUNDARY;
  for (std::size_t i = 0; i < count; ++i) {
    auto& value = distances[std::ptrdiff_t(i)];
    const double distance = value == value ? CGAL::to_double(value) : band;
    if (s == CGAL::ON_BOUNDARY || distance + last_distance <= reach) s = side(i);
    last_distance = distance;
    if (s == CGAL::ON_BOUNDED_SIDE) value = -value;
    else if (s == CGAL::ON_BOUNDARY) value = 0;
  }
}

/// The signed distances at all nodes of a lattice, in the order of `Volume_3::values`.
template <class ConcurrencyTag, class Kernel, class Progress>
std::vector<typename Kernel::FT> signed_distances(const Distance_mesh& mesh, const Lattice_3<Kernel>& lattice,
                                                  const Progress& on_progress, double band) {
  using FT = typename Kernel::FT;
  const Triangle_tree tree = make_triangle_tree(mesh, lattice);
  Lattice_distances<ConcurrencyTag, Kernel, Progress> measured(tree, lattice, on_progress, band);
  using Side = CGAL::Side_of_triangle_mesh<Distance_mesh, Side_kernel>;
  Side::AABB_tree side_tree(faces(mesh).first, faces(mesh).second, mesh);
  side_tree.build(); // otherwise the first query builds it, and several threads may be first
  const Side side(side_tree);
  const std::size_t nx = lattice.size()[0], ny = lattice.size()[1], nz = lattice.size()[2];
  const double step = std::sqrt(CGAL::to_double(lattice.steps()[0].squared_length()));
  parallel_for<ConcurrencyTag>(0, ny * nz, [&](std::size_t row) {
    sign_row(measured.distances().begin() + std::ptrdiff_t(row * nx), nx, step, band, [&](std::size_t i) {
      const auto p = lattice.point(FT(i), FT(row % ny), FT(row / ny));
      return side(Side_kernel::Point_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())));
    });
  });
  return std::move(measured.distances());
}

} // namespace equiaffine::internal

#endif
