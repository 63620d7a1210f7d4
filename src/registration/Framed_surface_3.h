// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a surface with frames and invariants, used to match two surfaces.
#ifndef EQUIAFFINE_SRC_REGISTRATION_FRAMED_SURFACE_3_H
#define EQUIAFFINE_SRC_REGISTRATION_FRAMED_SURFACE_3_H

#include "registration/Affine_map_3.h"
#include <equiaffine/base/internal/Point_tree.h>
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/geometry/affine_frame.h>
#include <equiaffine/geometry/euclidean_structure.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The signature of a point, which is invariant under all maps of the kind, and the logarithm of a power of the
/// scale of its frame, which is also invariant if the determinant is 1 or -1.
using Invariants = Eigen::Matrix<double, 5, 1>;
using Gradient_of_invariants = Eigen::Matrix<double, 5, 2>;

/// The number of invariants under maps of a kind.
inline int number_of_invariants(Map_kind kind) { return keeps_volume(kind) ? 5 : 4; }

/// A point of a surface with a frame that is covariant under maps, and the invariants around it. The frame is the
/// affine one, or the Euclidean one for maps that preserve angles. Its scale is such that a map with the matrix A
/// maps the tangent vectors e1 and e2 to A e1 and A e2 without a weight, and the gradient, the derivatives along
/// them, is invariant.
struct Framed_point_3 {
  Eigen::Vector3d point;
  Eigen::Matrix3d basis; ///< columns e1, e2 and a transversal vector
  Invariants invariants;
  Gradient_of_invariants gradient;
  double quality = 0;       ///< 0 for a point without a frame
  double certainty = 1;     ///< of the curvatures
  bool is_elliptic = false; ///< distinguishes the affine frames of elliptic and hyperbolic points

  bool has_frame() const { return quality > 0; }
};

