// SPDX-License-Identifier: GPL-3.0-or-later
// The only translation unit of the library that instantiates CGAL's mesher.
#include "delaunay/Angle_improvement_3.h"
#include "delaunay/Facet_mesh.h"
#include "delaunay/Feature_curve_3.h"
#include "delaunay/Surface_complex.h"
#include "delaunay/Surface_criteria_3.h"
#include "delaunay/initial_points.h"
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <CGAL/Real_timer.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/exceptions.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Silences CGAL's messages during its lifetime: on the standard error stream, the mesher warns about a triangulation
/// that does not meet the surface and, with some compilers, reports what it throws.
class Silent_messages {
public:
  Silent_messages()
      : warning_handler_(CGAL::set_warning_handler(ignore)), error_handler_(CGAL::set_error_handler(ignore)) {}
  ~Silent_messages() {
    CGAL::set_warning_handler(warning_handler_);
    CGAL::set_error_handler(error_handler_);
  }
  Silent_messages(const Silent_messages&) = delete;
  Silent_messages& operator=(const Silent_messages&) = delete;

private:
  static void ignore(const char*, const char*, const char*, int, const char*) {}

  CGAL::Failure_function warning_handler_, error_handler_;
};

/// The sign of the Gaussian curvature of the surface at a point; 0 if the curvature is negligible compared to k1 and
/// k2, or to the curvature 1/radius of a facet's ball.
inline int sign_of_gaussian_curvature(const Any_function_3& function, const Any_function_3::Point_3& p, double radius) {
  constexpr double negligible = 1e-8;
  const auto e = local_structure(function.taylor(p)).euclidean;
  const double least = negligible * (e.k1 * e.k1 + e.k2 * e.k2 + negligible / (radius * radius));
  return (e.gaussian_curvature > least) - (e.gaussian_curvature < -least);
}

/// Adds undecided boxes for triangles with vertices on both sides of a parabolic curve, so that the mesh is not
/// certified.
inline void report_straddling_triangles(const Any_function_3& function, double radius,
                                        Delaunay_surface_3<Any_function_3::Kernel>& mesh) {
  std::vector<int> sign;
  for (const auto& p : mesh.points) sign.push_back(sign_of_gaussian_curvature(function, p, radius));
  for (const auto& [a, b, c] : mesh.triangles) {
    if (std::min({sign[a], sign[b], sign[c]}) >= 0 || std::max({sign[a], sign[b], sign[c]}) <= 0) continue;
    mesh.undecided_boxes.push_back(mesh.points[a].bbox() + mesh.points[b].bbox() + mesh.points[c].bbox());
    mesh.is_certified = false;
  }
}

namespace {

using Mesh = Delaunay_surface_3<Any_function_3::Kernel>;

/// Computes one mesh: finds initial points, inserts them, refines the triangulation, and finds the boxes in which a
/// part of the surface may be missing from the mesh.
class Surface_mesher {
public:
  Surface_mesher(const Any_function_3& function, const Meshing_request_3& request,
                 const std::vector<Feature_curve_3>& features)
      : memory_(function), function_(memory_),
        domain_(function_, {.clip = request.domain, .radius = request.criteria.radius}), criteria_(request.criteria),
        size_(function, request.domain, criteria_.radius, request.sizing), features_(features) {}

  Mesh operator()() {
    CGAL::Real_timer timer;
    timer.start();
    const Initial_points points = find_initial_points(function_, domain_.domain(), criteria_.radius, size_, features_);
    const Inserted_points inserted = insert_points(complex_, points);
    Facet_mesh mesh = refine(points);
    if (points.has_features) {
      add_missing_facets(inserted, mesh);
      improve_angles(mesh);
    }
    mesh.surface.undecided_boxes = undecided_boxes(points, inserted, mesh);
    mesh.surface.is_certified = mesh.surface.undecided_boxes.empty();
    mesh.surface.function_evaluations = memory_.evaluations();
    mesh.surface.sampling_seconds = timer.time();
    return std::move(mesh.surface);
  }

private:
  /// Refines the triangulation and returns the mesh. If the surface is sampled densely enough, the mesh is a manifold
  /// at once (Boissonnat, Oudot). If it is not, refinement continues until it is, unless features or undecided boxes
  /// may prevent that.
  Facet_mesh refine(const Initial_points& points) {
    if (complex_.triangulation().dimension() < 3) return {};
    const bool is_decided = points.undecided_boxes.empty();
    const double smallest = is_decided ? 0 : criteria_.radius / 8; // limits refinement near singular points
    Facet_mesh mesh = refine(Manifoldness::ANY, smallest);
    if (mesh.topology.is_manifold || mesh.surface.triangles.empty() || !is_decided || points.has_features ||
        !is_refined_)
      return mesh;
    const bool has_boundary = mesh.topology.boundary_edges > 0;
    return refine(has_boundary ? Manifoldness::MANIFOLD_WITH_BOUNDARY : Manifoldness::MANIFOLD, smallest);
  }

