// SPDX-License-Identifier: GPL-3.0-or-later
// Moves the vertices of a triangle mesh onto the zero set of a fit.
#ifndef EQUIAFFINE_FIT_MOVE_TO_FIT_H
#define EQUIAFFINE_FIT_MOVE_TO_FIT_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_outcome.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/Triangle_array_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/surface/internal/jet_derivatives.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/number_utils.h>
#include <CGAL/tags.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The zero of a fit for a vertex of a mesh, if there is one.
struct Zero_of_fit_3 {
  Fit_outcome outcome;
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit normal of the fit at the zero
};

/// Finds the zero of a fit for a vertex with a normal, which need not be a unit vector, and a mean edge length. If
/// the fit has no derivatives at the vertex, the search starts above or below it.
template <class Fit>
Zero_of_fit_3 zero_of_fit(const Fit& fit, const Eigen::Vector3d& vertex, const Eigen::Vector3d& normal, double edge) {
  using FT = typename Fit::FT;
  constexpr double least_cosine = 0.5; // of the angle between the normals of fit and mesh
  constexpr double reach = 0.5;        // of a zero, as a multiple of the edge length or of the spacing of the data
  const auto is_known = [](const auto& jet) { return std::isfinite(CGAL::to_double(jet.value())); };
  typename Fit::Point_3 start(vertex[0], vertex[1], vertex[2]);
  auto jet = fit.first_order(start);
  if (!is_known(jet)) {
    start = fit.on_tangent_plane(start);
    jet = fit.first_order(start);
  }
  if (!is_known(jet)) return {Fit_outcome::NO_VALUE};
  const auto agrees = [&](const Eigen::Vector3d& g) {
    return g.dot(normal) >= least_cosine * g.norm() * normal.norm();
  };
  if (!agrees(eigen_gradient(jet))) return {Fit_outcome::OTHER_SIDE};
  const double farthest = reach * std::max(edge, CGAL::to_double(fit.spacing(start)));
  const auto zero = project_to_surface(fit, start, FT(farthest), jet);
  const Eigen::Vector3d move = coordinates_of(zero.point) - vertex;
  if (!zero.has_converged || !(move.norm() <= farthest)) return {Fit_outcome::NO_ZERO};
  const Eigen::Vector3d gradient = eigen_gradient(fit.first_order(zero.point));
  if (!agrees(gradient)) return {Fit_outcome::OTHER_SIDE};
  return {Fit_outcome::ON_FIT, move, gradient.normalized()};
}

/// Moves the vertices of a mesh to their zeros of a fit, such that no triangle flips and no new intersections of
/// triangles occur. Vertices without a zero follow their neighbors, and vertices on features stay. Where a triangle
/// flips or intersects another one, the followers are put back first, and then the vertices with a zero if that is
/// not enough. This terminates, because the given positions are valid; after a number of rounds whole neighborhoods
/// of growing size are put back.
class Whole_motion_3 {
public:
  using Vector = Eigen::Vector3d;

  /// Takes the pairs of intersecting triangles of the mesh, sorted.
  Whole_motion_3(const Triangle_array_3& mesh, std::vector<Zero_of_fit_3> zeros, std::vector<Triangle_pair> crossings)
      : mesh_(mesh), zeros_(std::move(zeros)), stays_(mesh.points().size()), moved_(mesh.points()),
        tested_(mesh.points()), old_crossings_(std::move(crossings)), crossings_(old_crossings_) {
    for (std::size_t v = 0; v < zeros_.size(); ++v) stays_[v] = is_on_feature(v);
    keep_to_one_sheet();
    while (true) {
      follow();
      if (!hold_turned_triangles() && !hold_crossing_triangles()) break;
      ++rounds_;
      widen();
    }
  }

  const std::vector<Vector>& points() const { return moved_; }
  Fit_outcome outcome(std::size_t v) const { return zeros_[v].outcome; }
  std::size_t crossings() const { return crossings_.size(); }

private:
  bool is_on_fit(std::size_t v) const { return zeros_[v].outcome == Fit_outcome::ON_FIT; }
  bool is_on_feature(std::size_t v) const { return zeros_[v].outcome == Fit_outcome::ON_FEATURE; }

  /// Whether two neighbors move to the same sheet of the fit: their moves differ little, or the new edge is about as
  /// oblique to the normals at both ends as a chord of a smooth surface, whose mean angle to them is a right angle.
  bool agree(std::size_t u, std::size_t v) const {
    constexpr double slope = 0.35, chord_slope = 0.2;
    const Vector edge = mesh_.points()[v] - mesh_.points()[u];
    const Vector change = zeros_[v].move - zeros_[u].move, chord = edge + change;
    if (change.norm() <= slope * edge.norm()) return true;
    return std::abs(chord.dot(zeros_[u].normal + zeros_[v].normal)) <= 2 * chord_slope * chord.norm();
  }

