// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_H
#define EQUIAFFINE_MARCHING_CUBES_H

#include <equiaffine/Batch_function_traits_3.h>
#include <equiaffine/Isosurface_3.h>
#include <equiaffine/internal/marching_cubes_cases.h>
#include <equiaffine/internal/parallel_for.h>
#include <equiaffine/named_parameters.h>
#include <equiaffine/project_to_surface.h>

#include <CGAL/Real_timer.h>
#include <CGAL/tags.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace equiaffine {

namespace internal {

/// Sweeps the nodes in planes of constant k. Memory: the output, and a few numbers per node of two planes.
template <class ConcurrencyTag, class Traits>
class Marching_cubes_3 {
  using FT = typename Traits::FT;
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Index = std::uint32_t;

  enum Sign : std::uint8_t { NEGATIVE, POSITIVE, UNDEFINED };
  static constexpr Index no_vertex = std::numeric_limits<Index>::max();

  struct Plane {
    std::vector<FT> values;
    std::vector<std::uint8_t> signs;
    std::array<std::vector<Index>, 3> vertices; // on the edges that begin at a node, by axis
  };

  struct Crossing {
    std::array<std::uint32_t, 3> node; // the edge runs from here
    std::uint32_t axis;
    FT first, second; // values at its ends
  };

public:
  Marching_cubes_3(const Traits& traits, const Lattice_3<Kernel>& lattice)
      : traits_(traits), lattice_(lattice), is_left_handed_(lattice.determinant() < FT(0)) {}

  Isosurface_3<Kernel> operator()(Vertex_position position) {
    CGAL::Real_timer timer;
    timer.start();
    const auto& n = lattice_.size();
    for (std::size_t k = 0; k < n[2]; ++k) {
      std::swap(planes_[0], planes_[1]);
      evaluate_plane(k);
      if (k > 0)
        for (std::size_t j = 0; j + 1 < n[1]; ++j) emit_row(j, k - 1);
    }
    result_.sampling_seconds = timer.time();
    place_vertices(position);
    result_.projection_seconds = timer.time() - result_.sampling_seconds;
    return std::move(result_);
  }

private:
  void evaluate_plane(std::size_t k) {
    const std::size_t nx = lattice_.size()[0], ny = lattice_.size()[1];
    Plane& plane = planes_[1];
    plane.values.resize(nx * ny);
    plane.signs.resize(nx * ny);
    for (auto& vertices : plane.vertices) vertices.assign(nx * ny, no_vertex);
    parallel_for<ConcurrencyTag>(0, ny, [&](std::size_t j) {
      const std::span<FT> row(plane.values.data() + j * nx, nx);
      evaluate_row(j, k, row);
      for (std::size_t i = 0; i < nx; ++i)
        plane.signs[j * nx + i] = row[i] >= FT(0) ? POSITIVE : row[i] < FT(0) ? NEGATIVE : UNDEFINED;
    });
  }

  void evaluate_row(std::size_t j, std::size_t k, std::span<FT> row) const {
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) {
      for (std::size_t i = 0; i < row.size(); ++i) row[i] = traits_.sample(i, j, k);
    } else {
      std::vector<Point_3> points(row.size());
      for (std::size_t i = 0; i < row.size(); ++i) points[i] = node(i, j, k);
      traits_.values(points, row);
    }
  }

  Point_3 node(std::size_t i, std::size_t j, std::size_t k) const {
    return lattice_.point(FT(double(i)), FT(double(j)), FT(double(k)));
  }

  /// The triangles of the cells between rows j, j + 1 and planes k, k + 1.
  void emit_row(std::size_t j, std::size_t k) {
    const std::size_t nx = lattice_.size()[0];
    const std::uint8_t* rows[4] = {&planes_[0].signs[j * nx], &planes_[0].signs[(j + 1) * nx],
                                   &planes_[1].signs[j * nx], &planes_[1].signs[(j + 1) * nx]};
    const auto& cases = Marching_cubes_cases::instance();
    for (std::size_t i = 0; i + 1 < nx; ++i) {
      unsigned positive = 0, undefined = 0;
      for (unsigned c = 0; c < 8; ++c) {
        const unsigned sign = rows[c >> 1][i + (c & 1)];
        positive |= (sign & 1) << c;
        undefined |= sign >> 1;
      }
      if (undefined || positive == 0 || positive == 255) continue;
      for (const auto& triangle : cases[positive]) {
        std::array<Index, 3> t;
        for (std::size_t m = 0; m < 3; ++m) t[m] = vertex_on(triangle[m], i, j, k);
        if (is_left_handed_) std::swap(t[1], t[2]);
        result_.triangles.push_back(t);
      }
    }
  }

