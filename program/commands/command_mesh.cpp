// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "commands/make_surface.h"
#include "output/Outputs.h"
#include "output/Part_writer.h"
#include "output/displays.h"
#include "output/statistics.h"
#include "source/source.h"
#include "system/files.h"
#include <equiaffine/mesh/mesh_topology.h>
#include <equiaffine/surface/parabolic_curves.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/task_group.h>
#endif

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

/// Work for another thread of TBB while this thread continues. Without other threads it is done immediately or in
/// wait().
class Background_work {
public:
  Background_work() = default;
  Background_work(const Background_work&) = delete;
  Background_work& operator=(const Background_work&) = delete;
  ~Background_work() {
    try {
      wait();
    } catch (...) { // another exception is active, or the result was not needed
    }
  }

  /// Starts f().
  template <class F>
  void start(F f) {
#ifdef CGAL_LINKED_WITH_TBB
    tasks_.run(std::move(f));
#else
    f();
#endif
  }

  /// Waits for all started work, and rethrows its exception, if any.
  void wait() {
#ifdef CGAL_LINKED_WITH_TBB
    tasks_.wait();
#endif
  }

private:
#ifdef CGAL_LINKED_WITH_TBB
  tbb::task_group tasks_;
#endif
};

Statistics make_statistics(const Request& options, const Annotated_surface& surface, const Source& source,
                           const Mesh_topology& topology) {
  Statistics statistics;
  statistics.source = describe(options.source);
  statistics.isovalue = options.source.level;
  statistics.vertices = surface.mesh.points.size();
  statistics.faces = surface.mesh.triangles.size();
  statistics.topology = topology;
  statistics.components_left_out = surface.components_left_out;
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

/// The rows of the matrix, and the translation if it is not zero.
std::string text_of(const CGAL::Aff_transformation_3<Kernel>& map) {
  std::string text;
  bool has_translation = false;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) text += (column > 0 ? " " : "") + number_text(map.m(row, column));
    text += row < 2 ? "; " : "";
    has_translation = has_translation || map.m(row, 3) != 0;
  }
  if (has_translation)
    text += ", then translated by " + number_text(map.m(0, 3)) + " " + number_text(map.m(1, 3)) + " " +
            number_text(map.m(2, 3));
  return text;
}

Description make_description(const Request& options, const Statistics& statistics, const Description& fit) {
  Description description = {{"Level set f =", number_text(options.source.level)}, {"of", statistics.source}};
  for (const auto& [name, value] : options.source.constants)
    description.emplace_back("with " + name + " =", number_text(value));
  if (const auto& map = options.source.transformation) {
    description.emplace_back("transformed by", text_of(*map));
  }
  if (options.orientation == Orientation_of_level_set::AGAINST_GRADIENT)
    description.emplace_back("Normals", "opposite to the gradient");
  description.emplace_back("Vertices", std::to_string(statistics.vertices));
  description.emplace_back("Triangles", std::to_string(statistics.faces));
  description.emplace_back("Components", std::to_string(statistics.topology.components) + left_out_text(statistics));
  description.emplace_back("Euler characteristic", std::to_string(statistics.topology.euler_characteristic));
  description.insert(description.end(), fit.begin(), fit.end());
  return description;
}

std::string summary(const Parabolic_curves_3<Kernel>& curves) {
  const std::size_t n = curves.polylines.size();
  std::string text = std::to_string(n) + (n == 1 ? " parabolic curve" : " parabolic curves");
  if (curves.unconverged_points > 0)
    text += ", " + std::to_string(curves.unconverged_points) +
            (curves.unconverged_points == 1 ? " unconverged point" : " unconverged points");
  return text + '\n';
}

Outputs outputs_of_mesh(const Request& options) {
  check_surface_output(options.output);
  check_display_outputs(options.display);
  if (options.parabolic_curves) check_curves_output(*options.parabolic_curves);
  if (options.stats) check_statistics_output(*options.stats);
  Outputs outputs(options.output, options.display);
  outputs.add(Output_kind::CURVES, options.parabolic_curves);
  outputs.add(Output_kind::STATISTICS, options.stats);
  return outputs;
}

