// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes in slabs of a lattice, for meshes larger than memory, and in blocks of its cells.
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_IN_SLABS_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_IN_SLABS_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/volume/Cell_block.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

namespace equiaffine {

/// The part of a mesh between planes of nodes: the vertices on edges that begin in the planes from `first_plane` to
/// `end_plane` - 1 and in the cells above these, and the triangles of these cells. In the whole mesh, the vertices
/// and triangles of a slab directly follow those of the previous slab.
///
/// For the mesh of a block of cells, `first_plane` and `end_plane` are layers of cells. The triangles are those of
/// these layers, and the vertices are those of the triangles that no earlier slab contains.
template <class Kernel>
struct Isosurface_slab_3 {
  std::size_t first_plane;                      ///< the first plane of nodes along k
  std::size_t end_plane;                        ///< one past the last plane of nodes
  std::size_t first_vertex;                     ///< the index of the first vertex in the whole mesh
  std::size_t first_triangle;                   ///< the index of the first triangle in the whole mesh
  std::vector<typename Kernel::Point_3> points; ///< of the vertices
  std::vector<Point_status> vertex_status;      ///< one per point, as in Isosurface_3
  /// Three vertex indices each, in the whole mesh: vertices of this slab, the next one, or earlier ones.
  std::vector<std::array<std::size_t, 3>> triangles;
  /// The id of each point, for the mesh of a block of cells.
  std::vector<Vertex_id> vertex_ids = {};
  /// For the mesh of a block of cells, the smallest id in the triangles of the whole mesh at each point. The vertex
  /// belongs to the block that contains the cell of this id.
  std::vector<Vertex_id> least_ids = {};
};

/// Totals of a mesh that was computed slab by slab.
struct Isosurface_totals {
  std::size_t vertices = 0;             ///< of the whole mesh
  std::size_t triangles = 0;            ///< of the whole mesh
  std::size_t function_evaluations = 0; ///< of f, with or without derivatives; repeated for nodes near seams
};

/// The number of layers of cells around a block that must be known to mesh the block.
inline constexpr std::size_t cells_around_block = 4;

} // namespace equiaffine

namespace equiaffine::internal {

/// \throw std::invalid_argument unless a block is not empty, lies in the lattice, and enough cells around it are
/// known
inline void check_block(const Cell_block& all, const Cell_block& block, const Cell_block& known) {
  const Cell_block needed = widened(block, cells_around_block, all);
  for (std::size_t a = 0; a < 3; ++a) {
    check_argument(block.first[a] < block.end[a] && block.end[a] <= all.end[a],
                   "a block has no cells or extends beyond the lattice: choose cells of the lattice");
    check_argument(known.first[a] <= needed.first[a] && needed.end[a] <= known.end[a] && known.end[a] <= all.end[a],
                   "too few cells around a block are known to mesh it: give `cells_around_block` on each side, or all "
                   "up to the end of the lattice");
  }
}

/// Computes the part of a surface that belongs to a block of cells, in slabs. The ids of a triangle's vertices
/// determine the cell to which it belongs, also after repairs, so that blocks are independent of each other. A slab
/// is computed with a margin of cells on all sides, as wide as the repairs near it require.
template <class ConcurrencyTag, class Traits>
class Isosurface_of_block {
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Part = Isosurface_in_layers<Kernel>;

public:
  /// The function may only be evaluated in the `known` cells.
  Isosurface_of_block(const Lattice_function<Traits>& function, const Slab_options& options, const Cell_block& block,
                      const Cell_block& known)
      : function_(function), position_(options.sampling.vertices), layers_per_slab_(options.planes_per_slab),
        block_(block), known_(known) {}

  template <class Visit>
  Isosurface_totals run(const Visit& visit) {
    for (std::size_t first = block_.first[2]; first < block_.end[2]; first += layers_per_slab_) {
      Cell_block layers = block_;
      layers.first[2] = first;
      layers.end[2] = std::min(first + layers_per_slab_, block_.end[2]);
      visit(slab(layers));
    }
    return totals_;
  }

private:
  /// A vertex of earlier slabs that the next slab may share.
  struct Shared_vertex {
    std::size_t number;
    Point_3 point;
  };

