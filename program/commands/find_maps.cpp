// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/find_maps.h"

#include "commands/Surface_to_register.h"
#include "output/maps.h"
#include "request/options.h"
#include "source/read_mesh.h"
#include "source/source.h"
#include "system/files.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/contradictions_of_meshes.h>
#include <equiaffine/registration/register_surfaces.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <CGAL/compute_average_spacing.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

bool is_fitted(const Surface_options& surface) { return surface.source.kind == Source_kind::FIT; }

/// Derivatives that are too rough to be matched have no frames that agree, or wrong ones.
void add_for_derivatives(std::initializer_list<const Surface_options*> surfaces, std::vector<std::string>& advice) {
  bool has_facets = false, has_samples = false;
  for (const Surface_options* surface : surfaces) {
    has_facets = has_facets || surface->source.kind == Source_kind::DISTANCE;
    has_samples =
        has_samples || (surface->source.kind == Source_kind::VOLUME && surface->source.spline.smoothing == 0.);
  }
  if (has_facets) advice.emplace_back("--fit in place of --distance-to, since facets have no affine curvature");
  if (has_samples) advice.emplace_back("--smoothing auto for the volume");
}

/// Whether both are meshes with too few points for any scale.
bool lacks_curvature(const Register_options& options, const Found_map& found) {
  const auto lacks = [](const Surface_options& options_of_side, const Surface_to_register& side) {
    const bool has_scale = options_of_side.source.fit.scale || side.scale;
    return is_fitted(options_of_side) && !has_scale && !side.mesh.triangles.empty();
  };
  return lacks(options.source, found.source) && lacks(options.target, found.target) && found.tried.empty();
}

void add_for_scales(const Surface_options& source, const Surface_options& target, std::vector<std::string>& advice) {
  const auto &scale = source.source.fit.scale, &other = target.source.fit.scale;
  if (is_fitted(source) && is_fitted(target))
    advice.emplace_back(scale && scale == other ? "a larger --scale, the same on both sides"
                                                : "the same --scale R on both sides");
  else if (is_fitted(source) || is_fitted(target))
    advice.emplace_back((is_fitted(source) ? scale : other) ? "a larger --scale" : "--scale R for the fit");
}

void add_for_reflections(const Map_options& maps, std::vector<std::string>& advice) {
  if (!maps.allows_reflections) advice.emplace_back("the command without --no-reflection");
}

void add_for_sizes(const Map_options& maps, std::vector<std::string>& advice) {
  if (maps.kind == Map_kind::RIGID) advice.emplace_back("--kind similarity, which allows other sizes");
}

void add_for_kind(const Map_options& maps, std::vector<std::string>& advice) {
  if (maps.kind != Map_kind::AFFINE) advice.emplace_back("--kind affine, which allows all maps");
  add_for_reflections(maps, advice);
}

/// Pieces of meshes without curvature are matched by maps that keep angles only.
void add_for_kind_without_curvature(const Map_options& maps, std::vector<std::string>& advice) {
  add_for_sizes(maps, advice);
  if (!keeps_angles(maps.kind)) advice.emplace_back("--kind similarity, which needs no curvature");
  add_for_reflections(maps, advice);
}

/// Returns what may find a map where none was found, the most promising first.
std::vector<std::string> what_to_try(const Register_options& options, const Found_map& found) {
  std::vector<std::string> advice;
  if (lacks_curvature(options, found)) {
    add_for_kind_without_curvature(options.maps, advice);
  } else {
    const bool are_data = is_fitted(options.source) || is_fitted(options.target);
    if ((are_data || found.registration.hypotheses == 0) && !keeps_angles(options.maps.kind))
      advice.emplace_back("--kind similarity, whose frames need fewer derivatives and exist on quadrics, too");
    add_for_scales(options.source, options.target, advice);
    add_for_derivatives({&options.source, &options.target}, advice);
    add_for_sizes(options.maps, advice);
    add_for_kind(options.maps, advice);
  }
  if (found.registration.hypotheses > 0 && options.least_overlap > Register_options().least_overlap)
    advice.emplace_back("a smaller --min-overlap");
  advice.emplace_back("surfaces that have more in common");
  return advice;
}