inline Eigen::Vector3d vector_of(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

/// The map of a kind that moves one point and its frame to the other.
inline Affine_map_3 map_between(const Framed_point_3& p, const Framed_point_3& q, Map_kind kind) {
  const Eigen::Matrix3d matrix = nearest_of_kind(q.basis * p.basis.inverse(), kind);
  return {matrix, q.point - matrix * p.point};
}

/// The principal curvatures of a level set, the greater one first, and their derivatives along the principal
/// directions. Not finite where the gradient is zero; arbitrary at umbilics. Units: 1/length and 1/length^2.
struct Derivatives_of_curvature {
  Eigen::Vector2d k;
  Eigen::Matrix2d gradient;               ///< row i is that of k[i]
  Eigen::Matrix<double, 3, 2> directions; ///< unit vectors
  Eigen::Vector3d normal;                 ///< along the gradient of the function
};

/// Derivatives of f determine those of the level set as a graph over its tangent plane by the chain rule: if f = g h
/// + A / 2 + h B + T / 6 + ..., where A, B and T are forms of degree 2, 1 and 3, then the height is h = -A / (2 g) -
/// (T - 3 A B / g) / (6 g) + ...
inline Derivatives_of_curvature derivatives_of_curvature(const Jet_3<double>& jet) {
  const Euclidean_structure_3<double> s = euclidean_structure(Monge_chart_3<double>(jet));
  Derivatives_of_curvature result;
  result.k << s.k1, s.k2;
  result.directions << vector_of(s.direction1), vector_of(s.direction2);
  result.normal = vector_of(s.normal);
  const double slope = eigen_gradient(jet).stableNorm();
  const Eigen::Vector2d mixed = result.directions.transpose() * eigen_hessian(jet) * result.normal / slope;
  std::array<Eigen::Matrix2d, 2> third = {Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix2d along =
        result.directions.transpose() * eigen_hessian_along(jet, axis) * result.directions / slope;
    for (int d = 0; d < 2; ++d) third[std::size_t(d)] += result.directions(axis, d) * along;
  }
  for (int i = 0; i < 2; ++i)
    for (int d = 0; d < 2; ++d)
      result.gradient(i, d) = -(third[std::size_t(d)](i, i) + (i == d ? 3 : 1) * result.k[i] * mixed[d]);
  return result;
}

// Frames at a point that are covariant under maps of a kind, with their invariants and the gradient of these.

/// The point with its affine frame e1 / sqrt(scale), e2 / sqrt(scale), xi / scale.
inline Framed_point_3 affine_framed_point(const Jet_3<double>& jet, const Eigen::Vector3d& p) {
  Framed_point_3 result;
  result.point = p;
  const auto structure = regular_structure<double>(jet, {p[0], p[1], p[2]});
  if (!structure.is_regular) return result;
  const Affine_frame_3<double> frame = affine_frame(structure.structure.affine);
  const double root = std::sqrt(frame.scale);
  result.basis << vector_of(frame.e1) / root, vector_of(frame.e2) / root, vector_of(frame.xi) / frame.scale;
  result.invariants << Eigen::Map<const Eigen::Vector4d>(frame.signature.data()), std::log(root);
  result.is_elliptic = frame.is_elliptic;
  result.quality = result.basis.allFinite() && result.invariants.allFinite() ? frame.quality : 0;
  return result;
}

/// The point with its Euclidean frame times the length L = 1 / |(k1, k2)|. The tangent vectors are the principal
/// directions, oriented so that L decreases along both; the third vector is the normal toward the side to which the
/// surface curves along the first direction. The first direction is chosen by the larger of k^2 + (slope of L)^2
/// along it, where k is its normalized curvature; if both slopes are equal this is the curvature of larger
/// magnitude, and if both magnitudes are equal, as on minimal surfaces, the faster decrease of L. The signature
/// consists of the other curvature, the slopes of -L along both directions, and the slope of the angle of (k1, k2)
/// along the first, all times powers of L.
inline Framed_point_3 euclidean_framed_point(const Jet_3<double>& jet, const Eigen::Vector3d& p) {
  Framed_point_3 result;
  result.point = p;
  const Derivatives_of_curvature s = derivatives_of_curvature(jet);
  const double length = 1 / s.k.norm();
  const Eigen::Vector2d k = length * s.k;
  const Eigen::Matrix2d change = length * length * s.gradient;
  const Eigen::Vector2d growth = change.transpose() * k;
  const double order = k[0] * k[0] - k[1] * k[1] + growth[0] * growth[0] - growth[1] * growth[1];
  const Eigen::Index first = order < 0 ? 1 : 0, second = 1 - first;
  const auto sign_of = [](double x) { return x < 0 ? -1. : 1.; };
  const double sign = sign_of(growth[first]), side = sign_of(k[first]);
  const double turn = sign * (k[first] * change(second, first) - k[second] * change(first, first));
  result.basis << sign * s.directions.col(first), sign_of(growth[second]) * s.directions.col(second), side * s.normal;
  result.basis *= length;
  result.invariants << side * k[second], std::abs(growth[first]), std::abs(growth[second]), turn, std::log(length);
  if (result.basis.allFinite() && result.invariants.allFinite())
    result.quality = std::min({std::abs(order), std::abs(k[first]), k[0] - k[1], growth.cwiseAbs().minCoeff()});
  return result;
}

/// The point with its frame, but without the gradient.
inline Framed_point_3 framed_point_of(const Jet_3<double>& jet, const Eigen::Vector3d& p, Map_kind kind) {
  return keeps_angles(kind) ? euclidean_framed_point(jet, p) : affine_framed_point(jet, p);
}

/// The step of differences in units of the tangent vectors of `Framed_point_3::basis`. Errors of gradients are about
/// 1e-5 of their size. This suffices because gradients only select candidates and direct Newton steps.
constexpr double step_of_gradient = 0x1p-8;

/// Computes the point with its frame and gradient, with 5 expansions taylor(p). The points of these differences are
/// covariant under maps.
template <class Taylor>
Framed_point_3 framed_point(const Taylor& taylor, const Eigen::Vector3d& p, Map_kind kind) {
  Framed_point_3 result = framed_point_of(taylor(p), p, kind);
  for (int i = 0; i < 2 && result.has_frame(); ++i) {
    const Eigen::Vector3d step = step_of_gradient * result.basis.col(i);
    const Framed_point_3 ahead = framed_point_of(taylor(p + step), p + step, kind);
    const Framed_point_3 behind = framed_point_of(taylor(p - step), p - step, kind);
    const bool is_smooth = ahead.has_frame() && behind.has_frame() && ahead.is_elliptic == result.is_elliptic &&
                           behind.is_elliptic == result.is_elliptic;
    if (!is_smooth) result.quality = 0;
    else result.gradient.col(i) = (ahead.invariants - behind.invariants) / (2 * step_of_gradient);
  }
  return result;
}

/// The distance from a point to the surface to first order, and the direction in which it increases. The distance is
/// NaN where the function is undefined.
struct Signed_distance_3 {
  double distance;
  Eigen::Vector3d normal;
};

/// A function restricted to its box, with frames on its zero set and distances from it.
class Framed_function_3 {
public:
  explicit Framed_function_3(Any_function_3 function) : function_(std::move(function)), box_(function_.bbox()) {}
  virtual ~Framed_function_3() = default;

  /// A benchmark overrides this to falsify frames.
  virtual Framed_point_3 framed_point(const Eigen::Vector3d& p, Map_kind kind) const {
    return internal::framed_point([this](const Eigen::Vector3d& q) { return taylor(q); }, p, kind);
  }

  Jet_3<double, 1> first_order(const Eigen::Vector3d& p) const {
    if (!contains(p)) return Jet_3<double, 1>(std::numeric_limits<double>::quiet_NaN());
    return function_.first_order(point(p));
  }

  double certainty(const Eigen::Vector3d& p) const { return function_.certainty(point(p)); }

  Signed_distance_3 distance(const Eigen::Vector3d& p) const {
    const auto jet = first_order(p);
    const Eigen::Vector3d gradient = eigen_gradient(jet);
    const double length = gradient.stableNorm();
    return {jet.value() / length, gradient / length};
  }

  /// Moves a point towards the surface by Newton steps along the gradient.
  Eigen::Vector3d moved_to_surface(Eigen::Vector3d p, int steps) const {
    for (int step = 0; step < steps; ++step) {
      const auto [distance, normal] = this->distance(p);
      p -= distance * normal;
    }
    return p;
  }

  /// Whether a point is in the box of the function.
  bool contains(const Eigen::Vector3d& p) const {
    for (int a = 0; a < 3; ++a)
      if (!(p[a] >= box_.min(a) && p[a] <= box_.max(a))) return false;
    return true;
  }

private:
  using Point_3 = Any_function_3::Point_3;

  Jet_3<double> taylor(const Eigen::Vector3d& p) const {
    if (!contains(p)) return Jet_3<double>(std::numeric_limits<double>::quiet_NaN());
    return function_.taylor(point(p));
  }

  static Point_3 point(const Eigen::Vector3d& p) { return Point_3(p[0], p[1], p[2]); }

  Any_function_3 function_;
  CGAL::Bbox_3 box_;
};

/// Returns `count` elements, or all of them, in random order.
template <class T>
std::vector<T> random_elements(const std::vector<T>& elements, std::size_t count, unsigned seed) {
  std::vector<T> result;
  for (const std::size_t i : random_subset(elements.size(), count, seed)) result.push_back(elements[i]);
  return result;
}

/// The root mean square distance of points from their mean.
inline double size_of_points(const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) return 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p / double(points.size());
  double sum = 0;
  for (const auto& p : points) sum += (p - mean).squaredNorm() / double(points.size());
  return std::sqrt(sum);
}

