// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses between the searches for a map: the scales at which fits are compared, the maps that are kept, and what to
// try if there is none.
#include "registration/surface_of_data.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/Registration_options.h>
#include <equiaffine/registration/contradictions_of_meshes.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/internal/searches.h>
#include <equiaffine/registration/register_surfaces.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

/// Thresholds for maps between surfaces, in addition to those of each search.
struct Surface_thresholds {
  // The scales of fits that are tried.
  std::array<double, 4> spacings = {10, 14, 7, 20}; ///< multiples of the mean spacing of the points
  double same_spacing = 1.2;                        ///< spacings with a smaller ratio count as equal
  double greatest_scale = 0.5;                      ///< relative to the diagonal of the smaller surface

  // Maps between surfaces at a scale.
  std::size_t fewest_parts = 6;      ///< separate parts of the source, each as large as the scale, that must lie on the target
  double part_on_target = 0.7;       ///< the fraction of the points of such a part
  std::size_t most_points = 4000;    ///< by which parts are judged
  double deviations = 4;             ///< standard deviations within which a point lies on the target
  double least_part_of_scale = 1e-3; ///< a distance within which it does for any deviation
  double greatest_factor = 2;        ///< by which the changes of volume and scale may differ

  // Maps between closed meshes.
  double most_contradictions = 0.1;        ///< the fraction of a mesh that may be off the other one
  double deviations_of_contradictions = 3; ///< standard deviations beyond which a point is off
};

constexpr Surface_thresholds surface_thresholds;

/// The scales of the two fits.
using Scales = std::array<double, 2>;

bool is_fitted(const Surface_to_register& surface) { return surface.origin == Surface_origin::FIT; }

bool are_meshes(const Registration_of_surfaces& found) { return found.source.is_mesh && found.target.is_mesh; }

Triangles_3 triangles_of_mesh(const Mesh_of_searches& mesh) { return triangles_of_soup(mesh.points, mesh.triangles); }

/// Returns the point of a level set close to a given one, by Newton steps along the gradient.
Kernel_of_searches::Point_3 on_level_set(Kernel_of_searches::Point_3 p, const Any_function_3& surface) {
  constexpr int steps = 3;
  for (int n = 0; n < steps; ++n) {
    const auto jet = surface.first_order(p);
    const auto& c = jet.coefficients();
    const Kernel_of_searches::Vector_3 gradient(c[1], c[2], c[3]);
    p = p - c[0] / gradient.squared_length() * gradient;
  }
  return p;
}

/// The number of separate parts of the source, each as large as the scale, whose points lie on the target. The frames of
/// a pair of points make one part and its neighbors agree, even if the surfaces are different.
std::size_t number_of_matched_parts(bool in_threads, const Registration_of_surfaces& found,
                                    const Registered_map_3<Kernel_of_searches>& map) {
  const Surface_thresholds& limits = surface_thresholds;
  const auto& all = found.source.mesh.points;
  std::vector<Kernel_of_searches::Point_3> points, moved;
  for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / limits.most_points) points.push_back(all[i]);
  for (const auto& p : points) moved.push_back(map.map(on_level_set(p, found.source.refined())));
  const std::vector<double> distances = distances_from_image(in_threads, moved, found.target.refined());
  const double scale = *found.source.scale, square = scale * scale;
  const double greatest = std::max(limits.deviations * map.rms, limits.least_part_of_scale * scale);
  std::vector<Kernel_of_searches::Point_3> centers;
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
    parts += on_target >= limits.part_on_target * count;
  }
  return parts;
}

