// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/Surface_to_register.h"

#include "commands/extract_surface.h"
#include "commands/fail_without_surface.h"
#include "source/any_level_set.h"
#include "source/source.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace equiaffine {

namespace {

Indexed_triangle_mesh_3<Kernel> extract(const Source_function& function, const Surface_options& options,
                                        Progress& progress) {
  progress.begin("extracting the surface");
  auto surface = extract_surface(function, options.isovalue, options.source, Vertex_position::PROJECTED);
  if (surface.triangles.empty() && (options.source.kind != Source_kind::FIT || options.isovalue != 0))
    fail_without_surface(function, options.source, options.isovalue,
                         {"box", "a finer --resolution", surface.repairs.vertices_at_poles > 0});
  return surface;
}

/// Throws the error that says so if no point of the data is in the box.
void check_box(const Source_function& function, const std::vector<Kernel::Point_3>& points,
               const Surface_options& options) {
  const CGAL::Bbox_3 box = std::visit([](const auto& f) { return f.bbox(); }, function);
  if (std::any_of(points.begin(), points.end(), [&](const auto& p) { return CGAL::do_overlap(box, p.bbox()); })) return;
  fail_without_surface(function, options.source, options.isovalue, {"box", "", false});
}

} // namespace

bool is_mesh_itself(const Surface_options& options) {
  const Source_options& source = options.source;
  const bool has_mesh = source.kind == Source_kind::FIT || source.kind == Source_kind::DISTANCE;
  return has_mesh && options.isovalue == 0 && !source.box;
}

Surface_to_register make_surface_to_register(const Surface_options& options, bool is_shown, Progress& progress) {
  Source source = make_source(options.source, progress);
  Surface_to_register surface{.function = any_level_set(source.function, options.isovalue),
                              .mesh = std::move(source.data),
                              .scale = source.fit ? source.fit->scale() : std::nullopt};
  if (options.source.transformation)
    for (Kernel::Point_3& p : surface.mesh.points) p = (*options.source.transformation)(p);
  if (source.unsmoothed) surface.unsmoothed = any_level_set(*source.unsmoothed, options.isovalue);
  const bool has_data = !surface.mesh.points.empty() && options.isovalue == 0; // the data lie on f = 0
  if (has_data) check_box(source.function, surface.mesh.points, options);
  else surface.mesh = extract(source.function, options, progress);
  if (is_shown && surface.mesh.triangles.empty()) surface.extracted = extract(source.function, options, progress);
  return surface;
}

} // namespace equiaffine
