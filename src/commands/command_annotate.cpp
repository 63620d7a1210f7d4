// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/error_columns.h"
#include "attributes/fit_columns.h"
#include "commands/commands.h"
#include "output/statistics.h"
#include "output/surface_output.h"
#include "source/read_vertices.h"
#include "system/atomic_file.h"
#include "system/name_of_file.h"
#include <equiaffine/Input_error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace equiaffine {

namespace {

using Structures = std::vector<Fitted_structure_3<double>>;

/// The least, median and greatest of the numbers of structures that have one.
template <class Get>
std::array<double, 3> spread(const Structures& structures, Get get) {
  std::vector<double> numbers;
  for (const auto& s : structures)
    if (std::isfinite(get(s))) numbers.push_back(get(s));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (numbers.empty()) return {nan, nan, nan};
  std::sort(numbers.begin(), numbers.end());
  return {numbers.front(), numbers[numbers.size() / 2], numbers.back()};
}

/// The part of the structures whose estimated error of K is below a part of |K| + H^2.
double part_known(const Structures& structures, double bound) {
  const auto known = std::count_if(structures.begin(), structures.end(), [&](const auto& s) {
    const auto& affine = s.structure.affine;
    const double size = std::abs(affine.gaussian_curvature) + affine.mean_curvature * affine.mean_curvature;
    return s.error.gaussian_curvature < bound * size;
  });
  return double(known) / double(structures.size());
}

Fit_statistics make_statistics(const std::string& source, const Indexed_triangle_mesh_3<Kernel>& mesh,
                               const Structures& structures) {
  Fit_statistics statistics;
  statistics.source = source;
  statistics.vertices = mesh.points.size();
  statistics.faces = mesh.triangles.size();
  statistics.topology = mesh_topology(mesh.triangles, mesh.points.size());
  for (const auto& s : structures) ++statistics.status[std::size_t(s.structure.status)];
  statistics.scales = spread(structures, [](const auto& s) { return s.scale; });
  statistics.noise = spread(structures, [](const auto& s) { return s.deviation; })[1];
  for (std::size_t n = 0; n < error_bounds.size(); ++n) statistics.known[n] = part_known(structures, error_bounds[n]);
  return statistics;
}

Description make_description(const Annotate_options& options, const Fit_statistics& statistics) {
  Description description = {{"Vertices of", statistics.source}};
  if (options.orientation == Orientation_of_level_set::AGAINST_GRADIENT)
    description.emplace_back("Normals", "against those of the data");
  description.emplace_back("Vertices", std::to_string(statistics.vertices));
  description.emplace_back("Triangles", std::to_string(statistics.faces));
  description.emplace_back("Components", std::to_string(statistics.topology.components));
  description.emplace_back("Euler characteristic", std::to_string(statistics.topology.euler_characteristic));
  return description;
}

void warn_of_doubt(const Fit_statistics& statistics, Progress& progress) {
  const auto known = std::size_t(std::llround(statistics.known.back() * double(statistics.vertices)));
  if (2 * known >= statistics.vertices) return;
  progress.warn(std::to_string(statistics.vertices - known) + " of " + std::to_string(statistics.vertices) +
                " vertices have no fit, or an estimated error of the affine Gaussian curvature of more than 50 %: the "
                "points are too few, or their noise is too large for fourth derivatives; give more points, or a "
                "larger --scale");
}

/// The output files of the command. The constructor throws if one of them cannot be written.
struct Outputs {
  explicit Outputs(const Annotate_options& options) {
    check_vertices_output(options.output);
    if (options.html) check_page_output(*options.html);
    if (options.png) check_picture_output(*options.png);
    if (options.stats) check_statistics_output(*options.stats);
    files.emplace_back(options.output);
    for (const auto& output : {options.html, options.png, options.stats})
      if (output) files.emplace_back(*output);
  }

  bool use_standard_output() const {
    return std::any_of(files.begin(), files.end(), [](const Output_file& output) { return output.path() == "-"; });
  }

  std::vector<Output_file> files; // the vertices, then those of page, picture, statistics that were asked for
};

void check_has_faces(const Annotate_options& options, const std::string& name,
                     const Indexed_triangle_mesh_3<Kernel>& mesh) {
  if ((options.html || options.png) && mesh.triangles.empty())
    throw Input_error("cannot show '" + name + "': it has no faces; give a mesh, or leave out --html and --png");
}

} // namespace

void run_annotate(const Annotate_options& options, std::ostream& out, Progress& progress) {
  Outputs outputs(options);
  progress.begin("reading the vertices");
  const std::string name = options.mesh == "-" ? "standard input" : name_of_file(options.mesh);
  const Point_table_3<Kernel> table = read_vertices(options.mesh);
  check_has_faces(options, name, table.mesh);
  const Stopwatch stopwatch;
  progress.begin("fitting polynomials");
  const Structures structures = fit_vertices(table, options.fit, options.orientation);
  Fit_statistics statistics = make_statistics(name, table.mesh, structures);
  Vertex_attributes attributes = attributes_of(structures, options.attributes);
  add_estimates(structures, options.estimates, attributes);
  statistics.annotate_seconds = stopwatch.seconds();

  const Stopwatch write_stopwatch;
  progress.begin("writing");
  auto file = outputs.files.begin();
  write_vertices(*file++, table, attributes);
  // Pages and pictures show what can be trusted, even if the mesh does not get the estimates of errors.
  add_estimates(structures, {error_attributes.begin(), error_attributes.end()}, attributes);
  if (options.html)
    write_page(*file++, table.mesh, attributes, options.page, page_title(options.output, name),
               make_description(options, statistics));
  if (options.png) write_picture(*file++, table.mesh, attributes, options.page, options.picture);
  for (Output_file& output : outputs.files) output.close();
  statistics.write_seconds = write_stopwatch.seconds();
  if (options.stats) file->stream() << to_JSON(statistics);
  progress.end();
  commit_all(outputs.files);
  warn_of_doubt(statistics, progress);
  if (outputs.use_standard_output()) return;
  out << summary(statistics);
  report_written(out, outputs.files);
}

} // namespace equiaffine