  Isosurface_slab_3<Kernel> slab(const Cell_block& layers) {
    for (std::size_t margin = cells_around_block;; margin *= 2) {
      const Cell_block cells = widened(layers, margin, known_);
      const Part part = isosurface_on_lattice<ConcurrencyTag, true>(
          function_.part(cells.first, {cells.end[0] + 1, cells.end[1] + 1, cells.end[2] + 1}), position_);
      totals_.function_evaluations += part.surface.function_evaluations;
      if (!part.is_undecided && agrees_with_slabs_before(part)) return taken_from(part, layers);
      const Cell_block more = widened(layers, 2 * margin, known_);
      if (more == cells) return taken_from(part, layers);
    }
  }

  /// Whether the vertices of earlier slabs have the same positions here, or do not occur.
  bool agrees_with_slabs_before(const Part& part) const {
    if (shared_.empty()) return true;
    for (std::size_t v = 0; v < part.ids.size(); ++v)
      if (const auto found = shared_.find(part.ids[v]);
          found != shared_.end() && found->second.point != part.surface.points[v])
        return false;
    return true;
  }

  Isosurface_slab_3<Kernel> taken_from(const Part& part, const Cell_block& layers) {
    constexpr std::size_t unused = std::numeric_limits<std::size_t>::max(), used = unused - 1;
    Isosurface_slab_3<Kernel> slab{layers.first[2], layers.end[2], totals_.vertices, totals_.triangles, {}, {}, {}};
    const auto& nodes = function_.lattice().size();
    std::vector<std::size_t> number(part.ids.size(), unused);
    std::vector<Vertex_id> least_ids = part.ids;
    for (const auto& triangle : part.surface.triangles) {
      const auto& [a, b, c] = triangle;
      const Vertex_id least = std::min({part.ids[a], part.ids[b], part.ids[c]});
      for (const auto v : triangle) least_ids[v] = std::min(least_ids[v], least);
      if (!layers.contains(cell_of(least, nodes))) continue;
      slab.triangles.push_back({a, b, c});
      number[a] = number[b] = number[c] = used;
    }
    std::unordered_map<Vertex_id, Shared_vertex> shared;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] == unused) continue;
      const auto& p = part.surface.points[v];
      if (const auto found = shared_.find(part.ids[v]); found != shared_.end()) {
        number[v] = found->second.number;
      } else {
        number[v] = totals_.vertices + slab.points.size();
        slab.points.push_back(p);
        slab.vertex_status.push_back(part.surface.vertex_status[v]);
        slab.vertex_ids.push_back(part.ids[v]);
        slab.least_ids.push_back(least_ids[v]);
      }
      if (cell_of(part.ids[v], nodes)[2] >= layers.end[2]) shared.try_emplace(part.ids[v], Shared_vertex{number[v], p});
    }
    for (auto& triangle : slab.triangles)
      for (std::size_t& v : triangle) v = number[v];
    shared_ = std::move(shared);
    totals_.vertices += slab.points.size();
    totals_.triangles += slab.triangles.size();
    return slab;
  }

  const Lattice_function<Traits>& function_;
  const Vertex_position position_;
  const std::size_t layers_per_slab_;
  const Cell_block block_, known_;
  Isosurface_totals totals_;
  std::unordered_map<Vertex_id, Shared_vertex> shared_;
};

/// Computes a surface in slabs, each with a margin of planes on both sides that is as wide as the repairs near its
/// seams require. Its vertices at the seam to the previous slab must equal, bit for bit, those that the previous slab
/// has found there.
template <class ConcurrencyTag, class Traits>
class Isosurface_in_slabs {
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;

public:
  Isosurface_in_slabs(const Lattice_function<Traits>& function, const Slab_options& options)
      : function_(function), position_(options.sampling.vertices), planes_per_slab_(options.planes_per_slab) {}

