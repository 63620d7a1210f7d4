// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the function of a source, and collects what the program reports about its samples or data.
#ifndef EQUIAFFINE_PROGRAM_SOURCE_SOURCE_H
#define EQUIAFFINE_PROGRAM_SOURCE_SOURCE_H

#include "request/source_options.h"
#include "source/source_function.h"
#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/attributes/Curvature_error_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Volume_options.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace equiaffine {

/// What the program reports about samples and their spline.
struct Spline_statistics {
  int degree = 0;
  Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION;
  double smoothing = 0;
  bool is_smoothing_chosen = false; ///< whether smoothing was chosen from the noise, not given
  Sample_noise noise = {};
  std::size_t least_nodes = 0;                     ///< minimum over the axes
  std::optional<std::size_t> distinct_values = {}; ///< the number of distinct samples, if at most 256
};

struct Source {
  Source_function function;
  std::size_t function_evaluations = 0;                 ///< to make the source
  std::optional<Spline_statistics> spline = {};         ///< if derivatives are those of a spline
  std::optional<Curvature_error_3<Kernel>> errors = {}; ///< of that spline, if estimates were requested
  std::optional<Fit_traits> fit = {};             ///< if derivatives are those of a fit, before any transformation
  std::optional<Source_function> unsmoothed = {}; ///< for the registration of a smoothed spline
  Indexed_triangle_mesh_3<Kernel> data = {};      ///< of a fit, not transformed
};

/// Makes the function. This may include reading a volume, computing distances, and fitting a spline. A fit is defined
/// far enough from its data for Delaunay facets of the radius. Throws `Input_error`.
Source make_source(const Source_options& options, Progress& progress, double radius = 0);

/// The source of an existing fit to the data.
Source source_of_fit(const Fit_traits& fit, Indexed_triangle_mesh_3<Kernel> data, const Source_options& options,
                     double radius = 0);

/// Fits the data of a source again with other options. Throws `Input_error`.
Source refitted(const Source& source, const Source_options& options, Progress& progress);

/// The default number of nodes per axis of a sampled source.
std::array<std::size_t, 3> default_resolution(Source_kind kind);

/// Samples a source that is not a volume.
Volume_3<Kernel> sample_source(const Source_options& options, Progress& progress);

/// "the formula x^2 + y^2 = 1", "the volume 'skull.nrrd'", "the distance to 'bunny.off'": files without folders.
std::string describe(const Source_options& options);

} // namespace equiaffine

#endif
