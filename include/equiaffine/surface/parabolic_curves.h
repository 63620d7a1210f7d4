// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the parabolic curves of the zero set of a function.
#ifndef EQUIAFFINE_SURFACE_PARABOLIC_CURVES_H
#define EQUIAFFINE_SURFACE_PARABOLIC_CURVES_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/monomials_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>
#include <CGAL/tags.h>
#include <Eigen/Dense>

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
  std::vector<Polyline_3<Kernel>> polylines; ///< the curves
  std::size_t unconverged_points = 0; ///< the number of points left at linear interpolation along an edge of the mesh
};

} // namespace equiaffine

namespace equiaffine::internal {

/// K_e |grad f|^4, a polynomial in the derivatives of f of order 1 and 2 (Goldman: Curvature formulas for implicit
/// curves and surfaces, 2005), with its derivatives up to order 1 or 2. \pre the jet is finite
template <int Order = 1, class FT>
requires(Order >= 1 && Order <= 2) Jet_3<FT, Order> parabolic_function(const Jet_3<FT>& f) {
  const auto derivative = [&](int i, int j, int k) {
    Jet_3<FT, Order> jet;
    for (std::size_t n = 0; n < jet.size; ++n) {
      const auto& m = monomials[n];
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

/// Finds a point at most `reach` from `start` where two branches of the curve f = d = 0 cross. It is a saddle of d on
/// f = 0, found by Newton's method for f = 0, grad d = m grad f. `jets(p)` returns the jets of f and d, of order at
/// least 2.
template <class Point_3, class Vector_3, class Jets>
std::optional<Point_3> crossing_near(const Point_3& start, double reach, const Jets& jets) {
  constexpr int maximal_iterations = 20;
  Point_3 p = start;
  std::optional<double> multiplier;
  for (int n = 0; n < maximal_iterations; ++n) {
    const auto [f, d] = jets(p);
    const Eigen::Vector3d f1 = eigen_gradient(f), d1 = eigen_gradient(d);
    const double norm = f1.norm();
    if (!multiplier) multiplier = f1.dot(d1) / (norm * norm);
    const Eigen::Matrix3d hessian = eigen_hessian(d) - *multiplier * eigen_hessian(f);
    Eigen::Matrix4d jacobian = Eigen::Matrix4d::Zero();
    jacobian.topLeftCorner<3, 3>() = hessian;
    jacobian.topRightCorner<3, 1>() = -f1;
    jacobian.bottomLeftCorner<1, 3>() = f1.transpose();
    Eigen::Vector4d defect;
    defect << d1 - *multiplier * f1, CGAL::to_double(f.value());
    const Eigen::Vector4d step = -jacobian.fullPivLu().solve(defect);
    p = p + Vector_3(step[0], step[1], step[2]);
    *multiplier += step[3];
    if (!(CGAL::to_double(CGAL::squared_distance(p, start)) <= reach * reach)) return std::nullopt; // also for NaN
    const double length = step.head<3>().norm();
    if (length > 1e-9 * reach) continue;
    // With the gradient of f replaced by the unit normal, minus the determinant is that of the Hessian of d in the
    // tangent plane, which is negative at a saddle.
    jacobian.topRightCorner<3, 1>() = f1 / norm;
    jacobian.bottomLeftCorner<1, 3>() = f1.transpose() / norm;
    const double scale = hessian.norm(), determinant = -jacobian.determinant();
    // Both are relative: to the square of the Hessian, and to the size of d at the distance `reach`.
    constexpr double least_determinant = 1e-4, negligible_value = 1e-6;
    if (!(determinant < -least_determinant * scale * scale)) return std::nullopt;
    if (!(std::abs(CGAL::to_double(d.value())) <= negligible_value * scale * reach * reach)) return std::nullopt;
    return p;
  }
  return std::nullopt;
}

/// Returns the solution of f = 0, d = 0 to which Newton's method with minimum-norm steps converges from `start`, or
/// nothing if a step leads too far away.
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
    if (!((p + step - start).squared_length() <= squared_reach)) return std::nullopt; // also for NaN
    p = p + step;
    const FT rounding = FT(8) * std::numeric_limits<FT>::epsilon();
    if (step.squared_length() <= rounding * rounding * (p - CGAL::ORIGIN).squared_length()) return p;
  }
  return std::nullopt;
}

/// Intersects the edges of a mesh with the curves, moves the points onto the curves, and links them to polylines.
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

  Parabolic_curves_3<Kernel> find() {
    values_.resize(mesh_.points.size());
    is_negligible_.resize(mesh_.points.size());
    parallel_for<ConcurrencyTag>(
        0, values_.size(), [&](std::size_t v) { evaluate(v); }, 256);
    look_beside_negligible_values();
    connect_edges(find_segments());
    points_.resize(edges_.size());
    std::vector<std::uint8_t> has_converged(edges_.size());
    parallel_for<ConcurrencyTag>(
        0, edges_.size(), [&](std::size_t e) { has_converged[e] = place_point(e); }, 64);
    join_at_crossings(find_crossings());
    Parabolic_curves_3<Kernel> curves;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      curves.unconverged_points += !has_converged[e] && !is_at_crossing_[e];
    curves.polylines = trace_polylines();
    return curves;
  }

private:
  using Segment = std::array<Edge, 2>;

  /// Computes the value at vertex v. It is negligible if it may be due to rounding of its terms, which are products
  /// of two first and two second derivatives. On a cone or a cylinder all values are negligible.
  void evaluate(std::size_t v) {
    constexpr double negligible = 1e-12;
    const auto jet = traits_.taylor(mesh_.points[v]);
    values_[v] = parabolic_function(jet).value();
    const double slope = eigen_gradient(jet).norm(), bend = eigen_hessian(jet).norm(), scale = slope * bend;
    is_negligible_[v] = std::abs(CGAL::to_double(values_[v])) <= negligible * scale * scale;
  }

  /// Replaces every negligible value by one near the vertex, slightly inside a triangle. If the curvature has a
  /// double zero at the vertex, it has one sign around it, and no curve passes.
  void look_beside_negligible_values() {
    constexpr double fraction = 1e-3; // of the way to the center of the triangle
    std::vector<bool> is_replaced(values_.size(), false);
    for (const auto& t : mesh_.triangles)
      for (const Index v : t) {
        if (!is_negligible_[v] || is_replaced[v]) continue;
        const Point_3& p = mesh_.points[v];
        const Vector_3 step =
            FT(fraction) * (CGAL::centroid(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]) - p);
        const FT length(std::sqrt(CGAL::to_double(step.squared_length())));
        const auto beside = project_to_surface(traits_, p + step, length);
        if (beside.has_converged) values_[v] = parabolic_function(traits_.taylor(beside.point)).value();
        is_replaced[v] = true;
      }
  }

