// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the function of a source, with the facts about its samples or data that the program reports.
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

/// The facts about samples, and about the spline that was made from them, that the program reports.
struct Spline_statistics {
  int degree = 0;
  Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION;
  double smoothing = 0;
  bool is_smoothing_chosen = false; ///< by the noise, and not given
  Sample_noise noise = {};
  std::size_t least_nodes = 0;                     ///< along the axis that has the fewest
  std::optional<std::size_t> distinct_values = {}; ///< the number of those of the samples, if they are at most 256
};

struct Source {
  Source_function function;
  std::size_t function_evaluations = 0;                 ///< the number that it took to make the source
  std::optional<Spline_statistics> spline = {};         ///< if derivatives are those of a spline
  std::optional<Curvature_error_3<Kernel>> errors = {}; ///< of that spline, if estimates were asked for
  std::optional<Fit_traits> fit = {};             ///< if derivatives are those of a fit, before any transformation
  std::optional<Source_function> unsmoothed = {}; ///< of a smoothed spline that is registered
  Indexed_triangle_mesh_3<Kernel> data = {};      ///< of a fit, not transformed
};

/// Makes the function. This may include reading a volume, measuring distances, and fitting a spline. A fit has values
/// for Delaunay facets of that radius. Throws `Input_error`.
Source make_source(const Source_options& options, Progress& progress, double radius = 0);

/// The source of a fit that was made before, to those data.
Source source_of_fit(const Fit_traits& fit, Indexed_triangle_mesh_3<Kernel> data, const Source_options& options,
                     double radius = 0);

/// The source of a fit to a mesh, fitted again with other options. Throws `Input_error`.
Source refitted(const Source& source, const Source_options& options, Progress& progress);

/// The nodes per axis of a source that is sampled, if none are given.
std::array<std::size_t, 3> default_resolution(Source_kind kind);

/// The samples of a source that is not a volume.
Volume_3<Kernel> sample_source(const Source_options& options, Progress& progress);

/// "the formula x^2 + y^2 = 1", "the volume 'skull.nrrd'", "the distance to 'bunny.off'": files by their names, without
/// folders.
std::string describe(const Source_options& options);

} // namespace equiaffine

#endif
