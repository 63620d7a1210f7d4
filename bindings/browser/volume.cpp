// SPDX-License-Identifier: GPL-3.0-or-later
// Level sets of a volume. The volume and its spline stay in memory until the next volume.
#include "sample.h"
#include <equiaffine/attributes/Curvature_error_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Volume_3.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace {

struct Fitted_volume {
  equiaffine::Volume_view_3<Kernel> samples;
  double smoothing;
  equiaffine::Sampled_function_traits_3<Kernel> spline;
  equiaffine::Curvature_error_3<Kernel> errors;
  double noise;                               ///< of the samples near the last level set
  std::optional<std::size_t> distinct_values; ///< number of distinct samples if small
};

std::vector<double> values;
std::optional<Fitted_volume> fitted;

/// Adds the errors of those affine curvatures that are columns of the surface.
void add_errors() {
  auto& columns = surface.attributes.columns;
  const auto has = [&](const char* name) { return equiaffine::find_column(surface.attributes, name) != nullptr; };
  const bool has_gaussian = has("affine_gaussian_curvature"), has_mean = has("affine_mean_curvature");
  if (!has_gaussian && !has_mean) return;
  std::vector<double> gaussian, mean;
  for (const auto& p : surface.mesh.points) {
    const auto error = fitted->errors(p);
    gaussian.push_back(error.affine_gaussian_curvature);
    mean.push_back(error.affine_mean_curvature);
  }
  if (has_gaussian) columns.push_back({"affine_gaussian_curvature_error", std::move(gaussian)});
  if (has_mean) columns.push_back({"affine_mean_curvature_error", std::move(mean)});
}

} // namespace

/// Allocates the values of a volume; i runs fastest.
EXPORTED double* eq_values(int nodes) {
  fitted.reset();
  try {
    values.assign(std::size_t(nodes), 0);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  return values.data();
}

/// Uses the values as a volume of nx, ny, nz nodes; `placing` contains its origin and its three steps. `smoothing` is a
/// scale in steps, 0 for none.
EXPORTED int eq_volume(int nx, int ny, int nz, const double* placing, double smoothing) {
  return outcome_of([&] {
    const auto vector = [&](int k) { return Kernel::Vector_3(placing[3 * k], placing[3 * k + 1], placing[3 * k + 2]); };
    const equiaffine::Lattice_3<Kernel> lattice({std::size_t(nx), std::size_t(ny), std::size_t(nz)},
                                                CGAL::ORIGIN + vector(0), {vector(1), vector(2), vector(3)});
    const CGAL::Sequential_tag tag;
    const equiaffine::Volume_view_3<Kernel> samples(equiaffine::Volume_3<Kernel>{lattice, std::exchange(values, {})});
    const equiaffine::Sampled_function_traits_3<Kernel> spline(samples, {.smoothing = smoothing}, tag);
    fitted = Fitted_volume{samples, smoothing,
                           spline,  equiaffine::Curvature_error_3<Kernel>(spline, samples, smoothing, 0, tag),
                           0,       equiaffine::number_of_few_values(equiaffine::Volume_parts_3<Kernel>::of(samples))};
  });
}

/// Meshes a level set of the volume on its own lattice, with estimates of the errors of affine curvatures.
EXPORTED int eq_level_set(double level, const char* attributes) {
  return outcome_of([&] {
    surface = {};
    if (!fitted) throw equiaffine::Input_error("there is no volume; call takeVolume first");
    sample(equiaffine::Level_set_traits_3(fitted->spline, level), attributes);
    fitted->noise = equiaffine::estimate_noise<CGAL::Sequential_tag>(fitted->samples, level).deviation;
    fitted->errors = fitted->errors.with_noise(fitted->smoothing, fitted->noise);
    add_errors();
  });
}

/// The standard deviation of the noise of the samples near the last level set.
EXPORTED double eq_noise() { return fitted ? fitted->noise : std::numeric_limits<double>::quiet_NaN(); }
/// The number of distinct sample values if at most 256, otherwise 0.
EXPORTED int eq_distinct_values() { return fitted ? int(fitted->distinct_values.value_or(0)) : 0; }
