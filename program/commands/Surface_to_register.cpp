// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/Surface_to_register.h"

#include "commands/extract_surface.h"
#include "output/maps_display.h"
#include "source/read_mesh.h"
#include "source/source.h"
#include "source/source_function.h"
#include "system/front_end.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/mesh/internal/Triangle_tree_3.h>
#include <equiaffine/registration/internal/Surface_to_register.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace equiaffine {

namespace {

using Map = CGAL::Aff_transformation_3<Kernel>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = Indexed_triangle_mesh_3<Kernel>;

constexpr bool in_threads = runs_in_threads<CGAL::Parallel_if_available_tag>();

Mesh extract(const Source_function& function, const Source_options& options, Progress& progress) {
  progress.begin("extracting the surface");
  auto surface = extract_surface(function, options.level, options, Vertex_position::PROJECTED);
  if (surface.triangles.empty() && (options.kind != Source_kind::FIT || options.level != 0))
    fail_without_surface(function, options, options.level,
                         {"box", "a finer " + option_text("resolution"), surface.repairs.vertices_at_poles > 0});
  return surface;
}

/// Throws if no point of the data is in the box.
void check_box(const Source_function& function, const std::vector<Kernel::Point_3>& points,
               const Source_options& options) {
  const CGAL::Bbox_3 box = std::visit([](const auto& f) { return f.bbox(); }, function);
  if (std::any_of(points.begin(), points.end(), [&](const auto& p) { return CGAL::do_overlap(box, p.bbox()); })) return;
  fail_without_surface(function, options, options.level, {"box", "", false});
}

} // namespace

bool is_mesh_itself(const Source_options& source) {
  const bool has_mesh = source.kind == Source_kind::FIT || source.kind == Source_kind::DISTANCE;
  return has_mesh && source.level == 0 && !source.box;
}

internal::Surface_origin origin_of_source(const Source_options& source) {
  using enum internal::Surface_origin;
  switch (source.kind) {
  case Source_kind::FIT: return FIT;
  case Source_kind::DISTANCE: return DISTANCE;
  case Source_kind::VOLUME: return source.spline.smoothing == 0. ? RAW_VOLUME : SPLINE;
  default: return source.derivatives == Derivatives::SPLINE ? SPLINE : FUNCTION;
  }
}

void read_data_once(Source_options& source, Progress& progress) {
  if (source.kind != Source_kind::FIT || source.data) return;
  progress.begin("reading the vertices");
  source.data = [data = std::make_shared<const Annotated_mesh_3<Kernel>>(read_vertices(source))] { return *data; };
}

internal::Surface_to_register make_surface_to_register(const Source_options& options, bool is_shown,
                                                       Progress& progress) {
  Source source = make_source(options, progress);
  internal::Surface_to_register surface{.function = any_level_set(source.function, options.level),
                                        .mesh = std::move(source.data),
                                        .origin = origin_of_source(options),
                                        .given_scale = options.fit.scale,
                                        .scale = source.fit ? source.fit->scale() : std::nullopt};
  if (options.transformation)
    for (Point& p : surface.mesh.points) p = (*options.transformation)(p);
  if (source.unsmoothed) surface.unsmoothed = any_level_set(*source.unsmoothed, options.level);
  const bool has_data = !surface.mesh.points.empty() && options.level == 0; // the data lie on f = 0
  if (has_data) check_box(source.function, surface.mesh.points, options);
  else surface.mesh = extract(source.function, options, progress);
  if (is_shown && surface.mesh.triangles.empty()) surface.extracted = extract(source.function, options, progress);
  surface.is_mesh = is_mesh_itself(options) && !surface.mesh.triangles.empty();
  return surface;
}

internal::Surface_to_register make_surface_of_any_scale(Source_options options, bool is_shown, Progress& progress) {
  read_data_once(options, progress);
  auto surface = make_surface_to_register(options, is_shown, progress);
  if (options.kind != Source_kind::FIT || options.fit.scale) return surface;
  std::vector<Point> points = surface.mesh.points;
  if (options.transformation)
    for (Point& p : points) p = options.transformation->inverse()(p);
  surface.spacing = internal::mean_spacing(in_threads, points);
  surface.at_scale = [options, is_shown, &progress](double scale) mutable {
    options.fit.scale = scale;
    auto result = make_surface_to_register(options, is_shown, progress);
    progress.begin("looking for the map");
    return result;
  };
  return surface;
}

namespace {

/// Joins meshes into one, with common columns.
class Joined_meshes {
public:
  void add(const Mesh& mesh, double number, std::vector<double> distances) {
    const auto first = std::uint32_t(result_.mesh.points.size());
    result_.mesh.points.insert(result_.mesh.points.end(), mesh.points.begin(), mesh.points.end());
    for (const auto& [a, b, c] : mesh.triangles) result_.mesh.triangles.push_back({a + first, b + first, c + first});
    distances.resize(mesh.points.size(), std::numeric_limits<double>::quiet_NaN());
    auto& all = result_.attributes.columns;
    all[0].values.insert(all[0].values.end(), distances.begin(), distances.end());
    all[1].values.insert(all[1].values.end(), mesh.points.size(), number);
  }

