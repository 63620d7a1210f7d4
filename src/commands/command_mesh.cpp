// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/estimates.h"
#include "commands/check_delaunay_surface.h"
#include "commands/commands.h"
#include "commands/extract_surface.h"
#include "commands/fail_without_surface.h"
#include "commands/remesh_fit.h"
#include "commands/remove_crumbs.h"
#include "engine/Engine.h"
#include "output/fit_display.h"
#include "output/statistics.h"
#include "output/surface_output.h"
#include "source/source.h"
#include "source/warnings.h"
#include "system/atomic_file.h"
#include "system/resources.h"
#include <equiaffine/Input_error.h>
#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/delaunay_surface.h>
#include <equiaffine/parabolic_curves.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

/// A surface with its attributes. sample() returns one without attributes, and make_surface() adds them.
struct Annotated_surface {
  Isosurface_3<Kernel> mesh;
  Vertex_attributes attributes;
  Estimates estimates;
  std::optional<Close_sheets> close_sheets;
  std::array<std::size_t, number_of_point_statuses> status{};
  std::optional<Completeness> completeness;
  double max_distance = 0, annotation_seconds = 0;
  std::optional<Parabolic_curves_3<Kernel>> curves; ///< if they were asked for
  std::vector<double> outcomes;                     ///< of vertices of a remesh
  std::optional<Remesh_statistics> remesh;
  std::string reason_against_remesh; ///< of faces that could not be remeshed although nothing else was asked for
};

template <class Traits>
Annotated_surface sample(const Traits& function, const Source&, const Mesh_options& options,
                         const Marching_cubes_options& method) {
  Annotated_surface surface;
  surface.mesh = extract_surface(function, options.source, method.vertices);
  if (surface.mesh.triangles.empty())
    fail_without_surface(function.base(), options.source, options.isovalue,
                         {"box", "a finer --resolution", surface.mesh.repairs.vertices_at_poles > 0});
  return surface;
}

template <class Traits>
Annotated_surface sample(const Traits& function, const Source&, const Mesh_options& options,
                         const Delaunay_options& method) {
  const CGAL::Bbox_3 box = function.bbox();
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  check_box_of_delaunay_surface(box, diagonal);
  Delaunay_criteria criteria = {method.angle, method.radius, method.distance};
  criteria.radius = std::min(criteria.radius, diagonal); // a larger bound would mean the same
  criteria = criteria.completed(Clip_domain_3(box));
  check_memory_of_delaunay_surface(diagonal, criteria.radius, criteria.distance);
  check_radius_of_delaunay_surface(box, criteria.radius);
  const Clip_domain_3 domain = method.clips_to_ball ? Clip_domain_3::ball_in(box) : Clip_domain_3(box);
  const auto parameters = parameters::clip(domain).facet_sizing(method.sizing);
  auto mesh = options.curves ? delaunay_surface(function, criteria, parameters.parabolic_features())
                             : delaunay_surface(function, criteria, parameters);
  if (mesh.triangles.empty())
    fail_without_surface(function.base(), options.source, options.isovalue,
                         {method.clips_to_ball ? "ball" : "box", mesh.is_certified ? "" : "a smaller --radius",
                          changes_sign_at_poles_only(function)});
  Annotated_surface surface;
  surface.completeness = {mesh.is_certified, std::move(mesh.undecided_boxes)};
  if (options.curves) surface.curves = std::move(mesh.parabolic_curves);
  surface.mesh = std::move(mesh);
  return surface;
}

template <class Traits>
Annotated_surface sample(const Traits&, const Source& source, const Mesh_options& options,
                         const Remesh_options& method) {
  Remeshed_fit remeshed = remesh_fit(source, options.source, method);
  Annotated_surface surface;
  surface.mesh = std::move(remeshed.mesh);
  surface.outcomes = std::move(remeshed.outcomes);
  surface.remesh = remeshed.statistics;
  return surface;
}

/// Samples a surface by the method that was asked for. The faces of a fit are remeshed if none was, and if they form a
/// surface.
template <class Traits>
Annotated_surface sample(const Traits& function, const Source& source, const Mesh_options& options) {
  std::string reason;
  if (options.remeshes_faces && !source.data.triangles.empty()) {
    try {
      return sample(function, source, options, Remesh_options());
    } catch (const Input_error& error) {
      reason = error.what();
    }
  }
  Annotated_surface surface =
      std::visit([&](const auto& method) { return sample(function, source, options, method); }, options.method);
  surface.reason_against_remesh = std::move(reason);
  return surface;
}

