// SPDX-License-Identifier: GPL-3.0-or-later
// The points from which refinement starts, with the balls that protect features and singular points.
#ifndef EQUIAFFINE_SRC_DELAUNAY_INITIAL_POINTS_H
#define EQUIAFFINE_SRC_DELAUNAY_INITIAL_POINTS_H

#include "delaunay/Border_curves_3.h"
#include "delaunay/Feature_curve_3.h"
#include "delaunay/Surface_complex.h"
#include "delaunay/Surface_criteria_3.h"
#include <equiaffine/delaunay/internal/Seed_grid_3.h>
#include <equiaffine/delaunay/internal/certified_seeding.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A ball around a vertex of the mesh that no other vertex may enter.
template <class Kernel>
struct Protecting_ball_3 {
  typename Kernel::Point_3 center;
  int dimension; ///< 1 on a curve, 0 for a corner, where curves end or meet
  double radius = 0;
};

/// Covers curves and corners with balls. In the regular triangulation of such balls, the segments between neighbors
/// on a curve are edges if the balls of neighbors overlap and no others do (Cheng, Dey, Ramos: Delaunay refinement
/// for piecewise smooth complexes, 2010). Where curves are close to each other or meet in a sharp corner, there are
/// more and smaller balls.
template <class Kernel>
class Protecting_balls_3 {
  using Point_3 = typename Kernel::Point_3;
  using Vector_3 = typename Kernel::Vector_3;

public:
  using Ball = Protecting_ball_3<Kernel>;
  using Projection = std::function<std::optional<Point_3>(const Point_3&)>;

  /// Two balls that are neighbors on a curve.
  struct Segment {
    std::size_t first, second; ///< indices of the balls
    std::size_t curve;         ///< index of the curve, in the order of `cover`
  };

  /// `least_distance` is the minimum distance between centers. Without it, curves that coincide up to rounding would
  /// get balls, and the mesh around them facets, of the size of rounding errors.
  explicit Protecting_balls_3(double least_distance) : least_distance_(least_distance) {}

  /// Places centers on a curve at distances of at most `size(p)`. The curve is approximated by a polyline of short
  /// segments. `project(p)` returns a point of the curve near a point of the polyline, or nothing; `project_end(p)`
  /// does the same near an end of an open curve.
  template <class Sizing>
  void cover(const Polyline_3<Kernel>& curve, const Sizing& size, Projection project, const Projection& project_end) {
    std::vector<std::size_t> chain;
    const auto append = [&](const Point_3& p, std::optional<std::size_t> ball) {
      if (ball) chain.push_back(*ball);
      else omitted_.push_back(p);
    };
    const auto append_corner = [&](const Point_3& p) {
      if (const auto end = project_end(p)) append(*end, corner(*end));
    };
    if (!curve.is_closed) append_corner(curve.points.front());
    for (const Point_3& p : divide(curve, size))
      if (const auto q = project(p)) append(*q, add(*q, 1));
    if (!curve.is_closed) append_corner(curve.points.back());
    for (std::size_t n = 1; n < chain.size(); ++n) join(chain[n - 1], chain[n]);
    if (curve.is_closed && chain.size() > 2) join(chain.back(), chain.front());
    projections_.push_back(std::move(project));
  }

  /// Sets the radii after all curves are covered, and adds balls where neighbors would not overlap.
  void complete() {
    constexpr int rounds = 6; // each one halves the remaining distances
    for (int round = 0; round == 0 || (round < rounds && fill_gaps()); ++round) {
      set_radii();
      separate();
      widen_all();
    }
    projections_.clear();
  }

  const std::vector<Ball>& balls() const { return balls_; }
  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Point_3>& omitted() const { return omitted_; } ///< points that are too close to other centers
  double least_distance() const { return least_distance_; }

private:
  using Grid = Seed_grid_3<Point_3, Vector_3>;