  Annotated_mesh_3<Kernel> result() && { return std::move(result_); }

private:
  Annotated_mesh_3<Kernel> result_ = {{}, {{{"distance", {}}, {"surface", {}}}, {}}};
};

/// Adds the frames of the pair as arrows; the longest has 1/5 of the diagonal.
void add_frames(const Registered_map_3<Kernel>& registered, double diagonal, Joined_meshes& all) {
  const auto& [points, frames] = *registered.pair;
  const Point p = registered.map(points[0]), q = points[1];
  std::array<Vector, 3> moved_frame = frames[0];
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    moved_frame[k] = registered.map(moved_frame[k]);
    for (const Vector& v : {moved_frame[k], frames[1][k]}) longest = std::max(longest, std::sqrt(v.squared_length()));
  }
  const double scale = 0.2 * diagonal / longest, radius = 0.004 * diagonal;
  for (std::size_t k = 0; k < 3; ++k) {
    all.add(arrow_mesh(q, scale * frames[1][k], radius), 2, {});
    all.add(arrow_mesh(p, scale * moved_frame[k], radius), 3, {});
  }
}

} // namespace

Annotated_mesh_3<Kernel> moved_source(const internal::Surface_to_register& source,
                                      const Distances_of_points& from_target, const Map& map) {
  Annotated_mesh_3<Kernel> result{internal::moved_mesh(source.mesh, map), {}};
  result.attributes.columns.push_back({"distance", from_target(result.mesh.points)});
  return result;
}

Annotated_mesh_3<Kernel> registered_surfaces(const internal::Surface_to_register& source,
                                             const internal::Surface_to_register& target,
                                             const std::array<Distances_of_points, 2>& from_source_and_target,
                                             const Surface_registration_3<Kernel>& registration) {
  const auto& [from_source, from_target] = from_source_and_target;
  const Map map = registration.found() ? registration.best().map : Map(CGAL::IDENTITY);
  const Mesh image = internal::moved_mesh(source.shown(), map);
  Joined_meshes all;
  all.add(target.shown(), 0, from_source(target.shown().points));
  all.add(image, 1, from_target(image.points));
  if (registration.found() && registration.best().pair)
    add_frames(registration.best(), internal::diagonal_of(image.points), all);
  return std::move(all).result();
}

Distances_of_points distances_from(const Any_function_3& surface, const Map& back) {
  return [&surface, back](const std::vector<Point>& points) {
    return internal::distances_from_image(in_threads, points, surface, back);
  };
}

Distances_of_points distances_from(const Mesh& mesh) {
  static constexpr auto in_tree = [](const Point& p) { return Triangle_tree_3::Point_3(p.x(), p.y(), p.z()); };
  const auto tree = std::make_shared<const Triangle_tree_3>(mesh.points, mesh.triangles, in_tree);
  return [tree](const std::vector<Point>& points) {
    std::vector<double> result(points.size());
    parallel_for<CGAL::Parallel_if_available_tag>(
        0, points.size(), [&](std::size_t i) { result[i] = tree->distance(in_tree(points[i])); }, 64);
    return result;
  };
}

Annotated_mesh_3<Kernel> surface_with_symmetries(const Mesh& surface, const Affine_symmetries_3<Kernel>& symmetries,
                                                 const Distances_of_points& distances) {
  std::vector<double> greatest(surface.points.size(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& symmetry : symmetries.maps) {
    const auto images = distances(internal::moved_mesh(surface, symmetry.map).points);
    for (std::size_t i = 0; i < images.size(); ++i) greatest[i] = std::fmax(greatest[i], images[i]);
  }
  const double diagonal = internal::diagonal_of(surface.points);
  const Symmetry_marks marks = marks_of(symmetries);
  Joined_meshes all;
  all.add(surface, 0, std::move(greatest));
  all.add(mesh_of_planes(marks.planes, surface, 0.002 * diagonal), 1, {});
  all.add(mesh_of_axes(marks.axes, surface, 0.004 * diagonal), marks.planes.empty() ? 1 : 2, {});
  Annotated_mesh_3<Kernel> result = std::move(all).result();
  auto& columns = result.attributes.columns;
  const auto& generators = symmetries.continuous.generators;
  for (std::size_t n = 0; n < generators.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      const auto& [matrix, translation] = generators[n];
      auto& column = columns.emplace_back();
      column.name = "generator" + std::to_string(n + 1) + '_' + "xyz"[k];
      column.values.assign(result.mesh.points.size(), std::numeric_limits<double>::quiet_NaN());
      for (std::size_t i = 0; i < surface.points.size(); ++i) {
        const Point& p = surface.points[i];
        column.values[i] = matrix(k, 0) * p.x() + matrix(k, 1) * p.y() + matrix(k, 2) * p.z() + translation[k];
      }
    }
  return result;
}

} // namespace equiaffine