  /// Returns a curve segment between two edges of each triangle with different signs at its vertices, unless all
  /// three values are negligible.
  std::vector<Segment> find_segments() const {
    std::vector<Segment> segments;
    for (const auto& t : mesh_.triangles) {
      Segment ends;
      std::size_t n = 0;
      bool is_defined = !(is_negligible_[t[0]] && is_negligible_[t[1]] && is_negligible_[t[2]]);
      for (std::size_t m = 0; m < 3; ++m) {
        const Index a = t[m], b = t[(m + 1) % 3];
        is_defined = is_defined && values_[a] - values_[a] == FT(0);
        if ((values_[a] < FT(0)) != (values_[b] < FT(0))) ends[n++] = std::minmax(a, b);
      }
      if (is_defined && n == 2) segments.push_back(ends);
    }
    return segments;
  }

  /// Collects the edges of all segments and, for each edge, the edges to which segments lead.
  void connect_edges(const std::vector<Segment>& segments) {
    for (const auto& [first, second] : segments) {
      edges_.push_back(first);
      edges_.push_back(second);
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    neighbors_.assign(edges_.size(), {none, none});
    const auto position = [&](const Edge& e) {
      return Index(std::lower_bound(edges_.begin(), edges_.end(), e) - edges_.begin());
    };
    for (const auto& [first, second] : segments) {
      const Index a = position(first), b = position(second);
      neighbors_[a][neighbors_[a][0] == none ? 0 : 1] = b;
      neighbors_[b][neighbors_[b][0] == none ? 0 : 1] = a;
    }
  }

  /// Moves the point of an edge from its linear position onto the curve, by at most about the length of the edge.
  /// Returns false if it stays.
  bool place_point(std::size_t e) {
    const auto [a, b] = edges_[e];
    const Vector_3 edge = mesh_.points[b] - mesh_.points[a];
    points_[e] = mesh_.points[a] + linear_zero(values_[a], values_[b]) * edge;
    auto p = project_to_parabolic_curve(traits_, points_[e], edge.squared_length());
    if (!p) p = bisect(a, edge);
    if (p) points_[e] = *p;
    return p.has_value();
  }

  /// Returns the point of the surface at which the parabolic function changes its sign along an edge from vertex v,
  /// or nothing if the surface is not found near the edge. This is needed where the gradient of the function vanishes
  /// on the curve and Newton's method fails, for example at a double zero of the curvature across it.
  std::optional<Point_3> bisect(Index v, const Vector_3& edge) const {
    constexpr int halvings = std::numeric_limits<FT>::digits;
    const FT length(std::sqrt(CGAL::to_double(edge.squared_length())));
    FT lower(0), upper(1);
    std::optional<Point_3> middle;
    for (int n = 0; n < halvings; ++n) {
      const FT t = (lower + upper) / FT(2);
      const auto found = project_to_surface(traits_, mesh_.points[v] + t * edge, length);
      if (!found.has_converged) return std::nullopt;
      middle = found.point;
      const FT value = parabolic_function(traits_.taylor(*middle)).value();
      ((value < FT(0)) == (values_[v] < FT(0)) ? lower : upper) = t;
    }
    return middle;
  }

  /// Appends the points where curves cross. Returns the squared radius of the neighborhood of each in which the mesh
  /// does not resolve the branches.
  std::vector<FT> find_crossings() {
    const auto jets = [this](const Point_3& p) {
      const auto jet = traits_.taylor(p);
      return std::pair(jet, parabolic_function<2>(jet));
    };
    std::vector<FT> squared_radii;
    for (Index e = 0; e < edges_.size(); ++e) {
      FT squared_length(0);
      for (const Index m : neighbors_[e])
        if (m != none) squared_length = std::max(squared_length, CGAL::squared_distance(points_[e], points_[m]));
      const double reach = 2 * std::sqrt(CGAL::to_double(squared_length));
      const auto crossing = crossing_near<Point_3, Vector_3>(points_[e], reach, jets);
      if (!crossing) continue;
      const auto is_same = [&](const Point_3& p) { return CGAL::squared_distance(p, *crossing) <= squared_length; };
      if (std::any_of(points_.begin() + std::ptrdiff_t(edges_.size()), points_.end(), is_same)) continue;
      points_.push_back(*crossing);
      squared_radii.push_back(FT(2) * squared_length);
    }
    return squared_radii;
  }

  /// Replaces the points near crossings by the crossings as neighbors.
  void join_at_crossings(const std::vector<FT>& squared_radii) {
    is_at_crossing_.assign(edges_.size(), false);
    std::vector<Index> replacement(points_.size());
    std::iota(replacement.begin(), replacement.end(), Index(0));
    for (Index e = 0; e < edges_.size(); ++e)
      for (std::size_t n = 0; n < squared_radii.size(); ++n)
        if (CGAL::squared_distance(points_[e], points_[edges_.size() + n]) <= squared_radii[n]) {
          replacement[e] = Index(edges_.size() + n);
          is_at_crossing_[e] = true;
        }
    for (auto& neighbors : neighbors_)
      for (Index& m : neighbors)
        if (m != none) m = replacement[m];
  }

  bool is_crossing(Index n) const { return n != none && n >= edges_.size(); }

  /// Links the points to curves: first those that end at the border of the mesh, then those between crossings, then
  /// closed ones.
  std::vector<Polyline_3<Kernel>> trace_polylines() const {
    std::vector<Polyline_3<Kernel>> polylines;
    std::vector<bool> is_used = is_at_crossing_; // per edge
    const auto trace = [&](Index first, Index before) {
      auto line = trace_polyline(first, before, is_used);
      if (line.points.size() > 1) polylines.push_back(std::move(line));
    };
    for (Index e = 0; e < edges_.size(); ++e)
      if (!is_used[e] && neighbors_[e][1] == none) trace(e, none);
    for (Index e = 0; e < edges_.size(); ++e)
      for (const Index m : neighbors_[e])
        if (!is_used[e] && is_crossing(m)) trace(e, m);
    for (Index e = 0; e < edges_.size(); ++e)
      if (!is_used[e]) trace(e, none);
    return polylines;
  }

  /// The curve from `first` on, away from the neighbor `before`, which may be a crossing or none.
  Polyline_3<Kernel> trace_polyline(Index first, Index before, std::vector<bool>& is_used) const {
    Polyline_3<Kernel> line;
    if (is_crossing(before)) line.points.push_back(points_[before]);
    for (Index here = first; here != none;) {
      line.points.push_back(points_[here]);
      if (is_crossing(here)) break;
      is_used[here] = true;
      const auto& [p, q] = neighbors_[here];
      const Index next = p != before ? p : q;
      before = here;
      line.is_closed = next == first;
      here = next == none || (!is_crossing(next) && is_used[next]) ? none : next;
    }
    return line;
  }

  const Indexed_triangle_mesh_3<Kernel>& mesh_;
  const Traits& traits_;
  std::vector<FT> values_;                      // of the parabolic function at the vertices of the mesh
  std::vector<std::uint8_t> is_negligible_;     // whether these values may be due to rounding
  std::vector<Edge> edges_;                     // edges of the mesh that curves cross, in ascending order
  std::vector<std::array<Index, 2>> neighbors_; // for each edge, the indices of neighbors along the curve
  std::vector<bool> is_at_crossing_;            // whether a crossing replaces the point of the edge
  std::vector<Point_3> points_;                 // one per edge, then the crossings
};

} // namespace equiaffine::internal

