// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes the zero set of a function by Marching Cubes on a lattice.
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_H

#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>
#include <equiaffine/marching_cubes/internal/isosurface_plan.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/linear_isosurface.h>
#include <equiaffine/marching_cubes/internal/node_signs.h>
#include <equiaffine/marching_cubes/internal/vertex_projection.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/to_face_graph.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/surface/internal/explain_sampler.h>

#include <CGAL/Real_timer.h>
#include <CGAL/number_utils.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A box around a block of nodes of the lattice and one layer of nodes around it. Because rounding is monotone, no
/// computed coordinate of a node lies outside those at the corners.
template <class Kernel>
CGAL::Bbox_3 box_around(const Lattice_3<Kernel>& lattice, const Node_block& block) {
  using FT = typename Kernel::FT;
  const auto coordinate = [&](int c, bool is_upper) {
    std::array<FT, 3> node;
    for (std::size_t axis = 0; axis < 3; ++axis)
      node[axis] = (lattice.steps()[axis][c] > FT(0)) == is_upper ? FT(double(block[axis].end))
                                                                  : FT(double(block[axis].first) - 1);
    const auto bounds = CGAL::to_interval(lattice.point(node[0], node[1], node[2])[c]);
    return is_upper ? bounds.second : bounds.first;
  };
  return {coordinate(0, false), coordinate(1, false), coordinate(2, false),
          coordinate(0, true),  coordinate(1, true),  coordinate(2, true)};
}

/// Samples the signs at the nodes of blocks in one thread. Values are computed in batches and discarded.
template <class Traits>
class Block_sampler {
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  using Function = Lattice_function<Traits>;
  static constexpr bool has_samples = Function::has_samples;
  static constexpr std::size_t batch = 64, smallest_block = 4; // nodes in all; nodes along an axis

public:
  Block_sampler(const Function& function, Node_signs& signs) : function_(function), signs_(signs) {}

  std::size_t evaluations() const { return evaluations_; }

  /// Samples all nodes of a block.
  void sample_all(const Node_block& block) {
    if constexpr (has_samples) return read_samples(block);
    for (std::size_t k = block[2].first; k < block[2].end; ++k)
      for (std::size_t j = block[1].first; j < block[1].end; ++j)
        for (std::size_t i = block[0].first; i < block[0].end; i += batch)
          sample_batch(function_.traits(), {{{i, std::min(i + batch, block[0].end)}, {j, j + 1}, {k, k + 1}}});
  }

  /// Halves a block along its long axes until the function's bounds on the block and one layer of nodes around it
  /// have one sign, or the block is small and is sampled. Because of the margin, every cell with a node in a skipped
  /// block is free of the surface, also if the function has no value at some nodes, which its bounds do not show.
  void sample_near_surface(const Node_block& block) { sample_part(function_.traits(), block); }

private:
  /// Reads the signs of the samples of a block, all planes together because k may be the fastest index of the array.
  void read_samples(const Node_block& block) {
    const std::size_t planes = block[2].size();
    std::vector<FT> values(batch * planes);
    for (std::size_t j = block[1].first; j < block[1].end; ++j)
      for (std::size_t i = block[0].first; i < block[0].end; i += batch) {
        const std::size_t n = std::min(batch, block[0].end - i);
        function_.copy_samples({i, j, block[2].first}, {n, 1, planes}, std::span(values).first(n * planes));
        for (std::size_t k = 0; k < planes; ++k)
          signs_.set(i, j, block[2].first + k, sign_word(&values[k * n], n, FT(0)));
      }
  }

  /// Samples a block. `traits` has its values; deep in the recursion it is a part of the function.
  void sample_part(const Batch_function_traits_3<Traits>& traits, const Node_block& block) {
    Node_block in_whole = block;
    for (std::size_t a = 0; a < 3; ++a) {
      in_whole[a].first += function_.first()[a];
      in_whole[a].end += function_.first()[a];
    }
    const auto box = box_around(function_.lattice(), in_whole);
    const Interval bounds = traits.bounds(box);
    if (bounds.upper() < 0) return;
    if (bounds.lower() >= 0) return signs_.set_positive(block);
    const std::size_t longest = std::max({block[0].size(), block[1].size(), block[2].size()});
    if (longest <= smallest_block) return sample_batch(traits, block);
    if constexpr (RestrictableImplicitFunctionTraits_3<Traits>)
      if (auto part = traits.restricted(box))
        return sample_parts(Batch_function_traits_3<Traits>(*std::move(part)), block, longest);
    sample_parts(traits, block, longest);
  }