/// A surface prepared for matching: points with their frames, and a tree of invariants for each kind of point.
struct Framed_surface_3 {
  const Framed_function_3& function;   ///< used for frames and matches
  const Framed_function_3& refinement; ///< used to refine and judge maps
  std::vector<Framed_point_3> points = {};
  std::vector<Eigen::Vector3d> probes = {}; ///< random points on the zero set of `refinement`, used to judge maps
  double size = 0;                          ///< size_of_points
  double spacing = 0;                       ///< 3/2 of the median distance between neighbors
  double noise = 0;  ///< median distance of the given points from the zero set of `refinement`, relative to `size`
  double chance = 0; ///< see chance_of_nearness
  std::array<std::vector<std::size_t>, 2> usable = {}; ///< points with good frames: hyperbolic ones, elliptic ones
  std::array<Point_tree<5>, 2> trees = {};             ///< of their invariants
  Point_tree<3> tree = {};                             ///< of all points

  const Point_tree<5>& tree_of(const Framed_point_3& p) const { return trees[p.is_elliptic]; }
};

/// Points with a frame of lower quality are not matched, unless almost all points have one, as on a slightly
/// perturbed ellipsoid. On quadrics the quality is of the order of rounding.
constexpr double least_quality = 0.02, least_quality_of_exact_frames = 1e-5;

