// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/make_surface.h"

#include "commands/extract_surface.h"
#include "request/Request.h"
#include "source/evaluate_source.h"
#include "source/source.h"
#include "source/source_function.h"
#include "source/warnings.h"
#include "system/expected_duration.h"
#include "system/front_end.h"
#include "system/memory_limit.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/volume/Lattice_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>

namespace equiaffine {

namespace {

constexpr const char* extracting = "extracting the surface";

/// Throws `Input_error` if `delaunay_surface` would reject the box.
void check_box_of_delaunay_surface(const CGAL::Bbox_3& box) {
  const internal::Delaunay_range range(box);
  if (range.has_box()) return;
  std::ostringstream text;
  text << "the box of the function has the diagonal " << range.diagonal() << " and coordinates up to "
       << std::max(range.diagonal(), range.greatest_coordinate()) << ", and " << option_text("method", "delaunay")
       << " needs numbers from " << internal::Delaunay_range::least << " to " << internal::Delaunay_range::greatest
       << "; choose another unit";
  throw Input_error(text.str());
}

/// Throws `Input_error` if `delaunay_surface` would reject the radius.
void check_radius_of_delaunay_surface(const CGAL::Bbox_3& box, double radius) {
  const internal::Delaunay_range range(box);
  if (radius >= range.least_radius()) return;
  std::ostringstream text;
  text << "a radius of " << radius << " is too small for coordinates up to " << range.greatest_coordinate()
       << ", which need at least " << range.least_radius() << "; choose a larger " << option_text("radius")
       << ", or an origin nearer to the box";
  throw Input_error(text.str());
}

/// Announces the duration of a stage that calls `run(options)` on the grid of the source, if it takes minutes. Calls it
/// on coarser grids.
template <class Run>
void announce_duration_on_grid(const std::string& stage, const Source_options& options, Progress& progress,
                               const Run& run) {
  if (options.kind == Source_kind::VOLUME) return; // the volume has the grid
  const std::array<std::size_t, 3> size = options.resolution.value_or(default_resolution(options.kind));
  const double fineness = double(*std::max_element(size.begin(), size.end()));
  announce_duration(stage, "a smaller " + option_text("resolution"), fineness, true, progress, [&](double coarse) {
    Source_options with_grid = options;
    with_grid.resolution = size;
    for (std::size_t& n : *with_grid.resolution)
      n = std::size_t(std::max(2., std::round(double(n) * coarse / fineness)));
    run(with_grid);
  });
}

/// Samples the surface; annotated_surface() adds attributes. The mesh does not depend on the orientation of the level
/// set; annotated_surface() flips the triangles.
Annotated_surface sample_on_grid(const Source_function& function, const Request& options, Progress& progress) {
  const auto extract = [&](const Source_options& source) {
    return extract_surface(function, options.source.level, source, options.marching_cubes.vertices);
  };
  if (options.source.derivatives == Derivatives::JETS) // splines have the grid of their samples
    announce_duration_on_grid(extracting, options.source, progress, extract);
  progress.begin(extracting);
  Annotated_surface surface;
  surface.mesh = extract(options.source);
  if (surface.mesh.triangles.empty())
    fail_without_surface(function, options.source, options.source.level,
                         {"box", "a finer " + option_text("resolution"), surface.mesh.repairs.vertices_at_poles > 0});
  return surface;
}

Annotated_surface sample_by_delaunay(const Source_function& function, const Request& options, Progress& progress) {
  const Any_function_3 level_set = any_level_set(function, options.source.level);
  const CGAL::Bbox_3 box = level_set.bbox();
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  check_box_of_delaunay_surface(box);
  const Clip_domain_3 domain = clip_domain(options.delaunay.clip, box);
  check_box_of_delaunay_surface(domain.bbox());
  Delaunay_options delaunay = options.delaunay;
  if (delaunay.radius) delaunay.radius = std::min(*delaunay.radius, diagonal); // a larger bound has no effect
  delaunay = delaunay.completed(box);
  const double radius = *delaunay.radius, distance = *delaunay.distance;
  check_memory_of_delaunay_surface(diagonal, radius, distance, options.source.memory_use);
  check_radius_of_delaunay_surface(box, radius);
  const double fineness = diagonal / std::min(radius, std::sqrt(distance * diagonal));
  announce_duration(extracting, "a larger " + option_text("radius") + " or " + option_text("distance"), fineness, false,
                    progress, [&](double coarse) {
                      const double factor = fineness / coarse;
                      Delaunay_options coarser = delaunay;
                      coarser.parabolic_curves = false;
                      coarser.radius = std::min(factor * radius, diagonal);
                      coarser.distance = std::min(factor * factor * distance, diagonal);
                      delaunay_surface(level_set, coarser);
                    });
  progress.begin(extracting);
  auto mesh = delaunay_surface(level_set, delaunay);
  if (mesh.triangles.empty())
    fail_without_surface(function, options.source, options.source.level,
                         {domain.is_ball() ? "ball" : "box",
                          mesh.is_certified ? "" : "a smaller " + option_text("radius"),
                          changes_sign_at_poles_only(function, options.source.level), mesh.is_certified});
  Annotated_surface surface;
  surface.completeness = {mesh.is_certified, std::move(mesh.undecided_boxes)};
  if (options.parabolic_curves) surface.curves = std::move(mesh.parabolic_curves);
  surface.mesh = std::move(mesh);
  return surface;
}

/// The remeshed faces of the data of a fit, or the reason why they could not be remeshed by default.
struct Remesh {
  std::optional<Remeshed_fit> fit;
  std::string reason_against;
};

Remesh remesh_of_source(Source& source, const Request& options, Progress& progress) {
  const bool is_asked_for = options.method == Mesh_method::REMESH;
  if (!is_asked_for && (!options.remeshes_faces || source.data.triangles.empty())) return {};
  try {
    return {remesh_fit(source, options.source, options.remesh, progress), ""};
  } catch (const Input_error& error) {
    if (is_asked_for) throw;
    return {std::nullopt, error.what()};
  }
}

/// Samples the surface by the requested method, or takes the remesh.
Annotated_surface sample(const Source_function& function, const Request& options, Remesh remesh,
                         Progress& progress) {
  if (remesh.fit) {
    Annotated_surface surface;
    surface.mesh = std::move(remesh.fit->mesh);
    surface.outcomes = std::move(remesh.fit->outcomes);
    surface.remesh = remesh.fit->statistics;
    return surface;
  }
  Annotated_surface surface = options.method == Mesh_method::DELAUNAY ? sample_by_delaunay(function, options, progress)
                                                                      : sample_on_grid(function, options, progress);
  surface.reason_against_remesh = std::move(remesh.reason_against);
  return surface;
}

/// The length of the longest step of the grid of a source on a box.
double longest_step(const CGAL::Bbox_3& box, const Source_options& options) {
  const Lattice_3<Kernel> lattice(options.resolution.value_or(default_resolution(options.kind)), box);
  double longest = 0;
  for (const auto& step : lattice.steps()) longest = std::max(longest, std::sqrt(step.squared_length()));
  return longest;
}

/// Samples the surface and computes its attributes, unless that is done later.
Annotated_surface annotated_surface(const Source& source, const Request& options, Remesh remesh,
                                    Attribute_time time, Progress& progress) {
  Annotated_surface surface = sample(source.function, options, std::move(remesh), progress);
  if (source.fit && !surface.remesh) {
    remove_small_fragments(surface.mesh, *source.fit, options.source);
    if (surface.mesh.triangles.empty())
      fail_without_surface(source.function, options.source, options.source.level,
                           {"box", "a finer " + option_text("resolution"), false});
    if (options.method == Mesh_method::MARCHING_CUBES)
      surface.close_sheets = source.fit->close_sheets(longest_step(source.fit->bbox(), options.source));
  }
  if (options.largest) surface.components_left_out = keep_largest(surface.mesh, *options.largest, surface.outcomes);
  if (surface.components_left_out > 0) surface.curves.reset(); // computed below for the remaining components
  if (options.orientation == Orientation_of_level_set::AGAINST_GRADIENT)
    for (auto& triangle : surface.mesh.triangles) std::swap(triangle[1], triangle[2]);
  if (time == Attribute_time::LATER) return surface;
  const Stopwatch stopwatch;
  progress.begin("computing attributes");
  for_each_attribute_block(
      source, options, surface, surface.mesh.points.size(),
      [&](std::size_t, Vertex_attributes&& attributes) { surface.attributes = std::move(attributes); });
  surface.estimates = estimates_at(source, options.source, surface.mesh.points, progress);
  add_estimates(surface.estimates, options.estimates, surface.attributes);
  if (surface.remesh && !options.attributes.columns.empty())
    surface.attributes.columns.push_back({"fit_outcome", std::move(surface.outcomes)});
  surface.annotation_seconds = stopwatch.seconds();
  if (options.parabolic_curves && !surface.curves) {
    progress.begin("finding parabolic curves");
    surface.curves = parabolic_curves<CGAL::Parallel_if_available_tag>(
        surface.mesh, any_level_set(source.function, options.source.level, options.orientation));
  }
  return surface;
}

} // namespace

void for_each_attribute_block(const Source& source, const Request& options, Annotated_surface& surface,
                              std::size_t vertices_of_block,
                              const std::function<void(std::size_t, Vertex_attributes&&)>& visit) {
  const std::span<const Kernel::Point_3> points(surface.mesh.points);
  const std::span<const Point_status> sampled_status(surface.mesh.vertex_status);
  surface.max_distance =
      max_distance_to_source(source.function, options.source.level, options.orientation, points, sampled_status);
  Attribute_selection selection = options.attributes;
  selection.has_status = true;
  const auto areas = selected_vertex_areas(selection, points, surface.mesh.triangles);
  for (std::size_t first = 0; first < points.size(); first += vertices_of_block) {
    const std::size_t count = std::min(vertices_of_block, points.size() - first);
    Vertex_attributes attributes = attributes_of_source(
        source.function, options.orientation, points.subspan(first, count), selection, options.estimator,
        Sampled_vertices(sampled_status, areas).part(first, count));
    const auto counts = equiaffine::count(*attributes.status);
    for (std::size_t s = 0; s < counts.size(); ++s) surface.status[s] += counts[s];
    if (!options.attributes.has_status) attributes.status.reset();
    visit(first, std::move(attributes));
  }
  surface.mesh.function_evaluations += 3 * points.size();
}

void check_memory(const Request& options) {
  if (options.source.derivatives == Derivatives::JETS && options.method == Mesh_method::MARCHING_CUBES)
    check_memory_of_surface(options.source.resolution.value_or(default_resolution(options.source.kind)),
                            options.source.memory_use);
}

void warn_of(const Annotated_surface& surface, const Source& source, const Request& options, Progress& progress) {
  if (!options.attributes.columns.empty())
    warn_of_outside(options.source, source, surface.status[std::size_t(Point_status::OUTSIDE)],
                    surface.mesh.points.size(), "vertices", progress);
  const bool has_curvatures =
      !options.attributes.columns.empty() && surface.status[std::size_t(Point_status::REGULAR)] > 0;
  if (has_curvatures && source.spline && options.source.kind == Source_kind::VOLUME)
    warn_of_steps(*source.spline, progress);
  if (!surface.reason_against_remesh.empty())
    progress.warn("cannot remesh the faces; Marching Cubes is used instead: " + surface.reason_against_remesh);
  if (surface.close_sheets) warn_of_close_sheets(*surface.close_sheets, progress);
  if (surface.estimates.fit)
    warn_of_doubt(*surface.estimates.fit, options.source.fit,
                  has_affine_curvatures(options.attributes, options.estimates), false, progress);
}

Annotated_surface surface_of(const Source& source, const Request& options, Progress& progress) {
  return annotated_surface(source, options, {}, Attribute_time::WITH_SURFACE, progress);
}

Made_surface make_surface(const Request& options, Progress& progress, Attribute_time time) {
  const Stopwatch stopwatch;
  Source source = make_source(options.source, progress, options.delaunay.radius.value_or(0));
  const double seconds = stopwatch.seconds();
  Remesh remesh = remesh_of_source(source, options, progress);
  Annotated_surface surface = annotated_surface(source, options, std::move(remesh), time, progress);
  return {std::move(source), std::move(surface), seconds};
}

} // namespace equiaffine