  /// Halves a block along its long axes.
  void sample_parts(const Batch_function_traits_3<Traits>& traits, const Node_block& block, std::size_t longest) {
    const std::size_t half = (longest / 2 + smallest_block - 1) / smallest_block * smallest_block;
    for (std::size_t k = block[2].first; k < block[2].end; k += half)
      for (std::size_t j = block[1].first; j < block[1].end; j += half)
        for (std::size_t i = block[0].first; i < block[0].end; i += half)
          sample_part(traits, {{{i, std::min(i + half, block[0].end)},
                                {j, std::min(j + half, block[1].end)},
                                {k, std::min(k + half, block[2].end)}}});
  }

  /// Samples a block of at most `batch` nodes whose rows each lie in one word of Node_signs.
  void sample_batch(const Batch_function_traits_3<Traits>& traits, const Node_block& block) {
    const std::size_t n = compute_values(traits, block), row = block[0].size();
    Sign_word signs = sign_word(values_.data(), n, FT(0));
    const auto first_bits = [&](Node_signs::Word word) { return Node_signs::within(word, 0, row); };
    for (std::size_t k = block[2].first; k < block[2].end; ++k)
      for (std::size_t j = block[1].first; j < block[1].end; ++j) {
        signs_.set(block[0].first, j, k, {first_bits(signs.positive), first_bits(signs.undefined)});
        signs.positive >>= row % 64; // a row of 64 is the only row
        signs.undefined >>= row % 64;
      }
  }

  /// Returns the number of values.
  std::size_t compute_values(const Batch_function_traits_3<Traits>& traits, const Node_block& block) {
    std::size_t n = 0;
    for (std::size_t k = block[2].first; k < block[2].end; ++k)
      for (std::size_t j = block[1].first; j < block[1].end; ++j)
        for (std::size_t i = block[0].first; i < block[0].end; ++i) points_[n++] = function_.point({i, j, k});
    traits.values(std::span<const Point_3>(points_).first(n), std::span(values_).first(n));
    evaluations_ += n;
    return n;
  }

  const Function& function_;
  Node_signs& signs_;
  std::size_t evaluations_ = 0;
  std::array<Point_3, batch> points_{};
  std::array<FT, batch> values_{};
};

/// The signs of a function at the nodes of a lattice, and the number of evaluations.
struct Sampled_signs {
  Node_signs signs;
  std::size_t evaluations;
};

/// Whether a function is only evaluated near its zero set, because it has bounds and its values at the nodes are not
/// given. Requires built-in numbers: with others, constants of the function may not convert to intervals.
template <class Traits>
inline constexpr bool skips_empty_space =
    BoundedImplicitFunctionTraits_3<Traits> && !Lattice_function<Traits>::has_samples &&
    std::is_floating_point_v<typename Traits::FT>;

template <class ConcurrencyTag, class Traits>
Sampled_signs sample_signs(const Lattice_function<Traits>& function) {
  constexpr std::size_t planes_per_slab = Lattice_function<Traits>::has_samples ? 16 : 8;
  const auto& size = function.size();
  Node_signs signs(size);
  std::vector<std::size_t> evaluations((size[2] + planes_per_slab - 1) / planes_per_slab); // per slab
  parallel_for<ConcurrencyTag>(0, evaluations.size(), [&](std::size_t s) {
    Block_sampler<Traits> sampler(function, signs);
    const Index_range planes = {planes_per_slab * s, std::min(size[2], planes_per_slab * (s + 1))};
    const Node_block slab = {{{0, size[0]}, {0, size[1]}, planes}};
    if constexpr (skips_empty_space<Traits>) sampler.sample_near_surface(slab);
    else sampler.sample_all(slab);
    evaluations[s] = sampler.evaluations();
  });
  return {std::move(signs), std::accumulate(evaluations.begin(), evaluations.end(), std::size_t(0))};
}

/// Counts the cells that contain the given vertices, which are in the order of their cells.
template <class FT>
std::size_t number_of_cells(const std::vector<Inner_vertex<FT>>& vertices) {
  std::size_t cells = 0;
  for (std::size_t n = 0; n < vertices.size(); ++n)
    if (n == 0 || vertices[n].cell != vertices[n - 1].cell) ++cells;
  return cells;
}