/// Whether only one file of vertices needs the attributes, so that they need not be kept in memory.
bool are_attributes_only_written(const Request& options) {
  return is_written_in_parts(options.output) && options.source.kind != Source_kind::FIT &&
         !options.source.estimates_errors && !options.display.shows_something() && !options.parabolic_curves;
}

/// Computes the attributes in blocks of vertices, and writes each block while the next one is computed.
void write_computed_attributes(Output_file& file, const Source& source, const Request& options,
                               Annotated_surface& surface) {
  constexpr std::size_t vertices_of_block = std::size_t(1) << 19;
  const std::span<const Kernel::Point_3> points(surface.mesh.points);
  Vertex_attributes layout;
  for (const Attribute& attribute : options.attributes.columns)
    layout.columns.push_back({std::string(attribute.name), {}});
  if (options.attributes.has_status) layout.status.emplace();
  const auto writer = part_writer(file.path(), file.stream(), points.size(), surface.mesh.triangles.size(), layout);
  Background_work writing;
  for_each_attribute_block(
      source, options, surface, vertices_of_block, [&](std::size_t first, Vertex_attributes&& attributes) {
        writing.wait();
        const auto block = points.subspan(first, std::min(vertices_of_block, points.size() - first));
        writing.start(
            [&writer, block, attributes = std::move(attributes)] { writer->write_vertices(block, attributes); });
      });
  writing.wait();
  writer->write_faces(surface.mesh.triangles);
}

} // namespace

void run_mesh(const Request& options, std::ostream& out, Progress& progress) {
  Outputs outputs = outputs_of_mesh(options);
  check_memory(options);
  const bool are_only_written = are_attributes_only_written(options);
  auto [source, surface, source_seconds] =
      make_surface(options, progress, are_only_written ? Attribute_time::LATER : Attribute_time::WITH_SURFACE);
  Mesh_topology topology;
  Background_work counting;
  counting.start([&topology, &mesh = surface.mesh] { topology = mesh_topology(mesh.triangles, mesh.points.size()); });
  if (are_only_written) {
    const Stopwatch stopwatch;
    progress.begin("computing and writing attributes");
    write_computed_attributes(outputs[Output_kind::RESULT], source, options, surface);
    surface.annotation_seconds = stopwatch.seconds();
  }

  const Stopwatch write_stopwatch;
  progress.begin("writing");
  counting.wait();
  Statistics statistics = make_statistics(options, surface, source, topology);
  statistics.sample_seconds += source_seconds;
  const Description fit = statistics.fit ? description_of(*statistics.fit) : Description();
  if (statistics.fit && !surface.attributes.columns.empty()) surface.attributes.comments = comments_of(*statistics.fit);
  if (!are_only_written) write_surface(outputs[Output_kind::RESULT], surface.mesh, surface.attributes);
  if (options.source.estimates_errors) add_errors(surface.estimates, surface.attributes);
  write_displays(outputs, surface.mesh, surface.attributes, options.display,
                 {page_title(options.output, statistics.source) + label_suffix(fit),
                  make_description(options, statistics, fit), notes_of(fit), label_suffix(fit)},
                 surface.curves ? surface.curves->polylines : std::vector<Polyline_3<Kernel>>());
  if (Output_file* const file = outputs.find(Output_kind::CURVES)) write_curves(*file, *surface.curves);
  outputs.close_results();
  statistics.write_seconds = write_stopwatch.seconds();
  if (Output_file* const file = outputs.find(Output_kind::STATISTICS)) file->stream() << to_JSON(statistics);
  progress.end();
  outputs.commit();
  warn_of(surface, source, options, progress);
  warn_of_lost_points(options.output, surface.mesh.points, progress);
  if (!outputs.use_standard_output()) {
    out << summary(statistics);
    if (options.parabolic_curves) out << summary(*surface.curves);
    outputs.report(out);
  }
}

} // namespace equiaffine
