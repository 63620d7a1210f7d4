// SPDX-License-Identifier: GPL-3.0-or-later
// Section 2 of the paper: the surface as a graph z = g(x, y), differentiated by the implicit function theorem.
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_DIRECT_ESTIMATE_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_DIRECT_ESTIMATE_H

#include <equiaffine/geometry/internal/affine_estimate.h>
#include <equiaffine/geometry/internal/implicit_derivatives.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine {

namespace internal {

template <class FT>
FT determinant(const std::array<FT, 3>& a, const std::array<FT, 3>& b, const std::array<FT, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The derivatives g_ij of the graph, 1 <= i + j <= 4.
template <class FT>
struct Graph_derivatives {
  std::array<std::array<FT, 5>, 5> g;

  explicit Graph_derivatives(const std::array<FT, Jet_3<FT>::size>& f) {
    static const auto formulas = [] {
      std::array<std::array<Implicit_derivative, 5>, 5> table;
      for (int i = 0; i <= default_order; ++i)
        for (int j = 0; i + j <= default_order; ++j)
          if (i + j > 0) table[std::size_t(i)][std::size_t(j)] = Implicit_derivative(i, j);
      return table;
    }();
    std::array<FT, 8> powers; // of 1 / f_z
    powers[0] = FT(1);
    for (std::size_t n = 1; n < powers.size(); ++n) powers[n] = powers[n - 1] / f[3];
    for (std::size_t i = 0; i < g.size(); ++i)
      for (std::size_t j = 0; i + j < g.size(); ++j)
        if (i + j > 0) g[i][j] = formulas[i][j](f, powers);
  }

  /// A jet of order 1 in x and y: g_ij and its derivatives.
  auto with_gradient(std::size_t i, std::size_t j) const {
    Jet_3<FT, 1, 0b111> jet(g[i][j]);
    jet.template at<1>() = g[i + 1][j];
    jet.template at<2>() = g[i][j + 1];
    return jet;
  }
};

/// Renames the axes cyclically so that `last` becomes z, and returns the derivatives of f by the renamed axes.
template <class FT>
std::array<FT, Jet_3<FT>::size> with_last_axis(const std::array<FT, Jet_3<FT>::size>& f, std::size_t last) {
  std::array<FT, Jet_3<FT>::size> r;
  for (std::size_t n = 0; n < r.size(); ++n) {
    std::array<int, 3> exponents;
    const Monomial_3 m = monomials[n];
    exponents[(last + 1) % 3] = m.i;
    exponents[(last + 2) % 3] = m.j;
    exponents[last] = m.k;
    r[n] = f[std::size_t(monomial_index(exponents[0], exponents[1], exponents[2]))];
  }
  return r;
}

/// The affine normal xi of section 2(d), each component with its derivatives by x and y.
template <class FT>
auto normal_of_graph(const Graph_derivatives<FT>& graph) {
  using std::sqrt;
  const auto x = graph.with_gradient(1, 0), y = graph.with_gradient(0, 1);
  const auto xx = graph.with_gradient(2, 0), xy = graph.with_gradient(1, 1), yy = graph.with_gradient(0, 2);
  const auto xxx = graph.with_gradient(3, 0), xxy = graph.with_gradient(2, 1);
  const auto xyy = graph.with_gradient(1, 2), yyy = graph.with_gradient(0, 3);
  const auto d = xx * yy - xy * xy;
  const auto factor = sqrt(sqrt(d.value() < FT(0) ? -d : d)) / (FT(4) * (d * d));
  const auto xi1 = xx * xy * yyy - xx * yy * xyy - yy * yy * xxx - FT(2) * (xy * xy * xyy) + FT(3) * (yy * xy * xxy);
  const auto xi2 = yy * xy * xxx - xx * yy * xxy - xx * xx * yyy - FT(2) * (xy * xy * xxy) + FT(3) * (xx * xy * xyy);
  const auto xi3 = FT(4) * (xy * xy * xy * xy) + FT(4) * (xx * xx * yy * yy) - FT(8) * (xx * yy * xy * xy) +
                   FT(3) * (x * yy * xy * xxy) + FT(3) * (y * xx * xy * xyy) - x * yy * yy * xxx - y * xx * xx * yyy -
                   FT(2) * (x * xy * xy * xyy) - FT(2) * (y * xy * xy * xxy) - x * xx * yy * xyy - y * xx * yy * xxy +
                   x * xx * xy * yyy + y * yy * xy * xxx;
  return std::array{factor * xi1, factor * xi2, factor * xi3};
}

} // namespace internal

/// The direct method of section 2 with the given axis (0, 1, 2) in the role of z. About 2,200 operations. Not finite
/// where that component of the gradient vanishes.
template <class FT>
Affine_estimate_3<FT> direct_estimate(const Jet_3<FT>& jet, std::size_t axis) {
  using internal::determinant;
  using std::abs;
  using std::sqrt;
  const auto f = internal::with_last_axis(internal::partial_derivatives(jet), axis);
  const internal::Graph_derivatives<FT> graph(f);
  const auto& g = graph.g;
  const auto normal = internal::normal_of_graph(graph);
  std::array<FT, 3> xi, xi_x, xi_y;
  for (std::size_t i = 0; i < 3; ++i) {
    xi[i] = normal[i].template at<0>();
    xi_x[i] = normal[i].template at<1>();
    xi_y[i] = normal[i].template at<2>();
  }
  const std::array<FT, 3> tangent_x = {FT(1), FT(0), g[1][0]}, tangent_y = {FT(0), FT(1), g[0][1]};
  const FT a4 = sqrt(FT(sqrt(FT(abs(g[2][0] * g[0][2] - g[1][1] * g[1][1])))));
  const FT b11 = -determinant(xi_x, tangent_y, xi) / a4, b12 = -determinant(tangent_x, xi_x, xi) / a4;
  const FT b21 = -determinant(xi_y, tangent_y, xi) / a4, b22 = -determinant(tangent_x, xi_y, xi) / a4;

  const FT sign = f[3] < FT(0) ? FT(-1) : FT(1); // the paper orients along the axis, we along the gradient
  const std::array<FT, 3> conormal = {-g[1][0] / a4, -g[0][1] / a4, FT(1) / a4};
  Affine_estimate_3<FT> r;
  for (std::size_t i = 0; i < 3; ++i) {
    r.conormal[(axis + 1 + i) % 3] = sign * conormal[i];
    r.normal[(axis + 1 + i) % 3] = sign * xi[i];
  }
  r.gaussian_curvature = b11 * b22 - b12 * b21;
  r.mean_curvature = sign * (b11 + b22) / FT(2);
  return r;
}

} // namespace equiaffine

#endif