/// Repairs the mesh, then removes the vertices at poles, which the repairs may renumber. `properties` are arrays with
/// one entry per vertex.
template <class Function, class FT, class Kernel, class... Properties>
Repair_report repair_and_remove_poles(const Function& function, const Isosurface_plan& plan,
                                      const std::vector<Inner_vertex<FT>>& inner_vertices, const Grid_rows& suspects,
                                      const std::vector<std::size_t>& poles, Layer_bounds& bounds,
                                      Isosurface_3<Kernel>& surface, Properties&... properties) {
  auto& [points, triangles] = static_cast<Indexed_triangle_mesh_3<Kernel>&>(surface);
  auto& status = surface.vertex_status;
  if (poles.empty())
    return repair_mesh(function, plan, inner_vertices, suspects, bounds, triangles, points, status, properties...);
  std::vector<std::uint8_t> is_at_pole(points.size(), 0);
  for (const std::size_t v : poles) is_at_pole[v] = 1;
  Repair_report report = repair_mesh(function, plan, inner_vertices, suspects, bounds, triangles, points, status,
                                     properties..., is_at_pole);
  remove_poles(surface, is_at_pole, bounds, properties...);
  report.vertices_at_poles = poles.size();
  return report;
}

/// A surface, and the bounds of its layers. `is_undecided` is true if repairs at a cut of the lattice depend on a
/// larger part of it.
template <class Kernel>
struct Isosurface_in_layers {
  Isosurface_3<Kernel> surface;
  Layer_bounds bounds;
  bool is_undecided;
  std::vector<Vertex_id> ids; ///< of the vertices, if requested
};

/// Computes the surface of a function on a lattice or a part of it: first the topology from the signs and values at
/// the nodes, then the vertices.
template <class ConcurrencyTag, bool WithIds = false, class Traits>
Isosurface_in_layers<Kernel_of<Traits>> isosurface_on_lattice(const Lattice_function<Traits>& function,
                                                              Vertex_position position) {
  using FT = typename Traits::FT;
  using Cell = std::array<std::size_t, 3>;
  CGAL::Real_timer timer;
  timer.start();
  const Sampled_signs sampled = sample_signs<ConcurrencyTag>(function);
  const Isosurface_plan plan = plan_isosurface<ConcurrencyTag>(sampled.signs, function, Case_table::instance());
  const std::size_t vertices = plan.numbering.number_of_vertices();
  const std::size_t inner = plan.numbering.number_of_inner_vertices(), edge_vertices = vertices - inner;

  Isosurface_3<Kernel_of<Traits>> surface;
  resize_with_large_pages(surface.points, vertices);
  surface.vertex_status.assign(vertices, Point_status::REGULAR);
  resize_with_large_pages(surface.triangles, plan.numbering.number_of_triangles());
  std::vector<Inner_vertex<FT>> inner_vertices(inner);
  const auto keep_inner = [&](std::size_t v, const Cell& cell, const std::array<FT, 3>& offset) {
    inner_vertices[plan.numbering.place_of_inner(v, cell[2])] = {cell, offset};
  };
  Grid_rows suspects =
      place_linearly<ConcurrencyTag>(function, plan, surface.points.data(), surface.triangles.data(), keep_inner);
  const std::size_t evaluated_cells = plan.number_of_ambiguous_cells() + number_of_cells(inner_vertices);
  surface.function_evaluations =
      sampled.evaluations + Lattice_function<Traits>::evaluations(2 * edge_vertices + 8 * evaluated_cells);
  surface.sampling_seconds = timer.time();

  std::size_t flips_undone = 0;
  std::vector<std::size_t> poles;
  if (position == Vertex_position::PROJECTED) {
    const Projection_report report = project_vertices<ConcurrencyTag>(function, plan, inner_vertices, surface);
    surface.function_evaluations += report.evaluations;
    suspects.add(report.suspects);
    flips_undone = report.flips_undone;
    poles = report.poles;
  }
  Layer_bounds bounds(plan.numbering);
  std::vector<Vertex_id> ids;
  const Repair_report report = [&] {
    const auto repair = [&](auto&... properties) {
      return repair_and_remove_poles(function, plan, inner_vertices, suspects, poles, bounds, surface, properties...);
    };
    if constexpr (!WithIds) return repair();
    ids = vertex_ids<ConcurrencyTag>(function, plan, inner_vertices);
    return repair(ids);
  }();
  distinguish_copies(ids);
  surface.repairs = report;
  surface.repairs.flips_undone = flips_undone;
  surface.projection_seconds = timer.time() - surface.sampling_seconds;
  return {std::move(surface), std::move(bounds), report.is_undecided, std::move(ids)};
}

/// A function on its own lattice, or on a lattice with the resolution of the options. \throw Input_error for bad
/// options
template <class Traits>
Lattice_function<Traits> on_lattice(const Traits& traits, const Marching_cubes_options& options) {
  options.check();
  if constexpr (LatticeImplicitFunctionTraits_3<Traits>) return {traits, traits.lattice()};
  else return {traits, sampling_lattice(traits, options.resolution.nodes())};
}