/// These bounds make the time of a search independent of the number of given points.
constexpr std::size_t most_framed_points = 6000, most_probes = 600;

/// The invariants used to match points: those that maps of the kind preserve, and zero for the rest.
inline Invariants kept_invariants(const Framed_point_3& p, Map_kind kind) {
  Invariants x = p.invariants;
  if (number_of_invariants(kind) < 5) x[4] = 0;
  return x;
}

inline Gradient_of_invariants kept_gradient(const Framed_point_3& p, Map_kind kind) {
  Gradient_of_invariants x = p.gradient;
  if (number_of_invariants(kind) < 5) x.row(4).setZero();
  return x;
}

/// Moves points to the surface, and removes those outside of its domain.
inline std::vector<Eigen::Vector3d> moved_to_surface(bool in_threads, const Framed_function_3& surface,
                                                     std::vector<Eigen::Vector3d> points, int steps = 3) {
  parallel_for(
      in_threads, 0, points.size(), [&](std::size_t i) { points[i] = surface.moved_to_surface(points[i], steps); }, 32);
  std::erase_if(points, [](const Eigen::Vector3d& p) { return !p.allFinite(); });
  return points;
}

/// The median distance of points from a surface, or 0 if it is undefined at all of them.
inline double median_distance(bool in_threads, const Framed_function_3& surface,
                              const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> distances(points.size());
  parallel_for(
      in_threads, 0, points.size(),
      [&](std::size_t i) { distances[i] = std::abs(surface.distance(points[i]).distance); }, 32);
  std::erase_if(distances, [](double d) { return !std::isfinite(d); });
  return distances.empty() ? 0 : median_of(std::move(distances));
}

/// 3/2 of the median distance of points from their nearest neighbor.
inline double typical_spacing(const Framed_surface_3& surface) {
  std::vector<double> distances;
  for (const Framed_point_3& p : surface.points) {
    const auto nearest = surface.tree.neighbors(p.point, 2);
    if (nearest.size() == 2) distances.push_back(nearest[1].distance);
  }
  return distances.empty() ? 0 : 1.5 * median_of(std::move(distances));
}

/// The probability that a random point of the bounding box is closer to the surface than t `size` is this number
/// times t, for small t. The estimate is increased by one half, and at least 1/10.
inline double chance_of_nearness(bool in_threads, const Framed_surface_3& surface) {
  constexpr std::size_t count = 2000;
  constexpr double distance = 0.01;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.probes) box.extend(p);
  std::minstd_rand random(3);
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& p : points)
    for (int a = 0; a < 3; ++a) p[a] = box.min()[a] + box.sizes()[a] * (double(random()) / double(random.max()));
  std::vector<char> is_inside(count), is_near(count);
  parallel_for(
      in_threads, 0, count,
      [&](std::size_t i) {
        const double d = std::abs(surface.refinement.distance(points[i]).distance);
        is_inside[i] = !std::isnan(d);
        is_near[i] = d < distance * surface.size;
      },
      32);
  const auto inside = std::count(is_inside.begin(), is_inside.end(), 1);
  const auto near = std::count(is_near.begin(), is_near.end(), 1);
  return std::max(0.1, 1.5 * double(near) / std::max(double(inside), 1.0) / distance);
}