/// Returns what may find symmetries where only the identity was found, or nothing was decided.
std::vector<std::string> what_to_try(const Symmetries_options& options, const Symmetries& found) {
  std::vector<std::string> advice;
  if (!is_undecided(found)) {
    if (!found.levels.empty()) advice.emplace_back("a larger --tolerance");
    add_for_kind(options.maps, advice);
    return advice;
  }
  add_for_derivatives({&options.surface}, advice);
  if (!keeps_angles(found.kind)) advice.emplace_back("--kind rigid, whose maps need no solid");
  if (!options.tolerance) advice.emplace_back("--tolerance PART for another distance to which maps may move points");
  return advice;
}

using Tag = CGAL::Parallel_if_available_tag;

/// A map is accepted if as good ones are expected less often than this by chance.
constexpr double accepted_log10 = -6;

/// The scales of the two fits.
using Scales = std::array<double, 2>;

/// Calls a search with the named parameters of a request.
template <class Search>
Surface_registration_3<Kernel> with_parameters(const Register_options& options, const Search& search) {
  const auto parameters = parameters::map_kind(options.maps.kind)
                              .reflections(options.maps.allows_reflections)
                              .number_of_maps(options.number_of_maps.value_or(1))
                              .least_overlap(options.least_overlap);
  return options.tolerance ? search(parameters.tolerance(*options.tolerance)) : search(parameters);
}

Surface_registration_3<Kernel> register_with(const Register_options& options, const Surface_to_register& source,
                                             const Surface_to_register& target) {
  const std::pair<const Any_function_3&, const Any_function_3&> refined(source.refined(), target.refined());
  return with_parameters(options, [&](const auto& parameters) {
    return register_surfaces<Tag>(source.function, source.mesh.points, target.function, target.mesh.points,
                                  parameters.refined_functions(refined));
  });
}

/// Whether the data choose the scale, and a file can be read again to try another one.
bool has_free_scale(const Source_options& source) {
  return source.kind == Source_kind::FIT && !source.fit.scale && source.text != "-";
}

/// The mean distance of the points of a fit from their six neighbors, before any transformation.
double spacing_of(const Source_options& source, const Surface_to_register& surface) {
  std::vector<Kernel::Point_3> points = surface.mesh.points;
  if (source.transformation)
    for (Kernel::Point_3& p : points) p = source.transformation->inverse()(p);
  return CGAL::compute_average_spacing<Tag>(points, 6);
}

/// The scale that one side has; else those from ten spacings on, while they are smaller than the surfaces: the same
/// length on both sides, since maps of scans mostly keep sizes, and each side's own multiple where points are not as
/// dense.
std::vector<Scales> scales_to_try(const Register_options& options, const Found_map& first) {
  for (const Surface_options* side : {&options.source, &options.target})
    if (const auto& given = side->source.fit.scale; given && *given > 0) return {{*given, *given}};
  constexpr double same = 1.2;
  Scales spacings = {spacing_of(options.source.source, first.source), spacing_of(options.target.source, first.target)};
  if (options.source.source.kind != Source_kind::FIT) spacings[0] = spacings[1];
  if (options.target.source.kind != Source_kind::FIT) spacings[1] = spacings[0];
  const double ratio = spacings[0] / spacings[1], greater = std::max(spacings[0], spacings[1]);
  const double greatest = std::min(diagonal_of(first.source.mesh.points), diagonal_of(first.target.mesh.points)) / 2;
  std::vector<Scales> scales;
  for (const double multiple : {10., 14., 7., 20.}) {
    scales.push_back({multiple * greater, multiple * greater});
    if (std::max(ratio, 1 / ratio) > same) scales.push_back({multiple * spacings[0], multiple * spacings[1]});
  }
  std::erase_if(scales, [=](const Scales& pair) { return std::max(pair[0], pair[1]) > greatest; });
  return scales;
}

/// The surfaces with fits at these scales where the scale is free, if such fits are possible.
std::optional<Found_map> at_scales(Register_options options, const Scales& scales, Progress& progress) {
  const bool is_shown = options.display.shows_something();
  Source_options &source = options.source.source, &target = options.target.source;
  if (has_free_scale(source)) source.fit.scale = scales[0];
  if (has_free_scale(target)) target.fit.scale = scales[1];
  try {
    return Found_map{make_surface_to_register(options.source, is_shown, progress),
                     make_surface_to_register(options.target, is_shown, progress)};
  } catch (const Input_error&) {
    return std::nullopt; // the scale is too large or too small for a surface
  }
}

