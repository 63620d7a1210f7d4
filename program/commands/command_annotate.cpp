// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/estimates.h"
#include "commands/commands.h"
#include "output/displays.h"
#include "output/statistics.h"
#include "source/read_mesh.h"
#include "source/source_function.h"
#include "source/warnings.h"
#include "system/files.h"
#include <equiaffine/base/Input_error.h>

#include <cstddef>
#include <string>
#include <vector>

namespace equiaffine {

namespace {

using Structures = std::vector<Fitted_structure_3<double>>;

Annotation_statistics make_statistics(const std::string& source, const Indexed_triangle_mesh_3<Kernel>& mesh,
                                      const Structures& structures, const Fit_statistics& fit) {
  Annotation_statistics statistics;
  statistics.source = source;
  statistics.vertices = mesh.points.size();
  statistics.faces = mesh.triangles.size();
  statistics.topology = mesh_topology(oriented_triangles(mesh), mesh.points.size());
  for (const auto& s : structures) ++statistics.status[std::size_t(s.structure.status)];
  statistics.fit = fit;
  return statistics;
}

Description make_description(const Request& options, const Annotation_statistics& statistics,
                             const Description& fit) {
  Description description = {{"Vertices of", statistics.source}};
  if (options.orientation == Orientation_of_level_set::AGAINST_GRADIENT)
    description.emplace_back("Normals", "opposite to those of the data");
  description.emplace_back("Vertices", std::to_string(statistics.vertices));
  description.emplace_back("Triangles", std::to_string(statistics.faces));
  description.emplace_back("Components", std::to_string(statistics.topology.components));
  description.emplace_back("Euler characteristic", std::to_string(statistics.topology.euler_characteristic));
  description.insert(description.end(), fit.begin(), fit.end());
  return description;
}

Outputs outputs_of_annotation(const Request& options) {
  check_vertices_output(options.output);
  check_display_outputs(options.display);
  if (options.stats) check_statistics_output(*options.stats);
  Outputs outputs(options.output, options.display);
  outputs.add(Output_kind::STATISTICS, options.stats);
  return outputs;
}

void check_has_faces(const Request& options, const std::string& name,
                     const Indexed_triangle_mesh_3<Kernel>& mesh) {
  if (options.display.html && mesh.triangles.empty())
    throw Input_error("cannot show '" + name + "': it has no faces; use --png instead of --html, or show the surface " +
                      "through the points with 'equiaffine mesh --fit " + options.input +
                      " -o OUT.ply --html PAGE.html'");
}

} // namespace

void run_annotate(const Request& options, std::ostream& out, Progress& progress) {
  Outputs outputs = outputs_of_annotation(options);
  progress.begin("reading the vertices");
  const std::string name = options.input == "-" ? "standard input" : name_of_file(options.input);
  const Point_table_3<Kernel> table = read_vertices(options.input);
  check_has_faces(options, name, table.mesh);
  const auto areas = selected_vertex_areas(options.attributes, table.mesh.points, table.mesh.triangles);
  const Stopwatch stopwatch;
  progress.begin("fitting polynomials");
  const Structures structures = fit_vertices(table, options.source.fit, options.orientation);
  const Estimates estimates = estimates_of(structures);
  Annotation_statistics statistics = make_statistics(name, table.mesh, structures, *estimates.fit);
  Vertex_attributes attributes = attributes_of_fit(structures, options.attributes, areas);
  add_estimates(estimates, options.estimates, attributes);
  statistics.has_colors = have_colors(table);
  statistics.annotate_seconds = stopwatch.seconds();
  const Description fit = description_of(statistics.fit);
  if (!attributes.columns.empty()) attributes.comments = comments_of(statistics.fit);

  const Stopwatch write_stopwatch;
  progress.begin("writing");
  write_vertices(outputs[Output_kind::RESULT], table, attributes);
  add_errors(estimates, attributes);
  write_displays(outputs, table.mesh, attributes, options.display,
                 {page_title(options.output, name) + label_suffix(fit), make_description(options, statistics, fit),
                  notes_of(fit), label_suffix(fit)});
  outputs.close_results();
  statistics.write_seconds = write_stopwatch.seconds();
  if (Output_file* const file = outputs.find(Output_kind::STATISTICS)) file->stream() << to_JSON(statistics);
  progress.end();
  outputs.commit();
  warn_of_opposed_normals(table, progress);
  warn_of_doubt(statistics.fit, options.source.fit, has_affine_curvatures(options.attributes, options.estimates), true,
                progress);
  if (outputs.use_standard_output()) return;
  out << summary(statistics);
  outputs.report(out);
}

} // namespace equiaffine