/// The lowest quality of points to match.
inline double least_quality_on(const std::vector<Framed_point_3>& points) {
  const auto good =
      std::count_if(points.begin(), points.end(), [](const auto& p) { return p.quality > least_quality; });
  return std::size_t(good) * 50 > points.size() ? least_quality : least_quality_of_exact_frames;
}

inline void build_trees(Framed_surface_3& surface, Map_kind kind) {
  const double quality = least_quality_on(surface.points);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Framed_point_3& p = surface.points[i];
    all.push_back(i);
    if (p.quality > quality) surface.usable[p.is_elliptic].push_back(i);
  }
  surface.tree = Point_tree<3>(all, [&](std::size_t i) { return surface.points[i].point; });
  for (std::size_t k = 0; k < 2; ++k)
    surface.trees[k] =
        Point_tree<5>(surface.usable[k], [&](std::size_t i) { return kept_invariants(surface.points[i], kind); });
}

/// Moves points along a surface by random steps, unless these leave its domain. Points on the nodes or edges of a
/// lattice may lie on curves, and if another surface meets this one in such a curve, many of them would be on it.
inline std::vector<Eigen::Vector3d> spread_over_surface(bool in_threads, const Framed_function_3& surface,
                                                        std::vector<Eigen::Vector3d> points, double longest_step) {
  constexpr int steps = 8;
  std::minstd_rand random(4);
  const auto uniform = [&] { return 2 * double(random()) / double(random.max()) - 1; };
  for (Eigen::Vector3d& p : points) {
    Eigen::Vector3d step;
    for (double& coordinate : step) coordinate = uniform();
    const Eigen::Vector3d normal = surface.distance(p).normal;
    const Eigen::Vector3d moved = p + longest_step * (step - step.dot(normal) * normal);
    if (std::isfinite(surface.first_order(moved).value())) p = moved;
  }
  return moved_to_surface(in_threads, surface, std::move(points), steps);
}

/// Computes the frames of the points, or of a random subset if there are too many.
inline Framed_surface_3 framed_surface(bool in_threads, const Framed_function_3& function,
                                       const Framed_function_3& refinement, const std::vector<Eigen::Vector3d>& given,
                                       Map_kind kind, std::size_t most_points = most_framed_points) {
  Framed_surface_3 result{.function = function, .refinement = refinement};
  const auto points = moved_to_surface(in_threads, function, random_elements(given, most_points, 1));
  result.size = size_of_points(points);
  result.points.resize(points.size());
  parallel_for(
      in_threads, 0, points.size(),
      [&](std::size_t i) {
        result.points[i] = function.framed_point(points[i], kind);
        result.points[i].certainty = function.certainty(points[i]);
      },
      16);
  build_trees(result, kind);
  result.spacing = typical_spacing(result);
  result.probes =
      spread_over_surface(in_threads, refinement, random_elements(points, most_probes, 2), result.spacing / 2);
  if (result.probes.empty()) return result;
  result.chance = chance_of_nearness(in_threads, result);
  result.noise = median_distance(in_threads, refinement, random_elements(given, most_probes, 5)) / result.size;
  return result;
}

/// Whether derivatives are exact, and not those of a fit, which has errors.
inline bool has_exact_frames(const Framed_surface_3& surface) {
  return std::all_of(surface.points.begin(), surface.points.end(),
                     [](const Framed_point_3& p) { return p.certainty == 1; });
}

} // namespace equiaffine::internal

#endif