  static double distance(const Point_3& p, const Point_3& q) { return std::sqrt(CGAL::squared_distance(p, q)); }
  double distance(std::size_t n, std::size_t m) const { return distance(balls_[n].center, balls_[m].center); }
  bool overlap(const Segment& s) const {
    return balls_[s.first].radius + balls_[s.second].radius > distance(s.first, s.second);
  }

  /// Points that divide a polyline into at least three pieces of equal length, measured in sizes, of at most one size
  /// each. Excludes the ends of an open polyline.
  template <class Sizing>
  static std::vector<Point_3> divide(const Polyline_3<Kernel>& curve, const Sizing& size) {
    std::vector<Point_3> points = curve.points;
    if (curve.is_closed) points.push_back(points.front());
    std::vector<double> length = {0}; // lengths from the first point, in sizes
    for (std::size_t n = 1; n < points.size(); ++n)
      length.push_back(length.back() +
                       distance(points[n - 1], points[n]) / size(CGAL::midpoint(points[n - 1], points[n])));
    const auto pieces = std::max(3.0, std::ceil(length.back()));
    std::vector<Point_3> divisions;
    for (std::size_t k = curve.is_closed ? 0 : 1, n = 1; double(k) < pieces; ++k) {
      const double at = length.back() * double(k) / pieces;
      while (length[n] < at) ++n;
      const double t = (at - length[n - 1]) / (length[n] - length[n - 1]);
      divisions.push_back(points[n - 1] + t * (points[n] - points[n - 1]));
    }
    return divisions;
  }

  /// Adds a ball and returns its index, or nothing if p is too close to another center.
  std::optional<std::size_t> add(const Point_3& p, int dimension) {
    const typename Grid::Seed center{p, Vector_3(0, 0, 0), least_distance_};
    if (centers_.is_crowded(center)) return std::nullopt;
    centers_.insert(center);
    balls_.push_back({p, dimension});
    neighbors_.emplace_back();
    return balls_.size() - 1;
  }

  /// The ball at a corner, which is shared by all curves that end there.
  std::optional<std::size_t> corner(const Point_3& p) {
    const auto known =
        std::find_if(corners_.begin(), corners_.end(), [&](std::size_t n) { return balls_[n].center == p; });
    if (known != corners_.end()) return *known;
    const auto added = add(p, 0);
    if (added) corners_.push_back(*added);
    return added;
  }

  /// Makes two balls neighbors on the curve that is being covered.
  void join(std::size_t a, std::size_t b) {
    neighbors_[a].push_back(b);
    neighbors_[b].push_back(a);
    segments_.push_back({a, b, projections_.size()});
  }

  bool are_neighbors(std::size_t a, std::size_t b) const {
    return std::find(neighbors_[a].begin(), neighbors_[a].end(), b) != neighbors_[a].end();
  }

  /// Gives every ball a radius at which it overlaps with its neighbors if they are about as large.
  void set_radii() {
    constexpr double overlap = 0.52; // radius / distance of neighbors
    for (std::size_t n = 0; n < balls_.size(); ++n) {
      double longest = 0;
      for (const std::size_t m : neighbors_[n]) longest = std::max(longest, distance(n, m));
      if (longest > 0) balls_[n].radius = std::min(overlap * longest, largest_radius(n));
    }
  }

