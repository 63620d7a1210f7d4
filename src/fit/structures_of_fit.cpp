// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/Curvature_fit_3.h"
#include "fit/Fitted_data_3.h"
#include "fit/Local_fit_3.h"
#include "fit/fit_input.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/function/Level_set_traits_3.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

/// Moves a point along gradients to the zero set of a patch, if that is close.
std::optional<Eigen::Vector3d> foot_on_patch(const Patch_3& patch, const Eigen::Vector3d& p) {
  const auto foot = foot_on_surface(
      p, [&](const Eigen::Vector3d& q) { return patch.taylor<1>(q); },
      [&](const Eigen::Vector3d&) { return 0.25 * patch.radius; }, 1e-12 * patch.radius, 20);
  return foot ? std::optional(foot->point) : std::nullopt;
}

/// The distance between the centers of fits relative to their radius. With small radii there are fits at every
/// point.
constexpr double distance_of_direct_fits = 0.1;

/// The same at a given scale, where the curvatures at a point are those of the fit around it: on a scan, K of a fit
/// with a center a tenth of the radius away differs by as much as the effect of noise.
constexpr double distance_of_direct_fits_at_scale = 0.02;

/// Rejects data in units in which affine curvatures, or their intermediate results, overflow or underflow double
/// precision.
void check_extent(const Fitted_data_3& fit) {
  check_argument(Extent_of_fit::has(fit.diagonal()),
                 "the diagonal of the bounding box of the points is below 1e-40 or above 1e40: choose another unit");
}

/// The structure at a data point, from the fit around it.
Fitted_structure_3<double> structure_at_point(const Fitted_data_3& fit, Data_points_3::Index i,
                                              Orientation_of_level_set orientation) {
  check_extent(fit);
  const Data_points_3& data = fit.data();
  const auto& choice = fit.choices().at(data.points[i]);
  const auto curvature = choice ? curvature_fit(data, i, *choice, fit.choices(), Fit_use::NUMBERS) : std::nullopt;
  const auto foot = curvature ? foot_on_patch(curvature->patch, data.points[i]) : std::nullopt;
  if (!foot) return structure_without_fit();
  return structure_of(curvature->patch.taylor(*foot), fit, curvature->accuracy, orientation);
}

std::vector<Fitted_structure_3<double>> structures_of_fit(bool in_threads, const Fitted_data_3& fit,
                                                          Orientation_of_level_set orientation) {
  check_extent(fit);
  const Data_points_3& data = fit.data();
  const double distance = fit.choices().scale() ? distance_of_direct_fits_at_scale : distance_of_direct_fits;
  const Patch_cover_3 cover = patch_cover(in_threads, data, fit.choices(), Fit_use::NUMBERS, distance);
  std::vector<Fitted_structure_3<double>> structures(data.size(), structure_without_fit());
  parallel_for(
      in_threads, 0, data.size(),
      [&](std::size_t i) {
        const auto k = cover.nearest[i];
        if (k == Patch_cover_3::none || !cover.fits[k]) return;
        const Patch_3& patch = cover.fits[k]->patch;
        if (const auto foot = foot_on_patch(patch, data.points[i]))
          structures[i] = structure_of(patch.taylor(*foot), fit, cover.fits[k]->accuracy, orientation);
      },
      64);
  return structures;
}

} // namespace

std::vector<Fitted_structure_3<double>> structures_of_data(bool in_threads, Fit_data_3 given,
                                                           const Fit_options& options,
                                                           Orientation_of_level_set orientation) {
  options.check();
  const std::size_t count = given.points.size();
  const bool is_mesh = given.kind == Fit_data_3::Kind::MESH;
  Fit_input_3 input = fit_input(in_threads, std::move(given), options);
  const Fitted_data_3 fit(in_threads, std::move(input.data), options);
  auto structures = structures_of_fit(in_threads, fit, orientation);
  if (!is_mesh) return elements_at(structures, input.positions);
  structures.resize(count); // drops the copies at creases
  return structures;
}

Fitted_structure_3<double> structure_of_vertex(Fit_data_3 given, const Fit_options& options,
                                               Orientation_of_level_set orientation, std::size_t i) {
  options.check();
  const Fitted_data_3 fit(false, fit_input(false, std::move(given), options).data, options);
  return structure_at_point(fit, Data_points_3::Index(i), orientation);
}

} // namespace equiaffine::internal