namespace equiaffine {

/// Finds the parabolic curves of the zero set of f. The polylines have a point for every edge of `mesh` at whose ends
/// K_e has different signs, and end where they cross. `mesh` is a mesh of the zero set computed by a sampler. Its
/// resolution determines which curves are found but not the accuracy of their points, which lie on f = 0 and K_e = 0
/// up to rounding. Curves where K_e touches zero without changing sign are not found. CGAL::Sequential_tag and
/// CGAL::Parallel_tag give the same curves, bit for bit.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
Parabolic_curves_3<Kernel_of<Traits>> parabolic_curves(const Indexed_triangle_mesh_3<Kernel_of<Traits>>& mesh,
                                                       const Traits& traits) {
  return internal::Parabolic_curve_finder_3<ConcurrencyTag, Traits>(mesh, traits).find();
}

/// The same for a mesh of CGAL of any kernel with double coordinates. Faces are triangulated.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL and ignored.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, ImplicitFunctionTraits_3 Traits,
          internal::Parameter_chain... Parameters>
Parabolic_curves_3<Kernel_of<Traits>> parabolic_curves(const Graph& mesh, const Traits& traits,
                                                       const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_parameters<Joined, internal::Vertex_point_tag, internal::Geom_traits_tag, internal::Verbose_tag>();
  static_assert(check_coordinates<Point_of_vertices<const Graph, Joined>>());
  return parabolic_curves<ConcurrencyTag>(
      internal::triangle_mesh_of<Kernel_of<Traits>>(mesh, internal::joined_parameters(given...)), traits);
}

} // namespace equiaffine

#endif
