// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "commands/evaluate_points.h"
#include "output/statistics.h"
#include "source/source.h"
#include "source/warnings.h"
#include "system/atomic_file.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/io/write_mesh.h>

#include <optional>

namespace equiaffine {

namespace {

Mesh_format output_format(const std::string& path) {
  if (path == "-") return Mesh_format::CSV;
  const std::optional<Mesh_format> format = mesh_format(path);
  if (format != Mesh_format::CSV && format != Mesh_format::PLY)
    throw Input_error("cannot write '" + path + "': its extension is not that of a table of points; use .csv or .ply");
  return *format;
}

} // namespace

void run_evaluate(const Evaluate_options& options, std::ostream& out, Progress& progress) {
  const Mesh_format format = output_format(options.output);
  Output_file output(options.output);
  progress.begin("reading the points");
  const Point_table_3<Kernel> table = read_points<Kernel>(options.points);
  const std::vector<Kernel::Point_3>& points = table.mesh.points;
  const Source source = make_source(options.source, progress);
  Vertex_attributes attributes = evaluate_points(options, source, points, progress);
  progress.begin("writing");
  if (format == Mesh_format::CSV) write_CSV(output.stream(), table, attributes);
  else write_PLY(output.stream(), table.mesh, merge_attributes(table.attributes, attributes));
  progress.end();
  output.commit();
  if (attributes.status)
    warn_of_outside(options.source, source, count(*attributes.status)[std::size_t(Point_status::OUTSIDE)],
                    points.size(), "points", progress);
  if (options.output == "-") return;
  out << points.size() << " points";
  if (attributes.status) {
    const auto counts = count(*attributes.status);
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (counts[i] > 0) out << ", " << counts[i] << ' ' << to_string(Point_status(i));
  }
  out << '\n';
  report_written(out, {&output, 1});
}

} // namespace equiaffine