  /// Whether a vertex moves away from a neighbor on a feature, which stays: the fit rounds the feature off.
  bool leaves(std::size_t v, std::size_t feature) const {
    constexpr double slope = 0.2;
    return zeros_[v].move.norm() > slope * (mesh_.points()[v] - mesh_.points()[feature]).norm();
  }

  /// Discards the larger move of two neighbors that disagree, and moves away from features.
  void keep_to_one_sheet() {
    std::vector<std::size_t> torn;
    for (std::size_t v = 0; v < zeros_.size(); ++v) {
      if (!is_on_fit(v)) continue;
      for (const auto u : mesh_.neighbors(v))
        if (is_on_feature(u) && leaves(v, u)) torn.push_back(v);
        else if (u < v && is_on_fit(u) && !agree(u, v))
          torn.push_back(zeros_[u].move.squaredNorm() > zeros_[v].move.squaredNorm() ? u : v);
    }
    for (const auto v : torn) zeros_[v].outcome = Fit_outcome::TORN_AWAY;
  }

  /// Vertices without a zero take the mean move of their neighbors, damped with every edge away from the fit.
  void follow() {
    constexpr int rings = 20;
    constexpr double loss = 0.03;
    std::vector<Vector> moves(zeros_.size(), Vector::Zero());
    std::vector<std::uint32_t> followers;
    for (std::uint32_t v = 0; v < zeros_.size(); ++v)
      if (is_on_fit(v)) moves[v] = zeros_[v].move;
      else if (!stays_[v] && !mesh_.neighbors(v).empty()) followers.push_back(v);
    std::vector<Vector> next(followers.size());
    for (int n = 0; n < rings; ++n) {
      for (std::size_t k = 0; k < followers.size(); ++k) {
        const auto around = mesh_.neighbors(followers[k]);
        next[k] = Vector::Zero();
        for (const auto u : around) next[k] += moves[u];
        next[k] /= double(around.size()) * (1 + loss);
      }
      for (std::size_t k = 0; k < followers.size(); ++k) moves[followers[k]] = next[k];
    }
    for (std::size_t v = 0; v < zeros_.size(); ++v) moved_[v] = mesh_.points()[v] + moves[v];
  }

  bool has_moved(const Index_triangle& t) const {
    return std::any_of(t.begin(), t.end(), [&](auto v) { return moved_[v] != mesh_.points()[v]; });
  }

  /// Marks vertices of a triangle to be put back: the followers, or all if there are none.
  void hold(const Index_triangle& t, Fit_outcome why) {
    bool follows = false;
    for (const auto v : t)
      if (!is_on_fit(v) && moved_[v] != mesh_.points()[v]) held_.emplace_back(v, why), follows = true;
    if (follows) return;
    for (const auto v : t)
      if (moved_[v] != mesh_.points()[v]) held_.emplace_back(v, why);
  }

  /// Fixes the marked vertices. Returns whether there are any.
  bool make_stay() {
    for (const auto& [v, why] : held_) {
      if (is_on_fit(v)) zeros_[v].outcome = why;
      stays_[v] = 1;
    }
    return !held_.empty();
  }

  bool hold_turned_triangles() {
    constexpr double least_cosine = 0.5;
    held_.clear();
    for (const auto& t : mesh_.triangles()) {
      if (!has_moved(t)) continue;
      const Vector before = mesh_.normal(t, mesh_.points()), after = mesh_.normal(t, moved_);
      if (!(before.dot(after) > least_cosine * before.norm() * after.norm())) hold(t, Fit_outcome::TURNED);
    }
    return make_stay();
  }

