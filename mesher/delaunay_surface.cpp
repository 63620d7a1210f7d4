// SPDX-License-Identifier: GPL-3.0-or-later
// The only translation unit of the library that instantiates CGAL's mesher.
#include "Angle_improvement_3.h"
#include "Border_curves_3.h"
#include "Facet_sizing_field.h"
#include "Feature_ends_3.h"
#include "Memoized_function_3.h"
#include "Protecting_balls_3.h"
#include "Surface_criteria_3.h"
#include "orient_triangles.h"
#include "singular_points.h"
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/surface/curve_step.h>
#include <equiaffine/surface/mesh_topology.h>
#include <equiaffine/surface/vertex_links.h>

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Real_timer.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/refine_mesh_3.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The surface alone: no point has to be asked on which side it is.
struct Surface_domain_3 : Implicit_mesh_domain_3<Memoized_function_3> {
  using Implicit_mesh_domain_3::Implicit_mesh_domain_3;

  struct Is_in_domain {
    Subdomain operator()(const Point_3&) const { return Subdomain(); }
  };
  Is_in_domain is_in_domain_object() const { return {}; }
};

/// CGAL's mesher warns on the standard error stream of a triangulation that does not meet the surface.
class Silent_warnings {
public:
  Silent_warnings()
      : handler_(CGAL::set_warning_handler([](const char*, const char*, const char*, int, const char*) {})) {}
  ~Silent_warnings() { CGAL::set_warning_handler(handler_); }
  Silent_warnings(const Silent_warnings&) = delete;
  Silent_warnings& operator=(const Silent_warnings&) = delete;

private:
  CGAL::Failure_function handler_;
};

using Triangulation = CGAL::Mesh_triangulation_3<Surface_domain_3>::type;
using Vertex = Triangulation::Vertex_handle;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Mesh = Delaunay_surface_3<Any_function_3::Kernel>;
using Point_3 = Any_function_3::Point_3;
using Kernel_point = Surface_domain_3::Point_3;
using Features = Protecting_balls_3<Any_function_3::Kernel>;

class Surface_mesher {
public:
  Surface_mesher(const Any_function_3& function, const Clip_domain_3& domain, const Delaunay_criteria& criteria,
                 Facet_sizing sizing, const std::vector<Feature_curve_3>& features)
      : memory_(function), function_(memory_), domain_(function_, domain, criteria.radius), criteria_(criteria),
        size_(function, domain, criteria.radius, sizing), features_(features) {}

  Mesh operator()() {
    CGAL::Real_timer timer;
    timer.start();
    insert_seeds();
    if (complex_.triangulation().dimension() == 3) refine(Manifoldness::ANY);
    if (!result_.triangles.empty() && result_.undecided_boxes.empty() && !has_features_) refine_until_manifold();
    if (has_features_) {
      Angle_improvement_3 improve_angles(function_, domain_.domain(), criteria_, size_);
      improve_angles(result_, is_on_feature_);
    }
    if (result_.is_certified && !topology_.is_manifold) report_where_not_manifold();
    report_what_is_lost();
    result_.function_evaluations = memory_.evaluations();
    result_.sampling_seconds = timer.time();
    return std::move(result_);
  }

private:
  // Of vertices on features, and of others from them, relative to the size of facets: with these, the facets beside
  // features have the angles of others, as far as features themselves do not prevent it.
  static constexpr double feature_spacing = 0.8, feature_clearance = 0.7;
  static constexpr double seed_clearance = 1.7; // the same, relative to the radius of a smaller ball

  void insert_seeds() {
    Certified_seeding_3 seeder(function_, domain_.domain(), size_, criteria_.radius);
    const Features features = cover_curves();
    auto balls = features.balls();
    for (const Features::Ball& ball : balls)
      seeder.keep_away(ball.center, std::min(feature_clearance * size_(ball.center), seed_clearance * ball.radius));
    has_features_ = !balls.empty();
    auto seeding = seeder();
    result_.is_certified = seeding.undecided_boxes.empty();
    result_.undecided_boxes = std::move(seeding.undecided_boxes);
    for (const Point_3& p : nodes_in(function_, result_.undecided_boxes)) add_node(p, seeding.seeds, balls);
    if (seeding.seeds.empty() && balls.empty()) return;
    const auto vertices = insert(balls);
    for (const auto& segment : features.segments())
      feature_edges_.emplace_back(vertices[segment.first], vertices[segment.second]);
    insert(seeding.scaffold, 3);
    insert(seeding.seeds, 2);
  }