std::string text_of(const Scales& scales) {
  std::ostringstream text;
  text.precision(2);
  text << scales[0];
  if (scales[1] != scales[0]) text << " and " << scales[1];
  return text.str();
}

/// The point of a level set near another one, by Newton's steps along the gradient.
Kernel::Point_3 on_surface(Kernel::Point_3 p, const Any_function_3& surface) {
  constexpr int steps = 3;
  for (int n = 0; n < steps; ++n) {
    const auto jet = surface.first_order(p);
    const auto& c = jet.coefficients();
    const Kernel::Vector_3 gradient(c[1], c[2], c[3]);
    p = p - c[0] / gradient.squared_length() * gradient;
  }
  return p;
}

/// The number of separate parts of the source, each as large as the scale, whose points lie on the target. Frames of a
/// pair of points make one part agree, and its neighbors with it, however unlike the surfaces are.
std::size_t number_of_matched_parts(const Found_map& found, const Registered_map_3<Kernel>& map) {
  constexpr std::size_t most_points = 4000;
  constexpr double part_on_target = 0.7, deviations = 4, least_part_of_scale = 1e-3;
  const auto& all = found.source.mesh.points;
  std::vector<Kernel::Point_3> points;
  for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / most_points) points.push_back(all[i]);
  std::vector<Kernel::Point_3> moved;
  for (const auto& p : points) moved.push_back(map.map(on_surface(p, found.source.refined())));
  const std::vector<double> distances = distances_from(found.target.refined())(moved);
  const double scale = *found.source.scale, square = scale * scale;
  const double greatest = std::max(deviations * map.rms, least_part_of_scale * scale);
  std::vector<Kernel::Point_3> centers;
  std::size_t parts = 0;
  for (const auto& center : points) {
    const auto is_near = [&](const auto& p) { return CGAL::squared_distance(p, center) < square; };
    if (std::any_of(centers.begin(), centers.end(), is_near)) continue;
    centers.push_back(center);
    double count = 0, on_target = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (4 * CGAL::squared_distance(points[i], center) < square) {
        ++count;
        on_target += distances[i] < greatest;
      }
    parts += on_target >= part_on_target * count;
  }
  return parts;
}

/// Whether the triangles of a file are the surface.
bool is_mesh(const Surface_options& options, const Surface_to_register& surface) {
  return is_mesh_itself(options) && !surface.mesh.triangles.empty();
}

bool are_meshes(const Register_options& options, const Found_map& found) {
  return is_mesh(options.source, found.source) && is_mesh(options.target, found.target);
}

/// Leaves out maps between closed meshes by which a large part of one is off the other, since frames along one edge make
/// many points agree, and maps between solids, whose corners a fit makes round. Distances, and which points are on the
/// other surface, become those of the triangles.
void judge_by_triangles(Found_map& found) {
  constexpr double most_contradictions = 0.1, deviations = 3;
  const auto &source = found.source.mesh, &target = found.target.mesh;
  std::erase_if(found.registration.maps, [&](auto& map) {
    const auto there = moved(source, map.map);
    const Mesh_contradictions found_here =
        contradictions_of_meshes(there.points, there.triangles, target.points, target.triangles, deviations * map.rms);
    const auto& parts = found_here.parts;
    map.contradictions = parts;
    map.inliers = found_here.inliers;
    map.rms = std::max(map.rms, found_here.rms);
    const bool is_contradicted =
        found_here.are_closed && *std::max_element(parts.begin(), parts.end()) > most_contradictions;
    const bool is_left_out = is_contradicted || (found_here.are_closed && found_here.are_exact_solids);
    found.maps_left_out += is_left_out;
    return is_left_out;
  });
  if (!found.registration.found()) found.registration.equally_good = 0;
}