/// Samples the surface and computes its attributes. `function` is the one in `source`, with its own type.
template <class Traits>
Annotated_surface make_surface(const Traits& function, const Source& source, const Mesh_options& options,
                               Progress& progress) {
  // The mesh is made from f whatever the orientation is, which then only decides to which side triangles are turned.
  const Level_set_traits_3<Traits> extracted(function, options.isovalue);
  const Level_set_traits_3<Traits> level_set(function, options.isovalue, options.orientation);
  progress.begin("extracting the surface");
  Annotated_surface surface = sample(extracted, source, options);
  if (source.fit && !surface.remesh) {
    remove_crumbs(surface.mesh, *source.fit, options.source);
    if (surface.mesh.triangles.empty())
      fail_without_surface(function, options.source, options.isovalue, {"box", "a finer --resolution", false});
    if (std::holds_alternative<Marching_cubes_options>(options.method))
      surface.close_sheets = close_sheets(*source.fit, options.source);
  }
  if (options.orientation == Orientation_of_level_set::AGAINST_GRADIENT)
    for (auto& triangle : surface.mesh.triangles) std::swap(triangle[1], triangle[2]);
  const Stopwatch stopwatch;
  progress.begin("computing attributes");
  surface.max_distance =
      engine<Traits>().max_distance_to_surface(level_set, surface.mesh.points, surface.mesh.vertex_status);
  surface.mesh.function_evaluations += 2 * surface.mesh.points.size();
  Attribute_selection selection = options.attributes;
  selection.has_status = true; // even if it is not written: the statistics count it
  surface.attributes = engine<Traits>().compute_attributes(
      {function, options.orientation, surface.mesh.points, selection, options.estimator, surface.mesh.vertex_status});
  surface.mesh.function_evaluations += surface.mesh.points.size();
  surface.status = count(*surface.attributes.status);
  surface.estimates = estimates_at(source, options.source, surface.mesh.points, progress);
  add_estimates(surface.estimates, options.estimates, surface.attributes);
  if (surface.remesh && !options.attributes.columns.empty())
    surface.attributes.columns.push_back({"fit_outcome", std::move(surface.outcomes)});
  if (!options.attributes.has_status) surface.attributes.status.reset();
  surface.annotation_seconds = stopwatch.seconds();
  if (options.curves && !surface.curves) {
    progress.begin("finding parabolic curves");
    surface.curves = parabolic_curves<CGAL::Parallel_if_available_tag>(surface.mesh, level_set);
  }
  return surface;
}

Statistics make_statistics(const Mesh_options& options, const Annotated_surface& surface, const Source& source) {
  Statistics statistics;
  statistics.source = describe(options.source);
  statistics.isovalue = options.isovalue;
  statistics.vertices = surface.mesh.points.size();
  statistics.faces = surface.mesh.triangles.size();
  statistics.topology = mesh_topology(surface.mesh.triangles, surface.mesh.points.size());
  statistics.status = surface.status;
  statistics.max_distance_to_surface = surface.max_distance;
  statistics.sample_seconds = surface.mesh.sampling_seconds;
  statistics.project_seconds = surface.mesh.projection_seconds;
  statistics.annotate_seconds = surface.annotation_seconds;
  statistics.completeness = surface.completeness;
  statistics.spline = source.spline;
  statistics.fit = surface.estimates.fit;
  statistics.close_sheets = surface.close_sheets;
  statistics.remesh = surface.remesh;
  statistics.function_evaluations = source.function_evaluations + surface.mesh.function_evaluations;
  return statistics;
}

/// The rows of the matrix, and the translation if there is one.
std::string text_of(const CGAL::Aff_transformation_3<Kernel>& map) {
  std::string text;
  bool has_translation = false;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) text += (column > 0 ? " " : "") + number_text(map.m(row, column));
    text += row < 2 ? "; " : "";
    has_translation = has_translation || map.m(row, 3) != 0;
  }
  if (has_translation)
    text += ", then by " + number_text(map.m(0, 3)) + " " + number_text(map.m(1, 3)) + " " + number_text(map.m(2, 3));
  return text;
}