  /// The vertex on an edge of cell (i, j, k), made when it is first asked for.
  Index vertex_on(int edge, std::size_t i, std::size_t j, std::size_t k) {
    const int corner = Marching_cubes_cases::first_corner(edge), axis = edge / 4;
    const std::size_t nx = lattice_.size()[0];
    const std::array<std::size_t, 3> first = {i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2)};
    Plane& plane = planes_[std::size_t(corner >> 2)];
    const std::size_t here = first[1] * nx + first[0];
    Index& vertex = plane.vertices[std::size_t(axis)][here];
    if (vertex == no_vertex) {
      CGAL_precondition(crossings_.size() < no_vertex);
      vertex = Index(crossings_.size());
      const FT& end = axis == 2 ? planes_[1].values[here] : plane.values[here + (axis == 0 ? 1 : nx)];
      crossings_.push_back({{std::uint32_t(first[0]), std::uint32_t(first[1]), std::uint32_t(first[2])},
                            std::uint32_t(axis),
                            plane.values[here],
                            end});
    }
    return vertex;
  }

  void place_vertices(Vertex_position position) {
    const std::size_t n = crossings_.size();
    result_.points.resize(n);
    result_.vertex_status.assign(n, Point_status::REGULAR);
    std::vector<std::uint32_t> evaluations(n, 0);
    parallel_for<ConcurrencyTag>(
        0, n,
        [&](std::size_t v) {
          if (position == Vertex_position::LINEAR) {
            result_.points[v] = linear_intersection(crossings_[v]);
            return;
          }
          const auto surface_point = intersect_edge(crossings_[v]);
          result_.points[v] = surface_point.has_converged ? surface_point.point : linear_intersection(crossings_[v]);
          if (!surface_point.has_converged) result_.vertex_status[v] = Point_status::UNCONVERGED;
          evaluations[v] = std::uint32_t(surface_point.evaluations);
        },
        256);
    if constexpr (!LatticeImplicitFunctionTraits_3<Traits>) result_.function_evaluations = lattice_.number_of_nodes();
    for (std::uint32_t e : evaluations) result_.function_evaluations += e;
  }

  std::array<Point_3, 2> ends(const Crossing& crossing) const {
    auto second = crossing.node;
    ++second[crossing.axis];
    return {node(crossing.node[0], crossing.node[1], crossing.node[2]), node(second[0], second[1], second[2])};
  }

  Point_3 linear_intersection(const Crossing& crossing) const {
    const auto [a, b] = ends(crossing);
    const FT t = crossing.first / (crossing.first - crossing.second);
    return a + (t >= FT(0) && t <= FT(1) ? t : FT(0.5)) * (b - a);
  }

  static FT length(const typename Traits::Vector_3& v) {
    using std::sqrt;
    return sqrt(v.squared_length());
  }

  Surface_point_3<Kernel> intersect_edge(const Crossing& crossing) const {
    const auto [a, b] = ends(crossing);
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) {
      // The spline need not have the signs of the samples: if it has no sign change here, its zero is looked for nearby.
      const FT fa = traits_.value(a), fb = traits_.value(b);
      const bool has_sign_change = (fa >= FT(0) && fb < FT(0)) || (fa < FT(0) && fb >= FT(0));
      auto result = has_sign_change ? intersect_segment(traits_, a, b, fa, fb)
                                    : project_to_surface(traits_, linear_intersection(crossing), length(b - a));
      result.evaluations += 2;
      return result;
    } else {
      return intersect_segment(traits_, a, b, crossing.first, crossing.second);
    }
  }

  const Batch_function_traits_3<Traits> traits_;
  const Lattice_3<Kernel> lattice_;
  const bool is_left_handed_;
  std::array<Plane, 2> planes_; // k and k + 1
  std::vector<Crossing> crossings_;
  Isosurface_3<Kernel> result_;
};

} // namespace internal

/// The zero set of a function, by Marching Cubes (Lorensen, Cline 1987): a triangle mesh with a vertex on every edge of a
/// node grid at whose ends the function has different signs. A value of zero counts as positive. The grid is the lattice of a model of
/// LatticeImplicitFunctionTraits_3, else `sampling_lattice(traits, number_of_nodes)`.
///
/// The mesh is an oriented 2-manifold for every input, with boundary where the surface leaves the grid or meets a node
/// without a value (NaN); normals point along the gradient. Vertices stay on their grid edges when projected, so
/// projection changes neither the topology nor the orientation of the triangles' projections along the axes. Nothing is found
/// where the surface crosses no grid edge. A vertex at a node with value exactly zero can make triangles of zero area.
///
/// Named parameters: `number_of_nodes` (64), `vertex_position` (PROJECTED).
/// The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Time: one evaluation per node, 4
/// to 6 with gradient per vertex. Memory: output plus O(nodes of a plane).
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          class NamedParameters = internal::No_parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, const NamedParameters& parameters = {}) {
  using Size = std::array<std::size_t, 3>;
  const auto lattice = [&] {
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) return traits.lattice();
    else
      return sampling_lattice(traits,
                              internal::get_parameter<internal::Number_of_nodes_tag>(parameters, Size{64, 64, 64}));
  }();
  const auto position = internal::get_parameter<internal::Vertex_position_tag>(parameters, Vertex_position::PROJECTED);
  return internal::Marching_cubes_3<ConcurrencyTag, Traits>(traits, lattice)(position);
}

} // namespace equiaffine

#endif