  /// Features: where the surface meets the border of the domain, and what the caller gave.
  Features cover_curves() const {
    Features features;
    const auto spacing = [&](const Point_3& p) { return feature_spacing * size_(p); };
    Border_curves_3 boundary(function_, domain_.domain(), criteria_.radius);
    const auto exactly = [](const Point_3& p) { return std::optional(p); };
    Feature_ends_3 ends(domain_.domain(), criteria_.radius);
    for (Feature_curve_3 curve : features_) {
      if (curve.reaches_border) ends.extend(curve);
      const auto project = [this, on_curve = curve.project](const Point_3& p) {
        const auto q = on_curve(p);
        return q && domain_.domain().contains(*q) ? q : std::nullopt;
      };
      const auto project_end = [&](const Point_3& p) { return ends.is_on_border(p) ? std::optional(p) : project(p); };
      features.cover(curve.polyline, spacing, project, project_end);
    }
    for (const auto& curve : boundary())
      for (const auto& piece : ends.split(curve))
        features.cover(
            piece, spacing, [&, axis = curve.axis](const Point_3& p) { return boundary.project(p, axis); }, exactly);
    features.complete();
    return features;
  }

  /// A ball for a node of the surface, which no seed is in.
  void add_node(const Point_3& p, std::vector<Point_3>& seeds, std::vector<Features::Ball>& balls) const {
    if (!domain_.domain().contains(p)) return;
    double radius = 0.4 * size_(p);
    for (const Features::Ball& ball : balls)
      radius = std::min(radius, 0.9 * (std::sqrt(CGAL::squared_distance(p, ball.center)) - ball.radius));
    if (!(radius > 0)) return;
    balls.push_back({p, 0, radius});
    std::erase_if(seeds, [&](const Point_3& q) { return CGAL::squared_distance(p, q) < 2 * radius * radius; });
  }

  std::vector<Vertex> insert(const std::vector<Features::Ball>& balls) {
    std::vector<Vertex> vertices;
    for (const Features::Ball& ball : balls) {
      const Kernel_point p(ball.center.x(), ball.center.y(), ball.center.z());
      vertices.push_back(insert(Triangulation::Weighted_point(p, ball.radius * ball.radius), ball.dimension, {}));
    }
    return vertices;
  }

  void insert(const std::vector<Point_3>& points, int dimension) {
    std::vector<Kernel_point> sorted;
    for (const Point_3& p : points) sorted.emplace_back(p.x(), p.y(), p.z());
    CGAL::spatial_sort(sorted.begin(), sorted.end());
    Triangulation::Cell_handle hint;
    for (const Kernel_point& p : sorted) {
      const Vertex vertex = insert(Triangulation::Weighted_point(p), dimension, hint);
      if (vertex != Vertex()) hint = vertex->cell();
    }
  }

  /// No vertex if the ball of another hides it.
  Vertex insert(const Triangulation::Weighted_point& p, int dimension, Triangulation::Cell_handle hint) {
    const Vertex vertex = complex_.triangulation().insert(p, hint);
    if (vertex == Vertex()) {
      if (dimension < 3) lost_.push_back(p.point());
      return vertex;
    }
    complex_.set_dimension(vertex, dimension);
    complex_.set_index(vertex, 1);
    return vertex;
  }

  void refine(Manifoldness manifoldness) {
    const double smallest = result_.undecided_boxes.empty() ? 0 : criteria_.radius / 8;
    const Surface_criteria_3<Triangulation> criteria(criteria_, size_, smallest);
    const Silent_warnings silence;
    refine_facets(complex_, domain_, criteria, manifoldness);
    read_mesh();
    topology_ = mesh_topology(result_.triangles, result_.points.size());
    if (topology_.is_manifold) return;
    orient_triangles(result_.triangles); // at a crease gradients say nothing
    topology_ = mesh_topology(result_.triangles, result_.points.size());
  }