  /// No ball may contain the center of a neighbor.
  double largest_radius(std::size_t n) const {
    constexpr double most_of_distance = 0.9;
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::size_t m : neighbors_[n]) shortest = std::min(shortest, distance(n, m));
    return most_of_distance * shortest;
  }

  /// Shrinks balls that overlap although they are not neighbors.
  void separate() {
    std::vector<std::size_t> order(balls_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return balls_[a].center.x() < balls_[b].center.x(); });
    double largest = 0;
    for (const Ball& ball : balls_) largest = std::max(largest, ball.radius);
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        Ball &a = balls_[order[i]], &b = balls_[order[j]];
        if (b.center.x() - a.center.x() > 2 * largest) break;
        if (are_neighbors(order[i], order[j])) continue;
        const double scale = gap * distance(a.center, b.center) / (a.radius + b.radius);
        if (scale >= gap) continue;
        a.radius *= scale;
        b.radius *= scale;
      }
  }

  /// Enlarges balls of neighbors that do not overlap. Corners come first, so that balls on the curves that meet there
  /// stay small.
  void widen_all() {
    for (const int dimension : {0, 1})
      for (const Segment& s : segments_) {
        if (balls_[s.first].dimension == dimension) widen(s.first, s);
        if (balls_[s.second].dimension == dimension) widen(s.second, s);
      }
  }

  /// Enlarges ball n of a segment whose balls do not overlap, as far as the other balls allow.
  void widen(std::size_t n, const Segment& s) {
    if (overlap(s)) return;
    const std::size_t other = s.first + s.second - n;
    double radius = std::min(1.04 * distance(n, other) - balls_[other].radius, largest_radius(n));
    for (std::size_t m = 0; m < balls_.size(); ++m)
      if (m != n && !are_neighbors(n, m)) radius = std::min(radius, gap * (distance(n, m) - balls_[m].radius));
    balls_[n].radius = std::max(balls_[n].radius, radius);
  }

  /// Adds a ball between neighbors that do not overlap, if the curve has a point there. Returns whether any was
  /// added.
  bool fill_gaps() {
    const std::size_t size = segments_.size();
    bool is_added = false;
    for (std::size_t s = 0; s < size; ++s) {
      const auto [a, b, curve] = segments_[s];
      if (overlap(segments_[s])) continue;
      const double length = distance(a, b);
      const auto p = projections_[curve](CGAL::midpoint(balls_[a].center, balls_[b].center));
      if (!p || !(std::max(distance(*p, balls_[a].center), distance(*p, balls_[b].center)) < length)) continue;
      const auto n = add(*p, 1);
      if (!n) continue;
      std::replace(neighbors_[a].begin(), neighbors_[a].end(), b, *n);
      std::replace(neighbors_[b].begin(), neighbors_[b].end(), a, *n);
      neighbors_[*n] = {a, b};
      segments_[s].second = *n;
      segments_.push_back({*n, b, curve});
      is_added = true;
    }
    return is_added;
  }

  static constexpr double gap = 0.98; // maximum of sum of radii / distance for balls that are not neighbors

  const double least_distance_;
  Grid centers_;
  std::vector<Point_3> omitted_;
  std::vector<Ball> balls_;
  std::vector<std::vector<std::size_t>> neighbors_; // along curves, per ball
  std::vector<std::size_t> corners_;                // indices of balls
  std::vector<Segment> segments_;
  std::vector<Projection> projections_; // per curve
};

using Feature_balls = Protecting_balls_3<Any_function_3::Kernel>;

/// Balls along all features: the given curves, and the curves in which the surface meets the border of the domain.
/// `radius` is the maximum radius of facets. Points of features that are closer to others than a thousandth of it are
/// omitted.
inline Feature_balls cover_features(const Memoized_function_3& function, const Clip_domain_3& domain, double radius,
                                    const Facet_sizing_field& size, const std::vector<Feature_curve_3>& given) {
  using Point_3 = Any_function_3::Point_3;
  constexpr double spacing_in_sizes = 0.8; // small enough for good angles of the facets at features
  const auto spacing = [&](const Point_3& p) { return spacing_in_sizes * size(p); };
  const auto keep = [](const Point_3& p) { return std::optional(p); };
  Feature_balls balls(radius / 1000);
  Feature_ends_3 ends(domain, radius);
  for (Feature_curve_3 curve : given) {
    if (curve.reaches_border) ends.extend(curve);
    const auto project = [&domain, to_curve = curve.project](const Point_3& p) {
      const auto q = to_curve(p);
      return q && domain.contains(*q) ? q : std::nullopt;
    };
    const auto project_end = [&](const Point_3& p) { return ends.is_on_border(p) ? std::optional(p) : project(p); };
    balls.cover(curve.polyline, spacing, project, project_end);
  }
  Border_curves_3 border(function, domain, radius);
  for (const auto& curve : border.find())
    for (const auto& piece : ends.split(curve)) {
      const auto project = [&border, axis = curve.axis](const Point_3& p) { return border.project(p, axis); };
      balls.cover(piece, spacing, project, keep);
    }
  balls.complete();
  return balls;
}

