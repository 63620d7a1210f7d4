// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/what_to_try.h"

#include <initializer_list>

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

} // namespace

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

} // namespace equiaffine