template <class ConcurrencyTag, class Traits>
Isosurface_3<Kernel_of<Traits>> isosurface_of(const Traits& traits, const Marching_cubes_options& options) {
  return isosurface_on_lattice<ConcurrencyTag>(on_lattice(traits, options), options.vertices).surface;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Meshes the zero set of a function by Marching Cubes (Lorensen, Cline 1987). The result is a triangle mesh with a
/// vertex on every edge of a node grid at whose ends the function has different signs. A value of zero counts as
/// positive. The grid is the lattice of a model of LatticeImplicitFunctionTraits_3, else
/// `sampling_lattice(traits, options.resolution.nodes())`.
///
/// The mesh is an oriented 2-manifold for every input, with boundary where the surface leaves the grid or meets a
/// node without a value (NaN); parts that touch there have separate vertices. Normals point along the gradient. The
/// topology is exactly that of the zero set of the trilinear interpolant of the values, where zero counts as
/// positive. For this, ambiguous cells get inner vertices for a tunnel or a curved disc. Projection does not change
/// the topology: a move that would flip a triangle or leave it without area is undone. Where the surface passes
/// through nodes, triangles without area are contracted or opened, and components without area are dropped. `repairs`
/// counts these changes. Parts of the surface that cross no edge of the grid are not found.
///
/// Where the sign changes along an edge at a pole, which projection detects because |f| grows toward it, the vertex
/// is removed with the triangles around it. The surface ends there, and the mesh is empty if there are only poles.
/// The same holds where f or its derivatives become undefined between two nodes and no zero is found. With LINEAR
/// vertices, poles are not distinguished from zeros. A vertex that could not be projected, for example at a jump,
/// stays at its linear position, is UNCONVERGED, and may be far from the surface.
///
/// Empty space is skipped if the function is a model of BoundedImplicitFunctionTraits_3 and has built-in numbers: f
/// is only evaluated near its zero set. The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit
/// for bit. Takes one evaluation per node (near the surface only, if empty space is skipped), and 4 more plus 4 to 6
/// with gradient per vertex. The memory is that of the output, one bit per node, and a buffer for some planes of
/// nodes.
///
/// The named parameters `geom_traits` and `verbose` are accepted for compatibility with CGAL and ignored.
/// \throw Input_error for bad options
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          internal::Parameter_chain... Parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, const Marching_cubes_options& options = {},
                                               const Parameters&...) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Geom_traits_tag,
                             internal::Verbose_tag>();
  return internal::isosurface_of<ConcurrencyTag>(traits, options);
}

/// The same for the level set f = isovalue. Its points and triangles are appended to the caller's containers, see
/// to_polygon_soup(). The result has no mesh, only the repairs, the status of each point, and the statistics.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, class Points, class Triangles,
          internal::Parameter_chain... Parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, const typename Traits::FT& isovalue,
                                               Points& points, Triangles& triangles,
                                               const Marching_cubes_options& options = {}, const Parameters&...) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Geom_traits_tag,
                             internal::Verbose_tag>();
  auto surface = internal::isosurface_of<ConcurrencyTag>(Level_set_traits_3<Traits>(traits, isovalue), options);
  to_polygon_soup(surface, points, triangles);
  return internal::without_mesh(std::move(surface));
}

/// The same for the zero set, which is added to a model of CGAL's MutableFaceGraph, see to_face_graph(). Vertices are
/// created in the order of `vertex_status` in the result. Further named parameters are
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `vertex_status_map` | writable property map | none | from vertices to Point_status |
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, Face_graph Graph,
          internal::Parameter_chain... Parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, Graph& graph,
                                               const Marching_cubes_options& options = {}, const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_parameters<Joined, internal::Geom_traits_tag, internal::Verbose_tag, internal::Vertex_point_tag,
                             internal::Vertex_status_tag>();
  auto surface = internal::isosurface_of<ConcurrencyTag>(traits, options);
  internal::copy_to_graph(surface, graph, internal::joined_parameters(given...));
  return internal::without_mesh(std::move(surface));
}

/// \cond
// Explains wrong arguments, see explain_sampler.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Traits, class... Others>
void marching_cubes(const Traits&,
                    const Others&...) requires Mistaken_for_sampler<Marching_cubes_options, Traits, Others...> {
  explain_sampler<Marching_cubes_options, Traits, Others...>();
}
/// \endcond

} // namespace equiaffine

#endif