/// Finds the node of a surface near a point, an isolated singular point such as the apex of a cone: f and its
/// gradient are 0 there, and its Hessian is regular. Newton's method finds it as a critical point of f, at most
/// `reach` away.
template <ImplicitFunctionTraits_3 Traits>
std::optional<typename Traits::Point_3> node_near(const Traits& traits, const typename Traits::Point_3& start,
                                                  double reach) {
  using Vector_3 = typename Traits::Vector_3;
  constexpr int maximal_iterations = 30;
  constexpr double least_determinant = 1e-6; // relative to |H|^3; on a singular curve the determinant is 0
  constexpr double negligible = 1e-10;       // f, relative to |H| reach^2
  const double rounding = 1e-12 * reach;
  auto p = start;
  for (int n = 0; n < maximal_iterations; ++n) {
    const auto jet = traits.taylor(p);
    const Eigen::Matrix3d hessian = eigen_hessian(jet);
    const double scale = hessian.norm();
    if (!(std::abs(hessian.determinant()) > least_determinant * scale * scale * scale)) return std::nullopt;
    const Eigen::Vector3d step = -(hessian.inverse() * eigen_gradient(jet));
    p = p + Vector_3(step[0], step[1], step[2]);
    if (!(CGAL::squared_distance(p, start) <= reach * reach)) return std::nullopt;
    if (step.norm() > rounding) continue;
    if (std::abs(traits.value(p)) > negligible * scale * reach * reach) return std::nullopt;
    return p;
  }
  return std::nullopt;
}

/// Finds the isolated singular point of a surface near a point where f has no gradient, such as the apex of half a
/// cone or of a pyramid, not much farther away than `reach`. The tangent planes around an apex almost meet in it:
/// their least-squares point is computed from gradients at surrounding points, at smaller and smaller distances.
template <ImplicitFunctionTraits_3 Traits>
std::optional<typename Traits::Point_3> apex_near(const Traits& traits, const typename Traits::Point_3& start,
                                                  double reach) {
  using Vector_3 = typename Traits::Vector_3;
  constexpr int directions = 16;
  constexpr double shrinkage = 8, last_distance = 1e-7; // of the surrounding points, relative to the reach
  constexpr double least_eigenvalue = 1e-4;             // relative to the largest one; tends to 0 except at an apex
  auto p = start;
  for (double distance = reach; distance > last_distance * reach; distance /= shrinkage) {
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    Eigen::Vector3d offsets = Eigen::Vector3d::Zero();
    for (int n = 0; n < directions; ++n) { // on a spiral from pole to pole
      const double z = 1 - (2 * n + 1.0) / directions, longitude = (n + 0.5) * std::numbers::pi * (3 - std::sqrt(5.0));
      const double r = std::sqrt(1 - z * z);
      const Eigen::Vector3d to_point = distance * Eigen::Vector3d(r * std::cos(longitude), r * std::sin(longitude), z);
      const auto jet = first_order(traits, p + Vector_3(to_point[0], to_point[1], to_point[2]));
      const Eigen::Vector3d gradient = eigen_gradient(jet), normal = gradient.normalized();
      if (!normal.allFinite()) return std::nullopt;
      normals += normal * normal.transpose();
      offsets += normal * (normal.dot(to_point) - jet.value() / gradient.norm());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normals, Eigen::EigenvaluesOnly);
    if (!(solver.eigenvalues()[0] > least_eigenvalue * solver.eigenvalues()[2])) return std::nullopt;
    const Eigen::Vector3d step = normals.inverse() * offsets;
    if (!(step.norm() <= distance)) return std::nullopt;
    p = p + Vector_3(step[0], step[1], step[2]);
  }
  return p;
}