Description make_description(const Mesh_options& options, const Statistics& statistics, const Description& fit) {
  Description description = {{"Level set f =", number_text(options.isovalue)}, {"of", statistics.source}};
  for (const auto& [name, value] : options.source.constants)
    description.emplace_back("with " + name + " =", number_text(value));
  if (const auto& map = options.source.transformation) {
    description.emplace_back("transformed by", text_of(*map));
  }
  if (options.orientation == Orientation_of_level_set::AGAINST_GRADIENT)
    description.emplace_back("Normals", "against the gradient");
  description.emplace_back("Vertices", std::to_string(statistics.vertices));
  description.emplace_back("Triangles", std::to_string(statistics.faces));
  description.emplace_back("Components", std::to_string(statistics.topology.components));
  description.emplace_back("Euler characteristic", std::to_string(statistics.topology.euler_characteristic));
  description.insert(description.end(), fit.begin(), fit.end());
  return description;
}

std::string summary(const Parabolic_curves_3<Kernel>& curves) {
  const std::size_t n = curves.polylines.size();
  std::string text = std::to_string(n) + (n == 1 ? " parabolic curve" : " parabolic curves");
  if (curves.unconverged_points > 0) text += ", " + std::to_string(curves.unconverged_points) + " points unconverged";
  return text + '\n';
}

/// The output files of the command. The constructor throws if one of them cannot be written.
struct Outputs {
  explicit Outputs(const Mesh_options& options) {
    check_surface_output(options.output);
    check_display_outputs(options.display);
    if (options.curves) check_curves_output(*options.curves);
    if (options.stats) check_statistics_output(*options.stats);
    files.emplace_back(options.output);
    for (const auto& output : {options.display.html, options.display.png, options.curves, options.stats})
      if (output) files.emplace_back(*output);
  }

  std::vector<Output_file> files; // the mesh, then those of page, picture, curves, statistics that were asked for
};

} // namespace

void run_mesh(const Mesh_options& options, std::ostream& out, Progress& progress) {
  Outputs outputs(options);
  if (options.source.derivatives == Derivatives::JETS && std::holds_alternative<Marching_cubes_options>(options.method))
    check_memory_of_surface(options.source.resolution.value_or(default_resolution(options.source.kind)));
  const Stopwatch source_stopwatch;
  const Source source = make_source(options.source, progress);
  const double source_seconds = source_stopwatch.seconds();
  Annotated_surface surface = std::visit(
      [&](const auto& function) { return make_surface(function, source, options, progress); }, source.function);

  const Stopwatch write_stopwatch;
  progress.begin("writing");
  Statistics statistics = make_statistics(options, surface, source);
  statistics.sample_seconds += source_seconds;
  const Description fit = statistics.fit ? description_of(*statistics.fit) : Description();
  if (statistics.fit && !surface.attributes.columns.empty()) surface.attributes.comments = comments_of(*statistics.fit);
  auto file = outputs.files.begin();
  write_surface(*file++, surface.mesh, surface.attributes);
  if (options.source.estimates_errors) add_errors(surface.estimates, surface.attributes);
  file = write_displays(file, surface.mesh, surface.attributes, options.display,
                        {page_title(options.output, statistics.source) + label_suffix(fit),
                         make_description(options, statistics, fit), notes_of(fit), label_suffix(fit)},
                        surface.curves ? surface.curves->polylines : std::vector<Polyline_3<Kernel>>());
  if (options.curves) write_curves(*file++, *surface.curves);
  for (Output_file& output : outputs.files) output.close();
  statistics.write_seconds = write_stopwatch.seconds();
  if (options.stats) file->stream() << to_JSON(statistics);
  progress.end();
  commit_all(outputs.files);
  if (!options.attributes.columns.empty())
    warn_of_outside(options.source, source, surface.status[std::size_t(Point_status::OUTSIDE)],
                    surface.mesh.points.size(), "vertices", progress);
  if (!surface.reason_against_remesh.empty())
    progress.warn("the faces are not remeshed, and Marching Cubes makes others: " + surface.reason_against_remesh);
  if (statistics.close_sheets) warn_of_close_sheets(*statistics.close_sheets, progress);
  if (statistics.fit)
    warn_of_doubt(*statistics.fit, options.source.fit, has_affine_curvatures(options.attributes, options.estimates),
                  progress);
  if (!use_standard_output(outputs.files)) {
    out << summary(statistics);
    if (options.curves) out << summary(*surface.curves);
    report_written(out, outputs.files);
  }
}

} // namespace equiaffine