  /// A seed or vertex of a feature without a triangle, or two neighbors on a feature without an edge: a part of the
  /// surface around them is not in the mesh.
  void report_what_is_lost() {
    const Triangulation& triangulation = complex_.triangulation();
    for (const auto vertex : triangulation.finite_vertex_handles())
      if (vertex->in_dimension() < 3 && !number_.contains(&*vertex))
        lost_.push_back(triangulation.point(vertex).point());
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges; // between vertices of features, smaller index first
    for (const auto& t : result_.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        if (is_on_feature_[t[i]] && is_on_feature_[t[(i + 1) % 3]]) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
    for (const auto& [v, w] : feature_edges_) {
      const auto first = number_.find(&*v), second = number_.find(&*w);
      if (first == number_.end() || second == number_.end()) continue; // reported as a vertex
      if (!edges.contains(std::minmax(first->second, second->second)))
        lost_.push_back(CGAL::midpoint(v->point().point(), w->point().point()));
    }
    for (const Kernel_point& p : lost_) {
      const double r = size_(p);
      result_.undecided_boxes.emplace_back(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
    }
    result_.is_certified = result_.is_certified && lost_.empty();
  }

  /// Seldom needed: on a surface that is sampled densely enough every Delaunay facet has its place (Boissonnat, Oudot).
  void refine_until_manifold() {
    if (topology_.is_manifold) return;
    refine(topology_.boundary_edges > 0 ? Manifoldness::MANIFOLD_WITH_BOUNDARY : Manifoldness::MANIFOLD);
  }

  /// Where parts of the surface, or features, are too near to each other for the radius.
  void report_where_not_manifold() {
    for_each_vertex_link(result_.triangles, result_.points.size(), [&](const auto& link) {
      const Point_3& p = result_.points[link.vertex()];
      if (!link.is_path_or_circle()) lost_.emplace_back(p.x(), p.y(), p.z());
    });
  }

  void read_mesh() {
    result_.points.clear();
    result_.triangles.clear();
    std::vector<Any_function_3::Vector_3> gradients;
    number_.clear();
    is_on_feature_.clear();
    for (auto facet = complex_.facets_in_complex_begin(); facet != complex_.facets_in_complex_end(); ++facet) {
      std::array<std::uint32_t, 3> triangle;
      for (int i = 0; i < 3; ++i) {
        const auto vertex = facet->first->vertex((facet->second + 1 + i) & 3);
        const auto [entry, is_new] = number_.try_emplace(&*vertex, std::uint32_t(number_.size()));
        triangle[std::size_t(i)] = entry->second;
        if (!is_new) continue;
        is_on_feature_.push_back(vertex->in_dimension() < 2);
        const auto& p = vertex->point();
        result_.points.emplace_back(p.x(), p.y(), p.z());
        const auto jet = function_.first_order(result_.points.back());
        gradients.push_back(gradient_of<Any_function_3::Vector_3>(jet));
      }
      const auto& [a, b, c] = triangle;
      const auto& p = result_.points;
      const auto normal = CGAL::cross_product(p[b] - p[a], p[c] - p[a]);
      if (normal * (gradients[a] + gradients[b] + gradients[c]) < 0) std::swap(triangle[1], triangle[2]);
      result_.triangles.push_back(triangle);
    }
    result_.vertex_status.assign(result_.points.size(), Point_status::REGULAR);
  }

  Memoized_function_3::Memory memory_;
  Memoized_function_3 function_;
  Surface_domain_3 domain_;
  Delaunay_criteria criteria_;
  Facet_sizing_field size_;
  const std::vector<Feature_curve_3>& features_;
  Complex complex_;
  Mesh_topology topology_;
  bool has_features_ = false;
  std::vector<std::pair<Vertex, Vertex>> feature_edges_;
  std::unordered_map<const void*, std::uint32_t> number_; // of the vertices of the mesh
  std::vector<bool> is_on_feature_;                       // per vertex of the mesh
  std::vector<Kernel_point> lost_;                        // where something of the surface is not in the mesh
  Mesh result_;
};

} // namespace

Mesh mesh_surface(const Any_function_3& function, const Clip_domain_3& domain, const Delaunay_criteria& criteria,
                  Facet_sizing sizing, const std::vector<Feature_curve_3>& features) {
  return Surface_mesher(function, domain, criteria, sizing, features)();
}

void report_straddling_triangles(Mesh& mesh, const Any_function_3& function, double radius) {
  constexpr double negligible = 1e-8; // beside the principal curvatures, or much less beside that of a facet's ball
  std::vector<int> sign;
  for (const Point_3& p : mesh.points) {
    const auto e = local_structure(function.taylor(p)).euclidean;
    const double least = negligible * (e.k1 * e.k1 + e.k2 * e.k2 + negligible / (radius * radius));
    sign.push_back((e.gaussian_curvature > least) - (e.gaussian_curvature < -least));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (std::min({sign[a], sign[b], sign[c]}) >= 0 || std::max({sign[a], sign[b], sign[c]}) <= 0) continue;
    mesh.undecided_boxes.push_back(mesh.points[a].bbox() + mesh.points[b].bbox() + mesh.points[c].bbox());
    mesh.is_certified = false;
  }
}

} // namespace equiaffine::internal