  template <class Visit>
  Isosurface_totals run(const Visit& visit) {
    const std::size_t planes = function_.size()[2];
    for (std::size_t first = 0; first < planes; first += planes_per_slab_)
      visit(slab(first, std::min(first + planes_per_slab_, planes)));
    return totals_;
  }

private:
  /// The surface of some planes, and the index of the first plane.
  struct Part {
    std::size_t first_plane;
    Isosurface_in_layers<Kernel> layers;

    std::size_t first_vertex(std::size_t plane) const { return layers.bounds.vertices[plane - first_plane]; }
    std::size_t first_triangle(std::size_t plane) const { return layers.bounds.triangles[plane - first_plane]; }

    /// The points on edges that begin in a plane, and in the cells above it.
    std::span<const Point_3> points_at(std::size_t plane) const {
      const std::size_t first = first_vertex(plane);
      return std::span<const Point_3>(layers.surface.points).subspan(first, first_vertex(plane + 1) - first);
    }
  };

  Part part_around(std::size_t first, std::size_t end, std::size_t margin) {
    const std::size_t first_plane = first - std::min(first, margin);
    const auto& [nx, ny, nz] = function_.size();
    const std::size_t end_plane = std::min(end + margin, nz);
    Part part{first_plane, isosurface_on_lattice<ConcurrencyTag>(
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
  std::vector<Point_3> seam_; // the points that the last slab has found in the first plane of the next one
};

} // namespace equiaffine::internal

namespace equiaffine {

/// Meshes the zero set of a function like marching_cubes(), but one slab of planes of nodes at a time, for meshes
/// larger than memory. Calls visit(slab) with an `Isosurface_slab_3<Kernel>` for each slab. Together, the slabs are
/// the mesh of marching_cubes(), bit for bit and in the same order, for every number of planes per slab.
///
///     std::ofstream file("faces.txt");
///     marching_cubes_in_slabs(traits, [&](const Isosurface_slab_3<Kernel>& slab) {
///       for (const auto& [a, b, c] : slab.triangles) file << a << ' ' << b << ' ' << c << '\n';
///     });
///
/// Takes the memory of a slab with 8 additional planes, and the time of marching_cubes() for the same number of
/// planes. Where a closed part of the surface without area extends beyond these planes, for example because f only
/// touches zero, the slab is computed again with more of them.
/// \throw Input_error for bad options
/// \throw std::runtime_error if the repairs near a seam depend on the surface far from it, which has not been
/// observed for any function
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, class Visit>
Isosurface_totals marching_cubes_in_slabs(const Traits& traits, const Visit& visit, const Slab_options& options = {}) {
  options.check();
  const auto function = internal::on_lattice(traits, options.sampling);
  return internal::Isosurface_in_slabs<ConcurrencyTag, Traits>(function, options).run(visit);
}

/// Meshes the zero set of a function in a block of cells of its lattice, one slab at a time, with vertex ids. The
/// meshes of all blocks, for example from different processes, together are the mesh of marching_cubes(): every
/// triangle is in exactly one of them, with the same points and ids, and vertices at the sides of blocks are in each
/// block that has triangles there.
///
/// The function is only evaluated in the `known` cells, by default all cells of the lattice. They must extend
/// `cells_around_block` beyond the block on each side, or to the end of the lattice. Where a closed part without area
/// extends beyond all known cells, blocks may disagree on whether to drop it, and some may keep its triangles.
/// \throw Input_error for bad options
/// \throw std::invalid_argument unless the block is not empty, lies in the lattice, and enough cells around it are
/// known
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, class Visit>
Isosurface_totals marching_cubes_of_block(const Traits& traits, const Cell_block& block, const Visit& visit,
                                          const Slab_options& options = {},
                                          const std::optional<Cell_block>& known = std::nullopt) {
  options.check();
  const auto function = internal::on_lattice(traits, options.sampling);
  const Cell_block all = cells_of(function.lattice().size());
  internal::check_block(all, block, known.value_or(all));
  return internal::Isosurface_of_block<ConcurrencyTag, Traits>(function, options, block, known.value_or(all))
      .run(visit);
}

} // namespace equiaffine

#endif