  /// Tests only the triangles that have moved since the last test.
  bool hold_crossing_triangles() {
    held_.clear();
    const auto& triangles = mesh_.triangles();
    std::vector<char> is_changed(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      is_changed[t] =
          std::any_of(triangles[t].begin(), triangles[t].end(), [&](auto v) { return moved_[v] != tested_[v]; });
    std::erase_if(crossings_, [&](const auto& pair) { return is_changed[pair.first] || is_changed[pair.second]; });
    const auto found = crossing_triangles(moved_, triangles, is_changed);
    crossings_.insert(crossings_.end(), found.begin(), found.end());
    tested_ = moved_;
    for (const auto& pair : crossings_) {
      if (std::binary_search(old_crossings_.begin(), old_crossings_.end(), pair)) continue;
      hold(triangles[pair.first], Fit_outcome::CROSSING);
      hold(triangles[pair.second], Fit_outcome::CROSSING);
    }
    return make_stay();
  }

  /// After many rounds, fixes the vertices around those marked, too: 1 ring of them, then 2, 4, and so on.
  void widen() {
    constexpr int many = 20;
    if (rounds_ <= many) return;
    std::vector<std::pair<std::uint32_t, Fit_outcome>> ring = std::move(held_);
    for (std::size_t n = std::size_t(1) << std::min(rounds_ - many - 1, 30); n > 0 && !ring.empty(); --n) {
      held_.clear();
      for (const auto& [v, why] : ring)
        for (const auto u : mesh_.neighbors(v))
          if (!stays_[u]) stays_[u] = 1, held_.emplace_back(u, why);
      make_stay();
      ring = std::move(held_);
    }
  }

  const Triangle_array_3& mesh_;
  std::vector<Zero_of_fit_3> zeros_;
  std::vector<char> stays_; ///< per vertex
  std::vector<Vector> moved_, tested_;
  std::vector<std::pair<std::uint32_t, Fit_outcome>> held_; ///< marked in this round
  std::vector<Triangle_pair> old_crossings_, crossings_;
  int rounds_ = 0;
};

/// Computes the motion of a mesh to a fit, given the intersecting pairs of its triangles. Vertices marked as
/// features stay; without marks there are none.
template <class ConcurrencyTag, class Fit>
Whole_motion_3 motion_to_fit(const Triangle_array_3& mesh, const Fit& fit, std::vector<Triangle_pair> crossings,
                             const std::vector<char>& is_feature = {}) {
  const std::vector<Eigen::Vector3d> normals = mesh.vertex_normals();
  std::vector<Zero_of_fit_3> zeros(normals.size());
  parallel_for<ConcurrencyTag>(
      0, zeros.size(),
      [&](std::size_t v) {
        zeros[v] = !is_feature.empty() && is_feature[v]
                       ? Zero_of_fit_3{Fit_outcome::ON_FEATURE}
                       : zero_of_fit(fit, mesh.points()[v], normals[v], mesh.mean_edge(v));
      },
      64);
  return Whole_motion_3(mesh, std::move(zeros), std::move(crossings));
}

/// Assigns the new points and the outcomes to the vertices of a mesh.
template <class Kernel, class Mesh, class Parameters>
Fit_move_report apply_motion(Mesh& mesh, const Whole_motion_3& motion, const Parameters& parameters) {
  const auto point_of = vertex_points(mesh, parameters);
  Fit_move_report report;
  report.crossings = motion.crossings();
  std::size_t n = 0;
  for (const auto v : vertices_of(mesh)) {
    const Eigen::Vector3d& p = motion.points()[n];
    const Fit_outcome outcome = motion.outcome(n++);
    report.largest_move = std::max(report.largest_move, (p - coordinates_of(get(point_of, v))).norm());
    ++report.number_of[std::size_t(outcome)];
    put(point_of, v, typename Kernel::Point_3(p[0], p[1], p[2]));
    if constexpr (has_parameter<Vertex_outcome_tag, Parameters>)
      put(given_parameter<Vertex_outcome_tag>(parameters), v, outcome);
  }
  return report;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Moves the vertices of a triangle mesh onto the zero set of a fit to it, or to a surface near it, as far as the
/// mesh stays valid: no triangle turns by more than 60 degrees, and no new intersections of triangles occur. The
/// connectivity does not change, so closed meshes stay closed and borders stay borders.
///
/// A vertex moves along the gradient of the fit, by at most 1.25 times the mean length of its edges, or of the
/// spacing of the data if that is larger. It does not move to the fit if the fit has no derivatives or no zero close
/// enough, has a different orientation, or is that of another sheet. Such vertices follow their neighbors, damped
/// with every edge away from the fit.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | writable property map | the mesh's own | from vertices to points of the fit's kernel |
/// | `vertex_outcome_map` | writable property map | none | from vertices to Fit_outcome |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL, and ignored.
///
/// Takes about 30 microseconds per vertex, and n log n time for the search for intersections in each of at most
/// about 20 + log n rounds. CGAL::Parallel_tag gives the same numbers.
/// \throw std::invalid_argument if a face is not a triangle, or a coordinate is not finite.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Mesh, class Kernel,
          internal::Parameter_chain... Parameters>
Fit_move_report move_to_fit(Mesh& mesh, const Fitted_function_traits_3<Kernel>& fit, const Parameters&... given) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Vertex_point_tag,
                             internal::Vertex_outcome_tag, internal::Geom_traits_tag, internal::Verbose_tag>();
  const auto parameters = internal::joined_parameters(given...);
  const auto array = internal::triangle_array_of(mesh, parameters);
  const auto motion = internal::motion_to_fit<ConcurrencyTag>(
      array, fit, internal::crossing_triangles(array.points(), array.triangles()));
  return internal::apply_motion<Kernel>(mesh, motion, parameters);
}

} // namespace equiaffine

#endif
