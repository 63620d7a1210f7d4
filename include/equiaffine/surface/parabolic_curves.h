// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_PARABOLIC_CURVES_H
#define EQUIAFFINE_SURFACE_PARABOLIC_CURVES_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/number/monomials_3.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/Polyline_3.h>
#include <equiaffine/surface/curve_step.h>
#include <equiaffine/surface/internal/parabolic_nodes.h>
#include <equiaffine/surface/sign_change.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine {

/// The curves on which the Gaussian curvature changes its sign, where the affine metric is degenerate and the affine
/// curvatures are infinite.
template <class Kernel>
struct Parabolic_curves_3 {
  std::vector<Polyline_3<Kernel>> polylines;
  std::size_t unconverged_points = 0; ///< left at the linear intersection with an edge of the mesh
};

/// K_e |grad f|^4, a polynomial in the derivatives of f of order 1 and 2 (Goldman: Curvature formulas for implicit
/// curves and surfaces, 2005), with its derivatives up to order 1 or 2. \pre the jet is finite.
template <int Order = 1, class FT>
requires(Order >= 1 && Order <= 2) Jet_3<FT, Order> parabolic_function(const Jet_3<FT>& f) {
  const auto derivative = [&](int i, int j, int k) {
    Jet_3<FT, Order> jet;
    for (std::size_t n = 0; n < jet.size; ++n) {
      const auto& m = internal::monomials[n];
      const int factorials = (m.i == 2 || m.j == 2 || m.k == 2) ? 2 : 1;
      jet.coefficients()[n] = f.derivative(i + m.i, j + m.j, k + m.k) / FT(factorials);
    }
    return jet;
  };
  const auto x = derivative(1, 0, 0), y = derivative(0, 1, 0), z = derivative(0, 0, 1);
  const auto xx = derivative(2, 0, 0), yy = derivative(0, 2, 0), zz = derivative(0, 0, 2);
  const auto xy = derivative(1, 1, 0), xz = derivative(1, 0, 1), yz = derivative(0, 1, 1);
  return (yy * zz - yz * yz) * x * x + (xx * zz - xz * xz) * y * y + (xx * yy - xy * xy) * z * z +
         FT(2) * ((xz * xy - xx * yz) * y * z + (xy * yz - yy * xz) * x * z + (yz * xz - zz * xy) * x * y);
}

namespace internal {

/// The solution of f = 0, d = 0 that Newton's method with steps of least length finds from p; nothing if one of them
/// leads too far away.
template <ImplicitFunctionTraits_3 Traits>
std::optional<typename Traits::Point_3> project_to_parabolic_curve(const Traits& traits,
                                                                   const typename Traits::Point_3& start,
                                                                   const typename Traits::FT& squared_reach) {
  using FT = typename Traits::FT;
  constexpr int maximal_iterations = 30;
  auto p = start;
  for (int n = 0; n < maximal_iterations; ++n) {
    const auto jet = traits.taylor(p);
    const auto step = step_to_curve<typename Traits::Vector_3>(jet, parabolic_function(jet));
    if (!((p + step - start).squared_length() <= squared_reach)) return std::nullopt; // also NaN
    p = p + step;
    const FT rounding = FT(8) * std::numeric_limits<FT>::epsilon();
    if (step.squared_length() <= rounding * rounding * (p - CGAL::ORIGIN).squared_length()) return p;
  }
  return std::nullopt;
}

template <class ConcurrencyTag, class Traits>
class Parabolic_curve_finder_3 {
  using FT = typename Traits::FT;
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Index = std::uint32_t;
  using Edge = std::pair<Index, Index>; // smaller index first
  static constexpr Index none = std::numeric_limits<Index>::max();

public:
  Parabolic_curve_finder_3(const Indexed_triangle_mesh_3<Kernel>& mesh, const Traits& traits)
      : mesh_(mesh), traits_(traits) {}