/// Removes maps between closed meshes that leave a large part of one off the other, since frames along one edge make many
/// points agree; and maps between solids, whose corners a fit rounds. Distances, and which points are on the other
/// surface, are then measured by the triangles.
void judge_by_triangles(Registration_of_surfaces& found) {
  const Triangles_3 target = triangles_of_mesh(found.target.mesh);
  std::erase_if(found.result.maps, [&](auto& map) {
    const Mesh_contradictions there =
        contradictions_of_triangles(triangles_of_mesh(moved_mesh(found.source.mesh, map.map)), target,
                                    surface_thresholds.deviations_of_contradictions * map.rms);
    map.contradictions = there.parts;
    map.inliers = there.inliers;
    map.rms = std::max(map.rms, there.rms);
    const bool is_contradicted = std::max(there.parts[0], there.parts[1]) > surface_thresholds.most_contradictions;
    const bool is_left_out = there.are_closed && (is_contradicted || there.are_exact_solids);
    found.result.maps_left_out += is_left_out;
    return is_left_out;
  });
  if (!found.result.found()) found.result.equally_good = 0;
}

/// Searches for a map by frames of curvature. Curvatures of two fits can be compared only at the same scale, so fits with
/// a scale chosen from the data are tried at multiples of the spacing of their points until a map is found.
class Search_at_scales {
public:
  Search_at_scales(bool in_threads, const Registration_options& options) : in_threads_(in_threads), options_(options) {}

  Registration_of_surfaces run(Surface_to_register source, Surface_to_register target) {
    Registration_of_surfaces first{std::move(source), std::move(target)};
    const bool is_free = first.source.at_scale || first.target.at_scale;
    const bool is_at_scale = first.source.scale || first.target.scale;
    if ((!is_free || !is_at_scale) && look(first, false)) return first;
    if (!is_free) return first;
    for (const Scales& scales : scales_to_try(first)) {
      auto found = at_scales(first, scales);
      if (!found) continue;
      first.result.scales.push_back(scales);
      found->result.scales = first.result.scales;
      found->result.maps_left_out = first.result.maps_left_out;
      if (look(*found, true)) return std::move(*found);
      first.result.maps_left_out = found->result.maps_left_out;
    }
    if (is_at_scale) look(first, false);
    else first.result.hypotheses = hypotheses_;
    return first;
  }

private:
  /// Searches for a map between the surfaces as given. The number of hypotheses accumulates over all searches.
  bool look(Registration_of_surfaces& found, bool are_scales_tried) {
    auto result = registration_of_functions(in_threads_, found.source, found.target, options_).result;
    result.scales = std::move(found.result.scales);
    result.maps_left_out = found.result.maps_left_out;
    found.result = std::move(result);
    ++attempts_;
    judge_by_scales(are_scales_tried, found);
    if (are_meshes(found)) judge_by_triangles(found);
    hypotheses_ += found.result.hypotheses;
    found.result.hypotheses = hypotheses_;
    return found.result.found();
  }

  /// The given scale of one side; otherwise those from ten spacings up to the size of the surfaces: the same length on
  /// both sides, since maps of scans mostly preserve sizes, and the multiple of each side's own spacing if the densities
  /// differ.
  static std::vector<Scales> scales_to_try(const Registration_of_surfaces& first) {
    for (const Surface_to_register* side : {&first.source, &first.target})
      if (const auto& given = side->given_scale; given && *given > 0) return {{*given, *given}};
    Scales spacings = {first.source.spacing, first.target.spacing};
    if (!is_fitted(first.source)) spacings[0] = spacings[1];
    if (!is_fitted(first.target)) spacings[1] = spacings[0];
    const double ratio = spacings[0] / spacings[1], greater = std::max(spacings[0], spacings[1]);
    const double greatest = surface_thresholds.greatest_scale *
                            std::min(diagonal_of(first.source.mesh.points), diagonal_of(first.target.mesh.points));
    std::vector<Scales> scales;
    for (const double multiple : surface_thresholds.spacings) {
      scales.push_back({multiple * greater, multiple * greater});
      if (std::max(ratio, 1 / ratio) > surface_thresholds.same_spacing)
        scales.push_back({multiple * spacings[0], multiple * spacings[1]});
    }
    std::erase_if(scales, [=](const Scales& pair) { return std::max(pair[0], pair[1]) > greatest; });
    return scales;
  }

