// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_LATTICE_FUNCTION_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_LATTICE_FUNCTION_H

#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>
#include <equiaffine/volume/Lattice_3.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// The values of a function at the nodes of a lattice, taken from samples if there are any: a Grid as in
/// isosurface_numbering.h.
template <class Traits>
class Lattice_function {
public:
  using FT = typename Traits::FT;
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Point = Point_3;
  using Node = std::array<std::size_t, 3>;
  using Offset = std::array<FT, 3>; ///< from the first node of a cell, in steps of the lattice
  static constexpr bool has_samples = LatticeImplicitFunctionTraits_3<Traits>;

  /// The ends of an edge of the lattice and the values there.
  struct Edge {
    std::array<Point_3, 2> ends;
    std::array<FT, 2> values;

    Point_3 linear_intersection() const { return ends[0] + linear_zero(values[0], values[1]) * (ends[1] - ends[0]); }
    bool ends_at(const Point_3& p) const { return coincide(p, ends[0]) || coincide(p, ends[1]); }
  };

  Lattice_function(const Traits& traits, const Lattice_3<Kernel>& lattice)
      : Lattice_function(Batch_function_traits_3<Traits>(traits), lattice, {0, 0, 0}, lattice.size()) {}

  /// The part with the nodes from `first` up to, but not including, `end` along each axis. It has its own node
  /// indices, which begin at 0.
  Lattice_function part(const Node& first, const Node& end) const {
    return Lattice_function(traits_, lattice_, first, {end[0] - first[0], end[1] - first[1], end[2] - first[2]});
  }

  /// The same function for a block of cells, which may take less memory.
  Lattice_function
  restricted_to_cells(const Cell_block& cells) const requires CellwiseImplicitFunctionTraits_3<Traits> {
    return Lattice_function(traits_.restricted_to_cells({in_whole(cells.first), in_whole(cells.end)}), lattice_, first_,
                            size_);
  }

  const Node& size() const { return size_; }   ///< the number of nodes along each axis
  const Node& first() const { return first_; } ///< the node of the lattice at which this part begins

  std::size_t index_in_whole(const Node& n) const {
    const Node node = in_whole(n);
    return lattice_.index(node[0], node[1], node[2]);
  }
  bool is_at_cut(const Grid_edge& e) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (a == e.axis) continue;
      if (e.node[a] == 0 && first_[a] > 0) return true;
      if (e.node[a] + 1 == size_[a] && first_[a] + size_[a] < lattice_.size()[a]) return true;
    }
    return false;
  }

  const Batch_function_traits_3<Traits>& traits() const { return traits_; }
  const Lattice_3<Kernel>& lattice() const { return lattice_; }
  static FT isovalue() { return FT(0); }
  bool is_left_handed() const { return lattice_.determinant() < FT(0); }
  static std::array<FT, 3> coordinates(const Point_3& p) { return {p.x(), p.y(), p.z()}; }

  Point_3 point(const Node& n) const {
    return lattice_.point(number(first_[0] + n[0]), number(first_[1] + n[1]), number(first_[2] + n[2]));
  }
  Point_3 point(const Node& cell, const Offset& offset) const {
    return lattice_.point(number(first_[0] + cell[0]) + offset[0], number(first_[1] + cell[1]) + offset[1],
                          number(first_[2] + cell[2]) + offset[2]);
  }

  /// The value at node n, whose position is p.
  FT value(const Node& n, const Point_3& p) const {
    if constexpr (has_samples) return traits_.sample(first_[0] + n[0], first_[1] + n[1], first_[2] + n[2]);
    else return traits_.value(p);
  }

  /// Copies the samples of a block of nodes, i fastest.
  void copy_samples(const Node& first, const Node& size, std::span<FT> out) const requires has_samples {
    samples(traits_, in_whole(first), size, out);
  }

  Edge edge(const Grid_edge& e) const {
    const Node end = end_of(e);
    const std::array<Point_3, 2> ends = {point(e.node), point(end)};
    return {ends, {value(e.node, ends[0]), value(end, ends[1])}};
  }

  /// The same for many edges at once.
  std::vector<Edge> edges(std::span<const Grid_edge> grid_edges) const {
    std::vector<Edge> result(grid_edges.size());
    if constexpr (has_samples) {
      for (std::size_t n = 0; n < result.size(); ++n) result[n] = edge(grid_edges[n]);
    } else {
      std::vector<Point_3> points;
      points.reserve(2 * result.size());
      for (const Grid_edge& e : grid_edges) {
        points.push_back(point(e.node));
        points.push_back(point(end_of(e)));
      }
      std::vector<FT> values(points.size());
      traits_.values(points, values);
      for (std::size_t n = 0; n < result.size(); ++n)
        result[n] = {{points[2 * n], points[2 * n + 1]}, {values[2 * n], values[2 * n + 1]}};
    }
    return result;
  }

  bool is_nearer_to_end(const Grid_edge& e, const Point_3& p) const {
    return (point(end_of(e)) - p).squared_length() < (p - point(e.node)).squared_length();
  }

  Point_3 moved(const Point_3& p, std::size_t axis, double steps) const {
    return p + FT(steps) * lattice_.steps()[axis];
  }

  std::array<FT, 8> cell_values(const Node& cell) const {
    std::array<FT, 8> f;
    for (std::size_t c = 0; c < 8; ++c) {
      const Node node = {cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)};
      f[c] = value(node, point(node));
    }
    return f;
  }

  /// The number of evaluations of the function for the values at n nodes.
  static constexpr std::size_t evaluations(std::size_t n) { return has_samples ? 0 : n; }

private:
  Lattice_function(const Batch_function_traits_3<Traits>& traits, const Lattice_3<Kernel>& lattice, const Node& first,
                   const Node& size)
      : traits_(traits), lattice_(lattice), first_(first), size_(size) {}

  Node in_whole(const Node& n) const { return {first_[0] + n[0], first_[1] + n[1], first_[2] + n[2]}; }

  static Node end_of(const Grid_edge& e) {
    const auto& [i, j, k] = e.node;
    return {i + (e.axis == 0), j + (e.axis == 1), k + (e.axis == 2)};
  }
  static bool coincide(const Point_3& p, const Point_3& q) {
    return p.x() == q.x() && p.y() == q.y() && p.z() == q.z();
  }
  static FT number(std::size_t n) { return FT(double(std::ptrdiff_t(n))); } // signed: converts in one instruction

  const Batch_function_traits_3<Traits> traits_;
  const Lattice_3<Kernel> lattice_;
  const Node first_, size_;
};

} // namespace equiaffine::internal

#endif