/// The isolated singular points of a surface in or near some boxes, without repetition.
template <ImplicitFunctionTraits_3 Traits>
std::vector<typename Traits::Point_3> singular_points_in(const Traits& traits, const std::vector<CGAL::Bbox_3>& boxes) {
  using Point_3 = typename Traits::Point_3;
  std::vector<Point_3> points;
  for (const CGAL::Bbox_3& box : boxes) {
    const Point_3 center((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
    const double reach = 2 * std::max({box.x_span(), box.y_span(), box.z_span()});
    const auto is_near_center = [&](const Point_3& p) {
      return CGAL::squared_distance(p, center) <= 4 * reach * reach;
    };
    if (std::any_of(points.begin(), points.end(), is_near_center)) continue; // it would be found again
    if (const auto point = node_near(traits, center, reach)) points.push_back(*point);
    else if (const auto apex = apex_near(traits, center, reach)) points.push_back(*apex);
  }
  return points;
}

/// The points that are inserted into the triangulation before refinement.
struct Initial_points {
  using Point_3 = Any_function_3::Point_3;

  std::vector<Feature_balls::Ball> balls;       ///< along features first, then around singular points
  std::vector<Feature_balls::Segment> segments; ///< between balls that are neighbors on a feature
  std::vector<Point_3> seeds;                   ///< on the surface
  std::vector<Point_3> scaffold;                ///< away from the surface
  std::vector<Point_3> omitted;                 ///< on features, but too close to others to become vertices
  std::vector<CGAL::Bbox_3> undecided_boxes;    ///< where a part of the surface may have been missed
  bool has_features = false;
};

/// Appends a ball around a singular point of the surface, smaller than a facet and disjoint from the other balls, and
/// removes the seeds in and near it.
inline void protect_singular_point(const Any_function_3::Point_3& p, double size, Initial_points& points) {
  double radius = 0.4 * size;
  for (const auto& ball : points.balls)
    radius = std::min(radius, 0.9 * (std::sqrt(CGAL::squared_distance(p, ball.center)) - ball.radius));
  if (!(radius > 0)) return;
  points.balls.push_back({p, 0, radius});
  std::erase_if(points.seeds, [&](const auto& q) { return CGAL::squared_distance(p, q) < 2 * radius * radius; });
}

/// Finds points on every component of the surface, and covers features and singular points with balls.
inline Initial_points find_initial_points(const Memoized_function_3& function, const Clip_domain_3& domain,
                                          double radius, const Facet_sizing_field& size,
                                          const std::vector<Feature_curve_3>& features) {
  // Minimum distances of seeds from vertices on features, which allow good angles of the facets at features.
  constexpr double clearance_in_sizes = 0.7, clearance_in_radii = 1.7;
  const Feature_balls covered = cover_features(function, domain, radius, size, features);
  std::vector<Fixed_vertex_3<Any_function_3::Point_3>> vertices;
  for (const auto& ball : covered.balls()) {
    const double clearance = std::min(clearance_in_sizes * size(ball.center), clearance_in_radii * ball.radius);
    vertices.push_back({ball.center, std::max(clearance, covered.least_distance())});
  }
  auto seeding = certified_seeding(function, domain, size, radius, vertices);
  Initial_points points{covered.balls(),          covered.segments(),
                        std::move(seeding.seeds), std::move(seeding.scaffold),
                        covered.omitted(),        std::move(seeding.undecided_boxes),
                        !covered.balls().empty()};
  for (const auto& p : singular_points_in(function, points.undecided_boxes))
    if (domain.contains(p)) protect_singular_point(p, size(p), points);
  return points;
}

} // namespace equiaffine::internal

#endif