/// Leaves out maps between fits at scales by which too few parts agree, and those that do not carry one scale to the
/// other if they were tried, since curvatures at different scales are not the same quantity. Makes the odds those of
/// all attempts together, and leaves out what is no better than chance then.
void judge_by_scales(std::size_t attempts, bool are_scales_tried, Found_map& found) {
  constexpr std::size_t fewest_parts = 6;
  constexpr double greatest_factor = 2; // of the volume
  const bool are_at_scale = found.source.scale && found.target.scale;
  const double ratio = are_at_scale ? *found.target.scale / *found.source.scale : 1;
  std::erase_if(found.registration.maps, [&](auto& map) {
    map.log10_false_alarms = std::min(0., map.log10_false_alarms + std::log10(double(attempts)));
    if (map.log10_false_alarms > accepted_log10) return true;
    if (!are_at_scale) return false;
    const double factor = std::abs(determinant_of(map.map)) / std::pow(ratio, 3);
    const bool is_of_other_size = std::max(factor, 1 / factor) > greatest_factor;
    const bool is_left_out =
        (are_scales_tried && is_of_other_size) || number_of_matched_parts(found, map) < fewest_parts;
    found.maps_left_out += is_left_out;
    return is_left_out;
  });
}

/// Finds the map by frames of curvature.
Found_map find_by_frames(const Register_options& options, Progress& progress) {
  const bool is_shown = options.display.shows_something();
  Found_map first{make_surface_to_register(options.source, is_shown, progress),
                  make_surface_to_register(options.target, is_shown, progress)};
  std::size_t hypotheses = 0, attempts = 0;
  const auto look = [&](Found_map& found, bool are_scales_tried) {
    progress.begin("looking for the map");
    found.registration = register_with(options, found.source, found.target);
    judge_by_scales(++attempts, are_scales_tried, found);
    if (are_meshes(options, found)) judge_by_triangles(found);
    found.registration.hypotheses += std::exchange(hypotheses, found.registration.hypotheses + hypotheses);
    return found.registration.found();
  };
  const bool is_free = has_free_scale(options.source.source) || has_free_scale(options.target.source);
  const bool is_at_scale = first.source.scale || first.target.scale;
  if ((!is_free || !is_at_scale) && look(first, false)) return first;
  if (!is_free) return first;
  for (const Scales& scales : scales_to_try(options, first)) {
    auto found = at_scales(options, scales, progress);
    if (!found) continue;
    first.tried.push_back(text_of(scales));
    found->tried = first.tried;
    found->maps_left_out = first.maps_left_out;
    if (look(*found, true)) return std::move(*found);
    first.maps_left_out = found->maps_left_out;
  }
  if (is_at_scale) look(first, false);
  else first.registration.hypotheses = hypotheses;
  return first;
}

/// Compares the triangles of two meshes as wholes and, for maps that keep angles, piece by piece.
void compare_triangles(const Register_options& options, Found_map& found, Progress& progress) {
  const auto &source = found.source.mesh, &target = found.target.mesh;
  progress.begin("comparing the triangles");
  auto by_triangles = with_parameters(options, [&](const auto& parameters) {
    return register_surfaces<Tag>(source.points, source.triangles, target.points, target.triangles, parameters);
  });
  by_triangles.hypotheses += found.registration.hypotheses;
  found.is_by_triangles = by_triangles.found();
  if (by_triangles.found()) {
    found.registration = std::move(by_triangles);
  } else {
    found.registration.hypotheses = by_triangles.hypotheses;
    found.registration.reason = std::move(by_triangles.reason);
    found.registration.slippage = std::move(by_triangles.slippage);
  }
}

} // namespace

Found_map find_map(const Register_options& options, Progress& progress) {
  Found_map found = find_by_frames(options, progress);
  const auto& source = found.source.mesh;
  if (!found.registration.found() && are_meshes(options, found)) compare_triangles(options, found, progress);
  else if (is_mesh(options.source, found.source)) // a fit makes edges round, and slides where they do not
    found.registration.slippage = slippage_of_mesh(source.points, source.triangles, options.maps.kind);
  return found;
}

Registration_report report_of(const Register_options& options, const Found_map& found) {
  Registration_report report = {describe(options.source.source),
                                describe(options.target.source),
                                found.registration,
                                options.number_of_maps.has_value(),
                                found.is_by_triangles,
                                found.maps_left_out,
                                found.tried,
                                {}};
  if (!report.registration.found()) report.advice = what_to_try(options, found);
  return report;
}