  /// CGAL's mesher gives up if the segment between the circumcenters next to a facet leads to another sheet of the
  /// surface, which may happen if facets are much larger than the bends of the surface. The mesh is then returned as
  /// it is.
  Facet_mesh refine(Manifoldness manifoldness, double smallest) {
    const Silent_messages silence;
    try {
      refine_facets(complex_, domain_, Surface_criteria_3<Surface_triangulation>(criteria_, size_, smallest),
                    manifoldness);
    } catch (const CGAL::Assertion_exception&) {
      is_refined_ = false;
    }
    return read_facets(complex_, function_);
  }

  void improve_angles(Facet_mesh& mesh) {
    Angle_improvement_3 improve(function_, domain_.domain(), criteria_, size_);
    improve(mesh.surface, mesh.is_on_feature);
  }

  /// The boxes that the seeding left undecided, one with the radius of a facet around every point that the mesh has
  /// lost, and the whole box if the mesher gave up.
  std::vector<CGAL::Bbox_3> undecided_boxes(const Initial_points& points, const Inserted_points& inserted,
                                            const Facet_mesh& mesh) const {
    Lost_points lost = inserted.hidden;
    if (points.undecided_boxes.empty() && !mesh.topology.is_manifold) append_singular_vertices(mesh, lost);
    append_isolated_vertices(complex_.triangulation(), mesh, lost);
    append_missing_feature_edges(inserted, mesh, lost);
    std::vector<CGAL::Bbox_3> boxes = points.undecided_boxes;
    if (!is_refined_) boxes.push_back(domain_.bbox());
    for (const auto& p : lost) {
      const double r = size_(p);
      boxes.emplace_back(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
    }
    return boxes;
  }

  Memoized_function_3::Memory memory_;
  Memoized_function_3 function_;
  Surface_domain_3 domain_;
  const Delaunay_criteria& criteria_;
  Facet_sizing_field size_;
  const std::vector<Feature_curve_3>& features_;
  Surface_complex complex_;
  bool is_refined_ = true; // whether all facets satisfy the criteria
};

/// Remeshes with additional features; accumulates the cost of both runs.
Mesh mesh_again(const Mesh& earlier, const Any_function_3& function, const Meshing_request_3& request,
                const std::vector<Feature_curve_3>& features) {
  Mesh mesh = Surface_mesher(function, request, features)();
  mesh.function_evaluations += earlier.function_evaluations;
  mesh.sampling_seconds += earlier.sampling_seconds;
  return mesh;
}

/// Computes the first mesh, and a second one if the surface ends where f becomes undefined: the curves where it ends
/// become features.
Mesh mesh_to_the_ends(const Any_function_3& function, const Meshing_request_3& request,
                      std::vector<Feature_curve_3>& features) {
  Mesh mesh = Surface_mesher(function, request, features)();
  const auto ends = End_curves_3(function, request.domain, request.criteria.radius).find(mesh);
  if (ends.empty()) return mesh;
  features.insert(features.end(), ends.begin(), ends.end());
  return mesh_again(mesh, function, request, features);
}

/// Computes another mesh with the parabolic curves of the last one as features.
Mesh follow_parabolic_curves(const Mesh& last, const Any_function_3& function, const Meshing_request_3& request,
                             std::vector<Feature_curve_3> features) {
  auto curves = parabolic_curves(last, function);
  append_parabolic_features(function, curves.polylines, request.criteria.radius, features);
  Mesh mesh = mesh_again(last, function, request, features);
  mesh.parabolic_curves = std::move(curves);
  report_straddling_triangles(function, request.criteria.radius, mesh);
  return mesh;
}

} // namespace

Delaunay_surface_3<Any_function_3::Kernel> mesh_surface(const Any_function_3& function,
                                                        const Meshing_request_3& request) {
  auto features = given_features(function, request);
  Mesh mesh = mesh_to_the_ends(function, request, features);
  return request.follows_parabolic_curves ? follow_parabolic_curves(mesh, function, request, features) : mesh;
}

} // namespace equiaffine::internal