  /// The surfaces with fits at these scales if the scale is free and such fits are possible.
  static std::optional<Registration_of_surfaces> at_scales(const Registration_of_surfaces& first,
                                                           const Scales& scales) {
    const auto at_scale = [](const Surface_to_register& surface, double scale) {
      return surface.at_scale ? surface.at_scale(scale) : surface;
    };
    try {
      return Registration_of_surfaces{at_scale(first.source, scales[0]), at_scale(first.target, scales[1])};
    } catch (const Input_error&) {
      return std::nullopt; // the scale is too large or too small for a surface
    }
  }

  /// Removes maps between fits at scales for which too few parts agree. If several scales were tried, also removes maps
  /// that do not map one scale to the other, since curvatures at different scales are different quantities. The
  /// significance becomes that of all attempts together, and maps that are no better than chance are removed.
  void judge_by_scales(bool are_scales_tried, Registration_of_surfaces& found) const {
    const bool are_at_scale = found.source.scale && found.target.scale;
    const double ratio = are_at_scale ? *found.target.scale / *found.source.scale : 1;
    std::erase_if(found.result.maps, [&](auto& map) {
      map.log10_false_alarms = std::min(0., map.log10_false_alarms + std::log10(double(attempts_)));
      if (map.log10_false_alarms > accepted_log10) return true;
      if (!are_at_scale) return false;
      const double factor = std::abs(determinant_of(map.map)) / std::pow(ratio, 3);
      const bool is_of_other_size = std::max(factor, 1 / factor) > surface_thresholds.greatest_factor;
      const bool is_left_out = (are_scales_tried && is_of_other_size) ||
                               number_of_matched_parts(in_threads_, found, map) < surface_thresholds.fewest_parts;
      found.result.maps_left_out += is_left_out;
      return is_left_out;
    });
  }

  bool in_threads_;
  const Registration_options& options_;
  std::size_t attempts_ = 0, hypotheses_ = 0;
};

/// Compares the triangles of two whole meshes and, for maps that preserve angles, of their pieces.
void compare_triangles(bool in_threads, const Registration_options& options, Registration_of_surfaces& found) {
  auto by_triangles = registration_of_triangles(in_threads, triangles_of_mesh(found.source.mesh),
                                                triangles_of_mesh(found.target.mesh), options);
  by_triangles.hypotheses += found.result.hypotheses;
  if (by_triangles.found()) {
    by_triangles.is_by_triangles = true;
    by_triangles.scales = std::move(found.result.scales);
    by_triangles.maps_left_out = found.result.maps_left_out;
    found.result = std::move(by_triangles);
  } else {
    found.result.hypotheses = by_triangles.hypotheses;
    found.result.reason = std::move(by_triangles.reason);
    found.result.slippage = std::move(by_triangles.slippage);
  }
}

/// Whether both are meshes with too few points for any scale.
bool lacks_curvature(const Registration_of_surfaces& found) {
  const auto lacks = [](const Surface_to_register& side) {
    return is_fitted(side) && !side.given_scale && !side.scale && !side.mesh.triangles.empty();
  };
  return lacks(found.source) && lacks(found.target) && found.result.scales.empty();
}

void add_for_scales(const Surface_to_register& source, const Surface_to_register& target,
                    std::vector<Registration_advice>& advice) {
  using enum Registration_advice;
  const auto &scale = source.given_scale, &other = target.given_scale;
  if (is_fitted(source) && is_fitted(target))
    advice.push_back(scale && scale == other ? LARGER_SAME_SCALE : SAME_SCALE);
  else if (is_fitted(source) || is_fitted(target))
    advice.push_back((is_fitted(source) ? scale : other) ? LARGER_SCALE : A_SCALE);
}