namespace {

/// How far symmetries may move points from the surface, a part of its size: splines and fits know the surface to within
/// their errors only.
std::optional<double> tolerance_of(const Symmetries_options& options) {
  const Source_options& source = options.surface.source;
  if (options.tolerance) return options.tolerance;
  if (source.kind == Source_kind::FIT) return 1e-3;
  if (source.derivatives == Derivatives::SPLINE) return 1e-5;
  return std::nullopt;
}

/// The triangles of the file that the source names, none if it has no faces.
Indexed_triangle_mesh_3<Kernel> read_triangles(const Source_options& source, Progress& progress) {
  progress.begin("reading the mesh");
  Indexed_triangle_mesh_3<Kernel> mesh = read_vertices(source).mesh;
  if (source.transformation)
    for (Kernel::Point_3& p : mesh.points) p = (*source.transformation)(p);
  return mesh;
}

auto parameters_of(const Symmetries_options& options) {
  return parameters::map_kind(options.maps.kind).reflections(options.maps.allows_reflections);
}

Symmetries symmetries_of_function(const Surface_to_register& surface, const Symmetries_options& options) {
  const auto parameters = parameters_of(options).complete(options.is_complete);
  const auto tolerance = tolerance_of(options);
  const auto& points = surface.mesh.points;
  if (!tolerance) return affine_symmetries<CGAL::Parallel_if_available_tag>(surface.function, points, parameters);
  return affine_symmetries<CGAL::Parallel_if_available_tag>(surface.function, points, parameters.tolerance(*tolerance));
}

Symmetries symmetries_of_mesh(const Indexed_triangle_mesh_3<Kernel>& mesh, const Symmetries_options& options) {
  const auto parameters = parameters_of(options);
  if (!options.tolerance)
    return affine_symmetries<CGAL::Parallel_if_available_tag>(mesh.points, mesh.triangles, parameters);
  return affine_symmetries<CGAL::Parallel_if_available_tag>(mesh.points, mesh.triangles,
                                                            parameters.tolerance(*options.tolerance));
}

} // namespace

std::string Found_symmetries::name(const Source_options& source) const {
  return level_set ? describe(source) : "the mesh '" + name_of_file(source.text) + "'";
}

Annotated_mesh_3<Kernel> Found_symmetries::shown() const {
  return surface_with_symmetries(mesh, symmetries,
                                 level_set ? distances_from(level_set->function) : distances_from(mesh));
}

Found_symmetries find_symmetries(const Symmetries_options& options, Progress& progress) {
  Found_symmetries found;
  const Source_options& source = options.surface.source;
  if (is_mesh_itself(options.surface)) {
    found.mesh = read_triangles(source, progress);
    if (!found.mesh.triangles.empty()) {
      progress.begin("looking for symmetries");
      found.symmetries = symmetries_of_mesh(found.mesh, options);
      if (!is_undecided(found.symmetries) || keeps_angles(options.maps.kind) || !found.symmetries.levels.empty())
        return found;
    }
  }
  const bool is_fit = source.kind == Source_kind::FIT;
  found.level_set = make_surface_to_register(options.surface, is_fit || options.display.shows_something(), progress);
  const Surface_to_register& surface = *found.level_set;
  const bool has_points_only = is_fit && surface.mesh.triangles.empty() && !surface.extracted.triangles.empty();
  progress.begin("looking for symmetries");
  const Symmetries by_function =
      has_points_only ? symmetries_of_mesh(surface.shown(), options) : symmetries_of_function(surface, options);
  if (!is_undecided(by_function) || found.mesh.triangles.empty()) found.symmetries = by_function;
  found.mesh = surface.shown();
  return found;
}

Symmetries_report report_of(const Symmetries_options& options, const Found_symmetries& found) {
  Symmetries_report report = {found.name(options.surface.source),
                              found.symmetries,
                              options.is_complete,
                              keeps_angles(found.symmetries.kind) && !keeps_angles(options.maps.kind),
                              {}};
  if (!std::isfinite(report.symmetries.maps.front().rms))
    throw Input_error("nothing is known of the symmetries of " + report.source +
                      ": it has a surface beside none of its points; give more points");
  if (is_undecided(report.symmetries) || report.symmetries.order() == 1U)
    report.advice = what_to_try(options, report.symmetries);
  return report;
}

} // namespace equiaffine
