// SPDX-License-Identifier: GPL-3.0-or-later
// The commands `evaluate` and `sample`: a source at given points, and at the nodes of a grid.
#include "attributes/estimates.h"
#include "commands/commands.h"
#include "output/statistics.h"
#include "source/evaluate_source.h"
#include "source/source.h"
#include "source/warnings.h"
#include "system/files.h"
#include "volume/volume_io.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/io/write_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace equiaffine {

namespace {

/// Marks points with infinite or NaN coordinates as OUTSIDE, whatever the function returns for them.
void mark_points_at_infinity(std::span<const Kernel::Point_3> points, Vertex_attributes& attributes) {
  if (!attributes.status) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Kernel::Point_3& p = points[i];
    if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) continue;
    (*attributes.status)[i] = Point_status::OUTSIDE;
    for (auto& column : attributes.columns) column.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

Mesh_format output_format(const std::string& path) {
  if (path == "-") return Mesh_format::CSV;
  const std::optional<Mesh_format> format = mesh_format(path);
  if (format != Mesh_format::CSV && format != Mesh_format::PLY)
    throw Input_error("cannot write '" + path +
                      "': the extension does not belong to a table of points; use .csv or .ply");
  return *format;
}

} // namespace

Vertex_attributes evaluate_points(const Request& options, const Source& source,
                                  const Indexed_triangle_mesh_3<Kernel>& at, Progress& progress) {
  const std::vector<Kernel::Point_3>& points = at.points;
  progress.begin("computing attributes");
  const auto areas = selected_vertex_areas(options.attributes, points, at.triangles);
  Vertex_attributes attributes = attributes_of_source(source.function, options.orientation, points, options.attributes,
                                                      options.estimator, {std::span<const Point_status>(), areas});
  if (options.source.estimates_errors)
    add_estimates(estimates_at(source, options.source, points, progress), options.estimates, attributes);
  mark_points_at_infinity(points, attributes);
  return attributes;
}

void run_evaluate(const Request& options, std::ostream& out, Progress& progress) {
  const Mesh_format format = output_format(options.output);
  Output_file output(options.output);
  progress.begin("reading the points");
  const Point_table_3<Kernel> table = read_points<Kernel>(options.points);
  const std::vector<Kernel::Point_3>& points = table.mesh.points;
  if (table.mesh.triangles.empty()) refuse_attributes_of_mesh(options.attributes);
  const Source source = make_source(options.source, progress);
  Vertex_attributes attributes = evaluate_points(options, source, table.mesh, progress);
  progress.begin("writing");
  if (format == Mesh_format::CSV) write_CSV(output.stream(), table, attributes);
  else write_PLY(output.stream(), table.mesh, merge_attributes(table.attributes, attributes));
  progress.end();
  output.commit();
  if (attributes.status)
    warn_of_outside(options.source, source, count(*attributes.status)[std::size_t(Point_status::OUTSIDE)],
                    points.size(), "points", progress);
  if (options.output == "-") return;
  out << points.size() << (points.size() == 1 ? " point" : " points");
  if (attributes.status) {
    const auto counts = count(*attributes.status);
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (counts[i] > 0) out << ", " << counts[i] << ' ' << to_string(Point_status(i));
  }
  out << '\n';
  report_written(out, {&output, 1});
}

void run_sample(const Request& options, std::ostream& out, Progress& progress) {
  check_volume_output(options.output);
  Output_file output(options.output);
  const Volume_3<Kernel> volume = sample_source(options.source, progress);
  progress.begin("writing");
  write_volume(output, volume, options.samples_are_float);
  progress.end();
  output.commit();
  const auto [nx, ny, nz] = volume.lattice.size();
  out << nx << " x " << ny << " x " << nz << " nodes";
  const auto unknown =
      std::count_if(volume.values.begin(), volume.values.end(), [](double v) { return std::isnan(v); });
  if (unknown > 0) out << ", " << unknown << " without a value";
  out << '\n';
  report_written(out, {&output, 1});
}

} // namespace equiaffine