/// What to try if no map was found, the most promising first. Pieces of meshes without curvature can be matched only by
/// maps that preserve angles, and inaccurate derivatives have frames that do not agree or are wrong.
std::vector<Registration_advice> advice_for_map(const Registration_options& options,
                                                const Registration_of_surfaces& found) {
  using enum Registration_advice;
  const auto& [source, target, result] = found;
  const auto comes_from = [&](Surface_origin origin) { return source.origin == origin || target.origin == origin; };
  const bool lacks = lacks_curvature(found), is_rigid = options.kind == Map_kind::RIGID;
  std::vector<Registration_advice> advice;
  if (lacks) {
    if (is_rigid) advice.push_back(SIMILARITIES_OF_OTHER_SIZE);
    if (!keeps_angles(options.kind)) advice.push_back(SIMILARITIES_OF_TRIANGLES);
  } else {
    if ((comes_from(Surface_origin::FIT) || result.hypotheses == 0) && !keeps_angles(options.kind))
      advice.push_back(SIMILARITIES_OF_FRAMES);
    add_for_scales(source, target, advice);
    if (comes_from(Surface_origin::DISTANCE)) advice.push_back(FIT_OF_MESH);
    if (comes_from(Surface_origin::RAW_VOLUME)) advice.push_back(SMOOTHING);
    if (is_rigid) advice.push_back(SIMILARITIES_OF_OTHER_SIZE);
    if (options.kind != Map_kind::AFFINE) advice.push_back(ALL_MAPS);
  }
  if (!options.reflections) advice.push_back(REFLECTIONS);
  if (result.hypotheses > 0 && options.min_overlap > Registration_options().min_overlap)
    advice.push_back(SMALLER_OVERLAP);
  advice.push_back(MORE_IN_COMMON);
  return advice;
}

} // namespace

std::vector<double> distances_from_image(bool in_threads, const std::vector<Kernel_of_searches::Point_3>& points,
                                         const Any_function_3& surface,
                                         const Kernel_of_searches::Aff_transformation_3& back) {
  const CGAL::Bbox_3 box = surface.bbox();
  std::vector<double> result(points.size(), std::numeric_limits<double>::quiet_NaN());
  parallel_for(
      in_threads, 0, points.size(),
      [&](std::size_t i) {
        const auto p = back(points[i]);
        for (int axis = 0; axis < 3; ++axis)
          if (!(box.min(axis) <= p[axis] && p[axis] <= box.max(axis))) return;
        const auto jet = surface.first_order(p);
        const auto& c = jet.coefficients();
        std::array<double, 3> gradient{};
        for (int k = 0; k < 3; ++k)
          gradient[std::size_t(k)] = c[1] * back.m(0, k) + c[2] * back.m(1, k) + c[3] * back.m(2, k);
        result[i] = std::abs(c[0]) / std::hypot(gradient[0], gradient[1], gradient[2]);
      },
      64);
  return result;
}

Registration_of_surfaces registration_of_surfaces(bool in_threads, Surface_to_register source,
                                                  Surface_to_register target, const Registration_options& options) {
  Registration_of_surfaces found = Search_at_scales(in_threads, options).run(std::move(source), std::move(target));
  if (!found.result.found() && are_meshes(found)) compare_triangles(in_threads, options, found);
  else if (found.source.is_mesh) // a fit rounds edges, and may slide where they do not
    found.result.slippage = slippage_of_triangles(in_threads, triangles_of_mesh(found.source.mesh), options.kind);
  if (!found.result.found()) found.result.advice = advice_for_map(options, found);
  return found;
}

Surface_registration_3<Kernel_of_searches> registration_of_data(bool in_threads, const Surface_data_3& source,
                                                                const Surface_data_3& target,
                                                                const Registration_options& options) {
  const auto surface = [&](const Surface_data_3& data) {
    return surface_of_data(in_threads, data, options.fit, Use_of_surface::REGISTRATION);
  };
  return registration_of_surfaces(in_threads, surface(source), surface(target), options).result;
}

} // namespace equiaffine::internal