  Parabolic_curves_3<Kernel> operator()() {
    values_.resize(mesh_.points.size());
    parallel_for<ConcurrencyTag>(
        0, values_.size(),
        [&](std::size_t v) { values_[v] = parabolic_function(traits_.taylor(mesh_.points[v])).value(); }, 256);
    find_segments();
    points_.resize(edges_.size());
    std::vector<std::uint8_t> has_converged(edges_.size());
    parallel_for<ConcurrencyTag>(
        0, edges_.size(), [&](std::size_t e) { has_converged[e] = place_point(e); }, 64);
    find_nodes();
    Parabolic_curves_3<Kernel> curves;
    for (std::size_t e = 0; e < edges_.size(); ++e) curves.unconverged_points += !has_converged[e] && !is_at_node_[e];
    link(curves.polylines);
    return curves;
  }

private:
  /// A segment of a curve in every triangle with different signs at its vertices, between two of its edges.
  void find_segments() {
    std::vector<std::array<Edge, 2>> segments;
    for (const auto& t : mesh_.triangles) {
      std::array<Edge, 2> ends;
      std::size_t n = 0;
      bool is_defined = true;
      for (std::size_t m = 0; m < 3; ++m) {
        const Index a = t[m], b = t[(m + 1) % 3];
        is_defined = is_defined && values_[a] - values_[a] == FT(0);
        if ((values_[a] < FT(0)) != (values_[b] < FT(0))) ends[n++] = std::minmax(a, b);
      }
      if (is_defined && n == 2) segments.push_back(ends);
    }
    for (const auto& [first, second] : segments) {
      edges_.push_back(first);
      edges_.push_back(second);
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    neighbours_.assign(edges_.size(), {none, none});
    const auto position = [&](const Edge& e) {
      return Index(std::lower_bound(edges_.begin(), edges_.end(), e) - edges_.begin());
    };
    for (const auto& [first, second] : segments) {
      const Index a = position(first), b = position(second);
      neighbours_[a][neighbours_[a][0] == none ? 0 : 1] = b;
      neighbours_[b][neighbours_[b][0] == none ? 0 : 1] = a;
    }
  }

  /// From the linear intersection with the edge, not further away than the edge is long.
  bool place_point(std::size_t e) {
    const auto [a, b] = edges_[e];
    const Vector_3 edge = mesh_.points[b] - mesh_.points[a];
    points_[e] = mesh_.points[a] + linear_zero(values_[a], values_[b]) * edge;
    const auto p = project_to_parabolic_curve(traits_, points_[e], edge.squared_length());
    if (p) points_[e] = *p;
    return p.has_value();
  }

  /// Appends the nodes to the points, and makes each a neighbor in place of the points near it: the mesh does not tell
  /// which of them are on which branch.
  void find_nodes() {
    const auto jets = [this](const Point_3& p) {
      const auto jet = traits_.taylor(p);
      return std::pair(jet, parabolic_function<2>(jet));
    };
    is_at_node_.assign(edges_.size(), false);
    std::vector<FT> squared_radii;
    for (Index e = 0; e < edges_.size(); ++e) {
      FT squared_length(0);
      for (const Index m : neighbours_[e])
        if (m != none) squared_length = std::max(squared_length, CGAL::squared_distance(points_[e], points_[m]));
      const double reach = 2 * std::sqrt(CGAL::to_double(squared_length));
      const auto node = node_of_curve_near<Point_3, Vector_3>(points_[e], reach, jets);
      if (!node) continue;
      const auto is_same = [&](const Point_3& p) { return CGAL::squared_distance(p, *node) <= squared_length; };
      if (std::any_of(points_.begin() + std::ptrdiff_t(edges_.size()), points_.end(), is_same)) continue;
      points_.push_back(*node);
      squared_radii.push_back(FT(2) * squared_length);
    }
    std::vector<Index> replacement(points_.size());
    std::iota(replacement.begin(), replacement.end(), Index(0));
    for (Index e = 0; e < edges_.size(); ++e)
      for (std::size_t n = 0; n < squared_radii.size(); ++n)
        if (CGAL::squared_distance(points_[e], points_[edges_.size() + n]) <= squared_radii[n]) {
          replacement[e] = Index(edges_.size() + n);
          is_at_node_[e] = true;
        }
    for (auto& neighbours : neighbours_)
      for (Index& m : neighbours)
        if (m != none) m = replacement[m];
  }

  void link(std::vector<Polyline_3<Kernel>>& polylines) {
    auto is_used = is_at_node_;
    const auto is_node = [this](Index n) { return n != none && n >= edges_.size(); };
    const auto follow = [&](Index first, Index last) {
      Polyline_3<Kernel> line;
      if (is_node(last)) line.points.push_back(points_[last]);
      for (Index here = first; here != none;) {
        line.points.push_back(points_[here]);
        if (is_node(here)) break;
        is_used[here] = true;
        const auto& [p, q] = neighbours_[here];
        const Index next = p != last ? p : q;
        last = here;
        line.is_closed = next == first;
        here = next == none || (!is_node(next) && is_used[next]) ? none : next;
      }
      if (line.points.size() > 1) polylines.push_back(std::move(line));
    };
    for (Index e = 0; e < edges_.size(); ++e)
      if (!is_used[e] && neighbours_[e][1] == none) follow(e, none); // an end, at the border of the mesh
    for (Index e = 0; e < edges_.size(); ++e)
      for (const Index m : neighbours_[e])
        if (!is_used[e] && is_node(m)) follow(e, m);
    for (Index e = 0; e < edges_.size(); ++e)
      if (!is_used[e]) follow(e, none);
  }

  const Indexed_triangle_mesh_3<Kernel>& mesh_;
  const Traits& traits_;
  std::vector<FT> values_; // of the parabolic function at the vertices
  std::vector<Edge> edges_;
  std::vector<std::array<Index, 2>> neighbours_; // along the curve, per edge
  std::vector<bool> is_at_node_;                 // per edge
  std::vector<Point_3> points_;                  // on the edges, then nodes
};

} // namespace internal

/// The parabolic curves of the zero set of f, as polylines with a point for every edge of `mesh` at whose ends K_e has
/// different signs, that end where they cross. `mesh` is what a sampler made of the zero set; its resolution decides
/// which curves are found, and their points lie on f = 0 and K_e = 0 to rounding whatever it is. Curves where K_e
/// touches zero without a change of sign are not found. The same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit
/// for bit.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
Parabolic_curves_3<Kernel_of<Traits>> parabolic_curves(const Indexed_triangle_mesh_3<Kernel_of<Traits>>& mesh,
                                                       const Traits& traits) {
  return internal::Parabolic_curve_finder_3<ConcurrencyTag, Traits>(mesh, traits)();
}

} // namespace equiaffine

#endif
