// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_IN_SLABS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_IN_SLABS_H

#include <equiaffine/marching_cubes/Isosurface_slab_3.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/lattice_isosurface.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Makes a surface in slabs. Each one is made with some planes more on both sides, as many as the repairs beside its
/// seams look at. What it has at the seam to the slab before must be, bit for bit, what that one had found there.
template <class ConcurrencyTag, bool SkipsEmptySpace, class Traits>
class Isosurface_in_slabs {
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;

public:
  Isosurface_in_slabs(const Lattice_function<Traits>& function, Vertex_position position, std::size_t planes_per_slab)
      : function_(function), position_(position), planes_per_slab_(planes_per_slab) {}

  template <class Visit>
  Isosurface_totals run(const Visit& visit) {
    const std::size_t planes = function_.size()[2];
    for (std::size_t first = 0; first < planes; first += planes_per_slab_)
      visit(slab(first, std::min(first + planes_per_slab_, planes)));
    return totals_;
  }

private:
  /// A surface of some planes, with the number of the first of them.
  struct Part {
    std::size_t first_plane;
    Isosurface_in_layers<Kernel> layers;

    std::size_t first_vertex(std::size_t plane) const { return layers.bounds.vertices[plane - first_plane]; }
    std::size_t first_triangle(std::size_t plane) const { return layers.bounds.triangles[plane - first_plane]; }

    /// The points on edges that begin in a plane, and in the cells above.
    std::span<const Point_3> points_at(std::size_t plane) const {
      const std::size_t first = first_vertex(plane);
      return std::span<const Point_3>(layers.surface.points).subspan(first, first_vertex(plane + 1) - first);
    }
  };

  Part part_around(std::size_t first, std::size_t end, std::size_t margin) {
    const std::size_t first_plane = first - std::min(first, margin);
    const auto& [nx, ny, nz] = function_.size();
    const std::size_t end_plane = std::min(end + margin, nz);
    Part part{first_plane, isosurface_on_lattice<ConcurrencyTag, SkipsEmptySpace>(
                               function_.part({0, 0, first_plane}, {nx, ny, end_plane}), position_)};
    totals_.function_evaluations += part.layers.surface.function_evaluations;
    return part;
  }

  bool agrees_at_seam(const Part& part, std::size_t plane) const {
    if (plane == 0) return true;
    const auto points = part.points_at(plane);
    return std::equal(points.begin(), points.end(), seam_.begin(), seam_.end());
  }

  Isosurface_slab_3<Kernel> slab(std::size_t first, std::size_t end) {
    constexpr std::size_t usual_margin = 4;
    const std::size_t planes = function_.size()[2];
    for (std::size_t margin = usual_margin;; margin *= 2) {
      const Part part = part_around(first, end, margin);
      if (!part.layers.is_undecided && agrees_at_seam(part, first)) return taken_from(part, first, end);
      if (margin >= planes)
        throw std::runtime_error("the surface is degenerate at a seam of slabs: choose more planes per slab");
    }
  }

  Isosurface_slab_3<Kernel> taken_from(const Part& part, std::size_t first, std::size_t end) {
    const auto& surface = part.layers.surface;
    Isosurface_slab_3<Kernel> slab{first, end, totals_.vertices, totals_.triangles, {}, {}, {}};
    const std::size_t vertex = part.first_vertex(first), end_vertex = part.first_vertex(end);
    slab.points.assign(surface.points.begin() + std::ptrdiff_t(vertex),
                       surface.points.begin() + std::ptrdiff_t(end_vertex));
    slab.vertex_status.assign(surface.vertex_status.begin() + std::ptrdiff_t(vertex),
                              surface.vertex_status.begin() + std::ptrdiff_t(end_vertex));
    const std::size_t triangle = part.first_triangle(first), end_triangle = part.first_triangle(end);
    slab.triangles.reserve(end_triangle - triangle);
    for (std::size_t t = triangle; t < end_triangle; ++t) {
      const auto& [a, b, c] = surface.triangles[t];
      slab.triangles.push_back(
          {a - vertex + totals_.vertices, b - vertex + totals_.vertices, c - vertex + totals_.vertices});
    }
    seam_.clear();
    if (end < function_.size()[2]) seam_.assign(part.points_at(end).begin(), part.points_at(end).end());
    totals_.vertices += slab.points.size();
    totals_.triangles += slab.triangles.size();
    return slab;
  }

  const Lattice_function<Traits>& function_;
  const Vertex_position position_;
  const std::size_t planes_per_slab_;
  Isosurface_totals totals_;
  std::vector<Point_3> seam_; // what the slab before has found in the first plane of the next one
};

} // namespace equiaffine::internal

#endif
